#include "jobs/record.h"

#include "core/build_id.h"
#include "core/file_bytes.h"
#include "core/hash.h"
#include "pipeline/write_file.h"
#include "settings/exact.h"

#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

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

std::string dumped(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

fs::path record_path(const fs::path& folder, const JobLine& job) {
  return folder / ".weft" / "jobs" / (sha256(job.id).substr(0, 32) + ".json");
}

void write_record(const fs::path& folder, const JobLine& job, const Outcome& outcome) {
  Json line{{"id", job.id},
            {"output", job.output},
            {"exit_status", outcome.exit_status},
            {"seconds", std::round(outcome.seconds * 1000) / 1000}};
  const auto report = Json::parse(to_json(outcome.report));
  line.update(report);
  if (!outcome.error.empty()) line["error"] = outcome.error;
  const Json record{{"format", record_format},
                    {"build", build_id()},
                    {"inputs_sha256", outcome.inputs_sha256},
                    {"report", std::move(line)}};
  write_file(record_path(folder, job), dumped(record) + "\n");
}

std::optional<Record> read_record(const fs::path& folder, const JobLine& job) {
  try {
    const FileBytes text(record_path(folder, job).string());
    const auto shallow = [](int depth, Json::parse_event_t, const Json&) { return depth <= 64; };  // as written
    const auto json = Json::parse(text.view(), shallow);
    if (json.at("format") != record_format) return std::nullopt;
    const auto& r = json.at("report");
    Record out;
    out.id = r.at("id");
    out.output = r.at("output");
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
    out.height_mm = r.at("height_mm");
    out.layers = r.at("layers");
    out.warnings = r.at("warnings").size();
    out.verdict = r.at("audit").at("verdict");
    out.line = dumped(r);
    if (out.id != job.id) return std::nullopt;
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
    if (const auto at = known_.find(path); at != known_.end()) return at->second;
  }
  auto hash = hash_of(path);  // twice, when two threads meet here: no harm
  const std::lock_guard lock(mutex_);
  return known_.emplace(path, std::move(hash)).first->second;
}

std::string inputs_hash(const Job& job, FileHashes& files) {
  std::string key;
  for (const auto& model : job.models) {
    exact::add(key, fs::path(model).filename().string());  // stands in the G-code
    exact::add(key, files.of(model));
  }
  const auto& p = job.placement;
  exact::add(key, p.centre);
  exact::add(key, p.keep_position);
  exact::add(key, p.scale);
  exact::add(key, p.rotate_deg);
  exact::add(key, Um{p.copies});
  exact::add(key, p.spacing);
  exact::add(key, job.audit);
  return sha256(key + exact::bytes_of(job.settings));
}

bool has_hash(const fs::path& file, const std::string& hash) {
  try {
    return hash_of(file) == hash;
  } catch (const Error&) {
    return false;
  }
}

}  // namespace weft::jobs
