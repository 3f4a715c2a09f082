// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/record.h"

#include "core/build_id.h"
#include "core/file_bytes.h"
#include "core/hash.h"
#include "core/json_text.h"
#include "core/write_file.h"
#include "pipeline/field_files.h"
#include "pipeline/model_parts.h"
#include "pipeline/transform_words.h"
#include "settings/exact.h"

#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>

namespace weft::jobs {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;
// 1 was written by versions that could take a file of fewer layers for a whole one: what it tells is not believed.
constexpr int record_format = 2;

/// Of a file of any size, in little memory. @throws Error{file}
std::string hash_of(const fs::path& path) {
  InputFile file(path.string());
  std::vector<char> block(1 << 20);
  Sha256 hash;
  for (std::size_t got = block.size(); got == block.size();) {
    got = file.read(block.data(), block.size());
    hash.add({block.data(), got});
  }
  file.check_whole();
  return hash.digest();
}

Json json_of(const std::optional<Stamp>& stamp) {
  if (!stamp) return {};
  return {stamp->device, stamp->inode, stamp->size, stamp->modified_ns, stamp->changed_ns};
}

/// @throws Json::exception
std::optional<Stamp> stamp_from(const Json& json) {
  if (json.is_null()) return std::nullopt;
  return Stamp{json.at(0), json.at(1), json.at(2), json.at(3), json.at(4)};
}

Json json_of(const std::vector<KnownFile>& files) {
  Json out = Json::array();
  for (const auto& file : files)
    out.push_back({{"path", file.path}, {"sha256", file.sha256}, {"stamp", json_of(file.stamp)}});
  return out;
}

Json json_of(const HookResult& hook) {
  return {{"status", hook.status}, {"attempts", hook.attempts}};
}

std::string dumped(const Json& json) {
  return json_text(json);
}

}  // namespace

fs::path record_path(const fs::path& folder, const JobLine& job) {
  const auto key = job.list.empty() ? job.id : job.list + "\n" + job.id;
  return folder / ".weft" / "jobs" / (sha256(key).substr(0, 32) + ".json");
}

void write_record(const fs::path& folder, const JobLine& job, const Outcome& outcome) {
  Json line{{"id", job.id},
            {"output", job.output},
            {"exit_status", outcome.exit_status},
            {"seconds", std::round(outcome.seconds * 1000) / 1000}};
  const auto report = Json::parse(to_json(outcome.report));
  line.update(report);
  if (!outcome.error.empty()) line["error"] = outcome.error;
  if (outcome.attempts > 1) line["attempts"] = outcome.attempts;
  if (outcome.hook) line["exec"] = json_of(*outcome.hook);
  const Json record{{"format", record_format},
                    {"build", build_id()},
                    {"inputs_sha256", outcome.inputs_sha256},
                    {"files", json_of(outcome.files)},
                    {"output", json_of(outcome.output)},
                    {"report", std::move(line)}};
  write_file(record_path(folder, job), dumped(record) + "\n");
}

namespace {

/// Reads the record, changes it, and writes it again. One that is not there, or no record, is left alone.
template <class Change>
void change_record(const fs::path& folder, const JobLine& job, const Change& change) {
  const auto path = record_path(folder, job);
  Json json;
  try {
    json = Json::parse(FileBytes(path.string()).view());
    change(json);
  } catch (const Json::exception&) {
    return;
  }
  write_file(path, dumped(json) + "\n");
}

}  // namespace

void write_hook(const fs::path& folder, const JobLine& job, const HookResult& result) {
  change_record(folder, job, [&](Json& json) { json.at("report")["exec"] = json_of(result); });
}

void write_stamps(const fs::path& folder, const JobLine& job, const std::vector<KnownFile>& files,
                  const std::optional<Stamp>& output) {
  change_record(folder, job, [&](Json& json) { json["files"] = json_of(files), json["output"] = json_of(output); });
}

