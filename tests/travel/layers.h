// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "geometry/boolean.h"
#include "geometry/offset.h"
#include "picture.h"
#include "rectangle.h"
#include "travel/travel.h"

#include <random>

/// Synthetic layers: walls from plain offsets and straight lines inside them.
namespace weft::travel::sample {

using test::rectangle;

constexpr Um width = 400;

inline Ring circle(Point centre, Um radius, int corners) {
  Ring ring;
  for (int i = 0; i < corners; ++i) {
    const double a = 2 * 3.14159265358979 * i / corners;
    ring.push_back({centre.x + rounded(radius * std::cos(a)), centre.y + rounded(radius * std::sin(a))});
  }
  return ring;
}

inline Ring turned_over(Ring ring) {
  std::reverse(ring.begin(), ring.end());
  return ring;
}

inline Bead closed_bead(const Ring& ring, Role role, std::uint16_t inset, std::uint32_t part) {
  Bead bead;
  for (const Point p : ring) bead.path.push_back({p, width, 1.F});
  bead.role = role, bead.closed = true, bead.inset = inset, bead.part = part;
  return bead;
}

/// Horizontal lines of that spacing across the region; every piece a bead.
inline void hatch(const Region& region, Um spacing, std::uint32_t part, std::uint32_t sequence, Beads& out) {
  const Box box = box_of(region.outer);
  auto rings = geometry::rings_of({region});
  for (Um y = box.min.y + spacing / 2 + 1; y < box.max.y; y += spacing) {
    std::vector<Um> xs;
    for (const auto& ring : rings)
      for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
        const Point a = ring[j], b = ring[i];
        if ((a.y > y) != (b.y > y))
          xs.push_back(rounded(a.x + (static_cast<double>(y) - a.y) * (static_cast<double>(b.x) - a.x) /
                                         (static_cast<double>(b.y) - a.y)));
      }
    std::sort(xs.begin(), xs.end());
    for (std::size_t k = 0; k + 1 < xs.size(); k += 2) {
      if (xs[k + 1] - xs[k] < width) continue;
      Bead bead;
      bead.path = {{{xs[k], y}, width, 1.F}, {{xs[k + 1], y}, width, 1.F}};
      bead.role = Role::infill, bead.part = part, bead.sequence = sequence;
      out.push_back(bead);
    }
  }
}

/// Three walls, the inner ones first, and lines inside.
inline ObjectLayer object(const Regions& outline, Um spacing = 2000, std::uint32_t sequence = 0) {
  ObjectLayer layer;
  layer.outline = outline;
  Beads fills;
  for (std::uint32_t part = 0; part < outline.size(); ++part) {
    for (const int inset : {2, 1, 0})
      for (const auto& r : geometry::rings_of(geometry::offset({outline[part]}, {.by = -(width / 2 + inset * width)})))
        layer.beads.push_back(
            closed_bead(r, inset == 0 ? Role::outer_wall : Role::inner_wall, static_cast<std::uint16_t>(inset), part));
    for (const auto& r : geometry::offset({outline[part]}, {.by = -3 * width}))
      hatch(r, spacing, part, sequence, fills);
  }
  layer.beads.insert(layer.beads.end(), fills.begin(), fills.end());
  return layer;
}

inline LayerInput layer(Regions outline, std::size_t index = 0, Um spacing = 2000, std::uint32_t sequence = 0) {
  tests::look_at(outline);
  LayerInput input;
  input.time.index = input.time.number = static_cast<std::uint32_t>(index);
  input.height = 200;
  input.z = static_cast<Um>(200 * (index + 1));
  input.objects.push_back(object(outline, spacing, sequence));
  return input;
}

/// A 40 × 30 mm plate with two holes and a deep bay, and a small island beside it.
inline Regions plate() {
  Region body{
      {{0, 0}, {40000, 0}, {40000, 30000}, {25000, 30000}, {25000, 12000}, {20000, 12000}, {20000, 30000}, {0, 30000}},
      {turned_over(circle({9000, 15000}, 4000, 48)), turned_over(circle({32000, 8000}, 3000, 32))}};
  Region island = rectangle({21500, 20000}, {23500, 28000});
  return {body, island};
}

struct Count {
  double travel_mm = 0, unretracted_mm = 0;
  int travels = 0, retractions = 0, crossings = 0;
};

inline Count count(const std::vector<LayerPlan>& plans) {
  Count c;
  std::optional<Point> at;
  bool retracted = false;
  for (const auto& plan : plans)
    for (const auto& step : plan.steps) {
      if (const auto* e = std::get_if<Extrude>(&step)) at = e->path.back().at;
      if (std::holds_alternative<Retract>(step)) ++c.retractions, retracted = true;
      if (std::holds_alternative<Prime>(step)) retracted = false;
      if (const auto* t = std::get_if<Travel>(&step)) {
        ++c.travels;
        c.crossings += t->crosses_wall ? 1 : 0;
        for (const auto& p : t->path) {
          const double mm = at ? distance(*at, flat(p)) / 1000 : 0.0;
          c.travel_mm += mm;
          if (!retracted) c.unretracted_mm += mm;
          at = flat(p);
        }
      }
    }
  return c;
}

}  // namespace weft::travel::sample
