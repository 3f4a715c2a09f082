// SPDX-License-Identifier: GPL-3.0-or-later
#include "adhesion/adhesion.h"

#include "adhesion/loops.h"
#include "adhesion/places.h"
#include "core/convex_hull.h"
#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/offset.h"
#include "model/flow.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace weft::adhesion {
namespace {

using namespace weft::literals;

constexpr Um arc_tolerance = 0.025_mm;
constexpr Um shortest_piece = 1_mm;  // what is left of a cut loop and shorter does not stick
constexpr int most_loops = 10000;    // of a skirt that grows to its minimal length

Um band_of(const AdhesionSettings& settings, Um nozzle, Um height) {
  return flow::band(length_or(settings.skirt_brim_line_width, nozzle, flow::automatic_width(nozzle, height)), height);
}

Bead bead_of(const BrimLoop& loop, Um width, Role role, std::uint32_t sequence) {
  Bead bead;
  bead.role = role, bead.closed = loop.closed, bead.sequence = sequence;
  bead.inset = static_cast<std::uint16_t>(std::min(loop.loop, 65535));
  bead.path.reserve(loop.line.size());
  for (const Point p : loop.line) bead.path.push_back({p, width, 1.F});
  return bead;
}

/// Loops as beads, cut to the print surface where that is asked for.
class Layer {
 public:
  Layer(const AdhesionSettings& settings, const AdhesionInput& input)
      : surface_(settings.adhesion_outside == AdhesionOutside::clip ? input.print_surface : nullptr) {}

  void add(const BrimLoop& loop, Um width, Role role, std::uint32_t sequence, Beads& beads) {
    if (loop.line.size() < 2) return;
    if (surface_ == nullptr) {
      beads.push_back(bead_of(loop, width, role, sequence));
      return;
    }
    if (surface_width_ != width) {
      surface_width_ = width;
      reach_ = geometry::offset({{*surface_, {}}}, {.by = -(width + 1) / 2});
    }
    const double before = loop.closed ? perimeter_of(loop.line) : length_of(loop.line);
    double kept = 0;
    for (const BrimLoop& piece : cut_loop(loop, reach_, true)) {
      const double way = piece.closed ? perimeter_of(piece.line) : length_of(piece.line);
      if (!piece.closed && way < shortest_piece) continue;
      kept += way;
      beads.push_back(bead_of(piece, width, role, sequence));
    }
    lost_um_ += std::max(0.0, before - kept);
  }

  void report(std::string_view what, Notices& notices) {
    if (lost_um_ >= 1)
      notices.push_back(
          {fmt::format("{}_clipped", what),
           fmt::format("{:.1f} mm of the {} would leave the print surface and were cut off", lost_um_ / 1000, what)});
    lost_um_ = 0;
  }

 private:
  const Ring* surface_;
  Regions reach_;
  Um surface_width_ = 0;
  double lost_um_ = 0;
};

/// The brim of a foot, group of parts by group of parts.
/// @param others what else stands there, with brims that are laid already
/// @param sequence of the first group; grows by their number
/// @return what it covers, with the parts, about
Regions add_brim(const Foot& foot, Um nominal, const Regions& others, std::uint32_t& sequence, Layer& layer,
                 Beads& beads) {
  const auto& settings = foot.settings;
  const int count = std::max(1, static_cast<int>(std::lround(static_cast<double>(settings.brim_width) / nominal)));
  const double band = static_cast<double>(settings.brim_width) / count;
  auto loops = brim_loops(foot.outlines, settings.brim_location, settings.brim_gap, band, count, others);
  const auto places = brim_places(settings, foot.outlines);
  if (places)
    for (auto& loop : std::exchange(loops, {}))
      for (auto& piece : cut_loop(loop, *places, true))
        if (piece.closed || length_of(piece.line) >= shortest_piece) loops.push_back(std::move(piece));
  // parts whose brims meet are one group
  const Regions groups = geometry::offset(foot.outlines, {.by = settings.brim_gap + settings.brim_width + 1,
                                                          .corner = geometry::Corner::round,
                                                          .arc_tolerance = arc_tolerance});
  // … and so is each place of its own: pieces of a loop that was cut are far from each other
  constexpr Um on_the_edge = 5;  // where they were cut
  const Regions together = places ? geometry::offset(*places, {.by = on_the_edge}) : groups;
  std::vector<Box> boxes;
  for (const Region& group : together) boxes.push_back(box_of(group.outer));
  std::vector<std::vector<const BrimLoop*>> of_group(together.size() + 1);
  for (const BrimLoop& loop : loops) {
    stop_if_asked();
    const Point p = loop.line.front();
    std::size_t g = 0;
    while (g < together.size() && !(boxes[g].contains(p) && side_of(together[g].outer, p) != Side::outside)) ++g;
    of_group[g].push_back(&loop);
  }
  for (std::size_t g = 0; g < of_group.size(); ++g)
    for (const BrimLoop* loop : of_group[g])
      layer.add(*loop, rounded(band), Role::brim, sequence + static_cast<std::uint32_t>(g), beads);
  sequence += static_cast<std::uint32_t>(of_group.size());
  return groups;
}

/// What stands there and is not of that foot.
Regions others_than(std::size_t foot, std::span<const Foot> feet) {
  Regions out;
  for (std::size_t i = 0; i < feet.size(); ++i)
    if (i != foot) out.insert(out.end(), feet[i].outlines.begin(), feet[i].outlines.end());
  return out;
}

/// How far brims reach beyond what they lie around.
Um reach_of(std::span<const Foot> feet) {
  Um out = 0;
  for (const auto& [outlines, settings] : feet)
    if (settings.brim_width > 0 && settings.brim_location != BrimLocation::inside)
      out = std::max(out, settings.brim_gap + settings.brim_width);
  return out;
}

/// Asked for ears only, and there is nothing to put one at.
void tell_no_tips(const Foot& foot, bool bare, Notices& notices) {
  if (bare && foot.settings.brim_ears && foot.settings.brim_narrow_width == 0 && !foot.outlines.empty())
    notices.push_back(
        {"brim_no_tips",
         fmt::format("brim_ears: the parts have no tip sharper than {:g}° (brim_ears_max_angle): there is no brim",
                     foot.settings.brim_ears_max_angle)});
}

}  // namespace

