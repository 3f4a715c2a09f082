// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/prime_lines.h"

#include "geometry/boolean.h"
#include "model/flow.h"
#include "pipeline/place_tower.h"

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

namespace weft::pipeline {
namespace {

/// A line is so long, or that share of the bed: some 17 mm³ with a nozzle of 0.4 mm, which fills one that has oozed.
constexpr Um longest = 100'000;
constexpr double most_of_bed = 0.6;
/// Between the lines of two tools, and between them and what stands on the bed.
constexpr Um apart = 1000, beside = 2000;
constexpr Um step = 1000;

/// Tools in the order that they are loaded.
std::vector<ToolId> tools_of(const Passes& passes) {
  std::vector<ToolId> out;
  for (const auto& pass : passes.passes)
    if (std::find(out.begin(), out.end(), pass.tool) == out.end()) out.push_back(pass.tool);
  return out;
}

/// The front left corner of a box of that size, as far in front as it has room, in the middle or at the sides.
std::optional<Point> place_for(Point size, const MachineSettings& machine, std::span<const Box> standing) {
  const Ring surface = print_surface(machine);
  const Box bed = box_of(surface);
  const Regions on{{surface, {}}};
  Regions off;
  for (const Ring& ring : machine.bed_exclude_areas) off.push_back({ring, {}});
  const Um first = bed.min.x + beside, last = bed.max.x - beside - size.x;
  for (Um y = bed.min.y + beside; y + size.y + beside <= bed.max.y; y += step)
    for (const Um x : {(first + last) / 2, first, last}) {
      const Box here{{x, y}, {x + size.x, y + size.y}};
      const Box kept = here.grown(beside);
      if (std::any_of(standing.begin(), standing.end(), [&](const Box& box) { return box.overlaps(kept); })) continue;
      const Regions area{{{kept.min, {kept.max.x, kept.min.y}, kept.max, {kept.min.x, kept.max.y}}, {}}};
      if (geometry::subtract(area, on).empty() && (off.empty() || geometry::intersect(area, off).empty()))
        return here.min;
    }
  return std::nullopt;
}

}  // namespace

void add_prime_lines(const Settings& plate, ToolScopes& tools, Scopes& scopes, const Passes& passes,
                     std::span<travel::LayerInput> layers, Notices& notices) {
  if (!plate.tools.prime_line || layers.empty()) return;
  auto& first = layers.front();
  const auto used = tools_of(passes);
  const auto width_of = [&](ToolId tool) {
    const auto& own = tools.several() ? tools.tools()[tool] : plate;
    return flow::automatic_width(own.machine.nozzle_diameter, first.height);
  };
  Um depth = -apart;
  for (const ToolId tool : used) depth += 2 * width_of(tool) + apart;
  const Um bed = box_of(print_surface(plate.machine)).size().x;
  const Um length = std::min(longest, rounded(most_of_bed * bed));
  auto standing = standing_on(plate, layers);
  for (const auto& region : passes.shield) standing.push_back(box_of(region.outer));
  if (passes.has_tower()) standing.push_back(box_of(tools::tower_outline(plate.tools, passes.size, passes.corner)));
  const auto corner = place_for({length, depth}, plate.machine, standing);
  if (!corner) return notices.push_back({"prime_line_no_room", "prime_line: there is no room for lines on the bed"});
  Um y = corner->y;
  for (std::size_t i = 0; i < used.size(); ++i) {
    const Um width = width_of(used[i]), end = corner->x + length;
    Bead bead;
    for (const Point p : {Point{corner->x, y + width / 2},
                          {end, y + width / 2},
                          {end, y + width * 3 / 2},
                          {corner->x, y + width * 3 / 2}})
      bead.path.push_back({p, flow::band(width, first.height), 1.F});
    bead.role = Role::skirt;
    bead.tool = used[i];
    bead.scope = tools.several() ? tools.laid_over(first.scope, used[i], scopes) : first.scope;
    first.adhesion.insert(first.adhesion.begin() + static_cast<std::ptrdiff_t>(i), std::move(bead));
    y += 2 * width + apart;
  }
}

}  // namespace weft::pipeline
