// SPDX-License-Identifier: GPL-3.0-or-later
#include "prusaslicer/keys.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace weft::prusaslicer {
namespace {

using Named = std::pair<std::string_view, const Key*>;

/// Rows by what `name` tells of them, the first of equals first.
template <class Name>
std::vector<Named> sorted_by(Name name) {
  std::vector<Named> out;
  for (const auto& row : keys())
    if (!name(row).empty()) out.emplace_back(name(row), &row);
  std::stable_sort(out.begin(), out.end(), [](const Named& a, const Named& b) { return a.first < b.first; });
  return out;
}

const Key* found_in(const std::vector<Named>& rows, std::string_view name) {
  const auto at = std::lower_bound(rows.begin(), rows.end(), name,
                                   [](const Named& row, std::string_view wanted) { return row.first < wanted; });
  return at != rows.end() && at->first == name ? at->second : nullptr;
}

}  // namespace

std::span<const Key> keys() {
  static const std::vector<Key> all = [] {
    std::vector<Key> out;
    for (const auto rows : {ported_keys(), reckoned_keys(), idle_keys(), missing_keys()})
      out.insert(out.end(), rows.begin(), rows.end());
    return out;
  }();
  return all;
}

const Key* find_key(std::string_view name) {
  static const auto rows = sorted_by([](const Key& row) { return row.name; });
  return found_in(rows, name);
}

std::string_view name_of(std::string_view ours) {
  static const auto rows = sorted_by([](const Key& row) { return row.ours; });
  const auto* row = found_in(rows, ours);
  return row ? row->name : std::string_view();
}

}  // namespace weft::prusaslicer
