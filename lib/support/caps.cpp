// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/caps.h"

#include "core/stop.h"
#include "geometry/nudge.h"
#include "geometry/simplify.h"
#include "geometry/trimmed.h"
#include "support/kinds.h"
#include "support/lengths.h"
#include "support/thin.h"
#include "tasks/parallel.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace weft::support {
namespace {

/// A layer of the object whose contact has a cap.
struct Capped {
  std::size_t layer = 0;
  Um height = 0;
};

class Capper {
 public:
  Capper(const Room& room, const Stack& stack, const Demand& demand, const std::vector<SupportLayer>& levels)
      : room_(room),
        stack_(stack),
        demand_(demand),
        levels_(levels),
        line_(line_width(room.settings(), room.object().nozzle)) {}

  struct Cap {
    std::size_t layer;
    SupportLayer lies;
  };
  /// The caps of one level, the highest first: where two would meet it is the higher one that stays.
  std::vector<Cap> on(std::size_t k, std::vector<Capped> capped) const {
    std::sort(capped.begin(), capped.end(), [](const Capped& a, const Capped& b) {
      return std::pair(-a.height, a.layer) < std::pair(-b.height, b.layer);
    });
    std::vector<Cap> out;
    Regions taken;
    for (const Capped& one : capped) {
      stop_if_asked();
      SupportLayer cap = cap_of(k, one, taken);
      const Regions all = all_areas(cap);
      if (all.empty()) continue;
      append(taken, all);
      out.push_back({one.layer, std::move(cap)});
    }
    return out;
  }

 private:
  SupportLayer cap_of(std::size_t k, const Capped& one, const Regions& taken) const {
    const Stack::Level lies{stack_.levels[k].z + one.height, one.height};
    SupportLayer out{lies.z, lies.height, {}, {}, {}, {}, false, {}};
    Regions shape = geometry::simplified(demand_[one.layer].wanted, coarse_outline);
    thicken(shape, shape, line_);
    Regions others = taken;
    for (std::size_t j = k + 1; j < levels_.size() && levels_[j].z - levels_[j].height < lies.z; ++j)
      append(others, all_areas(levels_[j]));
    const Box near = box_of(shape).grown(line_);
    const SupportLayer& base = levels_[k];
    Regions roof = geometry::trimmed(base.roof, near);
    append(roof, geometry::trimmed(base.under_roof, near));
    if (room_.settings().support_roof_enable) append(roof, geometry::trimmed(base.joists.area, near));
    const Regions barred = geometry::trimmed(others, near);
    Regions free = room_.free_part(shape, lies, shape);
    if (!barred.empty()) free = geometry::beyond(free, barred, beside_by);
    // What lies on one thing as a whole lies on no other.
    const auto on = [&](const Regions& all_under) {
      Regions lying, beside;
      for (Region& region : free) {
        const auto under = near_to(region, all_under);
        const Regions covered = geometry::covered(region, under, beside_by);
        const bool whole = covered.size() == 1 && covered.front() == region;
        append(lying, covered);
        if (!whole) beside.push_back(std::move(region));
      }
      free = std::move(beside);
      return opened(lying, line_ * 4 / 10);
    };
    out.roof = on(roof);
    out.branches = on(geometry::trimmed(base.branches, near));
    out.columns = on(geometry::trimmed(base.columns, near));
    return out;
  }

  const Room& room_;
  const Stack& stack_;
  const Demand& demand_;
  const std::vector<SupportLayer>& levels_;
  Um line_;
};

}  // namespace

Caps caps_on(const Room& room, const Stack& stack, const Demand& demand, const std::vector<SupportLayer>& levels) {
  std::vector<std::vector<Capped>> of_level(levels.size());
  for (std::size_t i = 0; i < stack.contacts.size(); ++i)
    if (const auto& contact = stack.contacts[i]; contact.level < levels.size() && contact.cap > 0)
      of_level[contact.level].push_back({i, contact.cap});
  const Capper capper(room, stack, demand, levels);
  auto caps = tasks::parallel_map(levels.size(), [&](std::size_t k) { return capper.on(k, of_level[k]); });
  Caps out{{}, std::vector<Regions>(stack.contacts.size())};
  const Um most = std::max(most_height(room.settings(), room.object().nozzle), room.object().nozzle * 3 / 4);
  for (auto& some : caps)
    for (auto& cap : some) {
      out.of[cap.layer] = all_areas(cap.lies);
      if (cap.lies.height > most) {
        SupportLayer lower = cap.lies;
        cap.lies.height -= lower.height / 2;
        lower.height /= 2, lower.z -= cap.lies.height;
        out.layers.push_back(std::move(lower));
      }
      out.layers.push_back(std::move(cap.lies));
    }
  return out;
}

}  // namespace weft::support
