#include "pipeline/sample.h"

#include <array>
#include <utility>

namespace weft::pipeline {
namespace {

/// What a role grows with: its length and time, and its volume.
struct Grows {
  double (*length)(const LayerMeasure&);
  double (*volume)(const LayerMeasure&);
};

double by_outline(const LayerMeasure& m) {
  return m.outline_mm;
}
double by_walls(const LayerMeasure& m) {
  return m.walls_mm3;
}
template <double LayerMeasure::*area>
double by_area(const LayerMeasure& m) {
  return m.*area;
}
template <double LayerMeasure::*area>
double by_volume(const LayerMeasure& m) {
  return m.*area * m.height_mm;
}
double by_layer(const LayerMeasure&) {
  return 1;
}

/// Null for what is planned on every layer.
Grows growth_of(Role role) {
  switch (role) {
    case Role::outer_wall:
    case Role::inner_wall:
    case Role::overhang_wall:
    case Role::gap_fill:
      return {by_outline, by_walls};
    case Role::infill:
      return {by_area<&LayerMeasure::sparse_mm2>, by_volume<&LayerMeasure::sparse_mm2>};
    case Role::solid_infill:
      return {by_area<&LayerMeasure::solid_mm2>, by_volume<&LayerMeasure::solid_mm2>};
    case Role::top_skin:
      return {by_area<&LayerMeasure::top_mm2>, by_volume<&LayerMeasure::top_mm2>};
    case Role::bridge:
      return {by_area<&LayerMeasure::bridge_mm2>, by_volume<&LayerMeasure::bridge_mm2>};
    case Role::skirt:
    case Role::brim:
      return {nullptr, nullptr};
    default:
      return {by_layer, by_layer};
  }
}

/// For each mm that the layers of the sample have, how many those have that they stand for.
class Ratios {
 public:
  Ratios(const Sample& sample, std::span<const LayerMeasure> measures) : sample_(sample), measures_(measures) {}
  double missing(double (*what)(const LayerMeasure&)) const {
    double sampled = 0, left_out = 0;
    for (std::size_t i = Sample::own_kind; i < measures_.size(); ++i)
      (sample_.has(i) ? sampled : left_out) += what(measures_[i]);
    return sampled > 0 ? left_out / sampled : 0;
  }

 private:
  const Sample& sample_;
  std::span<const LayerMeasure> measures_;
};

}  // namespace

void LayerMeasure::add(const LayerMeasure& other, double copies) {
  outline_mm += copies * other.outline_mm;
  walls_mm3 += copies * other.walls_mm3;
  solid_mm2 += copies * other.solid_mm2;
  top_mm2 += copies * other.top_mm2;
  sparse_mm2 += copies * other.sparse_mm2;
  bridge_mm2 += copies * other.bridge_mm2;
  height_mm = std::max(height_mm, other.height_mm);
}

Statistics extrapolated(const Sample& sample, std::span<const Statistics> layers,
                        std::span<const LayerMeasure> measures) {
  Statistics out, stands;  // everything planned; of it the layers that stand for others
  for (std::size_t i = 0; i < layers.size(); ++i) {
    out.append(layers[i]);
    if (i >= Sample::own_kind && sample.has(i)) stands.append(layers[i]);
  }
  if (sample.all() || measures.size() != layers.size()) return out;

  const Ratios ratios(sample, measures);
  double beads_mm3 = 0, beads_s = 0, more_mm3 = 0, more_s = 0;
  for (std::size_t r = 0; r < stands.features.size(); ++r) {
    const auto grows = growth_of(static_cast<Role>(r));
    const auto& feature = stands.features[r];
    beads_mm3 += feature.mm3;
    beads_s += feature.s;
    if (!grows.length) continue;
    const double longer = ratios.missing(grows.length), more = ratios.missing(grows.volume);
    out.features[r].mm += longer * feature.mm;
    out.features[r].s += longer * feature.s;
    out.features[r].mm3 += more * feature.mm3;
    more_s += longer * feature.s;
    more_mm3 += more * feature.mm3;
  }
  const double more_layers = ratios.missing(by_layer), more_walls = ratios.missing(by_outline);
  const auto more = [](auto& to, auto of, double factor) {
    to += static_cast<decltype(of)>(factor * static_cast<double>(of));
  };
  more(out.travel.mm, stands.travel.mm, more_layers);
  more(out.travel.s, stands.travel.s, more_layers);
  more(out.travel.moves, stands.travel.moves, more_layers);
  more(out.travel.retractions, stands.travel.retractions, more_layers);
  more(out.travel.wall_crossings, stands.travel.wall_crossings, more_layers);
  more(out.travel.retraction_s, stands.travel.retraction_s, more_layers);
  more(out.walls.beads, stands.walls.beads, more_walls);
  more(out.walls.variable_width_mm, stands.walls.variable_width_mm, more_walls);
  more(out.walls.flow_compensated_mm, stands.walls.flow_compensated_mm, more_walls);
  more_s += more_layers * (stands.travel.s + stands.travel.retraction_s);
  const double parts_s = beads_s + stands.travel.s + stands.travel.retraction_s;
  // What is not in the parts (extra prime, the flow of the material) grows as they do.
  const double filament = beads_mm3 > 0 ? more_mm3 / beads_mm3 : 0, time = parts_s > 0 ? more_s / parts_s : 0;
  out.filament_mm += filament * stands.filament_mm;
  out.filament_mm3 += filament * stands.filament_mm3;
  out.filament_g += filament * stands.filament_g;
  out.print_time_s += time * stands.print_time_s;
  out.layer_s.clear();  // not known one by one
  return out;
}

}  // namespace weft::pipeline