std::size_t layers_needed(const AdhesionSettings& settings) {
  const bool skirt = settings.skirt_line_count > 0;
  return std::max<std::size_t>(skirt ? static_cast<std::size_t>(settings.skirt_height) : 0,
                               settings.brim_width > 0 ? 1 : 0);
}

Adhesion build(const AdhesionSettings& settings, const AdhesionInput& input) {
  Adhesion result;
  std::size_t wanted = layers_needed(settings);
  for (const auto& foot : input.feet) wanted = std::max(wanted, layers_needed(foot.settings));
  const std::size_t height = std::min(wanted, input.layers.size());
  result.layers.resize(height);
  if (height == 0) return result;
  const PlateLayer& first = input.layers.front();
  Layer layer(settings, input);

  Beads brim;
  const Foot all{first.outlines, settings};
  const std::span<const Foot> feet = input.feet.empty() ? std::span(&all, 1) : input.feet;
  std::uint32_t sequence = 2;
  Regions laid;  // brims
  for (std::size_t i = 0; i < feet.size(); ++i) {
    if (feet[i].settings.brim_width == 0) continue;
    const std::size_t before = brim.size();
    Regions others = others_than(i, feet);
    others.insert(others.end(), laid.begin(), laid.end());
    const Regions own = add_brim(feet[i], band_of(settings, input.nozzle, first.height), others, sequence, layer, brim);
    laid.insert(laid.end(), own.begin(), own.end());
    tell_no_tips(feet[i], brim.size() == before, result.notices);
  }
  layer.report("brim", result.notices);
  if (settings.skirt_line_count > 0) {
    std::vector<Point> points;
    for (std::size_t i = 0; i < height; ++i)
      for (const Region& region : input.layers[i].outlines)
        points.insert(points.end(), region.outer.begin(), region.outer.end());
    const Ring hull = convex_hull(std::move(points));
    double missing_mm = to_mm(settings.skirt_brim_minimal_length);
    for (const Bead& bead : brim) missing_mm -= length_mm(bead);
    const Um clear = settings.skirt_gap + reach_of(feet);
    for (std::size_t i = 0; i < std::min(height, layers_needed(settings)) && hull.size() >= 3; ++i) {
      const Um band = band_of(settings, input.nozzle, input.layers[i].height);
      std::vector<BrimLoop> loops;
      for (int k = 0; k < settings.skirt_line_count || (i == 0 && missing_mm > 0 && k < most_loops); ++k) {
        const Regions loop = geometry::offset(
            {{hull, {}}},
            {.by = clear + k * band + band / 2, .corner = geometry::Corner::round, .arc_tolerance = arc_tolerance});
        if (loop.empty() || box_of(loop).size().x > max_coord / 2) break;
        missing_mm -= perimeter_of(loop.front().outer) / 1000;
        loops.push_back({loop.front().outer, true, k});
      }
      for (auto loop = loops.rbegin(); loop != loops.rend(); ++loop)
        layer.add(*loop, band, Role::skirt, 1, result.layers[i]);
    }
    layer.report("skirt", result.notices);
  }
  Beads& bottom = result.layers.front();
  bottom.insert(bottom.end(), std::make_move_iterator(brim.begin()), std::make_move_iterator(brim.end()));
  return result;
}

}  // namespace weft::adhesion
