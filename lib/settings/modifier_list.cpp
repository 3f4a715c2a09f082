// SPDX-License-Identifier: GPL-3.0-or-later
#include "settings/modifier_list.h"

#include "settings/groups/infill.h"
#include "settings/value.h"

#include <algorithm>
#include <charconv>
#include <stdexcept>

#include <fmt/format.h>

namespace weft {
namespace {

bool is_pattern(std::string_view name) {
  constexpr auto choices = choices_of(InfillPattern{});
  return std::any_of(choices.begin(), choices.end(), [&](const auto& c) { return c.name == name; });
}

/// What stands behind the last colon, which is cut off with it.
std::string_view cut_last(std::string_view& text) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string_view::npos) return {};
  const std::string_view last = value::trimmed(text.substr(colon + 1));
  text = value::trimmed(text.substr(0, colon));
  return last;
}

}  // namespace

std::vector<DenseMesh> parse_modifier_list(std::string_view text) {
  std::vector<DenseMesh> out;
  while (!value::trimmed(text).empty()) {
    const std::size_t end = std::min(text.size(), text.find(','));
    const std::string_view part = value::trimmed(text.substr(0, end));
    text.remove_prefix(std::min(text.size(), end + 1));
    std::string_view file = part, last = cut_last(file), pattern;
    if (is_pattern(last)) pattern = last, last = cut_last(file);
    double percent = 0;
    const auto [stop, error] = std::from_chars(last.data(), last.data() + last.size(), percent);
    if (file.empty() || last.empty() || error != std::errc{} || stop != last.data() + last.size() || !(percent >= 0) ||
        percent > 100)
      throw std::invalid_argument(fmt::format("'{}' is not file:% or file:%:pattern with 0 … 100 %", part));
    out.push_back({std::string(file), std::string(last), std::string(pattern)});
  }
  return out;
}

std::string text_of(const std::vector<DenseMesh>& meshes) {
  std::string out;
  for (const DenseMesh& mesh : meshes)
    out += fmt::format("{}{}:{}{}{}", out.empty() ? "" : ", ", mesh.file, mesh.density_percent,
                       mesh.pattern.empty() ? "" : ":", mesh.pattern);
  return out;
}

}  // namespace weft
