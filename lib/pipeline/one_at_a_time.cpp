// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/one_at_a_time.h"

#include "core/convex_hull.h"
#include "core/error.h"
#include "geometry/boolean.h"
#include "tasks/parallel.h"

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>
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

/// A band of an object's layers: where the nozzle is in it, on its ways between islands as well, and the lowest height
/// that it has there.
struct Band {
  Um bottom = 0;
  Ring hull;
};
constexpr std::size_t bands = 8;

std::vector<Band> bands_of(const Standing& copy) {
  std::vector<Band> out;
  const Um height = std::max<Um>(copy.height, 1);
  std::vector<Point> corners;
  std::optional<std::size_t> last;
  for (const auto* layer : layers_of(copy)) {
    const auto band = static_cast<std::size_t>(std::int64_t{layer->z - 1} * static_cast<std::int64_t>(bands) / height);
    if (last != band) out.push_back({layer->z, {}}), corners.clear();
    last = band;
    const Um by = out.size() == 1 ? copy.beside : 0;  // skirt and brim lie on the bed
    for (const auto& region : layer->outline)
      for (const Point p : region.outer)
        for (const Point d : {Point{-by, -by}, Point{by, -by}, Point{by, by}, Point{-by, by}}) corners.push_back(p + d);
    corners = out.back().hull = convex_hull(std::move(corners));
  }
  std::erase_if(out, [](const Band& band) { return band.hull.empty(); });
  return out;
}

/// All sums of their points.
Ring sum_of(const Ring& a, const Ring& b) {
  std::vector<Point> corners;
  for (const Point p : a)
    for (const Point q : b) corners.push_back(p + q);
  return convex_hull(std::move(corners));
}

/// What of the head is in the way: the bar alone, or the head as well.
std::string_view what_hits(const Standing& a, const Standing& b, std::vector<HeadSlab> head, bool has_bar) {
  if (!has_bar) return "head";
  head.pop_back();
  const auto may = may_follow({a, b}, head);
  return may[0][1] != 0 || may[1][0] != 0 ? "gantry" : "head";
}

/// "34.5 mm more in y": how much further apart they can be printed one after the other, the shorter way.
std::string how_far(const Standing& a, const Standing& b, const std::vector<HeadSlab>& head, Um furthest) {
  std::string out;
  Um least = furthest;
  for (const bool in_x : {true, false}) {
    const bool up = in_x ? b.by.x >= a.by.x : b.by.y >= a.by.y;
    const auto fits = [&](Um by) {
      Standing moved = b;
      (in_x ? moved.by.x : moved.by.y) += up ? by : -by;
      const auto may = may_follow({a, moved}, head);
      return may[0][1] != 0 || may[1][0] != 0;
    };
    if (!fits(least)) continue;
    Um low = 0, high = least;
    constexpr Um close = 100;
    while (high - low > close) (fits((low + high) / 2) ? high : low) = (low + high) / 2;
    if (high < least || out.empty())
      least = high, out = fmt::format("{:.1f} mm more in {}", to_mm(high), in_x ? "x" : "y");
  }
  return out;
}

[[noreturn]] void refuse_order(const Settings& settings, const std::vector<Standing>& copies,
                               const std::vector<HeadSlab>& head, const std::vector<std::vector<char>>& may) {
  const Point bed = weft::box_of(print_surface(settings.machine)).size();
  for (std::size_t i = 0; i < copies.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      if (may[i][j] != 0 || may[j][i] != 0) continue;
      const auto &a = copies[j], &b = copies[i];
      const auto far = how_far(a, b, head, std::max(bed.x, bed.y));
      throw Error{Error::Kind::audit,
                  fmt::format("the {} hits '{}' while '{}' is printed, and '{}' while '{}' is{}",
                              what_hits(a, b, head, settings.plate.gantry_height.has_value()), a.name, b.name, b.name,
                              a.name, far.empty() ? "" : "; " + far),
                  "print_sequence", "move them apart, as --arrange does, or print all at once"};
    }
  throw Error{Error::Kind::audit, "there is no order in which the head passes all that stands already",
              "print_sequence", "move the objects apart, or print all at once"};
}

}  // namespace

