// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "jobs/hook.h"
#include "jobs/job_list.h"
#include "pipeline/report.h"

#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>

namespace weft::jobs {

/// What tells, without reading it, that a file is the one it was: where it is, its size, and when it last changed.
/// Copies and restored files have another, and are read.
struct Stamp {
  std::uint64_t device = 0, inode = 0, size = 0;
  std::int64_t modified_ns = 0, changed_ns = 0;  ///< since 1970; the second cannot be set at will
  friend bool operator==(const Stamp&, const Stamp&) = default;
};
/// Nothing when there is no such file.
std::optional<Stamp> stamp_of(const std::filesystem::path& file);

/// A file that was read, and what was found.
struct KnownFile {
  std::string path, sha256;
  Stamp stamp;
  friend bool operator==(const KnownFile&, const KnownFile&) = default;
};

/// How a job ended.
struct Outcome {
  std::string inputs_sha256;  ///< of everything its G-code depends on, this build of weft apart
  int exit_status = 1;        ///< as `weft slice` would have left with; 130 when it was stopped
  std::string error;          ///< one line; empty when it went well
  double seconds = 0;
  unsigned attempts = 1;           ///< how often it was begun
  std::optional<HookResult> hook;  ///< when one was run
  std::vector<KnownFile> files;    ///< its models
  std::optional<Stamp> output;     ///< of its G-code
  Report report;
};

/// A job's outcome as a file of its own in DIR/.weft/jobs, written when the job ends: what makes a run resumable and
/// lets shares that ran on other machines be merged. `line` is its line of report.jsonl.
struct Record {
  std::string id, output, inputs_sha256, build, gcode_sha256, status, error;
  int exit_status = 1;
  double seconds = 0;
  double print_time_s = 0, filament_mm = 0, filament_g = 0, height_mm = 0;
  std::optional<double> cost;  ///< of filament and machine, when they have prices
  std::string currency;
  std::size_t layers = 0, warnings = 0;
  std::string verdict;     ///< of the audit
  std::string audit;       ///< the same in words
  bool hook_done = false;  ///< a hook was run, and went well
  std::vector<KnownFile> files;
  std::optional<Stamp> output_stamp;
  std::string line;  ///< JSON, without newline
};

std::filesystem::path record_path(const std::filesystem::path& folder, const JobLine& job);

/// @throws Error{file}
void write_record(const std::filesystem::path& folder, const JobLine& job, const Outcome& outcome);

/// nullopt when there is none, none that can be read, or one of another output: the job is then run again.
std::optional<Record> read_record(const std::filesystem::path& folder, const JobLine& job);

/// Notes in the record what its hook did. @throws Error{file}
void write_hook(const std::filesystem::path& folder, const JobLine& job, const HookResult& result);

/// Notes in the record the stamps that the job's files have now; contents were found to be the same.
/// @throws Error{file}
void write_stamps(const std::filesystem::path& folder, const JobLine& job, const std::vector<KnownFile>& files,
                  const std::optional<Stamp>& output);

/// Hashes of files by path; each is read once, or not at all when what a record knows of it still holds.
class FileHashes {
 public:
  /// @throws Error{file}
  std::string of(const std::string& path);
  /// Takes the hash for that of the file when it has that stamp.
  void trust(const KnownFile& file);
  /// What is known of these files, as far as they stayed the same while they were read.
  std::vector<KnownFile> known(const std::vector<std::string>& paths);

 private:
  std::mutex mutex_;
  std::map<std::string, KnownFile> known_;
};

/// The files that a job's G-code is made of: models, marks, and what infill is laid by.
std::vector<std::string> inputs_of(const Job& job);

/// Hash of everything the job's G-code depends on besides this build of weft: its files by name and content, settings,
/// placement. Two jobs of the same hash give the same bytes. @throws Error{file}
std::string inputs_hash(const Job& job, FileHashes& files);

/// Whether the G-code that a job made is there still: by its stamp where that is as it was noted, else by its hash.
/// @param check_full by its hash in any case
bool has_gcode(const std::filesystem::path& folder, const Record& record, bool check_full);

}  // namespace weft::jobs
