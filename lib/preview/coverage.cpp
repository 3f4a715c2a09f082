// SPDX-License-Identifier: GPL-3.0-or-later
#include "preview/coverage.h"

#include "core/stop.h"
#include "tasks/tasks.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

namespace weft::preview {
namespace {

constexpr Um finest_cell = 100;     // µm
constexpr Um most_cells = 8192;     // along a side
constexpr double sample_mm = 0.4;   // between samples along a bead: a nozzle
constexpr int across = 9;           // samples across a bead
constexpr int most_samples = 1000;  // along one piece

/// Where a row meets a bead: the hull of what it meets of the discs at both ends and of the strip between.
struct Span {
  double from = 1e300, to = -1e300;
  void add(double x) { from = std::min(from, x), to = std::max(to, x); }
  void disc(Point centre, double radius, double y) {
    const double dy = y - centre.y, half2 = radius * radius - dy * dy;
    if (half2 < 0) return;
    const double half = std::sqrt(half2);
    add(centre.x - half), add(centre.x + half);
  }
  void edge(double x0, double y0, double x1, double y1, double y) {
    if ((y0 <= y) == (y1 <= y)) return;
    add(x0 + (y - y0) * (x1 - x0) / (y1 - y0));
  }
};

/// The index of the layer that the bead lies on; none: the bed.
std::optional<std::size_t> layer_below(const Toolpaths& paths, std::size_t layer, const Stroke& bead) {
  const Um foot = bead.z - bead.height + bead.height / 4;
  for (std::size_t i = layer; i-- > 0;)
    if (paths.layers[i].z <= foot) return i;
  return std::nullopt;
}

double supported_share(const Coverage& below, const Stroke& bead) {
  const double dx = bead.to.x - bead.from.x, dy = bead.to.y - bead.from.y, length = std::hypot(dx, dy);
  if (length == 0) return 1;
  const int along = static_cast<int>(std::clamp(std::ceil(length / 1000 / sample_mm), 1.0, double{most_samples}));
  int hits = 0;
  for (int i = 0; i < along; ++i) {
    const double t = (i + 0.5) / along;
    for (int j = 0; j < across; ++j) {
      const double s = bead.width * ((j + 0.5) / across - 0.5) / length;
      hits += below.at({static_cast<Um>(std::lround(bead.from.x + t * dx - s * dy)),
                        static_cast<Um>(std::lround(bead.from.y + t * dy + s * dx))});
    }
  }
  return static_cast<double>(hits) / (along * across);
}

}  // namespace

Coverage::Coverage(Box window)
    : origin_(window.min),
      cell_(std::max({finest_cell, window.size().x / most_cells + 1, window.size().y / most_cells + 1})),
      width_(window.empty() ? 0 : window.size().x / cell_ + 1),
      height_(window.empty() ? 0 : window.size().y / cell_ + 1),
      stride_(static_cast<std::size_t>((width_ + 63) / 64)),
      bits_(stride_ * static_cast<std::size_t>(height_)) {}

void Coverage::fill(std::int64_t row, double from_um, double to_um) {
  const auto cell_from = [&](double x) { return std::ceil((x - origin_.x) / cell_ - 0.5); };
  const auto first = static_cast<std::int64_t>(std::clamp(cell_from(from_um), 0.0, static_cast<double>(width_)));
  const auto end = static_cast<std::int64_t>(std::clamp(cell_from(to_um), 0.0, static_cast<double>(width_)));
  std::uint64_t* words = &bits_[static_cast<std::size_t>(row) * stride_];
  for (std::int64_t x = first; x < end;) {
    const auto bit = static_cast<unsigned>(x % 64);
    const auto count = static_cast<unsigned>(std::min<std::int64_t>(64 - bit, end - x));
    words[x / 64] |= (count == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << count) - 1) << bit;
    x += count;
  }
}