std::optional<Stamp> stamp_of(const fs::path& file) {
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return std::nullopt;
  const auto ns = [](const timespec& t) { return std::int64_t{t.tv_sec} * 1'000'000'000 + t.tv_nsec; };
  return Stamp{status.st_dev, status.st_ino, static_cast<std::uint64_t>(status.st_size), ns(status.st_mtim),
               ns(status.st_ctim)};
}

std::optional<Record> read_record(const fs::path& folder, const JobLine& job) {
  try {
    const FileBytes text(record_path(folder, job).string());
    const auto shallow = [](int depth, Json::parse_event_t, const Json&) { return depth <= 64; };  // as written
    const auto json = Json::parse(text.view(), shallow);
    if (json.at("format") != record_format) return std::nullopt;
    const auto& r = json.at("report");
    Record out;
    // A name that is no UTF-8 is written as one that is.
    const auto read = [&](const char* name, const std::string& own) {
      const std::string written = r.at(name);
      return written == escape::utf8(own) ? own : written;
    };
    out.id = read("id", job.id);
    out.output = read("output", job.output);
    out.inputs_sha256 = json.at("inputs_sha256");
    out.build = json.at("build");
    out.gcode_sha256 = r.at("gcode_sha256");
    out.status = r.at("status");
    out.error = r.value("error", "");
    out.exit_status = r.at("exit_status");
    out.seconds = r.at("seconds");
    out.print_time_s = r.at("print_time_s");
    out.filament_mm = r.at("filament").at("mm");
    out.filament_g = r.at("filament").at("g");
    if (const auto cost = r.find("cost"); cost != r.end())
      out.cost = cost->at("total"), out.currency = cost->at("currency");
    out.height_mm = r.at("height_mm");
    out.layers = r.at("layers");
    out.warnings = r.at("warnings").size();
    out.verdict = r.at("audit").at("verdict");
    out.audit = r.at("audit").value("summary", "");
    out.line = dumped(r);
    if (const auto hook = r.find("exec"); hook != r.end()) out.hook_done = hook->at("status") == 0;
    for (const auto& file : json.value("files", Json::array()))
      if (const auto stamp = stamp_from(file.at("stamp")))
        out.files.push_back({file.at("path"), file.at("sha256"), *stamp});
    out.output_stamp = stamp_from(json.value("output", Json()));
    if (out.id != job.id || out.output != job.output) return std::nullopt;
    return out;
  } catch (const Json::exception&) {
    return std::nullopt;
  } catch (const Error&) {  // none is there, or it cannot be read
    return std::nullopt;
  }
}

std::string FileHashes::of(const std::string& path) {
  {
    const std::lock_guard lock(mutex_);
    if (const auto at = known_.find(path); at != known_.end()) return at->second.sha256;
  }
  const auto before = stamp_of(path);
  KnownFile file{path, hash_of(path), before.value_or(Stamp{})};  // twice, when two threads meet here: no harm
  if (stamp_of(path) != before) file.stamp = {};
  const std::lock_guard lock(mutex_);
  return known_.emplace(path, std::move(file)).first->second.sha256;
}

void FileHashes::trust(const KnownFile& file) {
  if (stamp_of(file.path) != file.stamp) return;
  const std::lock_guard lock(mutex_);
  known_.emplace(file.path, file);
}

std::vector<KnownFile> FileHashes::known(const std::vector<std::string>& paths) {
  std::vector<KnownFile> out;
  const std::lock_guard lock(mutex_);
  for (const auto& path : paths)
    if (const auto at = known_.find(path); at != known_.end() && at->second.stamp != Stamp{}) out.push_back(at->second);
  return out;
}

std::string inputs_hash(const Job& job, FileHashes& files) {
  std::string key;
  for (const auto& model : job.models) {
    const auto parts = pipeline::parts_of(model);
    for (const auto& part : parts) {
      exact::add(key, fs::path(part.file).filename().string());  // stands in the G-code
      exact::add(key, files.of(part.file));
      if (part.tool || parts.size() > 1) exact::add(key, part.tool), exact::add(key, std::uint64_t{parts.size()});
    }
  }
  for (const auto& mark : job.marks) {
    exact::add(key, std::uint64_t{mark.model});
    exact::add(key, mark.kind);
    const bool box = mark.source.starts_with("box:");
    exact::add(key, box ? mark.source : fs::path(mark.source).filename().string());  // stands in the G-code
    if (!box) exact::add(key, files.of(mark.source));
    for (const auto& [name, text] : mark.settings) exact::add(key, name), exact::add(key, text);
  }
  for (const auto& field : pipeline::field_files(job)) exact::add(key, files.of(field));
  const auto& p = job.placement;
  exact::add(key, p.centre);
  exact::add(key, p.keep_position);
  exact::add(key, p.drop);
  exact::add(key, p.scale);
  exact::add(key, p.rotate_deg);
  exact::add(key, Um{p.copies});
  exact::add(key, p.spacing);
  exact::add(key, Um{p.plate});
  exact::add(key, p.arrange);
  exact::add(key, p.fill);
  if (p.plates) exact::add(key, fmt::format("plate {} of all", p.on_plate));
  if (p.by_outlines()) exact::add(key, p.turn_deg);
  if (!job.by_name.empty()) exact::add(key, text_of(job.by_name));
  for (const auto& word : pipeline::transform_words())
    if (const auto text = word.text(p); !text.empty() && word.key != "scale")
      exact::add(key, fmt::format("{}={}", word.key, text));
  if (p.transform.stretch != Transform{}.stretch) exact::add(key, pipeline::find_transform_word("scale")->text(p));
  exact::add(key, job.audit);
  return sha256(key + exact::bytes_of(job.settings));
}

std::vector<std::string> inputs_of(const Job& job) {
  auto out = pipeline::files_of(job.models);
  for (const auto& mark : job.marks)
    if (!mark.source.starts_with("box:")) out.push_back(mark.source);
  for (auto& field : pipeline::field_files(job)) out.push_back(std::move(field));
  return out;
}

bool has_gcode(const fs::path& folder, const Record& record, bool check_full) {
  const auto file = folder / record.output;
  if (!check_full && record.output_stamp && stamp_of(file) == record.output_stamp) return true;
  try {
    return hash_of(file) == record.gcode_sha256;
  } catch (const Error&) {
    return false;
  }
}

}  // namespace weft::jobs
