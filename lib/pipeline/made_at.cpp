// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/made_at.h"

#include "core/error.h"
#include "gcode/custom_code.h"
#include "settings/gcode_variables.h"
#include "settings/tools.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <set>

#include <fmt/format.h>

namespace weft::pipeline {
namespace {

constexpr std::int64_t end_of_9999 = 253'402'300'799;

/// Names of variables that custom G-code of any tool mentions, and the file's name.
std::set<std::string> names_in(const Settings& settings) {
  std::set<std::string> out;
  const auto add = [&](const macro::Template& text) { out.insert(text.names().begin(), text.names().end()); };
  for (const auto& tool : settings_of_tools(settings)) {
    const gcode::CustomCode code(tool.gcode);
    for (const auto* text : code.all()) add(*text);
  }
  for (const auto& mark : settings.tools.gcode_at_heights) add(gcode::template_of(mark));
  add(macro::Template(settings.gcode.output_filename_format, "output_filename_format"));
  return out;
}

}  // namespace

std::int64_t parse_epoch(std::string_view text) {
  std::int64_t out = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), out);
  if (text.empty() || fault != std::errc() || end != text.data() + text.size() || out < 0 || out > end_of_9999)
    throw Error{Error::Kind::usage, fmt::format("'{}' is no number of seconds since 1970", text.substr(0, 40)),
                "SOURCE_DATE_EPOCH", "as date +%s writes it, or unset it"};
  return out;
}

void tell_time(Profile& profile, std::int64_t epoch_s) {
  using namespace std::chrono;
  const sys_seconds at{seconds{epoch_s}};
  const auto midnight = floor<days>(at);
  const year_month_day date{midnight};
  const hh_mm_ss time{at - midnight};
  const auto year = static_cast<int>(date.year());
  const auto month = static_cast<unsigned>(date.month()), day = static_cast<unsigned>(date.day());
  const auto hour = time.hours().count(), minute = time.minutes().count(), second = time.seconds().count();
  const std::array<std::pair<std::string_view, std::string>, 7> lines{
      {{"timestamp", fmt::format("\"{:04}{:02}{:02}-{:02}{:02}{:02}\"", year, month, day, hour, minute, second)},
       {"year", fmt::format("{}", year)},
       {"month", fmt::format("{}", month)},
       {"day", fmt::format("{}", day)},
       {"hour", fmt::format("{}", hour)},
       {"minute", fmt::format("{}", minute)},
       {"second", fmt::format("{}", second)}}};
  const auto named = names_in(profile.settings);
  const auto given = parse_gcode_variables(profile.settings.gcode.gcode_variables);
  std::string told;
  for (const auto& [name, value] : lines) {
    const std::string_view wanted = name;
    if (named.count(std::string(wanted)) == 0 ||
        std::any_of(given.begin(), given.end(), [&](const GcodeVariable& own) { return own.name == wanted; }))
      continue;
    told += fmt::format("{} = {}\n", wanted, value);
  }
  if (told.empty()) return;
  const auto& before = profile.settings.gcode.gcode_variables;
  profile.settings.gcode.gcode_variables = before + (before.empty() || before.ends_with('\n') ? "" : "\n") + told;
  profile.origins["gcode_variables"].push_back({"SOURCE_DATE_EPOCH", told, {}});
}

}  // namespace weft::pipeline