void Coverage::add(const Stroke& bead) {
  if (bits_.empty()) return;
  const double radius = bead.width / 2.0;
  const double dx = bead.to.x - bead.from.x, dy = bead.to.y - bead.from.y, length = std::hypot(dx, dy);
  const double nx = length > 0 ? -dy / length * radius : 0, ny = length > 0 ? dx / length * radius : 0;
  const auto row_of = [&](double y) { return std::floor((y - origin_.y) / cell_); };
  const double top = static_cast<double>(height_ - 1);
  const auto first = static_cast<std::int64_t>(std::clamp(row_of(std::min(bead.from.y, bead.to.y) - radius), 0.0, top));
  const auto last = static_cast<std::int64_t>(std::clamp(row_of(std::max(bead.from.y, bead.to.y) + radius), 0.0, top));
  for (std::int64_t row = first; row <= last; ++row) {
    const double y = origin_.y + (static_cast<double>(row) + 0.5) * cell_;
    Span span;
    span.disc(bead.from, radius, y), span.disc(bead.to, radius, y);
    if (length > 0) {
      const double ax = bead.from.x + nx, ay = bead.from.y + ny, bx = bead.to.x + nx, by = bead.to.y + ny;
      const double cx = bead.to.x - nx, cy = bead.to.y - ny, ex = bead.from.x - nx, ey = bead.from.y - ny;
      span.edge(ax, ay, bx, by, y), span.edge(bx, by, cx, cy, y);
      span.edge(cx, cy, ex, ey, y), span.edge(ex, ey, ax, ay, y);
    }
    if (span.from <= span.to) fill(row, span.from, span.to);
  }
}

void Coverage::add(const PathLayer& layer, const Toolpaths& paths) {
  StopNowAndThen stop(256);
  for (const Stroke& stroke : layer.strokes) {
    stop.step();
    if (stroke.extrudes() && !is_custom(paths, stroke)) add(stroke);
  }
}

bool Coverage::at(Point p) const {
  if (p.x < origin_.x || p.y < origin_.y) return false;
  const std::int64_t x = (std::int64_t{p.x} - origin_.x) / cell_, y = (std::int64_t{p.y} - origin_.y) / cell_;
  if (x >= width_ || y >= height_) return false;
  return bits_[static_cast<std::size_t>(y) * stride_ + static_cast<std::size_t>(x / 64)] >> (x % 64) & 1;
}

Coverage::Shared Coverage::shared(const Coverage& a, const Coverage& b) {
  Shared out;
  for (std::size_t i = 0; i < a.bits_.size(); ++i) {
    const std::uint64_t in_a = a.bits_[i], in_b = b.bits_[i];
    out.only_a += static_cast<std::uint64_t>(std::popcount(in_a & ~in_b));
    out.only_b += static_cast<std::uint64_t>(std::popcount(in_b & ~in_a));
    out.both += static_cast<std::uint64_t>(std::popcount(in_a & in_b));
  }
  return out;
}

bool is_custom(const Toolpaths& paths, const Stroke& stroke) {
  return paths.features[stroke.feature] == "custom";
}

Box box_of_beads(const PathLayer& layer, const Toolpaths& paths) {
  Box box;
  Um widest = 0;
  for (const Stroke& stroke : layer.strokes) {
    if (!stroke.extrudes() || is_custom(paths, stroke)) continue;
    box.add(stroke.from), box.add(stroke.to);
    widest = std::max(widest, stroke.width);
  }
  return box.empty() ? box : box.grown(widest / 2 + 1);
}

void set_support(Toolpaths& paths) {
  tasks::for_each_index(paths.layers.size(), [&](std::size_t i) {
    auto& layer = paths.layers[i];
    const Box window = box_of_beads(layer, paths);
    std::optional<Coverage> below;
    std::optional<std::size_t> shown;  // the layer that `below` shows
    StopNowAndThen stop(64);
    for (Stroke& stroke : layer.strokes) {
      stop.step();
      if (!stroke.extrudes() || is_custom(paths, stroke)) continue;
      const auto foot = layer_below(paths, i, stroke);
      if (!foot) continue;
      if (foot != shown) {
        below.emplace(window).add(paths.layers[*foot], paths);
        shown = foot;
      }
      stroke.support_percent = static_cast<std::uint8_t>(std::lround(100 * supported_share(*below, stroke)));
    }
  });
}

}  // namespace weft::preview
