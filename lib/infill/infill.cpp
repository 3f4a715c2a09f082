// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/infill.h"

#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/offset.h"
#include "infill/concentric.h"
#include "infill/slots.h"
#include "infill/small_areas.h"
#include "infill/sparse.h"
#include "infill/strips.h"
#include "model/flow.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace weft::infill {
namespace {

double radians(double degrees) {
  return degrees * std::numbers::pi / 180;
}

/// The directions, joints and order that a pattern of solid layers asks for.
void apply(SkinPattern pattern, SolidStyle& style) {
  style.connect = style.connect && pattern != SkinPattern::monotonic_lines;
  style.turned = pattern != SkinPattern::aligned_lines;
  style.ordered = pattern == SkinPattern::monotonic || pattern == SkinPattern::monotonic_lines;
}

/// Lines laid so far apart that they overlap less are as wide as before.
void spread_out(Um by, std::size_t from, Beads& beads) {
  if (by == 0) return;
  for (std::size_t i = from; i < beads.size(); ++i)
    for (Junction& j : beads[i].path) j.width = std::max(1, j.width - by);
}

/// A line of a belt is a bead.
void lay(const BeltLine& line, const SolidStyle& style, std::uint32_t part, Beads& beads) {
  Bead bead;
  bead.role = style.role, bead.part = part, bead.closed = line.closed;
  for (const Point at : line.path)
    if (bead.path.empty() || bead.path.back().at != at) bead.path.push_back({at, style.band, 1.F});
  if (bead.path.size() > (line.closed ? 2U : 1U)) beads.push_back(std::move(bead));
}

/// Lines along its edge where an area is a strip that bends. @returns what is no such strip
template <class IsOnBridge>
Regions fill_strips(const Regions& regions, const SolidStyle& style, const FillInput& input, std::uint32_t part,
                    const IsOnBridge& is_on_bridge, Beads& beads) {
  Regions rest;
  const std::size_t from = beads.size();
  for (const Region& region : regions) {
    Beads along;
    if (is_strip(region, style.band) && !angle_along_strip(region, style.band) && !is_on_bridge(region))
      along = input.along_edge(region, style.band);
    if (along.empty()) rest.push_back(region);
    for (Bead& line : along) {
      if (!line.closed && 1000 * length_mm(line) < style.band) continue;  // a dab
      beads.push_back({.path = std::move(line.path), .role = style.role, .closed = line.closed, .part = part});
    }
  }
  spread_out(flow::spread(input.height, input.overlap_factor), from, beads);
  return rest;
}

/// Across the bridge that most of an area lies on: its strands then carry each line at many places.
std::optional<double> angle_across_bridges(const Region& region, std::span<const BridgeArea> below) {
  const Box box = weft::box_of(region.outer);
  for (const BridgeArea& bridge : below) {
    const Box other = weft::box_of(bridge.regions);
    if (other.empty() || other.max.x < box.min.x || other.min.x > box.max.x || other.max.y < box.min.y ||
        other.min.y > box.max.y)
      continue;
    if (area_mm2(geometry::intersect({region}, bridge.regions)) >= area_mm2(region) / 2)
      return bridge.angle_rad + radians(90);
  }
  return std::nullopt;
}

/// Lines that cross strands at 64° and more are carried at about as many places as those straight across: they run
/// along a strip, and along walls or square on them.
double nearly_across(const Region& region, Um band, double across) {
  constexpr double nearly = 0.9;  // cosine of 26°
  const auto near = [&](double angle) { return std::abs(std::cos(angle - across)) > nearly; };
  if (const auto along = angle_along_strip(region, band); along && near(*along)) return *along;
  if (const auto along = angle_along_walls(region))
    for (const double angle : {*along, *along + radians(90)})
      if (near(angle)) return angle;
  return across;
}

/// Which way lines of solid areas run, against X.
class Directions {
 public:
  Directions(const ShellSettings& shells, const FillInput& input, const SolidStyle& top)
      : shells_(shells), input_(input) {
    std::pair most{false, 0.0};  // has long lines, mm²
    for (const PartAreas& areas : input.areas)
      for (const Region& region : areas.top) {
        const double angle = own(top, region);
        const auto along = angle_of_long_lines(region, angle);
        const std::pair each{along.has_value(), area_mm2(region)};
        if (each > most) most = each, seen_ = along.value_or(angle);
      }
  }

