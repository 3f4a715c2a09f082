// SPDX-License-Identifier: GPL-3.0-or-later
#include "preview/solid.h"

#include "core/stop.h"
#include "preview/colours.h"
#include "preview/coverage.h"
#include "tasks/tasks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <tuple>
#include <vector>

namespace weft::preview {
namespace {

constexpr int samples = 2;       // a pixel, in each direction
constexpr int band_rows = 32;    // pixels high: what one task draws
constexpr double margin = 0.04;  // share of the picture left free on each side
constexpr double diffuse = 0.55, rim = 0.25, ambient = 0.30;

struct Vec {
  double x = 0, y = 0, z = 0;
};
Vec operator-(Vec a, Vec b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Vec operator*(Vec a, double s) {
  return {a.x * s, a.y * s, a.z * s};
}
Vec operator+(Vec a, Vec b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
double dot(Vec a, Vec b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
Vec cross(Vec a, Vec b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
double length(Vec a) {
  return std::sqrt(dot(a, a));
}
Vec unit(Vec a) {
  return a * (1 / length(a));
}
Vec stretched(Vec a, double along_z) {
  return {a.x, a.y, a.z * along_z};
}

/// Axes of the picture in space: right, up, and towards the eye.
struct Camera {
  Vec eye, right, up, light;
  explicit Camera(const std::array<double, 3>& from) : eye(unit({from[0], from[1], from[2]})) {
    const bool upright = std::abs(eye.x) < 1e-9 && std::abs(eye.y) < 1e-9;
    right = upright ? Vec{1, 0, 0} : unit(cross({0, 0, 1}, eye));
    up = cross(eye, right);
    light = unit(right * -0.35 + up * 0.65 + eye * 0.68);
  }
};

struct Bead {
  Vec from, to;  ///< of its middle, mm
  double half_width, half_height;
};

/// What of the picture a bead may cover, in mm along right and up.
struct Window {
  double x0 = 1e300, x1 = -1e300, y0 = 1e300, y1 = -1e300;
  void add(const Window& o) {
    x0 = std::min(x0, o.x0), x1 = std::max(x1, o.x1), y0 = std::min(y0, o.y0), y1 = std::max(y1, o.y1);
  }
};

/// How far a bead's spheroid goes along an axis.
double reach_of(const Bead& bead, Vec axis) {
  return std::sqrt(bead.half_width * bead.half_width * (axis.x * axis.x + axis.y * axis.y) +
                   bead.half_height * bead.half_height * axis.z * axis.z);
}

/// Towards the eye.
double nearest_of(const Bead& bead, const Camera& camera) {
  constexpr double rounded = 1e-9;  // mm: what the ray finds may be so much nearer
  return std::max(dot(bead.from, camera.eye), dot(bead.to, camera.eye)) + reach_of(bead, camera.eye) + rounded;
}

Window window_of(const Bead& bead, const Camera& camera) {
  const double ax = dot(bead.from, camera.right), bx = dot(bead.to, camera.right), ex = reach_of(bead, camera.right);
  const double ay = dot(bead.from, camera.up), by = dot(bead.to, camera.up), ey = reach_of(bead, camera.up);
  return {std::min(ax, bx) - ex, std::max(ax, bx) + ex, std::min(ay, by) - ey, std::max(ay, by) + ey};
}

/// The bead of a stroke, if it is one.
class Beads {
 public:
  Beads(const Toolpaths& paths, const View& view) : paths_(paths), view_(view) {
    const std::size_t last_layer = paths.layers.empty() ? 0 : paths.layers.size() - 1;
    std::tie(first_, last_) = view.layers.value_or(std::pair<std::size_t, std::size_t>{0, last_layer});
    last_ = std::min(last_, last_layer);
    range_ = range_of(paths, first_, last_, view.colour);
  }
  /// Layers that are shown: [first, end).
  std::size_t first() const { return first_; }
  std::size_t end() const { return paths_.layers.empty() ? first_ : std::max(first_, last_ + 1); }
  std::size_t strokes(std::size_t layer) const { return paths_.layers[layer].strokes.size(); }

  std::optional<Bead> at(std::size_t layer, std::size_t k) const {
    const auto& strokes = paths_.layers[layer].strokes;
    const Stroke& s = strokes[k];
    if (!s.extrudes() || is_custom(paths_, s)) return std::nullopt;
    const Um z_from = k > 0 && strokes[k - 1].to == s.from ? strokes[k - 1].z : s.z;
    const double half = to_mm(s.height) / 2;
    return Bead{{to_mm(s.from.x), to_mm(s.from.y), to_mm(z_from) - half},
                {to_mm(s.to.x), to_mm(s.to.y), to_mm(s.z) - half},
                to_mm(s.width) / 2,
                std::max(half, 1e-3)};
  }
  Rgb colour(std::size_t layer, std::size_t k) const {
    const Stroke& s = paths_.layers[layer].strokes[k];
    return names_kinds(view_.colour) ? colour_of(paths_, s, view_.colour)
                                     : ramp(range_.share(measure(s, view_.colour)));
  }

 private:
  const Toolpaths& paths_;
  const View& view_;
  std::size_t first_ = 0, last_ = 0;
  Range range_;
};

/// Some strokes of a layer that follow each other, and what of the picture their beads may cover.
struct Chunk {
  std::uint32_t layer = 0, begin = 0, end = 0;
  Window window{};
  double nearest = -1e300;  ///< towards the eye, mm
};
constexpr std::size_t chunk_strokes = 32;  // a part of a contour, seldom one that goes across the picture

/// In the order of the file, without those that have no bead.
std::vector<Chunk> chunks_of(const Beads& beads, const Camera& camera) {
  std::vector<std::vector<Chunk>> of_layers(beads.end() - beads.first());
  tasks::for_each_index(of_layers.size(), [&](std::size_t i) {
    stop_if_asked();
    const std::size_t layer = beads.first() + i, strokes = beads.strokes(layer);
    for (std::size_t begin = 0; begin < strokes; begin += chunk_strokes) {
      const std::size_t end = std::min(begin + chunk_strokes, strokes);
      Chunk chunk{static_cast<std::uint32_t>(layer), static_cast<std::uint32_t>(begin),
                  static_cast<std::uint32_t>(end)};
      for (std::size_t k = begin; k < end; ++k)
        if (const auto bead = beads.at(layer, k))
          chunk.window.add(window_of(*bead, camera)),
              chunk.nearest = std::max(chunk.nearest, nearest_of(*bead, camera));
      if (chunk.nearest > -1e300) of_layers[i].push_back(chunk);
    }
  });
  std::vector<Chunk> out;
  for (const auto& some : of_layers) out.insert(out.end(), some.begin(), some.end());
  return out;
}

Window window_of(const std::vector<Chunk>& chunks) {
  Window all;
  for (const auto& chunk : chunks) all.add(chunk.window);
  return all;
}

/// A bead scaled along z until it is a capsule, and how a point of the picture lies in it: each number is linear in it.
class Capsule {
 public:
  Capsule(const Bead& bead, const Camera& camera)
      : camera_(camera), stretch_(bead.half_width / bead.half_height), r_(bead.half_width) {
    const Vec toward = stretched(camera.eye, stretch_), axis = stretched(bead.to - bead.from, stretch_);
    far_ = length(toward);
    d_ = toward * (1 / far_);
    depth_ = dot(axis, d_);
    const Vec flat = axis - d_ * depth_;
    reach_ = length(flat);
    whole_ = std::sqrt(reach_ * reach_ + depth_ * depth_);
    along_ = reach_ > 1e-9 ? flat * (1 / reach_) : unit(cross(d_, {0.31, 0.95, 0.05}));
    across_ = cross(d_, along_);
    const Vec right = stretched(camera.right, stretch_), up = stretched(camera.up, stretch_),
              from = stretched(bead.from, stretch_);
    v_ = {dot(right, along_), dot(up, along_), -dot(from, along_)};
    u_ = {dot(right, across_), dot(up, across_), -dot(from, across_)};
    k_ = Vec{-dot(right, d_), -dot(up, d_), dot(from, d_)} * (1 / far_);
  }

  struct Hit {
    double depth;  ///< towards the eye, mm
    double light;
  };
  /// Where the ray through that point of the picture meets the bead first.
  std::optional<Hit> at(double x, double y) const {
    const double v = v_.x * x + v_.y * y + v_.z, u = u_.x * x + u_.y * y + u_.z;
    const double beyond = v - std::clamp(v, 0.0, reach_);
    if (beyond * beyond + u * u > r_ * r_) return std::nullopt;
    const double c = std::sqrt(std::max(r_ * r_ - u * u, 0.0));
    const double t = reach_ > 1e-9 ? (v + c * depth_ / whole_) * whole_ / reach_ : depth_ > 0 ? whole_ + 1 : -1;
    double toward;
    Vec normal;
    if (t >= 0 && t <= whole_ && whole_ > 0) {
      toward = (t * depth_ + c * reach_) / whole_;
      normal = across_ * u + (d_ * reach_ - along_ * depth_) * (c / whole_);
    } else {
      const double e = t < 0 ? v : v - reach_, h = std::sqrt(std::max(r_ * r_ - e * e - u * u, 0.0));
      toward = (t < 0 ? 0 : depth_) + h;
      normal = along_ * e + across_ * u + d_ * h;
    }
    normal = unit(stretched(normal, stretch_));
    const double lit =
        ambient + rim * std::max(dot(normal, camera_.eye), 0.0) + diffuse * std::max(dot(normal, camera_.light), 0.0);
    return Hit{k_.x * x + k_.y * y + k_.z + toward / far_, lit};
  }

 private:
  const Camera& camera_;
  double stretch_, r_, far_, depth_, reach_, whole_;
  Vec d_, along_, across_, v_, u_, k_;
};

/// Millimetres of the picture to samples.
struct Fit {
  double scale, x0, y1;  ///< samples a mm; what the left and upper border show
  Fit(const Window& all, PixelSize size) {
    const double w = size.width * samples, h = size.height * samples;
    const double across = std::max(all.x1 - all.x0, 1e-3), along = std::max(all.y1 - all.y0, 1e-3);
    scale = (1 - 2 * margin) * std::min(w / across, h / along);
    x0 = (all.x0 + all.x1) / 2 - w / 2 / scale;
    y1 = (all.y0 + all.y1) / 2 + h / 2 / scale;
  }
  double x(int sample) const { return x0 + (sample + 0.5) / scale; }
  double y(int sample) const { return y1 - (sample + 0.5) / scale; }
};

/// Rows of the picture that one task draws, in samples. What lies behind all that is drawn already in the tiles it
/// covers is not looked at.
class Band {
 public:
  Band(int width, int first_row, int rows)
      : width_(width),
        first_(first_row),
        rows_(rows),
        tiles_across_((width + tile - 1) / tile),
        depth_(static_cast<std::size_t>(width) * static_cast<std::size_t>(rows), nothing),
        order_(depth_.size()),
        colour_(depth_.size()),
        tile_depth_(static_cast<std::size_t>(tiles_across_) * static_cast<std::size_t>((rows + tile - 1) / tile),
                    nothing),
        tile_changed_(tile_depth_.size()) {}

  /// @param number of the first stroke of the chunk, in the file
  void draw(const Chunk& chunk, std::uint64_t number, const Beads& beads, const Camera& camera, const Fit& fit) {
    if (const auto all = covered(chunk.window, fit); all.empty() || hidden(all, chunk.nearest, true)) return;
    for (std::size_t k = chunk.begin; k < chunk.end; ++k) {
      const auto bead = beads.at(chunk.layer, k);
      if (!bead) continue;
      const auto part = covered(window_of(*bead, camera), fit);
      if (part.empty() || hidden(part, nearest_of(*bead, camera), false)) continue;
      draw(Capsule(*bead, camera), part, number + (k - chunk.begin), beads.colour(chunk.layer, k), fit);
    }
  }

  void resolve(Image& image) const {
    for (int row = 0; row < rows_ / samples; ++row)
      for (int column = 0; column < image.size.width; ++column) {
        std::array<int, 3> sum{};
        int hits = 0;
        for (int k = 0; k < samples * samples; ++k) {
          const auto at = static_cast<std::size_t>(row * samples + k / samples) * static_cast<std::size_t>(width_) +
                          static_cast<std::size_t>(column * samples + k % samples);
          if (depth_[at] == std::numeric_limits<double>::lowest()) continue;
          sum[0] += colour_[at].r, sum[1] += colour_[at].g, sum[2] += colour_[at].b;
          ++hits;
        }
        if (hits == 0) continue;
        std::uint8_t* out = image.pixel(column, first_ / samples + row);
        for (std::size_t c = 0; c < 3; ++c) out[c] = static_cast<std::uint8_t>(sum[c] / hits);
        out[3] = static_cast<std::uint8_t>(255 * hits / (samples * samples));
      }
  }

 private:
  static constexpr int tile = 8;
  static constexpr double nothing = std::numeric_limits<double>::lowest();

  /// Samples [x0, x1) × [y0, y1).
  struct Samples {
    int x0, x1, y0, y1;
    bool empty() const { return x0 >= x1 || y0 >= y1; }
  };
  Samples covered(const Window& window, const Fit& fit) const {
    const auto sample = [](double v, double most) { return static_cast<int>(std::clamp(v, 0.0, most)); };
    return {sample((window.x0 - fit.x0) * fit.scale - 0.5, width_),
            sample((window.x1 - fit.x0) * fit.scale + 1.5, width_),
            sample((fit.y1 - window.y1) * fit.scale - 0.5 - first_, rows_),
            sample((fit.y1 - window.y0) * fit.scale + 1.5 - first_, rows_)};
  }

  /// @param exact what was drawn since a tile was looked at last is looked at first
  bool hidden(const Samples& part, double nearest, bool exact) {
    for (int y = part.y0 / tile; y <= (part.y1 - 1) / tile; ++y)
      for (int x = part.x0 / tile; x <= (part.x1 - 1) / tile; ++x) {
        const std::size_t i = at(x, y, tiles_across_);
        if (nearest < tile_depth_[i]) continue;
        if (!exact || !tile_changed_[i]) return false;
        tile_changed_[i] = 0;
        tile_depth_[i] = farthest_in(x * tile, y * tile);
        if (nearest >= tile_depth_[i]) return false;
      }
    return true;
  }
  double farthest_in(int x0, int y0) const {
    double out = std::numeric_limits<double>::max();
    for (int y = y0; y < std::min(y0 + tile, rows_); ++y)
      for (int x = x0; x < std::min(x0 + tile, width_); ++x) out = std::min(out, depth_[at(x, y, width_)]);
    return out;
  }

  void draw(const Capsule& capsule, const Samples& part, std::uint64_t number, Rgb colour, const Fit& fit) {
    for (int y = part.y0; y < part.y1; ++y)
      for (int x = part.x0; x < part.x1; ++x) {
        const auto hit = capsule.at(fit.x(x), fit.y(y + first_));
        const std::size_t i = at(x, y, width_);
        if (!hit || hit->depth < depth_[i]) continue;
        if (hit->depth == depth_[i] && number >= order_[i]) continue;  // of equals the first in the file
        depth_[i] = hit->depth;
        order_[i] = number;
        const auto tone = [&](std::uint8_t v) {
          return static_cast<std::uint8_t>(std::min(255.0, v * hit->light + 0.5));
        };
        colour_[i] = {tone(colour.r), tone(colour.g), tone(colour.b)};
        tile_changed_[at(x / tile, y / tile, tiles_across_)] = 1;
      }
  }

  static std::size_t at(int x, int y, int width) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }

  int width_, first_, rows_, tiles_across_;
  std::vector<double> depth_;  ///< of each sample
  std::vector<std::uint64_t> order_;
  std::vector<Rgb> colour_;
  std::vector<double> tile_depth_;  ///< of what lies deepest in it, or deeper
  std::vector<std::uint8_t> tile_changed_;
};

}  // namespace

PixelSize fitting_size(const Toolpaths& paths, const View& view, int longer) {
  const Window all = window_of(chunks_of(Beads(paths, view), Camera(*view.eye)));
  const double across = std::max(all.x1 - all.x0, 1e-3), along = std::max(all.y1 - all.y0, 1e-3);
  const double scale = longer / std::max(across, along);
  const auto side = [&](double mm) { return std::clamp(static_cast<int>(std::ceil(mm * scale)), 1, longer); };
  return {side(across), side(along)};
}

Image solid(const Toolpaths& paths, const View& view, PixelSize size) {
  const Camera camera(*view.eye);
  const Beads beads(paths, view);
  const auto chunks = chunks_of(beads, camera);
  Image image(size);
  if (chunks.empty()) return image;
  std::vector<std::uint32_t> order(chunks.size());  // what lies before the others first: it hides most of them
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return chunks[a].nearest > chunks[b].nearest; });
  const Fit fit(window_of(chunks), size);
  const auto bands = static_cast<std::size_t>((size.height + band_rows - 1) / band_rows);
  tasks::for_each_index(bands, [&](std::size_t i) {
    const int first = static_cast<int>(i) * band_rows, rows = std::min(band_rows, size.height - first);
    Band band(size.width * samples, first * samples, rows * samples);
    const double high = fit.y(first * samples - 1), low = fit.y((first + rows) * samples);
    StopNowAndThen stop(64);
    for (const std::uint32_t k : order) {
      const Chunk& chunk = chunks[k];
      stop.step();
      if (chunk.window.y1 >= low && chunk.window.y0 <= high)
        band.draw(chunk, std::uint64_t{k} * chunk_strokes, beads, camera, fit);
    }
    band.resolve(image);
  });
  return image;
}

}  // namespace weft::preview
