// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/disjoint_sets.h"
#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/box_columns.h"
#include "geometry/trimmed.h"
#include "support/bridged.h"
#include "support/lengths.h"
#include "support/near_edge.h"
#include "support/support.h"
#include "tasks/parallel.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

namespace weft::support {
namespace {

/// A piece of demand on its layer.
struct Patch {
  Region region;
  Box box;
  double mm2 = 0;
  bool always = false;  ///< however small
};
struct LayerPatches {
  std::vector<Patch> patches;
  std::size_t islands = 0;
  double bridged_mm2 = 0;
};

/// Which regions of a layer begin in the air: those of which no more than a bead's square lies over the layer below.
/// @param step  what of the layer lies over air
std::vector<std::size_t> beginning(const Regions& here, const Regions& step, Um outer_line) {
  const double bead = to_mm(outer_line) * to_mm(outer_line);
  std::vector<Box> boxes;
  for (const Region& region : here) boxes.push_back(box_of(region.outer).grown(2));
  const geometry::BoxColumns columns(std::move(boxes));
  std::vector<double> in_air_mm2(here.size(), 0);
  for (const Region& piece : step) {
    const Box box = box_of(piece.outer);
    columns.each_around(box.min, [&](std::uint32_t r) {
      if (columns[r].contains(box.max) && side_of(here[r], piece.outer.front()) != Side::outside)
        in_air_mm2[r] += area_mm2(piece);
    });
  }
  std::vector<std::size_t> out;
  for (std::size_t r = 0; r < here.size(); ++r) {
    if (in_air_mm2[r] <= 0) continue;
    const double whole = area_mm2(here[r]);
    if (whole - in_air_mm2[r] < bead && in_air_mm2[r] > whole / 2) out.push_back(r);
  }
  return out;
}

/// What of a layer has nothing below, if that is known.
const Regions* known_over_air(const Object& object, std::size_t layer) {
  return layer < object.over_air.size() ? object.over_air[layer] : nullptr;
}

class Layer {
 public:
  Layer(const SupportSettings& s, const Object& o, std::size_t i)
      : s_(s), o_(o), i_(i), here_(o.layers[i]->regions), below_(o.layers[i - 1]->regions) {}

  LayerPatches patches() {
    LayerPatches out;
    if (here_.empty()) return out;
    const Regions* const known = known_over_air(o_, i_);
    const Regions step = known != nullptr ? *known : geometry::subtract(here_, below_);
    if (step.empty()) return out;
    const bool enforced_layer = static_cast<int>(i_) <= s_.support_enforce_layers;
    const bool automatic = s_.support_enable && s_.support_auto;
    Regions wanted;
    if (automatic || enforced_layer) wanted = reaching_out(step, enforced_layer ? 0 : reach());
    Regions starts;
    if (automatic || enforced_layer)
      for (const auto r : beginning(here_, step, o_.outer_line)) starts.push_back(here_[r]);
    out.islands = starts.size();
    if (i_ < o_.blocked.size() && !o_.blocked[i_].empty()) {
      wanted = geometry::subtract(wanted, o_.blocked[i_]);
      starts = geometry::subtract(starts, o_.blocked[i_]);
    }
    if (!starts.empty()) wanted = geometry::subtract(wanted, starts);
    if (!s_.support_bridges && !enforced_layer) leave_bridges(wanted, out.bridged_mm2);
    for (Region& region : wanted) {
      const Box box = box_of(region.outer);
      const double mm2 = area_mm2(region);
      const bool always = enforced_layer || (mm2 < s_.minimum_support_area && reaches_far(region, box));
      out.patches.push_back({std::move(region), box, mm2, always});
    }
    add_always(starts, out);
    if (s_.support_enable && i_ < o_.enforced.size() && !o_.enforced[i_].empty()) {
      Regions marked = geometry::intersect(step, o_.enforced[i_]);
      for (const Patch& p : out.patches) {
        if (marked.empty()) break;
        marked = geometry::subtract(marked, {p.region});
      }
      add_always(geometry::opening(marked, 10), out);
    }
    return out;
  }

 private:
  Um reach() const {
    if (!s_.support_angle) return o_.outer_line / 2;
    return rounded(o_.layers[i_]->height * std::tan(*s_.support_angle * std::numbers::pi / 180));
  }

  bool reaches_far(const Region& region, const Box& box) const {
    const Um far = std::max<Um>(s_.support_cantilever_length, 1);
    return !geometry::subtract({region}, grown(geometry::trimmed(below_, box.grown(far + 1)), far)).empty();
  }

