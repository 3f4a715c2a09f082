#include "geometry/boolean.h"
#include "geometry/offset.h"
#include "travel/blocks.h"

namespace weft::travel {
namespace {

constexpr std::size_t corners_kept = 12;

bool begins_a_seam_line(const Bead& bead) {
  return bead.closed && bead.inset == 0 && bead.path.size() > 2 &&
         (bead.role == Role::outer_wall || bead.role == Role::overhang_wall);
}

std::vector<Ring> outer_wall_rings(const LayerInput& input) {
  std::vector<Ring> rings;
  for (const auto& object : input.objects)
    for (const auto& bead : object.beads) {
      if (!begins_a_seam_line(bead)) continue;
      Ring ring;
      ring.reserve(bead.path.size());
      for (const auto& j : bead.path) ring.push_back(j.at);
      rings.push_back(std::move(ring));
    }
  return rings;
}

Regions outline_of(const LayerInput& input) {
  Regions all;
  for (const auto& object : input.objects) all.insert(all.end(), object.outline.begin(), object.outline.end());
  return all;
}

Comb comb_boundary(const TravelSettings& settings, const LayerInput& input, const Regions& outline) {
  if (settings.retraction_combing == Combing::off) return {};
  auto rings = outer_wall_rings(input);
  if (rings.empty()) return Comb(outline);
  if (settings.retraction_combing != Combing::all || settings.retraction_combing_offset == 0)
    return Comb(std::move(rings));
  const auto centrelines = geometry::regions_from_rings(rings, geometry::WindingRule::even_odd);
  return Comb(
      geometry::offset(centrelines, {.by = settings.retraction_combing_offset, .corner = geometry::Corner::round}));
}

}  // namespace

Prepared prepare(const TravelSettings& settings, LayerInput input) {
  Prepared out;
  out.input = std::move(input);
  out.blocks = blocks_of(out.input);
  for (std::uint32_t b = 0; b < out.blocks.size(); ++b) {
    Block& block = out.blocks[b];
    const Beads& beads = beads_of(out.input, block);
    for (const std::uint32_t w : block.walls) {
      const bool seam = begins_a_seam_line(beads[w]);
      block.seams.push_back(seam ? static_cast<std::uint32_t>(out.seams.size()) : Block::no_seam);
      if (seam) out.seams.push_back({b, w, corners_of(beads[w], settings.z_seam_corner, corners_kept)});
    }
  }
  const auto outline = outline_of(out.input);
  out.comb = comb_boundary(settings, out.input, outline);
  out.outline = Comb(outline);
  return out;
}

}  // namespace weft::travel
