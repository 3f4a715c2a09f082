// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/hook_environment.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

namespace weft::jobs {
namespace {

/// A value of JSON as plain text; an environment ends at the first zero.
std::string plain(const std::string& json) {
  auto out = free_text(json);
  return out.substr(0, out.find('\0'));
}

std::string variable(const std::string& field) {
  std::string out = "WEFT_";
  for (const char c : field) {
    const auto u = static_cast<unsigned char>(c);
    out += std::isalnum(u) != 0 ? static_cast<char>(std::toupper(u)) : '_';
  }
  return out;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> hook_environment(const std::filesystem::path& folder,
                                                                  const JobLine& job, const Record& record) {
  const auto whole = std::filesystem::absolute(folder).lexically_normal();
  const bool made = record.exit_status == 0;
  std::vector<std::pair<std::string, std::string>> out{
      {"WEFT_ID", job.id},
      {"WEFT_STATUS", record.status},
      {"WEFT_EXIT_STATUS", fmt::format("{}", record.exit_status)},
      {"WEFT_ERROR", record.error},
      {"WEFT_OUTPUT", made ? (whole / record.output).string() : std::string()},
      {"WEFT_NAME", record.output},
      {"WEFT_FOLDER", whole.string()},
      {"WEFT_REPORT", record_path(whole, job).string()},
      {"WEFT_PRINT_TIME_S", fmt::format("{:.0f}", record.print_time_s)},
      {"WEFT_FILAMENT_G", fmt::format("{:.2f}", record.filament_g)}};
  if (record.cost) {
    out.emplace_back("WEFT_COST", fmt::format("{:.2f}", *record.cost));
    out.emplace_back("WEFT_CURRENCY", record.currency);
  }
  for (const auto& [name, value] : job.free_fields) out.emplace_back(variable(name), plain(value));
  return out;
}

}  // namespace weft::jobs
