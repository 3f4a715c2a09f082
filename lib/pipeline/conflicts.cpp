// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/conflicts.h"

#include "core/error.h"
#include "tasks/parallel.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include <fmt/format.h>

namespace weft::pipeline {
namespace {

struct Place {
  double x = 0, y = 0;
};
Place along(const Stroke& s, double t) {
  return {s.a.x + t * (s.b.x - s.a.x), s.a.y + t * (s.b.y - s.a.y)};
}
double radius(const Stroke& s, double t) {
  return (s.width_a + t * (s.width_b - s.width_a)) / 2;
}

/// Distance between the strokes' centrelines at these places, less their radii: convex in both, as the length of a
/// linear function less linear ones.
double gap_at(const Stroke& a, double s, const Stroke& b, double t) {
  const auto p = along(a, s), q = along(b, t);
  return std::hypot(p.x - q.x, p.y - q.y) - radius(a, s) - radius(b, t);
}

/// The least of a convex function on 0 … 1. Source: Kiefer, "Sequential minimax search for a maximum".
template <class F>
std::pair<double, double> least_of(F f) {
  constexpr double golden = 0.6180339887498949;
  constexpr int steps = 40;  // 4e-9 of the length
  double low = 0, high = 1, x = high - golden, y = low + golden;
  double fx = f(x), fy = f(y);
  for (int i = 0; i < steps; ++i) {
    if (fx < fy) {
      high = y, y = x, fy = fx;
      x = high - golden * (high - low), fx = f(x);
    } else {
      low = x, x = y, fx = fy;
      y = low + golden * (high - low), fy = f(y);
    }
  }
  std::pair best(fx < fy ? x : y, std::min(fx, fy));
  for (const double end : {0.0, 1.0})
    if (const double v = f(end); v < best.second) best = {end, v};
  return best;
}

/// Nearest place of the segment to p, 0 … 1.
double nearest(const Stroke& s, Place p) {
  const double dx = s.b.x - s.a.x, dy = s.b.y - s.a.y, length2 = dx * dx + dy * dy;
  if (length2 == 0) return 0;
  return std::clamp(((p.x - s.a.x) * dx + (p.y - s.a.y) * dy) / length2, 0.0, 1.0);
}

/// Where the centrelines are nearest: they cross, or an end of one is.
std::pair<double, double> nearest_of(const Stroke& a, const Stroke& b) {
  const double ax = a.b.x - a.a.x, ay = a.b.y - a.a.y, bx = b.b.x - b.a.x, by = b.b.y - b.a.y;
  const double cross = ax * by - ay * bx;
  if (cross != 0) {
    const double dx = b.a.x - a.a.x, dy = b.a.y - a.a.y;
    const double s = (dx * by - dy * bx) / cross, t = (dx * ay - dy * ax) / cross;
    if (s >= 0 && s <= 1 && t >= 0 && t <= 1) return {s, t};
  }
  const auto apart = [&](double s, double t) {
    const auto p = along(a, s), q = along(b, t);
    return std::hypot(p.x - q.x, p.y - q.y);
  };
  std::pair<double, double> best(0, nearest(b, along(a, 0)));
  double least = apart(best.first, best.second);
  const auto offer = [&](double s, double t) {
    if (const double distance = apart(s, t); distance < least) best = {s, t}, least = distance;
  };
  offer(1, nearest(b, along(a, 1)));
  offer(nearest(a, along(b, 0)), 0);
  offer(nearest(a, along(b, 1)), 1);
  return best;
}

/// The beads of one owner in one place of the sequence.
struct Piece {
  Owner owner;
  std::vector<const Bead*> beads;
  Box box{};  ///< of the plastic
};
struct Level {
  Um bottom = 0, top = 0;
  std::uint32_t layer = 0;
  std::vector<Piece> pieces;
};

Um widest(const Bead& bead) {
  Um out = 0;
  for (const auto& junction : bead.path) out = std::max(out, junction.width);
  return out;
}

void add(Level& level, Owner owner, const Bead& bead) {
  auto at = std::find_if(level.pieces.begin(), level.pieces.end(), [&](const Piece& p) { return p.owner == owner; });
  if (at == level.pieces.end()) at = level.pieces.insert(at, Piece{owner, {}, {}});
  at->beads.push_back(&bead);
  at->box.add(box_of(bead).grown((widest(bead) + 1) / 2));
}

std::vector<Level> levels_of(std::span<const travel::LayerInput> layers) {
  auto levels = tasks::parallel_map(layers.size(), [&](std::size_t i) {
    const auto& layer = layers[i];
    std::map<Um, Level> by_height;  // objects of a layer may be of other heights
    const auto level = [&](Um height) -> Level& {
      auto& out = by_height[height];
      out.bottom = layer.z - height, out.top = layer.z, out.layer = layer.time.number;
      return out;
    };
    for (const auto& object : layer.objects)
      for (const auto& bead : object.beads)
        add(level(object.height > 0 ? object.height : layer.height),
            {object.support ? Owner::Kind::support : Owner::Kind::object, object.object}, bead);
    for (const auto& bead : layer.adhesion) {
      // Infill and support that are purged into are printed first of their layer, and an object's all the same. A raft
      // has layers to itself.
      const auto kind = row_of(bead.role).kind;
      if (kind == RoleKind::wall || kind == RoleKind::skin || kind == RoleKind::fill) continue;
      if (kind == RoleKind::support && !layer.objects.empty()) continue;
      add(level(layer.height), {Owner::Kind::adhesion, static_cast<std::uint32_t>(bead.role)}, bead);
    }
    std::vector<Level> out;
    for (auto& [height, each] : by_height) out.push_back(std::move(each));
    return out;
  });
  std::vector<Level> out;
  for (auto& each : levels)
    for (auto& level : each) out.push_back(std::move(level));
  std::stable_sort(out.begin(), out.end(), [](const Level& a, const Level& b) { return a.top < b.top; });
  return out;
}

struct Marked {
  Stroke stroke;
  Role role;
};

Box box_of(const Stroke& s) {
  const Um r = (std::max(s.width_a, s.width_b) + 1) / 2;
  Box out;
  out.add(s.a), out.add(s.b);
  return out.grown(r);
}

/// The strokes of a piece that reach into a box.
std::vector<Marked> strokes_in(const Piece& piece, const Box& box) {
  std::vector<Marked> out;
  for (const Bead* bead : piece.beads) {
    const auto& path = bead->path;
    const std::size_t count = bead->closed ? path.size() : path.size() - 1;
    for (std::size_t i = 0; i < count; ++i) {
      const auto &a = path[i], &b = path[i + 1 == path.size() ? 0 : i + 1];
      const Stroke stroke{a.at, b.at, a.width, b.width};
      if (box_of(stroke).overlaps(box)) out.push_back({stroke, bead->role});
    }
  }
  return out;
}

/// The deepest place of two lists of strokes.
struct Deepest {
  Depth depth;
  Role role_a = Role::outer_wall, role_b = Role::outer_wall;
};
std::optional<Deepest> deepest_of(const std::vector<Marked>& a, const std::vector<Marked>& b, double tolerance) {
  std::vector<std::pair<Box, std::size_t>> sorted;  // of b, by their left sides
  Um longest = 0;
  for (std::size_t i = 0; i < b.size(); ++i) {
    sorted.emplace_back(box_of(b[i].stroke), i);
    longest = std::max(longest, sorted.back().first.size().x);
  }
  std::sort(sorted.begin(), sorted.end(), [](const auto& x, const auto& y) {
    return std::pair(x.first.min.x, x.second) < std::pair(y.first.min.x, y.second);
  });
  std::optional<Deepest> out;
  for (const auto& [stroke, role] : a) {
    const Box box = box_of(stroke);
    auto at = std::lower_bound(sorted.begin(), sorted.end(), box.min.x - longest,
                               [](const auto& each, Um x) { return each.first.min.x < x; });
    for (; at != sorted.end() && at->first.min.x <= box.max.x; ++at) {
      if (!at->first.overlaps(box)) continue;
      const auto& other = b[at->second];
      const double least = out ? std::max(tolerance, out->depth.um) : tolerance;
      if (const auto depth = depth_of(stroke, other.stroke, least)) out = {*depth, role, other.role};
    }
  }
  return out;
}

bool one_matter(const Owner& a, const Owner& b) {
  const bool both_of_objects = a.kind != Owner::Kind::adhesion && b.kind != Owner::Kind::adhesion;
  return a == b || (both_of_objects && a.number == b.number);
}

void compare(const Level& low, const Level& high, Um tolerance, std::vector<Conflict>& out) {
  for (std::size_t i = 0; i < low.pieces.size(); ++i)
    for (std::size_t k = &low == &high ? i + 1 : 0; k < high.pieces.size(); ++k) {
      const Piece *a = &low.pieces[i], *b = &high.pieces[k];
      if (one_matter(a->owner, b->owner) || !a->box.overlaps(b->box)) continue;
      if (b->owner < a->owner) std::swap(a, b);
      const auto mine = strokes_in(*a, b->box), others = strokes_in(*b, a->box);
      if (mine.empty() || others.empty()) continue;
      if (const auto deepest = deepest_of(mine, others, tolerance))
        out.push_back({a->owner, b->owner, deepest->role_a, deepest->role_b, high.top, high.layer, deepest->depth.at,
                       deepest->depth.um, 1});
    }
}

std::string name_of(const Owner& owner, const std::vector<ObjectLabel>& objects) {
  if (owner.kind == Owner::Kind::adhesion) return std::string(row_of(static_cast<Role>(owner.number)).key);
  const auto name = owner.number < objects.size() ? fmt::format("'{}'", objects[owner.number].name) : "an object";
  return owner.kind == Owner::Kind::support ? "the support of " + name : name;
}

}  // namespace

std::optional<Depth> depth_of(const Stroke& a, const Stroke& b, double least) {
  auto [s, t] = nearest_of(a, b);
  const double widest = (std::max(a.width_a, a.width_b) + std::max(b.width_a, b.width_b)) / 2.0;
  const auto p = along(a, s), q = along(b, t);
  if (widest - std::hypot(p.x - q.x, p.y - q.y) <= least) return std::nullopt;
  if (a.width_a != a.width_b || b.width_a != b.width_b) {
    const auto over_t = [&](double at) { return least_of([&](double other) { return gap_at(a, at, b, other); }); };
    s = least_of([&](double at) { return over_t(at).second; }).first;
    t = over_t(s).first;
  }
  const double depth = -gap_at(a, s, b, t);
  if (depth <= least) return std::nullopt;
  const auto u = along(a, s), v = along(b, t);
  return Depth{depth, {rounded((u.x + v.x) / 2), rounded((u.y + v.y) / 2)}};
}

std::vector<Conflict> conflicts_in(std::span<const travel::LayerInput> layers, Um tolerance) {
  const auto levels = levels_of(layers);
  auto found = tasks::parallel_map(levels.size(), [&](std::size_t i) {
    std::vector<Conflict> out;
    for (std::size_t k = i + 1; k-- > 0 && levels[k].top > levels[i].bottom;)
      compare(levels[k], levels[i], tolerance, out);
    return out;
  });
  std::map<std::pair<Owner, Owner>, Conflict> pairs;
  for (const auto& level : found)
    for (const auto& each : level) {
      const auto [at, is_new] = pairs.try_emplace({each.a, each.b}, each);
      if (is_new) continue;
      Conflict& known = at->second;
      const std::size_t count = known.layers + 1;
      if (each.z == known.z && each.depth_um > known.depth_um) known = each;
      known.layers = count;
    }
  std::vector<Conflict> out;
  for (const auto& [owners, conflict] : pairs) out.push_back(conflict);
  std::stable_sort(out.begin(), out.end(), [](const Conflict& a, const Conflict& b) { return a.z < b.z; });
  return out;
}

std::string describe(const Conflict& c, const std::vector<ObjectLabel>& objects) {
  return fmt::format("{} and {} overlap at layer {}, z {:.3f}, ({:.3f}, {:.3f}), {:.3f} mm deep ({}, {})",
                     name_of(c.a, objects), name_of(c.b, objects), c.layer, to_mm(c.z), to_mm(c.at.x), to_mm(c.at.y),
                     c.depth_um / 1000, row_of(c.role_a).key, row_of(c.role_b).key);
}

namespace {

/// Supports that meet hold each other, and may lie in skirt and brim; a brim lies at its part.
bool is_harmless(const Conflict& c) {
  const auto bears = [](const Owner& owner) {
    const bool around =
        owner.kind == Owner::Kind::adhesion && owner.number != static_cast<std::uint32_t>(Role::wipe_tower);
    return around || owner.kind == Owner::Kind::support;
  };
  const auto is_brim = [](const Owner& owner) {
    return owner.kind == Owner::Kind::adhesion && owner.number == static_cast<std::uint32_t>(Role::brim);
  };
  return (bears(c.a) && bears(c.b)) || is_brim(c.a) || is_brim(c.b);
}

}  // namespace

void check_conflicts(std::span<const travel::LayerInput> layers, const std::vector<ObjectLabel>& objects, Um tolerance,
                     bool annotate, Notices& notices) {
  std::optional<Conflict> first;
  for (const auto& conflict : conflicts_in(layers, tolerance)) {
    const bool harmless = is_harmless(conflict);
    notices.push_back({harmless ? "paths_touch" : "paths_conflict", describe(conflict, objects)});
    if (!harmless && !first) first = conflict;
  }
  if (!first || annotate) return;
  const bool both = first->a.kind == Owner::Kind::object && first->b.kind == Owner::Kind::object;
  throw Error{Error::Kind::audit, describe(*first, objects), "plate",
              both ? "move them apart, or join them: a.stl+b.stl" : "more --spacing, or less around them"};
}

}  // namespace weft::pipeline
