// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/box_columns.h"
#include "travel/blocks.h"
#include "travel/comb_base.h"
#include "travel/obstacles.h"
#include "travel/off_surfaces.h"

#include <algorithm>

namespace weft::travel {
namespace {

constexpr std::size_t corners_kept = 12;

Comb comb_boundary(const TravelSettings& settings, const LayerInput& input) {
  if (settings.retraction_combing == Combing::off) return {};
  if (settings.retraction_combing == Combing::infill) return Comb(gathered(input, &ObjectLayer::sparse));
  const bool all = settings.retraction_combing == Combing::all;
  if (all && settings.retraction_combing_offset == 0 && all_closed(input)) return Comb(outer_wall_rings(input));
  const auto base = comb_base(input, all ? settings.retraction_combing_offset : 0);
  if (settings.retraction_combing == Combing::noskin)
    return Comb(geometry::subtract(base, gathered(input, &ObjectLayer::skin)));
  return Comb(base);
}

/// Of each ring, whether what it goes round is a hole: whether an odd number of the others is round it.
std::vector<char> holes_among(const std::vector<Ring>& rings) {
  std::vector<Box> boxes;
  for (const auto& r : rings) boxes.push_back(box_of(r));
  const geometry::BoxColumns columns(std::move(boxes));
  std::vector<char> hole(rings.size(), 0);
  StopNowAndThen stop(64);
  for (std::size_t i = 0; i < rings.size(); ++i) {
    stop.step();
    columns.each_around(i, [&](std::uint32_t k) {
      if (side_of(rings[k], rings[i][0]) == Side::inside) hole[i] = hole[i] == 0;
    });
  }
  return hole;
}

void add_seams(const TravelSettings& settings, Prepared& layer) {
  std::vector<Ring> rings;
  for (std::uint32_t b = 0; b < layer.blocks.size(); ++b) {
    Block& block = layer.blocks[b];
    const Beads& beads = beads_of(layer.input, block);
    for (const std::uint32_t w : block.walls) {
      const bool seam = begins_a_seam_line(beads[w]);
      block.seams.push_back(seam ? static_cast<std::uint32_t>(layer.seams.size()) : Block::no_seam);
      if (!seam) continue;
      layer.seams.push_back({b, w, {}});
      rings.push_back(ring_of(beads[w]));
    }
  }
  const auto hole = holes_among(rings);
  for (std::size_t s = 0; s < rings.size(); ++s) {
    stop_if_asked();
    auto& seam = layer.seams[s];
    const bool counter_clockwise = double_area(rings[s]) > 0;
    const bool material_left = counter_clockwise != (hole[s] != 0);
    const auto& own = seams_of(settings, layer.input, layer.blocks[seam.block]);
    seam.corners = corners_of(beads_of(layer.input, layer.blocks[seam.block])[seam.bead], own.z_seam_corner,
                              material_left, corners_kept);
    if (own.z_seam_visibility_weight == 0 || own.z_seam_type == SeamType::random ||
        own.z_seam_type == SeamType::shortest)
      continue;
    // A corner so much blunter than the best cannot be hidden enough to win: its rays are spared.
    const double decides = 2 * own.z_seam_visibility_weight / std::max(0.01, own.z_seam_corner_weight);
    const auto worth = std::find_if(seam.corners.begin(), seam.corners.end(), [&](const Corner& c) {
      return static_cast<double>(c.strength) < static_cast<double>(seam.corners.front().strength) - decides;
    });
    add_exposure(beads_of(layer.input, layer.blocks[seam.block])[seam.bead], material_left, layer.outline,
                 {seam.corners.begin(), worth});
  }
}

}  // namespace

AreasRead areas_read(const TravelSettings& settings) {
  const auto combing = settings.retraction_combing;
  return {combing == Combing::noskin, combing == Combing::no_outer_surfaces, combing == Combing::infill};
}

Prepared prepare_order(const TravelSettings& settings, LayerInput input) {
  Prepared out;
  out.input = std::move(input);
  out.blocks = blocks_of(out.input);
  out.outline = Comb(gathered(out.input, &ObjectLayer::outline));
  add_seams(settings, out);
  return out;
}

void prepare_ways(const TravelSettings& settings, Prepared& layer) {
  const auto outline = gathered(layer.input, &ObjectLayer::outline);
  if (settings.retraction_combing == Combing::no_outer_surfaces) {
    layer.comb = within_second_walls(layer.input, outline);
    layer.narrows = within_outer_walls(layer.input);
  } else {
    layer.comb = comb_boundary(settings, layer.input);
  }
  layer.free = Comb(free_area(layer.input.room));
}

Prepared prepare(const TravelSettings& settings, LayerInput input) {
  auto out = prepare_order(settings, std::move(input));
  prepare_ways(settings, out);
  return out;
}

}  // namespace weft::travel
