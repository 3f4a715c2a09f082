// SPDX-License-Identifier: GPL-3.0-or-later
// What each pattern costs a millimetre of line, on one core: a prism of 100 mm with a hole of 30, at a density.
//   benchmark_infill [PERCENT | PATTERN]...
// Beside it the budget: what a slicer that is to spend a tenth of its time on infill can afford.
#include "infill/infill.h"
#include "infill/prepared.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <ctime>
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

/// Of the processor: what else the machine does counts for nothing.
double milliseconds_since(std::clock_t start) {
  return 1000.0 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

void measure(const Prism& prism, InfillPattern pattern, std::string_view name, double percent) {
  InfillSettings settings;
  settings.infill_pattern = pattern, settings.infill_sparse_density = percent, settings.infill_line_width = 450;
  auto start = std::clock();
  const infill::Prepared prepared =
      infill::prepare(settings, {prism.layers, infill::box_of(prism.layers), 400}, prism.areas, {}, {});
  const double before = milliseconds_since(start);
  double mm = 0;
  start = std::clock();
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
  std::vector<std::string_view> only;
  for (int i = 1; i < count; ++i)
    if (const double percent = std::atof(arguments[i]); percent > 0)
      densities.push_back(percent);
    else
      only.emplace_back(arguments[i]);
  if (densities.empty()) densities = {20};
  const Prism prism;
  for (const auto& choice : choices_of(InfillPattern{})) {
    if (!only.empty() && std::find(only.begin(), only.end(), choice.name) == only.end()) continue;
    for (const double percent : densities) measure(prism, choice.value, choice.name, percent);
  }
}
