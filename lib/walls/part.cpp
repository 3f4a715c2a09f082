// SPDX-License-Identifier: GPL-3.0-or-later
#include "walls/part.h"

#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/medial_axis.h"
#include "geometry/offset.h"
#include "geometry/simplify.h"
#include "walls/finish.h"
#include "walls/fit_ends.h"
#include "walls/keep_inside.h"
#include "walls/keep_volume.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <new>
#include <numbers>
#include <optional>
#include <utility>

namespace weft::walls {
namespace {

constexpr double tip_deg = 45;  // a single bead is led into the tip of a sharper corner: else the part would lack it
constexpr double dab_share = 2.0 / 3;  // of the square of a bead's width: a smaller part is a dab
constexpr double chord_um = 4;         // how far a chord may stand off a bead that bends around a corner
// A width is held for so many nozzles or not laid: an orifice lays nothing that is finer than itself, and within that
// way an extruder has hardly begun to answer. The edge of an outer wall is seen: it gives up only what no two moves fit
// into. Open beads between walls change most. At 60 mm/s an extruder that lags by 20 ms follows them by 1.2 mm: it lays
// less twice where they change less, by more than what is commanded then leaves bare.
constexpr double steady_loop = 1.0, steady_open = 1.75, steady_outer = 0.25;
constexpr Um rest_chord = 2;  // … and off what walls leave: most of its points are ribs that tell nothing, rounded

void add_rings(const Regions& at, Um width, std::uint16_t inset, std::uint32_t part, Beads& out) {
  auto add = [&](const Ring& ring) {
    if (ring.size() < 3) return;
    Bead bead;
    bead.role = inset == 0 ? Role::outer_wall : Role::inner_wall;
    bead.closed = true;
    bead.inset = inset;
    bead.part = part;
    for (const Point p : ring) bead.path.push_back({p, width});
    out.push_back(std::move(bead));
  };
  for (const Region& region : at) {
    add(region.outer);
    for (const Ring& hole : region.holes) add(hole);
  }
}

/// Concentric walls of nominal width: when there is no medial axis to go by.
Regions plain(const Widths& widths, const Regions& whole, std::uint32_t part, Beads& out) {
  Um edge = 0;
  for (int i = 0; i < widths.walls; ++i) {
    const Um width = rounded(i == 0 ? widths.outer : widths.inner);
    const Regions at = geometry::offset(whole, {.by = -(edge + width / 2)});
    if (at.empty()) break;
    add_rings(at, width, static_cast<std::uint16_t>(i), part, out);
    edge += width;
  }
  return edge == 0 ? whole : geometry::offset(whole, {.by = -edge});
}

Regions rest_of(const Skeleton& skeleton, const Laying& laying, Point origin) {
  std::vector<Ring> rings;
  for (const auto& places : trace_rest(skeleton, laying)) {
    Ring ring;
    for (const Place p : places) {
      const Point q{origin.x + rounded(p.x), origin.y + rounded(p.y)};
      if (ring.empty() || ring.back() != q) ring.push_back(q);
    }
    ring = geometry::simplified(ring, rest_chord);
    if (ring.size() >= 3) rings.push_back(std::move(ring));
  }
  return rings.empty() ? Regions{} : geometry::regions_from_rings(rings);
}

/// Not valid, too, when the library underneath gives up: concentric walls are better than no part.
geometry::MedialAxis axis_of(const Region& region) {
  try {
    return geometry::medial_axis(region);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {
    return {};
  }
}

}  // namespace

Part part_of(const WallSettings& settings, const Widths& widths, const Region& region, Um nozzle, std::uint32_t index) {
  Part out;
  const auto axis = axis_of(region);
  if (!axis.valid) {
    out.valid = false;
    out.inside = plain(widths, {region}, index, out.beads);
    return out;
  }
  Skeleton skeleton = skeleton_of(axis, chord_um, reach_of(widths));
  LayingOptions options;
  options.steep = std::sin(settings.wall_transition_angle / 2 * std::numbers::pi / 180);
  options.steep_tip = std::max(options.steep, std::sin(tip_deg / 2 * std::numbers::pi / 180));
  options.ramp = settings.wall_transition_length.of(nozzle);
  options.filter = settings.wall_transition_filter_distance;
  FinishOptions finishing;
  finishing.origin = axis.origin;
  finishing.part = index;
  finishing.least_feature = 0.8 * widths.least_feature;  // what is thinner was not laid; widths may give a little
  finishing.least_length = settings.min_wall_length;
  finishing.least_area = widths.least_area;
  finishing.compensate = settings.flow_compensation;
  finishing.stable_outer = std::max<double>(settings.min_output_width, widths.outer / 4);
  finishing.stable_inner = std::max<double>(settings.min_output_width, widths.inner / 4);
  finishing.most_width = widths.most;
  options.corner_width = settings.wall_corner_width / 100;
  if (options.corner_width >= 1) {  // else walls get narrower for a short way on purpose
    finishing.steady_outer = steady_outer * nozzle;
    finishing.steady_loop = steady_loop * nozzle;
    finishing.steady_open = steady_open * nozzle;
  }
  options.narrowest = std::max(finishing.stable_outer, finishing.stable_inner);
  const Laying laying = lay(skeleton, widths, options);
  // So small a part gets an even bead: what pieces of it would gain they would swell over each other.
  const bool dab = 1e6 * area_mm2(region) < dab_share * widths.outer * widths.outer;
  finishing.least_flow = settings.min_flow_ratio / 100;
  finishing.most_flow = settings.max_flow_ratio / 100;
  auto pairs = trace_pairs(skeleton, laying), middles = trace_middles(skeleton, laying);
  fit_ends(middles, pairs);
  finishing.has_walls = !pairs.empty();
  std::vector<Line> finished;
  for (auto* lines : {&pairs, &middles})
    for (Line& line : *lines) {
      stop_if_asked();
      finish(std::move(line), finishing, finished, out.left_out);
    }
  stop_if_asked();
  out.inside = rest_of(skeleton, laying, axis.origin);
  stop_if_asked();
  if (!dab) keep_inside(region, finishing, finished);
  for (const Line& line : finished) append_bead(line, finishing, out.beads);
  const double wanted = area_mm2(region) - area_mm2(out.inside);
  stop_if_asked();
  keep_volume(wanted, rounded(widths.most), dab, out.beads);
  return out;
}

}  // namespace weft::walls
