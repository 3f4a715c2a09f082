// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/cheaper.h"

#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/offset.h"
#include "geometry/simplify.h"
#include "geometry/spatial_index.h"
#include "support/columns.h"
#include "support/lengths.h"

#include <algorithm>
#include <numbers>

namespace weft::support {
namespace {

double perimeter_mm(const Regions& regions) {
  double um = 0;
  for (const Region& region : regions) {
    um += perimeter_of(region.outer);
    for (const Ring& hole : region.holes) um += perimeter_of(hole);
  }
  return um / 1000;
}

/// What the beads of an area of columns take, mm³: lines inside, or a loop where it is narrow.
double column_mm3(const SupportSettings& s, const Regions& area, Um line, Um height) {
  const double mm2 = area_mm2(area), loop = 0.5 * perimeter_mm(area) * to_mm(line);
  return to_mm(height) * std::min(mm2, std::max(mm2 * s.support_infill_rate / 100, loop));
}

/// What the loops of a branch take, mm² on a level.
double walls_mm2(const SupportSettings& s, const Region& branch, Um line) {
  const double thick_mm = to_mm(s.support_tree_branch_diameter_double_wall);
  const bool two = thick_mm > 0 && area_mm2(branch) > std::numbers::pi / 4 * thick_mm * thick_mm;
  const double loop_mm = perimeter_mm({branch}) - std::numbers::pi * to_mm(line);  // half a line further in
  return std::min(area_mm2(branch), s.support_wall_count.value_or(two ? 2 : 1) * loop_mm * to_mm(line));
}

/// Columns as they would stand, every two millimetres of height: visit(region, height that it stands for), and
/// land(region) for what of them comes to stand on the part.
/// @return what stands on the lowest level
template <class Visit, class Land>
Regions guess_columns(const SupportSettings& s, const Object& object, const Stack& stack,
                      const std::vector<KeepOut>& keep_out, const std::vector<Regions>& contacts, Visit visit,
                      Land land) {
  using namespace weft::literals;
  constexpr Um step = 2_mm, coarse = 0.1_mm;
  Regions falling;
  Um height = 0;
  for (std::size_t k = stack.levels.size(); k-- > 0;) {
    append(falling, contacts[k]);
    height += stack.levels[k].height;
    if (falling.empty() || (height < step && k > 0)) continue;
    stop_if_asked();
    falling = geometry::simplified(geometry::unite(falling), coarse);
    if (s.support_join_distance > 0) falling = geometry::closing(falling, s.support_join_distance / 2);
    if (s.support_type == SupportType::everywhere)
      for (const Region& region :
           geometry::intersect(falling, outlines_between(object, stack.levels[k].bottom(), stack.levels[k].z)))
        land(region);
    falling = opened(geometry::subtract(falling, keep_out[k].near), line_width(s, object.nozzle) / 2);
    for (const Region& region : falling) visit(region, height);
    height = 0;
  }
  return falling;
}

/// What the first layer of what stands there takes, with what spreads around it.
double foot_mm3(const SupportSettings& s, const Regions& standing, Um height) {
  return area_mm2(grown(geometry::unite(standing), s.support_brim_width)) * to_mm(height) *
         s.support_initial_layer_density / 100;
}

}  // namespace

Split cheaper(const SupportSettings& s, const Object& object, const Stack& stack, const std::vector<KeepOut>& keep_out,
              const std::vector<Regions>& contacts) {
  const Um line = line_width(s, object.nozzle);
  Regions all;
  for (const auto& regions : contacts) append(all, regions);
  const Regions patches = grown(geometry::unite(all), std::max<Um>(s.support_join_distance / 2, line));
  const geometry::SegmentIndex index(patches);
  const auto patch_of = [&](const Region& region) { return index.region_at(region.outer.front()).value_or(0); };
  std::vector<double> columns_mm3(patches.size(), 0), branches_mm3(patches.size(), 0);

  constexpr double mm3_by_scar_mm2 = 1;  // what stands on the part is filed off
  const Regions standing = guess_columns(
      s, object, stack, keep_out, contacts,
      [&](const Region& region, Um height) { columns_mm3[patch_of(region)] += column_mm3(s, {region}, line, height); },
      [&](const Region& region) { columns_mm3[patch_of(region)] += mm3_by_scar_mm2 * area_mm2(region); });
  const Um first = stack.levels.front().height;
  for (const Region& region : standing) columns_mm3[patch_of(region)] += foot_mm3(s, {region}, first);
  auto branches = tree(s, object, stack, keep_out, contacts);
  double tree_mm3 = foot_mm3(s, branches.areas[0], first);
  for (std::size_t k = 1; k < stack.levels.size(); ++k) {
    stop_if_asked();
    for (const Region& region : branches.areas[k])
      tree_mm3 += walls_mm2(s, region, line) * to_mm(stack.levels[k].height);
  }
  // Either has a roof. On a column it takes the place of what fills it; on branches most of its lowest level is free.
  constexpr double joists = 0.2;
  const double roof =
      s.support_roof_enable && s.support_roof_height > 0
          ? to_mm(s.support_roof_height) * s.support_infill_rate / 100 - (1 - joists) * to_mm(object.nozzle) / 2
          : 0;
  for (const auto& regions : contacts)
    for (const Region& region : regions) columns_mm3[patch_of(region)] -= area_mm2(region) * roof;
  // Branches that meet are shared: each tip pays by its height.
  double heights = 0;
  for (const Point3 tip : branches.tips_at) heights += tip.z - object.floor;
  for (const Point3 tip : branches.tips_at)
    if (const auto patch = index.region_at({tip.x, tip.y}))
      branches_mm3[*patch] += tree_mm3 * (tip.z - object.floor) / std::max(1.0, heights);
  for (std::size_t k = 0; k < branches.left.size(); ++k) {  // what no branch gets near stands on columns of its own
    if (branches.left[k].empty()) continue;
    Regions held = branches.areas[k];
    append(held, branches.roofs[k]);
    if (k + 1 < branches.roofs.size())  // what lies on the tips of that level
      append(held, branches.roofs[k + 1]), append(held, branches.joists[k + 1].area);
    for (const Region& region : opened(geometry::subtract(branches.left[k], grown(geometry::unite(held), reached)), 50))
      branches_mm3[patch_of(region)] += column_mm3(s, {region}, line, stack.levels[k].z - object.floor);
  }

  Split out{std::vector<Regions>(contacts.size()), std::vector<Regions>(contacts.size()), std::nullopt};
  bool columns_too = false;
  for (std::size_t k = 0; k < contacts.size(); ++k)
    for (const Region& region : contacts[k]) {
      const auto patch = patch_of(region);
      const bool by_branches = branches_mm3[patch] < columns_mm3[patch];
      (by_branches ? out.for_branches : out.for_columns)[k].push_back(region);
      columns_too = columns_too || !by_branches;
    }
  if (!columns_too) out.branches = std::move(branches);
  return out;
}

}  // namespace weft::support
