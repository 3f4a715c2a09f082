// SPDX-License-Identifier: GPL-3.0-or-later
#include "settings/pattern_list.h"

#include "settings/value.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <stdexcept>

#include <fmt/format.h>

namespace weft {

std::vector<PatternFrom> parse_pattern_list(std::string_view text) {
  std::vector<PatternFrom> out;
  while (!value::trimmed(text).empty()) {
    const std::size_t end = std::min(text.size(), text.find(','));
    const std::string_view part = value::trimmed(text.substr(0, end));
    text.remove_prefix(std::min(text.size(), end + 1));
    const std::size_t colon = part.find(':');
    const std::string_view percent = value::trimmed(part.substr(0, colon)),
                           name = colon == std::string_view::npos ? std::string_view()
                                                                  : value::trimmed(part.substr(colon + 1));
    double v = 0;
    const auto [stop, error] = std::from_chars(percent.data(), percent.data() + percent.size(), v);
    if (colon == std::string_view::npos || error != std::errc{} || stop != percent.data() + percent.size() ||
        !(v >= 0) || v > 100)
      throw std::invalid_argument(fmt::format("'{}' is not %:pattern with 0 … 100 %", part));
    constexpr auto choices = choices_of(InfillPattern{});
    const auto known = std::find_if(choices.begin(), choices.end(), [&](const auto& c) { return c.name == name; });
    if (known == choices.end()) throw std::invalid_argument(fmt::format("'{}' is no pattern", name));
    constexpr std::array of_whole_objects{InfillPattern::cubicsubdiv, InfillPattern::support_cubic,
                                          InfillPattern::lightning};
    if (std::find(of_whole_objects.begin(), of_whole_objects.end(), known->value) != of_whole_objects.end())
      throw std::invalid_argument(fmt::format("'{}' looks at the whole object and cannot be one of several", name));
    if (!out.empty() && v / 100 <= out.back().density)
      throw std::invalid_argument(fmt::format("{} % is not more than the {} % before", v, 100 * out.back().density));
    out.push_back({v / 100, known->value});
  }
  return out;
}

}  // namespace weft
