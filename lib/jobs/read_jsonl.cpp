// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/job_list.h"
#include "settings/catalogue.h"

#include <algorithm>
#include <set>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace weft::jobs {
namespace {

using Json = nlohmann::ordered_json;

/// A number, text or flag as profiles write it. @throws std::invalid_argument
std::string text_of(const Json& v) {
  if (v.is_string()) return v.get<std::string>();
  if (v.is_number() || v.is_boolean()) return v.dump();
  throw std::invalid_argument(fmt::format("{} is neither text, number nor true or false", v.dump()));
}

constexpr int deepest = 64;  // levels of a line; it needs three

/// The object of a line. A name given twice would be lost silently by the parser: it is refused.
Json parse_line(std::string_view line) {
  std::vector<std::set<std::string>> seen;
  const auto refuse_twins = [&](int depth, Json::parse_event_t event, Json& parsed) {
    if (depth > deepest) throw std::invalid_argument(fmt::format("is more than {} levels deep", deepest));
    if (event == Json::parse_event_t::object_start) seen.emplace_back();
    if (event == Json::parse_event_t::object_end) seen.pop_back();
    if (event == Json::parse_event_t::key && !seen.back().insert(parsed.get<std::string>()).second)
      throw std::invalid_argument(fmt::format("'{}' is given twice", parsed.get<std::string>()));
    return true;
  };
  try {
    auto out = Json::parse(line, refuse_twins);
    if (!out.is_object()) throw std::invalid_argument("is not a JSON object");
    return out;
  } catch (const Json::parse_error& problem) {
    throw std::invalid_argument(fmt::format("is not JSON: column {}", problem.byte));
  } catch (const Json::out_of_range&) {
    throw std::invalid_argument("holds a number that is too large");
  }
}

void set_all(JobLine& job, const Json& object, const std::filesystem::path& folder) {
  for (const auto& [name, v] : object.items()) {
    if (name == "set") {
      if (!v.is_object()) throw std::invalid_argument("set: is not an object of settings");
      for (const auto& [key, item] : v.items()) job.settings.emplace_back(key, text_of(item));
      continue;
    }
    if (is_free_field(name)) {
      if (!v.is_primitive() || v.is_null())
        throw std::invalid_argument(name + ": is not a text, a number, true or false");
      job.free_fields.emplace_back(name, v.dump());
      continue;
    }
    std::vector<std::string> values;
    try {
      if (v.is_array())
        for (const auto& item : v) values.push_back(text_of(item));
      else
        values.push_back(text_of(v));
      if (set_field(job, name, values, folder)) continue;
    } catch (const std::invalid_argument& problem) {
      throw std::invalid_argument(fmt::format("{}: {}", name, problem.what()));
    }
    throw std::invalid_argument(
        fmt::format("unknown name '{}'{}", name, find_setting(name) ? "; settings belong in \"set\"" : ""));
  }
}

}  // namespace

std::string free_text(const std::string& json) {
  const auto value = Json::parse(json, nullptr, false);
  return value.is_string() ? value.get<std::string>() : json;
}

JobList read_jsonl(std::string_view text, const std::string& path, const std::filesystem::path& folder) {
  JobList list;
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  for (int number = 1; !text.empty(); ++number) {
    const auto end = std::min(text.find('\n'), text.size());
    const auto line = value::trimmed(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.empty()) continue;
    JobLine job;
    job.where = fmt::format("{}:{}", path, number);
    try {
      set_all(job, parse_line(line), folder);
      list.jobs.push_back(std::move(job));
    } catch (const std::invalid_argument& problem) {
      list.errors.emplace_back(
          Error::Kind::usage, problem.what(), job.where,
          R"(a line is {"id": "a", "models": ["a.stl"], "profiles": ["p.ini"], "set": {"layer_height": 0.2}, "output": "a.gcode"})");
    }
  }
  return list;
}

}  // namespace weft::jobs
