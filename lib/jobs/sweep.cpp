// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/sweep.h"

#include "core/parts.h"
#include "profile/profile.h"
#include "profile/tool_values.h"
#include "settings/catalogue.h"
#include "settings/tools.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>

#include <fmt/format.h>

namespace weft::jobs {
namespace {

/// The setting that is varied, of the plate or of a tool (`tool.1.material_flow`); null: there is none.
const CatalogueEntry* entry_of(const std::string& key) {
  const auto tool = tool_key(key);
  return find_setting(tool ? tool->second : key);
}

constexpr std::size_t most_jobs = 1'000'000;

std::optional<double> number(const std::string& text) {
  std::size_t end = 0;
  try {
    const double v = std::stod(text, &end);
    if (end == text.size() && std::isfinite(v)) return v;
  } catch (const std::exception&) {
  }
  return std::nullopt;
}

std::vector<std::string> trimmed_parts(std::string_view text, char separator) {
  std::vector<std::string> out;
  for (const auto part : parts(text, separator)) out.emplace_back(value::trimmed(part));
  return out;
}

int decimals_of(const std::string& text) {
  const auto dot = text.find('.');
  return dot == std::string::npos ? 0 : static_cast<int>(text.size() - dot - 1);
}

void read_range(Axis& axis, const std::vector<std::string>& parts, const std::string& option) {
  std::vector<double> v;
  int decimals = 0;
  for (const auto& part : parts) {
    const auto n = number(part);
    if (!n)
      throw Error{Error::Kind::usage, fmt::format("'{}' is not a number", part), option,
                  "as in infill_sparse_density=10:50:10"};
    v.push_back(*n);
    decimals = std::max(decimals, decimals_of(part));
  }
  if (v[1] < v[0])
    throw Error{Error::Kind::usage, fmt::format("{} is below {}", parts[1], parts[0]), option,
                "FROM:TO:STEP runs upwards"};
  if (v.size() == 2) {
    axis.from = v[0], axis.to = v[1];
    axis.decimals = entry_of(axis.key)->type == "integer" ? 0 : std::max(decimals, 3);
    return;
  }
  if (!(v[2] > 0)) throw Error{Error::Kind::usage, fmt::format("a step of {} leads nowhere", parts[2]), option};
  const double steps = std::floor((v[1] - v[0]) / v[2] + 1e-9);
  if (steps + 1 > static_cast<double>(most_jobs)) throw Error{Error::Kind::usage, "has too many values", option};
  for (int i = 0; i <= static_cast<int>(steps); ++i)
    axis.values.push_back(value::number(v[0] + i * v[2], std::min(decimals, 9)));
}

/// A generator that is the same in every standard library. Source: Steele, Lea, Flood 2014, "SplitMix64".
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  double share() { return static_cast<double>(next() >> 11) * 0x1p-53; }  // 0 … 1, 1 excluded
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(share() * static_cast<double>(n)); }

 private:
  std::uint64_t state_;
};

std::vector<std::vector<std::string>> sample(const std::vector<Axis>& axes, const SweepOptions& options) {
  const std::size_t n = options.samples;
  std::vector<std::vector<std::string>> out(n);
  Dice dice(options.seed);
  for (const auto& axis : axes) {
    std::vector<std::size_t> strata(n);
    std::iota(strata.begin(), strata.end(), std::size_t{0});
    for (std::size_t i = n; i > 1; --i) std::swap(strata[i - 1], strata[dice.below(i)]);
    for (std::size_t i = 0; i < n; ++i) {
      const double at = (static_cast<double>(strata[i]) + dice.share()) / static_cast<double>(n);
      if (axis.continuous())
        out[i].push_back(value::number(axis.from + at * (axis.to - axis.from), axis.decimals));
      else
        out[i].push_back(axis.values[std::min(axis.values.size() - 1,
                                              static_cast<std::size_t>(at * static_cast<double>(axis.values.size())))]);
    }
  }
  return out;
}

/// A name for a file, of "infill_sparse_density=10,infill_pattern=grid".
std::string file_name(const std::string& id, std::size_t index) {
  std::string out;
  for (const char c : id) {
    const auto u = static_cast<unsigned char>(c);
    out += std::isalnum(u) || c == '_' || c == '.' || c == '-' || c == '=' || c == '%' || u >= 0x80 ? c : '_';
  }
  if (out.size() > 150) out = fmt::format("{:04}", index + 1);
  return out + ".gcode";
}

}  // namespace

