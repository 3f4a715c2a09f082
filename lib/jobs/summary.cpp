// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/summary.h"

#include "core/escape.h"
#include "core/json_text.h"
#include "core/write_file.h"

#include <map>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace weft::jobs {
namespace {

using Given = std::vector<std::pair<std::string, std::string>>;

/// Names that jobs give values to, in the order of their first appearance.
std::vector<std::string> names_in(const Collected& collected, Given JobLine::*given) {
  std::vector<std::string> out;
  std::set<std::string_view> seen;
  for (const auto& entry : collected.entries)
    for (const auto& [name, value] : entry.line.*given)
      if (seen.insert(name).second) out.push_back(name);
  return out;
}

/// Cells of a job below these names; of a name that it gives twice the last. @param text of a value
template <class Text>
std::string cells_of(const std::vector<std::string>& names, const Given& given, const Text& text) {
  std::map<std::string_view, std::string_view> values;
  for (const auto& [name, value] : given) values[name] = value;
  std::string out;
  for (const auto& name : names) {
    const auto at = values.find(name);
    out += "," + (at == values.end() ? std::string() : escape::csv(text(std::string(at->second))));
  }
  return out;
}

}  // namespace

namespace {

/// Whether the record is of what the job is now. A job that failed before its inputs were known has no hash of them,
/// and looking for one would take what it took then: it is run again by the next run, whatever they are.
bool is_of(const Record& record, const Job& job, FileHashes& files) {
  if (record.inputs_sha256.empty()) return record.exit_status != 0;
  try {
    return record.inputs_sha256 == inputs_hash(job, files);
  } catch (const Error&) {  // it can no longer be read
    return false;
  }
}

}  // namespace

Collected collect(const std::vector<Prepared>& jobs, const std::filesystem::path& folder, bool check_full) {
  Collected out;
  FileHashes files;
  for (const auto& job : jobs) {
    Collected::Entry entry{job.line, read_record(folder, job.line)};
    const bool gone = entry.ok() && !has_gcode(folder, *entry.record, check_full);
    if (entry.record && !check_full)
      for (const auto& file : entry.record->files) files.trust(file);
    if (gone || (entry.record && !is_of(*entry.record, job.job, files))) entry.record.reset();
    out.missing += !entry.record;
    out.ok += entry.ok();
    out.failed += entry.record && !entry.ok();
    out.entries.push_back(std::move(entry));
  }
  return out;
}

namespace {

using Json = nlohmann::ordered_json;

/// An object as text, with the job's free fields right behind its id.
std::string with_free_fields(const std::string& object, const JobLine& line) {
  const auto begin = json_text(Json{{"id", line.id}});
  const auto id = begin.substr(0, begin.size() - 1);  // without its brace
  if (line.free_fields.empty() || !object.starts_with(id)) return object;
  std::string fields;
  for (const auto& [name, value] : line.free_fields) fields += "," + json_text(Json(name)) + ":" + value;
  return id + fields + object.substr(id.size());
}

}  // namespace

std::string report_jsonl(const Collected& collected) {
  std::string out;
  for (const auto& entry : collected.entries) {
    const auto object =
        entry.record ? entry.record->line
                     : json_text(Json{{"id", entry.line.id}, {"output", entry.line.output}, {"status", "missing"}});
    out += with_free_fields(object, entry.line) + "\n";
  }
  return out;
}

std::string summary_csv(const Collected& collected) {
  const auto keys = names_in(collected, &JobLine::settings), fields = names_in(collected, &JobLine::free_fields);
  std::string out =
      "id,output,status,exit_status,seconds,layers,height_mm,print_time_s,filament_mm,filament_g,audit,warnings,error,"
      "cost,currency";
  for (const auto& field : fields) out.append(",").append(escape::csv(field));
  for (const auto& key : keys) out.append(",").append(escape::csv(key));
  out += "\n";
  for (const auto& entry : collected.entries) {
    out += fmt::format("{},{},", escape::csv(entry.line.id), escape::csv(entry.line.output));
    if (const auto& r = entry.record)
      out += fmt::format("{},{},{:.3f},{},{:.3f},{:.3f},{:.3f},{:.3f},{},{},{},{},{}", r->status, r->exit_status,
                         r->seconds, r->layers, r->height_mm, r->print_time_s, r->filament_mm, r->filament_g,
                         r->verdict, r->warnings, escape::csv(r->error), r->cost ? fmt::format("{:.2f}", *r->cost) : "",
                         escape::csv(r->currency));
    else
      out += "missing,,,,,,,,,,,,";
    out += cells_of(fields, entry.line.free_fields, free_text);
    out += cells_of(keys, entry.line.settings, [](const std::string& as_it_is) { return as_it_is; });
    out += "\n";
  }
  return out;
}

namespace {

/// The free fields of a job.
std::string properties_xml(const JobLine& line) {
  std::string out;
  for (const auto& [name, value] : line.free_fields)
    out += fmt::format("    <property name=\"{}\" value=\"{}\"/>\n", escape::xml(name), escape::xml(free_text(value)));
  return out.empty() ? out : "   <properties>\n" + out + "   </properties>\n";
}

std::string verdict_xml(const Collected::Entry& entry) {
  if (entry.ok() && entry.record->verdict == "annotated")
    return fmt::format("   <system-out>audit annotated: {}</system-out>\n", escape::xml(entry.record->audit));
  if (entry.ok()) return {};
  if (!entry.record) return "   <error type=\"missing\" message=\"the job was not run\"/>\n";
  return fmt::format("   <failure type=\"exit status {}\" message=\"{}\"/>\n", entry.record->exit_status,
                     escape::xml(entry.record->error));
}

}  // namespace

std::string junit_xml(const Collected& collected, std::string_view suite) {
  double seconds = 0;
  for (const auto& entry : collected.entries) seconds += entry.record ? entry.record->seconds : 0;
  const auto counts = fmt::format(R"(tests="{}" failures="{}" errors="{}" time="{:.3f}")", collected.entries.size(),
                                  collected.failed, collected.missing, seconds);
  std::string out =
      fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites {}>\n <testsuite name=\"{}\" {}>\n", counts,
                  escape::xml(suite), counts);
  for (const auto& entry : collected.entries) {
    out += fmt::format("  <testcase classname=\"{}\" name=\"{}\" time=\"{:.3f}\"", escape::xml(suite),
                       escape::xml(entry.line.id), entry.record ? entry.record->seconds : 0.0);
    const auto inside = properties_xml(entry.line) + verdict_xml(entry);
    out += inside.empty() ? "/>\n" : ">\n" + inside + "  </testcase>\n";
  }
  return out + " </testsuite>\n</testsuites>\n";
}

std::array<std::string, 3> summary_names(const std::string& suffix) {
  return {"report" + suffix + ".jsonl", "summary" + suffix + ".csv", "junit" + suffix + ".xml"};
}

void write_summaries(const Collected& collected, const std::filesystem::path& folder, const std::string& suffix) {
  const auto [report, summary, junit] = summary_names(suffix);
  write_file(folder / report, report_jsonl(collected));
  write_file(folder / summary, summary_csv(collected));
  write_file(folder / junit, junit_xml(collected, "weft batch"));
}

}  // namespace weft::jobs
