// SPDX-License-Identifier: GPL-3.0-or-later
// What each pattern costs a millimetre of line, on one core: a prism of 100 mm with a hole of 30, at a density.
//   benchmark_infill [PERCENT]...
// Beside it the budget: what a slicer that is to spend a tenth of its time on infill can afford.
#include "infill/infill.h"
#include "infill/prepared.h"

#include <array>
#include <chrono>
#include <cstdlib>
#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace {
using namespace weft;
using namespace weft::literals;

constexpr std::size_t layer_count = 40;

/// µs a mm.
double budget_of(InfillPattern pattern) {
  constexpr std::array slow{InfillPattern::fermat, InfillPattern::voronoi, InfillPattern::voronoi_3d,
                            InfillPattern::streamlines, InfillPattern::medial};
  constexpr std::array families{InfillPattern::lines,           InfillPattern::grid,
                                InfillPattern::triangles,       InfillPattern::zigzag,
                                InfillPattern::aligned,         InfillPattern::slanted,
                                InfillPattern::crosszag,        InfillPattern::lockedzag,
                                InfillPattern::trihexagon,      InfillPattern::cubic,
                                InfillPattern::tetrahedral,     InfillPattern::quarter_cubic,
                                InfillPattern::lateral_lattice, InfillPattern::lateral_honeycomb};
  for (const auto p : slow)
    if (p == pattern) return 4;
  for (const auto p : families)
    if (p == pattern) return 0.3;
  return 1;
}

struct Prism {
  Regions outline{{{{-50'000, -50'000}, {50'000, -50'000}, {50'000, 50'000}, {-50'000, 50'000}},
                   {{{-15'000, -15'000}, {-15'000, 15'000}, {15'000, 15'000}, {15'000, -15'000}}}}};
  std::vector<infill::ShellLayer> layers;
  std::vector<infill::LayerAreas> areas;
  Prism() {
    for (std::size_t i = 0; i < layer_count; ++i) {
      layers.push_back({static_cast<Um>(200 * (i + 1)), 200, &outline, &outline});
      infill::PartAreas part;
      part.sparse = outline;
      areas.push_back({part});
    }
  }
};

using Clock = std::chrono::steady_clock;
double milliseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

void measure(const Prism& prism, InfillPattern pattern, std::string_view name, double percent) {
  InfillSettings settings;
  settings.infill_pattern = pattern, settings.infill_sparse_density = percent, settings.infill_line_width = 450;
  auto start = Clock::now();
  const infill::Prepared prepared =
      infill::prepare(settings, {prism.layers, infill::box_of(prism.layers), 400}, prism.areas, {}, {});
  const double before = milliseconds_since(start);
  double mm = 0;
  start = Clock::now();
  for (std::size_t i = 0; i < layer_count; ++i) {
    const auto layer = infill::fill(settings, {},
                                    {.areas = prism.areas[i],
                                     .index = i,
                                     .z = prism.layers[i].z,
                                     .height = 200,
                                     .nozzle = 400,
                                     .reach = 50'000,
                                     .prepared = &prepared});
    for (const Bead& bead : layer.beads) mm += length_mm(bead);
  }
  const double ms = milliseconds_since(start);
  const double each = 1000 * ms / mm, budget = budget_of(pattern);
  fmt::print("{:18} {:3.0f} %  {:7.3f} µs/mm  budget {:3.1f}{}  prepared in {:7.1f} ms\n", name, percent, each, budget,
             each > budget ? " ✗" : "  ", before);
}
}  // namespace

int main(int count, char** arguments) {
  std::vector<double> densities;
  for (int i = 1; i < count; ++i) densities.push_back(std::atof(arguments[i]));
  if (densities.empty()) densities = {20};
  const Prism prism;
  for (const auto& choice : choices_of(InfillPattern{}))
    for (const double percent : densities) measure(prism, choice.value, choice.name, percent);
}