  double of_solid(const SolidStyle& style, const Region& region) const {
    const auto across =
        shells_.skin_angle || !style.turned ? std::nullopt : angle_across_bridges(region, input_.bridges_below);
    return across ? nearly_across(region, style.band, *across) : own(style, region);
  }
  /// What is seen is laid in long lines: each end is a turn, beside a wall. Below it directions alternate. Tops that
  /// have about as many ends either way look like the largest of their layer that has not.
  double of_top(const SolidStyle& style, const Region& region) const {
    const double angle = own(style, region);
    if (!style.turned || shells_.skin_angle) return angle;
    const auto along = angle_of_long_lines(region, angle);
    return along ? *along : own(style, region, seen_);
  }

 private:
  double own(const SolidStyle& style, const Region& region, std::optional<double> like = {}) const {
    if (style.turned && !shells_.skin_angle) {
      if (const auto along = angle_along_strip(region, style.band)) return *along;
      if (const auto along = angle_along_narrow(region, style.band)) return nearly_across(region, style.band, *along);
    }
    const auto walls = shells_.skin_angle ? std::optional(radians(*shells_.skin_angle)) : angle_along_walls(region);
    if (like && !walls) return *like;
    const bool across =
        like ? std::abs(std::cos(*walls - *like)) < std::sqrt(0.5) : style.turned && input_.index % 2 == 1;
    return walls.value_or(radians(45)) + (across ? radians(90) : 0);
  }

