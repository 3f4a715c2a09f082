// SPDX-License-Identifier: GPL-3.0-or-later
#include "settings/near.h"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

namespace weft {
namespace {

std::string lower(std::string_view text) {
  std::string out(text);
  for (auto& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min({row[j - 1] + 1, above + 1, diagonal + (a[i - 1] == b[j - 1] ? 0u : 1u)});
      diagonal = above;
    }
  }
  return row.back();
}

std::string did_you_mean(std::string_view wrong, const std::vector<std::string>& names) {
  const auto wanted = lower(wrong).substr(0, 200);
  std::vector<std::pair<std::size_t, std::string>> near;
  for (const auto& name : names) {
    const auto known = lower(name);
    const auto distance = edit_distance(wanted, known);
    if (known.find(wanted) != std::string::npos)
      near.emplace_back(distance / 100, name);
    else if (distance <= wanted.size() / 3 + 1)
      near.emplace_back(distance + 1, name);
  }
  std::stable_sort(near.begin(), near.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  if (near.size() > 3) near.resize(3);
  if (near.empty()) {
    std::string out = "there are";
    for (std::size_t i = 0; i < names.size() && i < 6; ++i) out += fmt::format("{} '{}'", i == 0 ? "" : ",", names[i]);
    return out + (names.size() > 6 ? " …" : "");
  }
  std::string out = "did you mean";
  for (std::size_t i = 0; i < near.size(); ++i)
    out += fmt::format("{} '{}'", i == 0 ? "" : i + 1 == near.size() ? " or" : ",", near[i].second);
  return out + "?";
}

}  // namespace weft