std::vector<std::vector<char>> may_follow(const std::vector<Standing>& copies, const std::vector<HeadSlab>& head) {
  std::vector<std::size_t> kind;  // of each copy: the first of the same layers
  for (std::size_t i = 0; i < copies.size(); ++i) {
    const auto same = [&](const Standing& other) {
      return other.layers == copies[i].layers && other.beside == copies[i].beside;
    };
    kind.push_back(static_cast<std::size_t>(std::find_if(copies.begin(), copies.end(), same) - copies.begin()));
  }
  const auto of_kinds = [&](const auto& make) {
    return tasks::parallel_map(
        copies.size(), [&](std::size_t i) { return kind[i] == i ? make(copies[i]) : decltype(make(copies[i])){}; });
  };
  const auto banded = of_kinds([](const Standing& copy) { return bands_of(copy); });
  std::vector<Ring> slabs;
  for (const auto& slab : head) slabs.push_back(convex_hull({slab.outline.begin(), slab.outline.end()}));
  std::vector<Um> heights;
  for (const auto& list : banded)
    for (const auto& band : list)
      for (const auto& slab : head) heights.push_back(band.bottom + slab.from);
  const auto above = of_kinds([&](const Standing& copy) { return silhouettes_above(copy, heights); });
  return tasks::parallel_map(copies.size(), [&](std::size_t i) {
    std::vector<char> may(copies.size(), 1);
    for (std::size_t j = 0; j < copies.size(); ++j) {
      if (i == j) continue;
      const Point by = copies[j].by - copies[i].by;
      for (const auto& band : banded[kind[j]])
        for (std::size_t k = 0; k < head.size() && may[j] != 0; ++k) {
          const auto& standing = above[kind[i]].at(band.bottom + head[k].from);
          if (standing.empty()) continue;
          Ring swept = sum_of(band.hull, slabs[k]);
          for (auto& p : swept) p = p + by;
          if (!weft::box_of(swept).overlaps(weft::box_of(standing))) continue;
          if (!geometry::intersect(standing, {{swept, {}}}).empty()) may[j] = 0;
        }
    }
    return may;
  });
}

std::vector<std::size_t> order_of(const std::vector<Standing>& copies, const std::vector<std::vector<char>>& may) {
  std::vector<char> done(copies.size(), 0);
  std::vector<std::size_t> out;
  Point at{};
  ToolId loaded = any_tool;
  while (out.size() < copies.size()) {
    std::optional<std::size_t> best;
    for (std::size_t j = 0; j < copies.size(); ++j) {
      if (done[j] != 0) continue;
      bool next = true;  // whatever is printed after it may follow it
      for (std::size_t other = 0; other < copies.size(); ++other)
        next = next && (other == j || done[other] != 0 || may[j][other] != 0);
      if (!next) continue;
      const auto rank = [&](std::size_t c) {
        return std::tuple(copies[c].tool != loaded, copies[c].height, distance2(at, copies[c].by));
      };
      if (!best || rank(j) < rank(*best)) best = j;
    }
    if (!best) return {};
    done[*best] = 1, at = copies[*best].by, loaded = copies[*best].tool;
    out.push_back(*best);
  }
  return out;
}

Sequence one_at_a_time(const Settings& settings, const std::vector<Standing>& copies) {
  const auto head = head_of(settings.plate, settings.machine);
  if (head.empty())
    throw Error{Error::Kind::settings, "one_at_a_time: machine_head_profile does not say how wide the head is",
                "print_sequence", "as in 0: -10x-10, 10x-10, 10x10, -10x10; 12: -30x-25, 45x-25, 45x60, -30x60"};
  const auto may = may_follow(copies, head);
  const auto order = order_of(copies, may);
  if (order.size() < copies.size()) refuse_order(settings, copies, head, may);
  Sequence out;
  for (const std::size_t i : order)
    out.push_back({.objects = {static_cast<ObjectId>(i)}, .rise = static_cast<std::uint32_t>(out.size())});
  return out;
}

}  // namespace weft::pipeline
