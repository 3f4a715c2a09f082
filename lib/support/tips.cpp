// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/tips.h"

#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/offset.h"
#include "geometry/spatial_index.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>

namespace weft::support {
namespace {

/// Points by cell of a grid as wide as what is asked for.
class NearPoints {
 public:
  explicit NearPoints(Um within) : cell_(std::max<Um>(within, 100)), within2_(std::int64_t{within} * within) {}
  void add(Point p) { cells_[key(column(p.x), column(p.y))].push_back(p); }
  bool any(Point p) const {
    for (Um dy = -1; dy <= 1; ++dy)
      for (Um dx = -1; dx <= 1; ++dx) {
        const auto found = cells_.find(key(column(p.x) + dx, column(p.y) + dy));
        if (found == cells_.end()) continue;
        for (const Point q : found->second)
          if (distance2(p, q) <= within2_) return true;
      }
    return false;
  }

 private:
  Um column(Um v) const { return v >= 0 ? v / cell_ : -((-v + cell_ - 1) / cell_); }
  static std::int64_t key(Um c, Um r) { return (std::int64_t{c} << 32) ^ static_cast<std::uint32_t>(r); }
  Um cell_;
  std::int64_t within2_;
  std::unordered_map<std::int64_t, std::vector<Point>> cells_;  // looked up only: its order shows nowhere
};

/// The rim of a contact, point by point: where the bead along it lies, or where there is no room for one, its edge.
class Rim {
 public:
  struct Walk {
    std::vector<Point> points;
    Um inset = 0;  ///< from the edge
  };
  Rim(const Regions& contact, const Regions& around, double step, Um line)
      : around_(around), all_free_(around.empty()) {
    for (const Region& region : contact) {
      const Regions inside = geometry::offset({region}, {.by = -line / 2});
      for (const Ring& ring : geometry::rings_of(inside)) add(ring, step, line / 2);
      if (!inside.empty()) continue;
      add(region.outer, step, 0);
      for (const Ring& hole : region.holes) add(hole, step, 0);
    }
  }
  const std::vector<Walk>& walks() const { return walks_; }
  bool hangs_free(Point p, Um inset) const {
    constexpr double inside = 150;  // further from the rim of all of them
    return all_free_ || !around_.region_at(p) || around_.nearest(p, inside + inset);
  }

 private:
  void add(const Ring& line, double step, Um inset) {
    auto& points = walks_.emplace_back(Walk{{}, inset}).points;
    for (std::size_t i = 0; i < line.size(); ++i) {
      const Point a = line[i], b = line[(i + 1) % line.size()];
      const int pieces = std::max(1, static_cast<int>(distance(a, b) / step));
      for (int k = 0; k < pieces; ++k) points.push_back(lerp(a, b, static_cast<double>(k) / pieces));
    }
  }
  geometry::SegmentIndex around_;
  bool all_free_;
  std::vector<Walk> walks_;
};

/// Puts tips under one contact.
class Placer {
 public:
  Placer(const Regions& contact, TipSpacing spacing, const Field& field, std::size_t slab, Um radius)
      : contact_(contact),
        spacing_(spacing),
        field_(field),
        slab_(slab),
        radius_(radius),
        held_(spacing.inside),
        held_at_rim_(spacing.rim) {
    for (const Region& region : contact) boxes_.push_back(box_of(region.outer));
  }

  void hold(Point p) { held_.add(p), held_at_rim_.add(p); }
  const std::vector<Point>& tips() const { return out_; }

  /// A tip stands as far ahead of the first place that none holds as lets it hold that place too.
  void along(const Rim& rim, bool must_be_free) {
    const auto may = [&](Point p) { return !must_be_free || is_free(p); };
    for (const auto& [points, inset] : rim.walks()) {
      stop_if_asked();
      for (std::size_t i = 0; i < points.size(); ++i) {
        if (!may(points[i])) continue;
        const bool free = rim.hangs_free(points[i], inset);
        if (free ? held_at_rim_.any(points[i]) : held_.any(points[i])) continue;
        const double within = 0.9 * (free ? spacing_.rim : spacing_.inside);
        Point at = points[i];
        for (std::size_t j = i + 1; j < points.size() && distance(points[i], points[j]) <= within; ++j)
          if (may(points[j])) at = points[j];
        put(at);
      }
    }
  }

  /// A lattice of triangles, the middle of three points of which is 0.92 of what one covers away from each; and what
  /// is left between it and the rim.
  void inside() {
    const geometry::SegmentIndex inside(contact_);
    lattice(inside, spacing_.inside * 16 / 10, spacing_.inside * 139 / 100);
    lattice(inside, spacing_.inside / 4, spacing_.inside / 4);
  }

 private:
  bool is_free(Point p) const { return field_.to_anything(slab_, p) >= radius_; }
  void put(Point p) { out_.push_back(p), hold(p); }
  /// Its rows lie across the strands of a roof.
  void lattice(const geometry::SegmentIndex& inside, Um across, Um up) {
    const auto floor_div = [](Um v, Um by) { return v >= 0 ? v / by : -((-v + by - 1) / by); };
    const Point from = field_.origin();  // the lattice goes with the object
    const Box box = box_of(contact_);
    for (Um row = floor_div(box.min.x - from.x, up); row * up <= box.max.x - from.x; ++row) {
      stop_if_asked();
      const Um x = row * up + from.x, shift = from.y + (row % 2 != 0 ? across / 2 : 0);
      for (const auto& [begin, end] : boxes_at(x))
        for (Um place = floor_div(begin - shift - 1, across) + 1; place * across + shift <= end; ++place) {
          const Point p{x, place * across + shift};
          if (!held_.any(p) && is_free(p) && inside.region_at(p)) put(p);
        }
    }
  }
  /// From where to where regions' boxes reach there, ascending.
  std::vector<std::pair<Um, Um>> boxes_at(Um x) const {
    std::vector<std::pair<Um, Um>> out;
    for (const Box& box : boxes_)
      if (box.min.x <= x && x <= box.max.x) out.emplace_back(box.min.y, box.max.y);
    std::sort(out.begin(), out.end());
    std::size_t kept = 0;
    for (const auto& [begin, end] : out) {
      if (kept > 0 && begin <= out[kept - 1].second)
        out[kept - 1].second = std::max(out[kept - 1].second, end);
      else
        out[kept++] = {begin, end};
    }
    out.resize(kept);
    return out;
  }

  const Regions& contact_;
  std::vector<Box> boxes_;  ///< of its regions
  TipSpacing spacing_;
  const Field& field_;
  std::size_t slab_;
  Um radius_;
  NearPoints held_, held_at_rim_;
  std::vector<Point> out_;
};

}  // namespace

std::vector<Point> tips_under(const Regions& contact, const Regions& around, const std::vector<Point>& standing,
                              TipSpacing spacing, const Field& field, std::size_t slab, TipShape shape) {
  Placer placer(contact, spacing, field, slab, shape.radius);
  const Box near = box_of(contact).grown(spacing.inside);
  // What stands beside a strip does not carry it, however near.
  const geometry::SegmentIndex edge(contact);
  for (const Point p : standing)
    if (near.contains(p) && (edge.region_at(p) || edge.nearest(p, shape.radius + shape.line / 2.0))) placer.hold(p);
  // The rim first, so that what runs along it lies on tips and not beside them; at last where branches find no way.
  const Rim rim(contact, around, std::max(200.0, spacing.rim / 4.0), shape.line);
  placer.along(rim, true);
  placer.inside();
  placer.along(rim, false);
  return placer.tips();
}

}  // namespace weft::support
