// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/one_at_a_time.h"

#include "core/convex_hull.h"
#include "core/error.h"
#include "geometry/boolean.h"
#include "settings/tools.h"
#include "tasks/parallel.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace weft::pipeline {
namespace {

/// All of an object's layers by height, those of its support among them.
std::vector<const PrintedLayer*> layers_of(const Standing& copy) {
  std::vector<const PrintedLayer*> out;
  for (const auto* list : copy.layers)
    for (const auto& layer : *list) out.push_back(&layer);
  std::stable_sort(out.begin(), out.end(), [](const auto* a, const auto* b) { return a->z < b->z; });
  return out;
}

/// What lies above each of these heights, seen from above, in the object's own coordinates.
std::map<Um, Regions> silhouettes_above(const Standing& copy, std::vector<Um> heights) {
  std::sort(heights.begin(), heights.end(), std::greater<>());
  heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
  const auto layers = layers_of(copy);
  std::map<Um, Regions> out;
  Regions all;
  std::size_t left = layers.size();
  for (const Um height : heights) {
    Regions more;
    for (; left > 0 && layers[left - 1]->z > height; --left) {
      more.insert(more.end(), layers[left - 1]->outline.begin(), layers[left - 1]->outline.end());
      if (more.size() > 64) more = geometry::unite(more);
    }
    if (!more.empty()) {
      more.insert(more.end(), all.begin(), all.end());
      all = geometry::unite(more);
    }
    out[height] = all;
  }
  return out;
}

/// A band of an object's layers: the hull of each island, and the lowest height that the nozzle has in it.
struct Band {
  Um bottom = 0;
  std::vector<Ring> hulls;
};
constexpr std::size_t bands = 8;

std::vector<Band> bands_of(const Standing& copy, Um beside) {
  const auto layers = layers_of(copy);
  std::vector<Band> out;
  const Um height = std::max<Um>(copy.height, 1);
  Regions islands;
  std::optional<Um> bottom;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const auto band =
        static_cast<std::size_t>(std::int64_t{layers[i]->z - 1} * static_cast<std::int64_t>(bands) / height);
    if (!bottom) bottom = layers[i]->z;
    islands.insert(islands.end(), layers[i]->outline.begin(), layers[i]->outline.end());
    const bool last =
        i + 1 == layers.size() || static_cast<std::size_t>(std::int64_t{layers[i + 1]->z - 1} *
                                                           static_cast<std::int64_t>(bands) / height) != band;
    if (!last) continue;
    Band made{*bottom, {}};
    for (const auto& region : geometry::unite(islands)) {
      std::vector<Point> corners;
      const Um by = out.empty() ? beside : 0;  // skirt and brim lie on the bed
      for (const Point p : region.outer)
        for (const Point d : {Point{-by, -by}, Point{by, -by}, Point{by, by}, Point{-by, by}}) corners.push_back(p + d);
      made.hulls.push_back(convex_hull(std::move(corners)));
    }
    out.push_back(std::move(made));
    islands.clear(), bottom.reset();
  }
  return out;
}

/// All sums of their points.
Ring sum_of(const Ring& a, const Ring& b) {
  std::vector<Point> corners;
  for (const Point p : a)
    for (const Point q : b) corners.push_back(p + q);
  return convex_hull(std::move(corners));
}

[[noreturn]] void refuse_order(const std::vector<Standing>& copies, const std::vector<std::vector<char>>& may) {
  for (std::size_t i = 0; i < copies.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (!may[i][j] && !may[j][i])
        throw Error{Error::Kind::audit,
                    fmt::format("the head hits '{}' while '{}' is printed, and '{}' while '{}' is", copies[j].name,
                                copies[i].name, copies[i].name, copies[j].name),
                    "print_sequence", "move them apart, or print all at once"};
  throw Error{Error::Kind::audit, "there is no order in which the head passes all that stands already",
              "print_sequence", "move the objects apart, or print all at once"};
}

}  // namespace

std::vector<HeadSlab> head_of(const PlateSettings& plate, const MachineSettings& machine) {
  auto out = parse_head_profile(plate.machine_head_profile);
  if (!plate.gantry_height || out.empty()) return out;
  Box head;
  for (const auto& slab : out) head.add(weft::box_of(slab.outline));
  const Box bed = weft::box_of(print_surface(machine));
  const Um wide = 2 * std::max(bed.size().x, bed.size().y);
  Box bar = head;
  if (plate.gantry_axis == GantryAxis::x)
    bar.min.x = -wide, bar.max.x = wide;
  else
    bar.min.y = -wide, bar.max.y = wide;
  out.push_back({*plate.gantry_height, {bar.min, {bar.max.x, bar.min.y}, bar.max, {bar.min.x, bar.max.y}}});
  return out;
}