  const ShellSettings& shells_;
  const FillInput& input_;
  std::optional<double> seen_;  // direction of the tops that have none of their own
};

/// How far the outline is from what walls leave inside.
double depth_of_walls(const FillInput& input) {
  if (input.wall_count == 0) return 0;
  const Um inner =
               input.wall_line_width > 0 ? input.wall_line_width : flow::automatic_width(input.nozzle, input.height),
           outer = input.outer_wall_line_width > 0 ? input.outer_wall_line_width
                                                   : flow::automatic_outer_width(input.nozzle);
  const auto spacing = [&](Um width) { return flow::spacing(width, input.height, input.overlap_factor); };
  return (outer + spacing(outer)) / 2.0 + (input.wall_count - 1.0) * spacing(inner);
}

/// Parts of a region by how dense they are at least. Pre: their levels are doubled from each to the next
std::vector<DenseLevel> levels_of(const Region& region, const std::vector<Density::Part>& parts) {
  constexpr double same = 1.01;
  double least = 1e9, most = 0;
  for (const Density::Part& part : parts) least = std::min(least, part.level), most = std::max(most, part.level);
  std::vector<DenseLevel> out;
  for (double level = least; level < most * same; level *= 2) {
    DenseLevel& each = out.emplace_back(DenseLevel{level, {region}});
    if (level == least) continue;
    each.within.clear();
    for (const Density::Part& part : parts)
      if (part.level * same > level) each.within = geometry::unite(each.within, {part.region});
  }
  return out;
}

/// Sparse lines, as dense at each place as it is asked for there. Branches have no density to meet.
void fill_as_dense(const Region& region, SparseStyle style, Beads& beads) {
  const Density* density = style.prepared != nullptr && style.prepared->density ? &*style.prepared->density : nullptr;
  if (density == nullptr || style.pattern == InfillPattern::lightning) return fill_sparse(region, style, beads);
  if (density->goes_on() && style.pattern == InfillPattern::concentric) {
    const std::size_t own = beads.size();
    fill_concentric(region, style, *density, beads);
    return density->even(region, style.z, style.band, false, own, beads);
  }
  constexpr double least = 0.005, most = 0.95;  // what is less is nothing
  bool dithered = false;
  const std::size_t first = beads.size();
  const std::vector<Density::Part> parts = density->parts(region, style.z, style.index);
  if (density->goes_on())
    if (const auto levels = levels_of(region, parts); !levels.empty() && levels.front().density > least &&
                                                      levels.back().density < most &&
                                                      fill_levels(region, style, levels, beads)) {
      density->follow(levels, style.z, first, beads);
      return density->even(region, style.z, style.band, false, first, beads);
    }
  for (const Density::Part& part : parts) {
    if (part.level < least) continue;
    const std::size_t from = beads.size();
    style.density = std::min(part.level, most), style.pattern = part.pattern, style.even = !part.dithered;
    fill_sparse(part.region, style, beads);
    if (!part.dithered) density->follow(style.density, style.z, from, beads);
    dithered = dithered || part.dithered;
  }
  density->even(region, style.z, style.band, dithered, first, beads);
}

/// Solid layers that are laid as a pattern of sparse infill, dense.
struct WindingRow {
  SkinPattern skin;
  InfillPattern pattern;
};
constexpr std::array winding_rows{WindingRow{SkinPattern::concentric, InfillPattern::concentric},
                                  WindingRow{SkinPattern::hilbert, InfillPattern::hilbert},
                                  WindingRow{SkinPattern::archimedean, InfillPattern::archimedean},
                                  WindingRow{SkinPattern::octagram, InfillPattern::octagram},
                                  WindingRow{SkinPattern::fermat, InfillPattern::fermat}};

/// The pattern where there is room for it to wind, and lines in what is narrower.
void fill_winding(const Region& region, InfillPattern pattern, const SolidStyle& style, const FillInput& input,
                  Beads& beads) {
  constexpr double room = 1.5;  // bands on each side of a line
  const Regions wide = geometry::opening({region}, rounded(room * style.band), geometry::Corner::miter);
  const std::size_t from = beads.size();
  for (const Region& each : wide)
    fill_sparse(each,
                {.pattern = pattern,
                 .density = 1,
                 .band = style.band,
                 .angle_rad = style.angle_rad,
                 .overlap = style.overlap,
                 .connect = style.connect,
                 .z = input.z,
                 .origin = style.origin,
                 .part = style.part,
                 .turn = input.index,
                 .turned = false,
                 .reach = static_cast<double>(input.reach)},
                beads);
  for (std::size_t i = from; i < beads.size(); ++i) beads[i].role = style.role;
  for (const Region& rest : geometry::subtract({region}, wide)) fill_solid(rest, style, beads);
}

/// Lines, which may lose what they would lay twice where they turn.
void fill_lines(const Region& region, const ShellSettings& shells, const SolidStyle& style, Beads& beads) {
  const std::size_t from = beads.size();
  fill_solid_and_slots(region, style, beads);
  if (style.role != Role::bridge && shells.small_area_flow_length > 0)
    thin_short_lines(shells.small_area_flow_length, style.angle_rad, from, beads);
}

/// What of a part's areas is ironed: what keeps off their edge by the inset. A top may go on below what stands on it,
/// as far as letters do; there it is ironed up to their edge.
Regions ironed(const ShellSettings& shells, const FillInput& input, const PartAreas& areas) {
  if (shells.ironing_surfaces == IroningSurfaces::topmost && !input.topmost) return {};
  const Um inset = shells.ironing_inset.value_or(input.nozzle / 2);
  Regions out = areas.top;
  if (!out.empty() && input.above != nullptr && !input.above->empty())
    out = geometry::subtract(out, geometry::offset(*input.above, {.by = -inset}));
  if (shells.ironing_surfaces == IroningSurfaces::solid) {
    out = geometry::unite(out, areas.solid);
    out = geometry::unite(out, areas.belted);
  }
  return geometry::offset(out, {.by = -inset});
}

/// @param across of a region: the direction across the lines of its skin
template <class Across>
void iron(const ShellSettings& shells, const FillInput& input, const PartAreas& areas, SolidStyle style,
          std::uint32_t& sequence, Beads& beads, const Across& across) {
  style.part = areas.part;
  for (const Region& region : ironed(shells, input, areas)) {
    stop_if_asked();
    style.sequence = ++sequence;
    style.angle_rad = shells.ironing_angle ? radians(*shells.ironing_angle) : across(region);
    fill_solid(region, style, beads);
  }
}

/// How the areas of a layer are filled, but for what differs from area to area.
struct Styles {
  SolidStyle solid, top, bridge, ironing;
  std::optional<InfillPattern> solid_winds, top_winds;
  SparseStyle sparse;
};

std::optional<InfillPattern> winding(SkinPattern pattern) {
  const auto row = std::find_if(winding_rows.begin(), winding_rows.end(),
                                [&](const WindingRow& each) { return each.skin == pattern; });
  return row == winding_rows.end() ? std::nullopt : std::optional(row->pattern);
}

/// Of so many layers printed at once. Lines are as far apart in all layers, so that they stand on each other.
SparseStyle sparse_of(const InfillSettings& infill, const FillInput& input, int layers, std::size_t turn) {
  SparseStyle style = sparse_style(infill, {.index = input.index,
                                            .turn = turn,
                                            .z = input.z,
                                            .height = input.height * layers,
                                            .nozzle = input.nozzle,
                                            .origin = input.origin,
                                            .reach = static_cast<double>(input.reach),
                                            .turned_rad = input.turned_rad});
  style.layers = layers, style.prepared = input.prepared;
  if (style.prepared != nullptr && style.prepared->band > 0) style.band = style.prepared->band;
  return style;
}

Styles styles_of(const InfillSettings& infill, const ShellSettings& shells, const FillInput& input) {
  const Um automatic = flow::automatic_width(input.nozzle, input.height);
  const double overlap = infill.infill_overlap.of(input.wall_line_width > 0 ? input.wall_line_width : automatic);
  const auto band = [&](Um width) { return flow::spacing(width, input.height, input.overlap_factor); };
  Styles out;
  out.solid = {.role = Role::solid_infill,
               .band = band(length_or(shells.skin_line_width, input.nozzle, automatic)),
               .angle_rad = 0,
               .overlap = {overlap},
               .connect = infill.infill_connect_lines,
               .fixed_strand = false,
               .flow = 1,
               .origin = input.origin,
               .gaps = shells.gap_fill_enabled,
               .part = 0,
               .sequence = 0};
  out.top = out.bridge = out.ironing = out.solid;
  out.ironing.role = Role::ironing, out.ironing.band = shells.ironing_line_spacing;
  out.ironing.overlap = {}, out.ironing.gaps = false, out.ironing.flow = shells.ironing_flow / 100;
  out.top.role = Role::top_skin, out.top.band = band(length_or(shells.top_skin_line_width, input.nozzle, input.nozzle));
  apply(shells.bottom_pattern, out.solid);
  apply(shells.top_pattern, out.top);
  out.bridge.role = Role::bridge, out.bridge.band = input.nozzle, out.bridge.fixed_strand = out.bridge.gaps = true;
  out.bridge.flow = flow::bridge_flow(input.nozzle, input.height) * shells.bridge_flow / 100;
  out.solid_winds = winding(shells.bottom_pattern), out.top_winds = winding(shells.top_pattern);
  out.sparse = sparse_of(infill, input, 1, input.index);
  // the round end of a line stays within the outermost wall
  const auto kept_within = [&, depth = depth_of_walls(input)](Um widest) {
    const double most = depth - widest / 2.0;
    return Overlap{std::min(overlap, most), most};
  };
  for (SolidStyle* style : {&out.solid, &out.top})
    style->overlap = kept_within(flow::line_width(style->band, input.height));
  out.bridge.overlap = kept_within(input.nozzle);
  out.sparse.overlap = kept_within(width_of_sparse(infill, input.nozzle, input.height));
  return out;
}

/// What of a part is sparse, in this layer and for those below it.
void fill_sparse_areas(const InfillSettings& infill, const FillInput& input, SparseStyle style, const PartAreas& areas,
                       Beads& beads) {
  const auto fill_all = [&](const Regions& regions) {
    style.part = areas.part;
    for (const Region& region : regions) {
      stop_if_asked();
      fill_as_dense(region, style, beads);
    }
  };
  fill_all(areas.sparse);
  if (areas.combined.empty()) return;
  const Overlap overlap = style.overlap;
  style = sparse_of(infill, input, areas.combined_layers, areas.combined_turn);
  style.overlap = overlap;
  fill_all(areas.combined);
}

}  // namespace

