// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/patches.h"

#include "geometry/offset.h"
#include "geometry/simplify.h"
#include "geometry/touching.h"

#include <algorithm>

namespace weft::support {

Um height_of(const Patch& patch, const Stack& stack, const Object& object) {
  const std::size_t top = patch.contacts.empty() ? stack.levels.size() - 1 : patch.contacts.back().first;
  return stack.levels[top].z - object.floor;
}

Patches::Patches(const std::vector<Regions>& contacts, Um apart) {
  constexpr Um coarse = 100;  // patches are much further apart
  Regions around;
  std::vector<std::size_t> of_region;  // which region of contacts each of `around` is about
  std::size_t count = 0;
  for (const auto& regions : contacts)
    for (const Region& region : regions) {
      for (Region& wide : geometry::offset({{geometry::simplified(region.outer, coarse), {}}}, {.by = apart / 2 + 1}))
        around.push_back(std::move(wide)), of_region.push_back(count);
      ++count;
    }
  patch_of_.resize(around.size());
  std::vector<std::size_t> patch_of_region(count, 0);
  const auto sets = geometry::overlapping(around);
  for (std::size_t patch = 0; patch < sets.size(); ++patch)
    for (const std::size_t i : sets[patch]) patch_of_[i] = patch_of_region[of_region[i]] = patch;
  index_ = geometry::SegmentIndex(around);
  patches_.resize(count > 0 ? std::max<std::size_t>(sets.size(), 1) : 0);
  auto patch = patch_of_region.begin();
  for (std::size_t k = 0; k < contacts.size(); ++k)
    for (const Region& region : contacts[k]) {
      auto& of = patches_[*patch++].contacts;
      if (of.empty() || of.back().first != k) of.push_back({k, {}});
      of.back().second.push_back(region);
    }
}

std::optional<std::size_t> Patches::at(Point p) const {
  const auto region = index_.region_at(p);
  return region ? std::optional(patch_of_[*region]) : std::nullopt;
}

}  // namespace weft::support