std::vector<std::vector<char>> may_follow(const std::vector<Standing>& copies, const std::vector<HeadSlab>& head,
                                          Um beside) {
  const auto banded = tasks::parallel_map(copies.size(), [&](std::size_t j) { return bands_of(copies[j], beside); });
  std::vector<Ring> slabs;
  for (const auto& slab : head) slabs.push_back(convex_hull({slab.outline.begin(), slab.outline.end()}));
  std::vector<Um> heights;
  for (const auto& list : banded)
    for (const auto& band : list)
      for (const auto& slab : head) heights.push_back(band.bottom + slab.from);
  const auto above =
      tasks::parallel_map(copies.size(), [&](std::size_t i) { return silhouettes_above(copies[i], heights); });
  return tasks::parallel_map(copies.size(), [&](std::size_t i) {
    std::vector<char> may(copies.size(), 1);
    for (std::size_t j = 0; j < copies.size(); ++j) {
      if (i == j) continue;
      const Point by = copies[j].by - copies[i].by;
      for (const auto& band : banded[j])
        for (std::size_t k = 0; k < head.size() && may[j] != 0; ++k) {
          const auto& standing = above[i].at(band.bottom + head[k].from);
          if (standing.empty()) continue;
          for (const auto& hull : band.hulls) {
            Ring swept = sum_of(hull, slabs[k]);
            for (auto& p : swept) p = p + by;
            if (!weft::box_of(swept).overlaps(weft::box_of(standing))) continue;
            if (!geometry::intersect(standing, {{swept, {}}}).empty()) may[j] = 0;
          }
        }
    }
    return may;
  });
}

std::vector<std::size_t> order_of(const std::vector<Standing>& copies, const std::vector<std::vector<char>>& may) {
  std::vector<char> done(copies.size(), 0);
  std::vector<std::size_t> out;
  Point at{};
  while (out.size() < copies.size()) {
    std::optional<std::size_t> best;
    for (std::size_t j = 0; j < copies.size(); ++j) {
      if (done[j] != 0) continue;
      bool next = true;  // whatever is printed after it may follow it
      for (std::size_t other = 0; other < copies.size(); ++other)
        next = next && (other == j || done[other] != 0 || may[j][other] != 0);
      if (!next) continue;
      const auto rank = [&](std::size_t c) { return std::pair(copies[c].height, distance2(at, copies[c].by)); };
      if (!best || rank(j) < rank(*best)) best = j;
    }
    if (!best) return {};
    done[*best] = 1, at = copies[*best].by;
    out.push_back(*best);
  }
  return out;
}

Sequence one_at_a_time(const Settings& settings, const std::vector<Standing>& copies) {
  const auto head = head_of(settings.plate, settings.machine);
  if (head.empty())
    throw Error{Error::Kind::settings, "one_at_a_time: machine_head_profile does not say how wide the head is",
                "print_sequence", "as in 0: -10x-10, 10x-10, 10x10, -10x10; 12: -30x-25, 45x-25, 45x60, -30x60"};
  if (tool_count(settings) > 1)
    throw Error{Error::Kind::settings, "one_at_a_time: several tools print all at once only", "print_sequence",
                "print_sequence = all_at_once"};
  const auto& a = settings.adhesion;
  const Um nozzle = settings.machine.nozzle_diameter;
  const Um width = a.skirt_brim_line_width ? a.skirt_brim_line_width->of(nozzle) : nozzle;
  const Um beside = a.brim_width + (a.skirt_line_count > 0 ? a.skirt_gap + a.skirt_line_count * width : 0);
  const auto may = may_follow(copies, head, beside);
  const auto order = order_of(copies, may);
  if (order.size() < copies.size()) refuse_order(copies, may);
  Sequence out;
  for (const std::size_t i : order)
    out.push_back({.objects = {static_cast<ObjectId>(i)}, .rise = static_cast<std::uint32_t>(out.size())});
  return out;
}

}  // namespace weft::pipeline
