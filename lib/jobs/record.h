#pragma once
#include "jobs/job_list.h"
#include "pipeline/report.h"

#include <map>
#include <mutex>
#include <optional>
#include <string>

namespace weft::jobs {

/// How a job ended.
struct Outcome {
  std::string inputs_sha256;  ///< of everything its G-code depends on, this build of weft apart
  int exit_status = 1;        ///< as `weft slice` would have left with; 130 when it was stopped
  std::string error;          ///< one line; empty when it went well
  double seconds = 0;
  Report report;
};

/// A job's outcome as a file of its own in DIR/.weft/jobs, written when the job ends: what makes a run resumable and
/// lets shares that ran on other machines be merged. `line` is its line of report.jsonl.
struct Record {
  std::string id, output, inputs_sha256, build, gcode_sha256, status, error;
  int exit_status = 1;
  double seconds = 0;
  double print_time_s = 0, filament_mm = 0, filament_g = 0, height_mm = 0;
  std::size_t layers = 0, warnings = 0;
  std::string verdict;  ///< of the audit
  std::string audit;    ///< the same in words
  std::string line;     ///< JSON, without newline
};

std::filesystem::path record_path(const std::filesystem::path& folder, const JobLine& job);

/// @throws Error{file}
void write_record(const std::filesystem::path& folder, const JobLine& job, const Outcome& outcome);

/// nullopt when there is none, or none that can be read: the job is then run again.
std::optional<Record> read_record(const std::filesystem::path& folder, const JobLine& job);

/// Hashes of files by path; each is read once.
class FileHashes {
 public:
  /// @throws Error{file}
  std::string of(const std::string& path);

 private:
  std::mutex mutex_;
  std::map<std::string, std::string> known_;
};

/// Hash of everything the job's G-code depends on besides this build of weft: models by name and content, settings,
/// placement. Two jobs of the same hash give the same bytes. @throws Error{file}
std::string inputs_hash(const Job& job, FileHashes& files);

/// Whether the file is there and has that hash.
bool has_hash(const std::filesystem::path& file, const std::string& sha256);

}  // namespace weft::jobs
