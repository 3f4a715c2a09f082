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

Ring ring_of(const Bead& bead) {
  Ring ring;
  ring.reserve(bead.path.size());
  for (const auto& j : bead.path) ring.push_back(j.at);
  return ring;
}

std::vector<Ring> outer_wall_rings(const LayerInput& input) {
  std::vector<Ring> rings;
  for (const auto& object : input.objects)
    for (const auto& bead : object.beads)
      if (begins_a_seam_line(bead)) rings.push_back(ring_of(bead));
  return rings;
}

Regions gathered(const LayerInput& input, Regions ObjectLayer::*which) {
  Regions all;
  for (const auto& object : input.objects) all.insert(all.end(), (object.*which).begin(), (object.*which).end());
  return all;
}

/// A line's width, for keeping clear of the outer wall.
Um outer_wall_width(const LayerInput& input) {
  for (const auto& object : input.objects)
    for (const auto& bead : object.beads)
      if (begins_a_seam_line(bead)) return bead.path[0].width;
  return 0;
}

Comb comb_boundary(const TravelSettings& settings, const LayerInput& input, const Regions& outline) {
  if (settings.retraction_combing == Combing::off) return {};
  if (settings.retraction_combing == Combing::infill) return Comb(gathered(input, &ObjectLayer::sparse));
  auto rings = outer_wall_rings(input);
  if (settings.retraction_combing == Combing::all && settings.retraction_combing_offset == 0)
    return rings.empty() ? Comb(outline) : Comb(std::move(rings));
  const auto base = rings.empty() ? outline : geometry::regions_from_rings(rings, geometry::WindingRule::even_odd);
  if (settings.retraction_combing == Combing::noskin)
    return Comb(geometry::subtract(base, gathered(input, &ObjectLayer::skin)));
  if (settings.retraction_combing == Combing::no_outer_surfaces) {
    const auto inner = geometry::offset(base, {.by = -outer_wall_width(input)});
    return Comb(geometry::subtract(inner, gathered(input, &ObjectLayer::top)));
  }
  return Comb(geometry::offset(base, {.by = settings.retraction_combing_offset, .corner = geometry::Corner::round}));
}

/// Of each ring, whether what it goes round is a hole: whether an odd number of the others is round it.
std::vector<char> holes_among(const std::vector<Ring>& rings) {
  std::vector<Box> boxes;
  for (const auto& r : rings) boxes.push_back(box_of(r));
  std::vector<char> hole(rings.size(), 0);
  for (std::size_t i = 0; i < rings.size(); ++i)
    for (std::size_t k = 0; k < rings.size(); ++k)
      if (i != k && boxes[k].contains(boxes[i].min) && boxes[k].contains(boxes[i].max) &&
          side_of(rings[k], rings[i][0]) == Side::inside)
        hole[i] = hole[i] == 0;
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
    auto& seam = layer.seams[s];
    const bool counter_clockwise = double_area(rings[s]) > 0;
    const bool material_left = counter_clockwise != (hole[s] != 0);
    seam.corners = corners_of(beads_of(layer.input, layer.blocks[seam.block])[seam.bead], settings.z_seam_corner,
                              material_left, corners_kept);
    if (settings.z_seam_visibility_weight != 0 && settings.z_seam_type != SeamType::random)
      add_exposure(beads_of(layer.input, layer.blocks[seam.block])[seam.bead], material_left, layer.outline,
                   seam.corners);
  }
}

}  // namespace

Prepared prepare(const TravelSettings& settings, LayerInput input) {
  Prepared out;
  out.input = std::move(input);
  out.blocks = blocks_of(out.input);
  const auto outline = gathered(out.input, &ObjectLayer::outline);
  out.comb = comb_boundary(settings, out.input, outline);
  out.outline = Comb(outline);
  add_seams(settings, out);
  return out;
}

Notices check(const TravelSettings& settings, const RetractionSettings& retraction) {
  Notices notices;
  const auto say = [&](std::string message) { notices.push_back({"setting_without_effect", std::move(message)}); };
  if (settings.retraction_combing_offset != 0 && settings.retraction_combing != Combing::all)
    say("retraction_combing_offset has no effect: it moves the boundary of retraction_combing = all only");
  if (settings.retraction_combing_max_distance && settings.retraction_combing == Combing::off)
    say("retraction_combing_max_distance has no effect: retraction_combing is off");
  if ((settings.z_seam_x != 0 || settings.z_seam_y != 0) && settings.z_seam_type != SeamType::user)
    say("z_seam_x and z_seam_y have no effect: z_seam_type is not user");
  if (retraction.wipe && retraction.firmware_retraction)
    say("wipe has no effect: with firmware_retraction the firmware draws the filament back at once");
  if (!retraction.retraction_enable && retraction.retraction_hop > 0)
    say("retraction_hop has no effect: lifts go with retractions, and retraction_enable is off");
  return notices;
}

}  // namespace weft::travel
