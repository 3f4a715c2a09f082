// SPDX-License-Identifier: GPL-3.0-or-later
// libFuzzer target for folders of results: the bytes are what an earlier run has left there of a job, its record and,
// behind a byte of 0, its G-code. Whatever they are, the reports of the folder are whole lines of JSON and of CSV, and
// after a run the G-code is that of the job: what is not so is never taken for it. In a record stand @BUILD@, @INPUTS@,
// @GCODE@ for the hashes that a right one has.
#include "core/build_id.h"
#include "core/hash.h"
#include "cuboid.h"
#include "jobs/batch.h"
#include "jobs/summary.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>
#include <unistd.h>

namespace {

using namespace weft;
namespace fs = std::filesystem;

void require(bool holds) {
  if (!holds) std::abort();
}

std::string bytes_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}
void write(const fs::path& path, std::string_view bytes) {
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

/// An OBJ of a plate, 4 × 4 × 0.3 mm.
std::string plate() {
  std::string out;
  for (const char* z : {"0", "0.3"})
    for (const char* corner : {"0 0", "4 0", "4 4", "0 4"}) out += std::string("v ") + corner + " " + z + "\n";
  for (const auto& face : cuboid_faces) {
    out += "f";
    for (const int corner : face) out += " " + std::to_string(corner + 1);
    out += "\n";
  }
  return out;
}

/// A folder, a job that has its results there, and what these are.
struct Work {
  fs::path scratch = fs::temp_directory_path() / ("weft-batch-folder-fuzz-" + std::to_string(::getpid()));
  jobs::BatchOptions options;
  std::vector<jobs::Prepared> jobs;
  std::string gcode, inputs;

  Work() {
    fs::remove_all(scratch);
    fs::create_directories(scratch);
    write(scratch / "part.obj", plate());
    auto list =
        jobs::read_jsonl(R"({"id": "a", "models": ["part.obj"], "output": "a.gcode", "x-of": 7})", "list", scratch);
    jobs::complete(list);
    std::vector<Error> errors;
    jobs = jobs::prepare(std::move(list.jobs), {}, errors);
    require(errors.empty() && jobs.size() == 1);
    options.folder = scratch / "out";
    options.threads = 1;
    run();
    gcode = bytes_of(output());
    const auto record = jobs::read_record(options.folder, jobs.front().line);
    require(record && record->exit_status == 0 && record->gcode_sha256 == sha256(gcode));
    inputs = record->inputs_sha256;
  }
  ~Work() {
    std::error_code ignored;
    fs::remove_all(scratch, ignored);
  }

  fs::path output() const { return options.folder / "a.gcode"; }
  fs::path record() const { return jobs::record_path(options.folder, jobs.front().line); }
  void run() const { jobs::run_batch(jobs, options, {}); }

  std::string with_hashes(std::string_view text) const {
    std::string out(text);
    for (const auto& [token, value] :
         {std::pair<std::string, std::string>{"@BUILD@", build_id()}, {"@INPUTS@", inputs}, {"@GCODE@", sha256(gcode)}})
      for (auto at = out.find(token); at != std::string::npos; at = out.find(token, at + value.size()))
        out.replace(at, token.size(), value);
    return out;
  }
};

bool is_json_lines(const std::string& text) {
  if (!text.empty() && text.back() != '\n') return false;
  for (std::size_t begin = 0; begin < text.size();) {
    const auto end = text.find('\n', begin);
    if (!nlohmann::json::accept(text.substr(begin, end - begin))) return false;
    begin = end + 1;
  }
  return true;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Work work;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto end = std::min(bytes.find('\0'), bytes.size());
  write(work.record(), work.with_hashes(bytes.substr(0, end)));
  write(work.output(), end < bytes.size() ? bytes.substr(end + 1) : std::string_view(work.gcode));

  const auto collected = jobs::collect(work.jobs, work.options.folder);
  require(collected.entries.size() == 1 && collected.ok + collected.failed + collected.missing == 1);
  const auto report = jobs::report_jsonl(collected);
  require(is_json_lines(report) && std::count(report.begin(), report.end(), '\n') == 1);
  require(!jobs::summary_csv(collected).empty() && !jobs::junit_xml(collected, "suite").empty());
  require(collected.ok == 0 || bytes_of(work.output()) == work.gcode);

  work.run();
  require(bytes_of(work.output()) == work.gcode);
  const auto record = jobs::read_record(work.options.folder, work.jobs.front().line);
  require(record && record->exit_status == 0 && record->gcode_sha256 == sha256(work.gcode));
  return 0;
}
