// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/rungs.h"

#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/clip_lines.h"
#include "geometry/trimmed.h"
#include "support/lengths.h"
#include "tasks/parallel.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace weft::support {
namespace {

/// A narrow column, and where a roof begins above it.
struct Hollow {
  Regions area, begins;
};

/// The rungs of one column on one level.
class Rungs {
 public:
  /// Their ends lie on walls.
  Rungs(Um line, Um span, const Regions& hollow) : line_(line), span_(span), inside_(grown(hollow, -line / 2)) {}

  /// One above another, as far as a roof begins there.
  void above(const Polyline& rung, const geometry::SegmentIndex& begins) {
    const Point a = rung.front(), b = rung.back();
    const double length = distance(a, b);
    const Point middle = lerp(a, b, 0.5);
    if (!inside_.region_at(middle)) return;
    constexpr int places = 8;
    for (int i = 0; i <= places; ++i)
      if (begins.region_at(lerp(a, b, static_cast<double>(i) / places)))
        return across(middle, (b.x - a.x) / length, (b.y - a.y) / length);
  }
  /// Across what lies along a ring, wherever no rung is near.
  void along(const Ring& ring) {
    const std::size_t n = ring.size();
    for (std::size_t i = 0; i < n; ++i) {
      const Point a = ring[i], b = ring[i + 1 < n ? i + 1 : 0];
      const double length = distance(a, b);
      const int pieces = std::max(1, static_cast<int>(length / (span_ / 4.0)));
      for (int k = 0; k < pieces; ++k) {
        const Point p = lerp(a, b, (k + 0.5) / pieces);
        if (!is_near(p)) across(p, (a.y - b.y) / length, (b.x - a.x) / length);
      }
    }
  }
  std::vector<Polyline> lines() && { return std::move(lines_); }

 private:
  bool is_near(Point p) const {
    return std::any_of(lines_.begin(), lines_.end(), [&](const Polyline& rung) {
      return geometry::foot_of(p, {rung.front(), rung.back()}).distance_um < span_ * 0.8;
    });
  }
  /// From wall to wall through p in that direction.
  void across(Point p, double x, double y) {
    const Point to{rounded(x * span_), rounded(y * span_)};
    const Polyline whole{p - to, p + to};
    for (auto& piece : geometry::clip_lines({&whole, 1}, inside_)) {
      const double length = length_of(piece.line);
      if (length < line_ || length > span_ + 2 * line_) continue;  // longer ones would sag themselves
      if (geometry::foot_of(p, {piece.line.front(), piece.line.back()}).distance_um > line_) continue;
      return lines_.push_back(std::move(piece.line));
    }
  }

  Um line_, span_;
  geometry::SegmentIndex inside_;
  std::vector<Polyline> lines_;
};

std::vector<Hollow> hollows_under(const Room& room, const SupportLayer& level, const Regions& roof_above) {
  const auto& s = room.settings();
  const Um line = line_width(s, room.object().nozzle), half = hollow_column(line, s.support_infill_rate / 100);
  std::vector<Hollow> out;
  for (const Region& column : level.columns) {
    const Box box = box_of(column.outer);
    const Regions above = geometry::trimmed(roof_above, box);
    if (above.empty()) continue;
    const Point size = box.size();
    // Rungs are needed where the roof begins, and reach no further than they span.
    const Box begun = box_of(above), meets{{std::max(box.min.x, begun.min.x), std::max(box.min.y, begun.min.y)},
                                           {std::min(box.max.x, begun.max.x), std::min(box.max.y, begun.max.y)}};
    Regions hollow =
        geometry::trimmed({&column, 1}, meets.grown(2 * half + roof_span(room.object().nozzle) + 2 * line));
    if (std::min(size.x, size.y) > 2 * half) hollow = geometry::subtract(hollow, opened(hollow, half));
    // Of what is no wider than a bead half lies on the wall that it runs along.
    Regions begins = opened(geometry::intersect(hollow, above), line * 4 / 10);
    if (!begins.empty()) out.push_back({std::move(hollow), std::move(begins)});
  }
  return out;
}

}  // namespace

void lay_rungs(const Room& room, std::span<SupportLayer> levels) {
  const auto& s = room.settings();
  const Um nozzle = room.object().nozzle;
  if (s.support_wall_count.value_or(0) > 0) return;  // then columns are filled
  const auto hollows = tasks::parallel_map(levels.size(), [&](std::size_t k) {
    if (k + 1 >= levels.size() || levels[k].first || levels[k + 1].roof.empty()) return std::vector<Hollow>{};
    stop_if_asked();
    return hollows_under(room, levels[k], levels[k + 1].roof);
  });
  std::vector<Polyline> below, here;
  for (std::size_t k = 0; k < levels.size(); ++k) {
    for (const auto& [area, begins] : hollows[k]) {
      Rungs rungs(line_width(s, nozzle), roof_span(nozzle), area);
      const geometry::SegmentIndex where(begins);
      for (const auto& rung : below) rungs.above(rung, where);
      for (const Region& strip : begins) {
        rungs.along(strip.outer);
        for (const Ring& hole : strip.holes) rungs.along(hole);
      }
      auto lines = std::move(rungs).lines();
      std::move(lines.begin(), lines.end(), std::back_inserter(here));
    }
    levels[k].joists.lines.insert(levels[k].joists.lines.end(), here.begin(), here.end());
    below = std::exchange(here, {});
  }
}

}  // namespace weft::support
