// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "pipeline/object_scopes.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace weft::pipeline {

/// The scopes of a layer that a stage can tell apart, each with the regions that it holds for.
struct Told {
  ScopeId scope = 0;
  std::vector<std::uint32_t> regions;
};
template <class T>
std::vector<Told> told_apart(const Handed<T>& handed, const Areas& areas) {
  std::vector<Told> out;
  std::uint32_t region = 0;
  for (const auto& area : areas) {
    auto same = std::find_if(out.begin(), out.end(),
                             [&](const Told& told) { return handed.alike(told.scope) == handed.alike(area.scope); });
    if (same == out.end()) same = out.insert(out.end(), Told{area.scope, {}});
    for (std::uint32_t i = 0; i < area.regions; ++i) same->regions.push_back(region++);
  }
  return out;
}

}  // namespace weft::pipeline
