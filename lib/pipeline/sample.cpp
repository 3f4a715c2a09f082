// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/sample.h"

#include <array>
#include <optional>
#include <vector>

namespace weft::pipeline {
namespace {

/// What the beads of a role grow with; nothing: they are planned on every layer, whatever the sample.
struct Grows {
  Role role;
  std::optional<Growth> with;
};
constexpr std::array grows{
    Grows{Role::outer_wall, Growth::walls},
    Grows{Role::inner_wall, Growth::walls},
    Grows{Role::overhang_wall, Growth::walls},
    Grows{Role::infill, Growth::sparse},
    Grows{Role::solid_infill, Growth::solid},
    Grows{Role::top_skin, Growth::top},
    Grows{Role::bridge, Growth::bridge},
    Grows{Role::overhang_skin, Growth::solid},
    Grows{Role::gap_fill, Growth::walls},
    Grows{Role::skirt, std::nullopt},
    Grows{Role::brim, std::nullopt},
    Grows{Role::support, std::nullopt},
    Grows{Role::support_interface, std::nullopt},
    Grows{Role::wipe_tower, std::nullopt},
    Grows{Role::ironing, Growth::top},
};
static_assert(grows.size() == roles.size() && in_order(grows, &Grows::role), "row i of grows is role i");

std::optional<Growth> growth_of(Role role) {
  return row_of(grows, role).with;
}

/// How much was left out for each unit that was planned.
LayerMeasure::Amount missing(const SampleMeasure& measure, Growth g) {
  const auto &planned = measure.planned[g], &left_out = measure.left_out[g];
  return {planned.length > 0 ? left_out.length / planned.length : 0,
          planned.volume > 0 ? left_out.volume / planned.volume : 0};
}

/// Kinds of fill that no layer of the sample has go by another that it has, area by area: a part may have a single top.
struct StandIn {
  Role role, by;
};
std::vector<StandIn> stand_ins(const Statistics& above, const SampleMeasure& measure) {
  constexpr std::array fills{Role::solid_infill, Role::top_skin, Role::bridge};
  std::vector<StandIn> out;
  for (const Role role : fills) {
    const Growth own = *growth_of(role);
    if (measure.planned[own].length > 0 || measure.left_out[own].length <= 0) continue;
    for (const Role by : fills)
      if (measure.planned[*growth_of(by)].length > 0 && above.features[static_cast<std::size_t>(by)].mm > 0) {
        out.push_back({role, by});
        break;
      }
  }
  return out;
}

/// What a plan of the same statistics, of which each count and length is `factor` times as large, takes more.
void add_travels(Statistics& out, const Statistics& above, double factor) {
  const auto more = [factor](auto& to, auto of) { to += static_cast<decltype(of)>(factor * static_cast<double>(of)); };
  more(out.travel.mm, above.travel.mm);
  more(out.travel.s, above.travel.s);
  more(out.travel.moves, above.travel.moves);
  more(out.travel.retractions, above.travel.retractions);
  more(out.travel.wall_crossings, above.travel.wall_crossings);
  more(out.travel.retraction_s, above.travel.retraction_s);
}

void add_walls(Statistics& out, const Statistics& above, double factor) {
  out.walls.beads += static_cast<std::int64_t>(factor * static_cast<double>(above.walls.beads));
  out.walls.variable_width_mm += factor * above.walls.variable_width_mm;
  out.walls.flow_compensated_mm += factor * above.walls.flow_compensated_mm;
  for (std::size_t i = 0; i < out.walls.over_air_mm.size(); ++i)
    out.walls.over_air_mm[i] += factor * above.walls.over_air_mm[i];
  out.walls.whole_over_air_mm += factor * above.walls.whole_over_air_mm;
}

void add_filament(Statistics& out, const Statistics& above, double factor) {
  out.filament_mm += factor * above.filament_mm;
  out.filament_mm3 += factor * above.filament_mm3;
  out.filament_g += factor * above.filament_g;
  for (std::size_t i = 0; i < above.tools.size() && i < out.tools.size(); ++i) {
    out.tools[i].filament_mm += factor * above.tools[i].filament_mm;
    out.tools[i].filament_mm3 += factor * above.tools[i].filament_mm3;
    out.tools[i].filament_g += factor * above.tools[i].filament_g;
  }
}

}  // namespace

bool Sample::has(std::size_t layer) const {
  if (all() || layer < own_kind) return true;
  const std::size_t block = (layer - own_kind) / stride, within = (layer - own_kind) % stride;
  return within == (block ^ (block >> 2)) % stride;  // each place equally often, and no two blocks long in step
}

bool has_beads(const Statistics& layer) {
  for (std::size_t r = 0; r < layer.features.size(); ++r)
    if (layer.features[r].mm > 0 && growth_of(static_cast<Role>(r))) return true;
  return false;
}

void LayerMeasure::add(const LayerMeasure& other, double copies) {
  for (std::size_t i = 0; i < growths; ++i) {
    amounts[i].length += copies * other.amounts[i].length;
    amounts[i].volume += copies * other.amounts[i].volume;
  }
}

Statistics extrapolated(const Statistics& bottom, const Statistics& above, const SampleMeasure& measure) {
  Statistics out = bottom;
  out.append(above);
  double beads_mm3 = 0, parts_s = 0, more_mm3 = 0, more_s = 0;
  for (std::size_t r = 0; r < above.features.size(); ++r) {
    const auto& feature = above.features[r];
    beads_mm3 += feature.mm3;
    parts_s += feature.s;
    const auto with = growth_of(static_cast<Role>(r));
    if (!with) continue;
    const auto more = missing(measure, *with);
    out.features[r].mm += more.length * feature.mm;
    out.features[r].s += more.length * feature.s;
    out.features[r].mm3 += more.volume * feature.mm3;
    more_s += more.length * feature.s;
    more_mm3 += more.volume * feature.mm3;
  }
  for (const auto& [role, by] : stand_ins(above, measure)) {
    const auto& of = measure.left_out[*growth_of(role)];
    const auto& planned = measure.planned[*growth_of(by)];
    const auto& like = above.features[static_cast<std::size_t>(by)];
    auto& feature = out.features[static_cast<std::size_t>(role)];
    const double length = of.length / planned.length, volume = of.volume / planned.volume;
    feature.mm += length * like.mm, feature.s += length * like.s, feature.mm3 += volume * like.mm3;
    more_s += length * like.s, more_mm3 += volume * like.mm3;
  }
  const double layers = missing(measure, Growth::layers).length;
  add_travels(out, above, layers);
  add_walls(out, above, missing(measure, Growth::walls).length);
  const double travels_s = above.travel.s + above.travel.retraction_s;
  more_s += layers * travels_s;
  parts_s += travels_s;
  // What is not in the parts (extra prime, the flow of the material, waiting) grows as they do.
  add_filament(out, above, beads_mm3 > 0 ? more_mm3 / beads_mm3 : 0);
  out.print_time_s += (parts_s > 0 ? more_s / parts_s : 0) * above.print_time_s;
  out.layer_s.clear(), out.silent_layer_s.clear();  // not known one by one
  return out;
}

}  // namespace weft::pipeline