  /// What reaches further than that beyond the layer below, grown back to it.
  Regions reaching_out(const Regions& step, Um by) const {
    if (by <= 0) return geometry::opening(step, 5);
    if (!any_may_be_further(step, below_, by)) return {};
    const Regions near = geometry::trimmed(below_, box_of(step).grown(by + 1));
    const Regions over = geometry::subtract(step, grown(near, by));
    if (over.empty()) return {};
    return geometry::intersect(step, grown(over, by + 20));
  }

  void leave_bridges(Regions& wanted, double& bridged_mm2) const {
    Regions left;
    for (Region& region : wanted) {
      stop_if_asked();
      const Regions crossed = bridged(region, below_, s_.support_max_bridge_length, o_.nozzle);
      if (crossed.empty()) {
        left.push_back(std::move(region));
        continue;
      }
      bridged_mm2 += area_mm2(crossed);
      append(left, opened(geometry::subtract({region}, grown(crossed, 50)), o_.nozzle / 2));
    }
    wanted = std::move(left);
  }

  static void add_always(const Regions& regions, LayerPatches& out) {
    for (const Region& region : regions) out.patches.push_back({region, box_of(region.outer), area_mm2(region), true});
  }

  const SupportSettings& s_;
  const Object& o_;
  std::size_t i_;
  const Regions &here_, &below_;
};

/// Small patches go, unless with what lies above and below them they are not small: a slope is a strip a layer.
void drop_small(const SupportSettings& s, std::vector<LayerPatches>& layers) {
  constexpr Um near = 0.5_mm;
  std::vector<std::size_t> first(layers.size() + 1, 0);
  for (std::size_t i = 0; i < layers.size(); ++i) first[i + 1] = first[i] + layers[i].patches.size();
  DisjointSets together(first.back());  // patches of neighbouring layers whose boxes nearly meet
  StopNowAndThen now_and_then(256);
  for (std::size_t i = 1; i < layers.size(); ++i)
    for (std::size_t a = 0; a < layers[i].patches.size(); ++a) {
      now_and_then.step();
      const Box box = layers[i].patches[a].box.grown(near);
      for (std::size_t b = 0; b < layers[i - 1].patches.size(); ++b)
        if (box.overlaps(layers[i - 1].patches[b].box)) together.join(first[i] + a, first[i - 1] + b);
    }
  std::vector<double> mm2(first.back(), 0.0);
  for (std::size_t i = 0; i < layers.size(); ++i)
    for (std::size_t a = 0; a < layers[i].patches.size(); ++a)
      mm2[together.of(first[i] + a)] += layers[i].patches[a].mm2;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    std::vector<Patch> kept;
    for (std::size_t a = 0; a < layers[i].patches.size(); ++a) {
      Patch& p = layers[i].patches[a];
      if (p.always || mm2[together.of(first[i] + a)] >= s.minimum_support_area) kept.push_back(std::move(p));
    }
    layers[i].patches = std::move(kept);
  }
}

}  // namespace

Demand demand(const SupportSettings& settings, const Object& object) {
  auto layers = tasks::parallel_map(object.layers.size(), [&](std::size_t i) {
    return i == 0 ? LayerPatches{} : Layer(settings, object, i).patches();
  });
  drop_small(settings, layers);
  Demand out(layers.size());
  for (std::size_t i = 0; i < layers.size(); ++i) {
    out[i].islands = layers[i].islands, out[i].bridged_mm2 = layers[i].bridged_mm2;
    for (Patch& p : layers[i].patches) out[i].wanted.push_back(std::move(p.region));
  }
  return out;
}

std::vector<Island> islands(const Object& object) {
  const auto of_layer = tasks::parallel_map(object.layers.size(), [&](std::size_t i) {
    std::vector<Island> out;
    if (i == 0) return out;
    const Regions& here = object.layers[i]->regions;
    const Regions& below = object.layers[i - 1]->regions;
    const Regions* known = known_over_air(object, i);
    if (here.empty() || (known ? known->empty() : here == below)) return out;
    if (known) {
      for (const auto r : beginning(here, *known, object.outer_line)) out.push_back({i, here[r].outer.front()});
      return out;
    }
    // Where each region has a corner in one below, nothing begins here: most layers are told so.
    const Box under = box_of(below);
    const bool near = std::all_of(here.begin(), here.end(), [&](const Region& r) {
      const Point p = r.outer.front();
      return under.contains(p) &&
             std::any_of(below.begin(), below.end(), [&](const Region& b) { return side_of(b, p) != Side::outside; });
    });
    if (near) return out;
    for (const auto r : beginning(here, geometry::subtract(here, below), object.outer_line))
      out.push_back({i, here[r].outer.front()});
    return out;
  });
  std::vector<Island> out;
  for (const auto& some : of_layer) out.insert(out.end(), some.begin(), some.end());
  return out;
}

}  // namespace weft::support
