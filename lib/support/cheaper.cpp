// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/cheaper.h"

#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/offset.h"
#include "geometry/outline_length.h"
#include "geometry/simplify.h"
#include "support/column_steps.h"
#include "support/columns.h"
#include "support/lengths.h"
#include "support/patches.h"
#include "support/plastic.h"
#include "support/tree.h"
#include "tasks/parallel.h"

#include <algorithm>
#include <optional>

namespace weft::support {
using namespace weft::literals;
namespace {

/// What the columns of a patch would take, mm³: as they are, and if they were of one density.
struct ColumnsMm3 {
  double as_they_are = 0, of_one_density = 0;
};

/// Reckons them.
class Guess {
 public:
  Guess(const Room& room, const Stack& stack)
      : room_(room),
        stack_(stack),
        s_(room.settings()),
        line_(line_width(s_, room.object().nozzle)),
        shares_(column_shares(s_, room.object().nozzle, usual_band(s_, room.object().nozzle))) {}

  static constexpr Um finest = 2_mm;
  /// @param step  of the way down: contacts fall from no lower than where one ends, so of high ones mostly more comes
  /// out
  ColumnsMm3 columns_mm3(const Patch& patch, Um step = finest) const {
    constexpr Um coarse = 0.1_mm;
    std::vector<std::pair<Um, const Regions*>> carried;
    for (const auto& [k, regions] : patch.contacts) carried.push_back({stack_.levels[k].z, &regions});
    const NearMm2 near(s_, room_.object().nozzle, shares_, carried);
    double mm3 = 0, saved_mm3 = 0, mm2 = 0;
    std::vector<double> by_mm;
    Regions falling;
    Lean lean(s_, line_, height_of(patch, stack_, room_.object()));
    Um height = 0;
    bool changed = false;  // since by_mm was reckoned: most columns fall far as they are
    auto next = patch.contacts.rbegin();
    for (std::size_t k = next->first + 1; k-- > 0;) {
      if (next != patch.contacts.rend() && next->first == k)
        append(falling, geometry::coarsened((next++)->second, coarse)), changed = true;
      height += stack_.levels[k].height;
      if (falling.empty() || (height < step && k > 0)) continue;
      stop_if_asked();
      if (changed) {
        falling = geometry::simplified(geometry::unite(falling), coarse);
        if (const Um by = s_.support_join_distance / 2; by > 0)
          falling = grown(geometry::coarsened(grown(falling, by, coarse), coarse), -by, coarse);
      }
      bool cut = false;
      mm3 += lost(k, falling, cut);
      if (changed || cut) {
        by_mm.assign(shares_.size(), 0), mm2 = area_mm2(falling);
        for (const Region& region : falling) {
          const auto own = column_mm3(s_, room_.object().nozzle, shares_, region, 1_mm);
          for (std::size_t i = 0; i < own.size(); ++i) by_mm[i] += own[i];
        }
      }
      mm3 += by_mm.front() * to_mm(height);
      if (by_mm.size() > 1)
        saved_mm3 +=
            to_mm(height) * (by_mm.front() - taken_mm3(by_mm, near.at(stack_.levels[k].bottom() + height / 2), mm2));
      const int levels = std::max(1, height / stack_.levels[k].height);
      changed = (s_.support_conical_enabled && lean.narrow(height, falling, levels)) || cut;
      height = 0;
    }
    mm3 += foot_mm3(falling) - roof_mm3(patch);
    return {mm3 - saved_mm3, mm3};
  }

  /// Whether they take less than that by steps coarser than the finest: those cost least, and mostly tell.
  bool take_less_coarsely(const Patch& patch, double mm3) const {
    for (Um step = height_of(patch, stack_, room_.object()); step > finest; step /= 4)
      if (columns_mm3(patch, step).as_they_are < mm3) return true;
    return false;
  }