Axis parse_axis(const std::string& text) {
  const std::string option = "--vary " + text;
  const auto equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    throw Error{Error::Kind::usage, fmt::format("'{}' is not KEY=VALUES", text), "--vary",
                "as in --vary layer_height=0.1,0.2,0.3"};
  Axis axis;
  const auto typed = std::string(value::trimmed(text.substr(0, equals)));
  const auto tool = tool_key(typed);
  const auto* entry = entry_of(typed);
  if (!entry) {
    const auto near = nearest_key(tool ? tool->second : typed);
    throw Error{Error::Kind::settings, fmt::format("unknown setting '{}'", typed), "--vary",
                near.empty() ? "`weft settings` lists them all" : fmt::format("did you mean '{}'?", near)};
  }
  if (tool && !differs_by_tool(*entry))
    throw Error{Error::Kind::settings, fmt::format("{} is no tool's own", entry->key), option, "leave out the tool"};
  axis.key = tool ? fmt::format("tool.{}.{}", tool->first, entry->key) : std::string(entry->key);
  const auto values = text.substr(equals + 1);
  const auto range = trimmed_parts(values, ':');
  if ((range.size() == 2 || range.size() == 3) && values.find(',') == std::string::npos)
    read_range(axis, range, option);
  else
    axis.values = trimmed_parts(values, ',');
  std::set<std::string> seen;
  for (const auto& v : axis.values) {
    if (v.empty()) throw Error{Error::Kind::usage, "a value is empty", option, "separate values by one comma"};
    if (!seen.insert(v).second) throw Error{Error::Kind::usage, fmt::format("the value {} is given twice", v), option};
  }
  return axis;
}

std::vector<std::vector<std::string>> combinations(const std::vector<Axis>& axes, const SweepOptions& options) {
  if (options.combine == Combine::sample) return sample(axes, options);
  for (const auto& axis : axes)
    if (axis.continuous())
      throw Error{Error::Kind::usage, "a range without a step", "--vary " + axis.key,
                  "give FROM:TO:STEP, or --sample N"};
  std::vector<std::vector<std::string>> out;
  if (options.combine == Combine::zip) {
    for (const auto& axis : axes)
      if (axis.values.size() != axes.front().values.size())
        throw Error{Error::Kind::usage,
                    fmt::format("{} has {} values, {} has {}", axes.front().key, axes.front().values.size(), axis.key,
                                axis.values.size()),
                    "--zip", "give all axes equally many values, or leave --zip out"};
    for (std::size_t i = 0; i < axes.front().values.size(); ++i) {
      auto& row = out.emplace_back();
      for (const auto& axis : axes) row.push_back(axis.values[i]);
    }
    return out;
  }
  out.emplace_back();
  for (const auto& axis : axes) {
    if (out.size() * axis.values.size() > most_jobs)
      throw Error{Error::Kind::usage, fmt::format("more than {} combinations", most_jobs), "--vary",
                  "--sample N takes some of them"};
    std::vector<std::vector<std::string>> longer;
    for (const auto& row : out)
      for (const auto& v : axis.values) {
        longer.push_back(row);
        longer.back().push_back(v);
      }
    out = std::move(longer);
  }
  return out;
}

JobList sweep_jobs(const std::vector<std::string>& models, const std::vector<Axis>& axes, const SweepOptions& options) {
  JobList list;
  std::set<std::string> seen;
  for (const auto& row : combinations(axes, options)) {
    JobLine job;
    job.models = models;
    for (std::size_t a = 0; a < axes.size(); ++a) {
      job.settings.emplace_back(axes[a].key, row[a]);
      job.id += fmt::format("{}{}={}", a == 0 ? "" : ",", axes[a].key, row[a]);
    }
    if (!seen.insert(job.id).second) continue;  // samples of few values may fall together
    job.where = "--vary " + job.id;
    job.output = file_name(job.id, list.jobs.size());
    list.jobs.push_back(std::move(job));
  }
  complete(list);
  return list;
}

}  // namespace weft::jobs
