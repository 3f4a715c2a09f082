// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/patches.h"

#include "geometry/boolean.h"
#include "geometry/simplify.h"
#include "support/lengths.h"

namespace weft::support {
namespace {

/// What all of them cover, and somewhat more.
Regions covered_by(const std::vector<Regions>& contacts, Um apart) {
  constexpr Um coarse = 100;  // patches are much further apart
  Regions all;
  for (const auto& regions : contacts)
    for (const Region& region : regions) all.push_back({geometry::simplified(region.outer, coarse), {}});
  return grown(all, apart / 2 + 1);
}

}  // namespace

Patches::Patches(const std::vector<Regions>& contacts, Um apart) : index_(covered_by(contacts, apart)) {
  for (std::size_t k = 0; k < contacts.size(); ++k)
    for (const Region& region : contacts[k]) {
      const std::size_t patch = index_.region_at(region.outer.front()).value_or(0);
      if (patch >= patches_.size()) patches_.resize(patch + 1);
      auto& of = patches_[patch].contacts;
      if (of.empty() || of.back().first != k) of.push_back({k, {}});
      of.back().second.push_back(region);
    }
}

}  // namespace weft::support
