// SPDX-License-Identifier: GPL-3.0-or-later
#include "adhesion/adhesion.h"

#include "adhesion/ears.h"
#include "adhesion/loops.h"
#include "core/convex_hull.h"
#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/offset.h"
#include "model/flow.h"

#include <algorithm>
#include <cmath>
#include <numbers>

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

/// A disc.
Region disc(Point centre, Um radius) {
  constexpr int corners = 48;
  Region out;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    out.outer.push_back({centre.x + rounded(radius * std::cos(angle)), centre.y + rounded(radius * std::sin(angle))});
  }
  return out;
}

/// What of a brim's loops lies around tips of the parts.
std::vector<BrimLoop> at_tips(const AdhesionSettings& settings, const Regions& outlines,
                              const std::vector<BrimLoop>& loops) {
  Regions ears;
  for (const Point tip : tips_of(geometry::unite(outlines), settings.brim_ears_max_angle))
    ears.push_back(disc(tip, settings.brim_gap + settings.brim_width));
  std::vector<BrimLoop> out;
  if (ears.empty()) return out;
  ears = geometry::unite(ears);
  for (const BrimLoop& loop : loops)
    for (BrimLoop& piece : cut_loop(loop, ears, true)) out.push_back(std::move(piece));
  std::erase_if(out, [](const BrimLoop& loop) { return !loop.closed && length_of(loop.line) < shortest_piece; });
  return out;
}

/// The brim, group of parts by group of parts.
void add_brim(const AdhesionSettings& settings, const PlateLayer& first, Um nominal, std::uint32_t first_sequence,
              Layer& layer, Beads& beads) {
  const int count = std::max(1, static_cast<int>(std::lround(static_cast<double>(settings.brim_width) / nominal)));
  const double band = static_cast<double>(settings.brim_width) / count;
  std::vector<BrimLoop> loops = brim_loops(first.outlines, settings.brim_location, settings.brim_gap, band, count);
  if (settings.brim_ears) loops = at_tips(settings, first.outlines, loops);
  // parts whose brims meet are one group
  const Regions groups = geometry::offset(first.outlines, {.by = settings.brim_gap + settings.brim_width + 1,
                                                           .corner = geometry::Corner::round,
                                                           .arc_tolerance = arc_tolerance});
  std::vector<Box> boxes;
  for (const Region& group : groups) boxes.push_back(box_of(group.outer));
  std::vector<std::vector<const BrimLoop*>> of_group(groups.size() + 1);
  for (const BrimLoop& loop : loops) {
    stop_if_asked();
    const Point p = loop.line.front();
    std::size_t g = 0;
    while (g < groups.size() && !(boxes[g].contains(p) && side_of(groups[g].outer, p) != Side::outside)) ++g;
    of_group[g].push_back(&loop);
  }
  for (std::size_t g = 0; g < of_group.size(); ++g)
    for (const BrimLoop* loop : of_group[g])
      layer.add(*loop, rounded(band), Role::brim, first_sequence + static_cast<std::uint32_t>(g), beads);
}

}  // namespace

std::size_t layers_needed(const AdhesionSettings& settings) {
  const bool skirt = settings.skirt_line_count > 0;
  return std::max<std::size_t>(skirt ? static_cast<std::size_t>(settings.skirt_height) : 0,
                               settings.brim_width > 0 ? 1 : 0);
}

Adhesion build(const AdhesionSettings& settings, const AdhesionInput& input) {
  Adhesion result;
  const std::size_t height = std::min(layers_needed(settings), input.layers.size());
  result.layers.resize(height);
  if (height == 0) return result;
  const PlateLayer& first = input.layers.front();
  Layer layer(settings, input);

  Beads brim;
  if (settings.brim_width > 0) {
    add_brim(settings, first, band_of(settings, input.nozzle, first.height), 2, layer, brim);
    layer.report("brim", result.notices);
    if (settings.brim_ears && brim.empty() && !first.outlines.empty())
      result.notices.push_back(
          {"brim_no_tips",
           fmt::format("brim_ears: the parts have no tip sharper than {:g}° (brim_ears_max_angle): there is no brim",
                       settings.brim_ears_max_angle)});
  }
  if (settings.skirt_line_count > 0) {
    std::vector<Point> points;
    for (std::size_t i = 0; i < height; ++i)
      for (const Region& region : input.layers[i].outlines)
        points.insert(points.end(), region.outer.begin(), region.outer.end());
    const Ring hull = convex_hull(std::move(points));
    double missing_mm = to_mm(settings.skirt_brim_minimal_length);
    for (const Bead& bead : brim) missing_mm -= length_mm(bead);
    const bool brim_outside = settings.brim_width > 0 && settings.brim_location != BrimLocation::inside;
    const Um clear = settings.skirt_gap + (brim_outside ? settings.brim_gap + settings.brim_width : 0);
    for (std::size_t i = 0; i < height && hull.size() >= 3; ++i) {
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