 private:
  /// Takes away what the part keeps off on a level. @return what of it stands on the part, as so much plastic
  /// @param cut  becomes true where something is near enough to keep it off
  double lost(std::size_t k, Regions& falling, bool& cut) const {
    constexpr double mm3_by_scar_mm2 = 1;  // what stands on the part is filed off
    double mm3 = 0;
    const auto& level = stack_.levels[k];
    const Box near = box_of(falling).grown(1);
    if (s_.support_type == SupportType::everywhere)
      if (const Regions part = room_.part(level.bottom(), level.z, near); !part.empty())
        mm3 += mm3_by_scar_mm2 * area_mm2(geometry::intersect(falling, part));
    if (const Regions kept_off = room_.kept_off_beside(level, near); !kept_off.empty())
      falling = opened(geometry::subtract(falling, kept_off), line_ / 2), cut = true;
    return mm3;
  }
  /// What the first layer of what stands there takes, with what spreads around it.
  double foot_mm3(const Regions& standing) const {
    return area_mm2(grown(standing, s_.support_brim_width)) * to_mm(stack_.levels.front().height) *
           s_.support_initial_layer_density / 100;
  }
  /// Either has a roof. On a column it takes the place of what fills it, and its lowest level is strands far apart or
  /// rungs; on branches most of that is free where it is wider than the loop along its rim, and strips of a slope lie
  /// on loops of their own.
  double roof_mm3(const Patch& patch) const {
    if (!s_.support_roof_enable || s_.support_roof_height <= 0) return 0;
    constexpr double joists = 0.2;
    double mm2 = 0, wide_mm2 = 0, loops_mm = 0;
    for (const auto& [k, regions] : patch.contacts) {
      mm2 += area_mm2(regions);
      for (const Region& region : regions)
        if (const Point size = box_of(region.outer).size(); std::min(size.x, size.y) > narrow_roof)
          wide_mm2 += area_mm2(opened({region}, narrow_roof / 2));
      for (const Region& region : regions) loops_mm += perimeter_of(region.outer) / 1000;
    }
    const double free_mm2 = wide_mm2 * (1 - joists) - loops_mm * to_mm(line_) - mm2 * (1 - under_roof_share(s_));
    return mm2 * to_mm(s_.support_roof_height) * s_.support_infill_rate / 100 -
           free_mm2 * to_mm(most_height(s_, room_.object().nozzle));
  }

  const Room& room_;
  const Stack& stack_;
  const SupportSettings& s_;
  Um line_;
  std::vector<double> shares_;
};

/// What is held is strips too narrow for a roof on branches, on the whole, as under slopes. Each strip would need a row
/// of tips of its own, as those beside it do not carry it, and each tip as much as one that holds ten times more: where
/// columns take less than a row of tips does, branches need not be reckoned. High up they may well be less.
/// @param columns_mm3  what columns take, if it had to be reckoned in fine steps
bool for_columns_alone(const SupportSettings& settings, const Guess& guess, const Patch& patch,
                       std::optional<ColumnsMm3>& columns_mm3) {
  constexpr double tips_mm3_by_mm = 0.95;  // of a strip's outline: the least of those that share branches low down
  double mm2 = 0, round_mm = 0;
  for (const auto& [k, regions] : patch.contacts) mm2 += area_mm2(regions), round_mm += geometry::outline_mm(regions);
  if (2 * mm2 >= round_mm * to_mm(narrowest_roof(branch_style(settings)))) return false;
  const double tips_mm3 = tips_mm3_by_mm * round_mm;
  if (guess.take_less_coarsely(patch, tips_mm3)) return true;
  columns_mm3 = guess.columns_mm3(patch);
  return columns_mm3->as_they_are < tips_mm3;
}

}  // namespace

Split cheaper(const Room& room, const Stack& stack, const std::vector<Regions>& contacts, tasks::Spare& spare) {
  Split out{std::vector<Regions>(contacts.size()), std::vector<Regions>(contacts.size()), std::nullopt};
  const Patches& patches = out.patches.emplace(contacts, apart(room.settings(), room.object().nozzle));
  const Guess guess(room, stack);
  const auto& all = patches.all();
  std::vector<std::optional<ColumnsMm3>> columns_mm3(all.size());
  std::vector<char> strips(all.size(), 0);
  spare.for_each_index(all.size(), [&](std::size_t i) {
    strips[i] = char{for_columns_alone(room.settings(), guess, all[i], columns_mm3[i])};
  });
  std::vector<std::size_t> asked;
  std::vector<Regions> wide(contacts.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (strips[i] == 0) asked.push_back(i);
    for (const auto& [k, regions] : all[i].contacts) append((strips[i] != 0 ? out.for_columns : wide)[k], regions);
  }
  if (asked.empty()) return out;
  // A field is made slab by slab: columns are reckoned meanwhile.
  tasks::for_each_index(2, [&](std::size_t structure) {
    if (structure == 0)
      out.field.emplace(room.settings(), room.object(), stack, wide);
    else
      tasks::for_each_index(asked.size(), [&](std::size_t i) {
        if (auto& mm3 = columns_mm3[asked[i]]; !mm3) mm3 = guess.columns_mm3(all[asked[i]]);
      });
  });
  // Under a mushroom a mm³ of branches takes a third longer than one of columns: at three quarters of the plastic they
  // take the same time. Columns with fewer lines below are quicker still, but are not to take more than branches do.
  constexpr double worth_branches = 0.75;
  std::vector<double> least_mm3(all.size(), 0);  // for which branches are not taken
  for (const std::size_t i : asked)
    least_mm3[i] = std::min(columns_mm3[i]->as_they_are, worth_branches * columns_mm3[i]->of_one_density);
  const auto by_branches_mm3 = branches_mm3(room, stack, *out.field, wide, patches, least_mm3);
  for (const std::size_t i : asked)
    for (const auto& [k, regions] : all[i].contacts)
      append((by_branches_mm3[i] < least_mm3[i] ? out.for_branches : out.for_columns)[k], regions);
  return out;
}

}  // namespace weft::support