FillLayer fill(const InfillSettings& infill, const ShellSettings& shells, const FillInput& input) {
  const Styles styles = styles_of(infill, shells, input);
  const Directions directions(shells, input, styles.top);
  FillLayer layer;
  std::uint32_t sequence = 0;
  const auto fill_all = [&](const Regions& regions, SolidStyle style, std::optional<InfillPattern> winds,
                            std::uint32_t part, const auto& angle_of) {
    style.part = part;
    for (const Region& region : regions) {
      stop_if_asked();
      style.sequence = style.ordered ? ++sequence : 0;
      style.angle_rad = angle_of(style, region);
      const std::size_t from = layer.beads.size();
      if (winds)
        fill_winding(region, *winds, style, input, layer.beads);
      else
        fill_lines(region, shells, style, layer.beads);
      if (style.role != Role::bridge) spread_out(flow::spread(input.height, input.overlap_factor), from, layer.beads);
    }
  };
  const auto solid_angle = [&](const SolidStyle& style, const Region& region) {
    return directions.of_solid(style, region);
  };
  const auto top_angle = [&](const SolidStyle& style, const Region& region) {
    return directions.of_top(style, region);
  };
  const auto is_on_bridge = [&](const Region& region) {
    return angle_across_bridges(region, input.bridges_below).has_value();
  };
  const auto fill_skin = [&](const Regions& regions, const SolidStyle& style, std::optional<InfillPattern> winds,
                             std::uint32_t part, const auto& angle_of, const auto& on_bridge) {
    const bool strips = input.along_edge && style.turned && !shells.skin_angle && !winds;
    fill_all(strips ? fill_strips(regions, style, input, part, on_bridge, layer.beads) : regions, style, winds, part,
             angle_of);
  };
  for (const PartAreas& areas : input.areas) {
    for (const BridgeArea& area : areas.bridges)
      fill_all(area.regions, area.ledge ? styles.solid : styles.bridge, std::nullopt, areas.part,
               [&](const auto&...) { return area.angle_rad; });
    if (infill.infill_sparse_density > 0) fill_sparse_areas(infill, input, styles.sparse, areas, layer.beads);
    SolidStyle solid = styles.solid, top = styles.top;
    std::optional<geometry::SegmentIndex> sparse;  // lines beside it are as even as any
    if (!areas.sparse.empty() && !(areas.solid.empty() && areas.top.empty()))
      sparse.emplace(areas.sparse), solid.loose = top.loose = &*sparse;
    const std::size_t from = layer.beads.size();
    for (const BeltLine& line : areas.belts) lay(line, styles.solid, areas.part, layer.beads);
    spread_out(flow::spread(input.height, input.overlap_factor), from, layer.beads);
    fill_skin(areas.solid, solid, styles.solid_winds, areas.part, solid_angle, is_on_bridge);
    fill_skin(areas.top, top, styles.top_winds, areas.part, top_angle, [](const Region&) { return false; });
    if (shells.ironing_enabled)
      iron(shells, input, areas, styles.ironing, sequence, layer.beads,
           [&](const Region& region) { return top_angle(styles.top, region) + radians(90); });
  }
  return layer;
}

Notices check(const InfillSettings& infill, Um nozzle_diameter, Um height) {
  if (infill.infill_line_width || infill.infill_sparse_density <= 0 || infill.infill_sparse_density >= 100) return {};
  const double d = to_mm(nozzle_diameter), h = to_mm(height);
  const double strand_mm = std::numbers::pi / 4 * (d * d - h * h) / h + h,
               widest_mm = to_mm(flow::automatic_width(nozzle_diameter, height, false));
  constexpr double noticed = 1.05;  // of the width: a cut by less is not worth a word
  if (strand_mm <= noticed * widest_mm) return {};
  return {
      {"infill_line_width_cut",
       fmt::format("infill_line_width: auto would be {:.2f} mm, a strand of the nozzle's cross-section in layers of "
                   "{:.2f} mm; a nozzle of {:.2f} mm presses none flat beyond {:.2f} mm, and lines are that wide",
                   strand_mm, h, d, widest_mm)}};
}

}  // namespace weft::infill
