// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "jobs/batch.h"

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace weft::jobs {

/// What is known of each job of a list, from the records in the folder: those of this run, of earlier ones, and of
/// shares that ran elsewhere and were copied here. A record of other inputs than the job has now, or of which the
/// G-code is gone or not what was made, counts as missing.
struct Collected {
  struct Entry {
    JobLine line;
    std::optional<Record> record;  ///< none: the job was not run
    bool ok() const { return record && record->exit_status == 0; }
  };
  std::vector<Entry> entries;  ///< in the order of the list
  std::size_t ok = 0, failed = 0, missing = 0;
};
/// @throws Error{file} for a model that cannot be read
/// @param check_full models are read whatever their stamps say
Collected collect(const std::vector<Prepared>& jobs, const std::filesystem::path& folder, bool check_full = false);

/// The report of each, a JSON object a line; a job that was not run is a line with "status": "missing".
std::string report_jsonl(const Collected& collected);

/// A table: one row a job, one column a figure, and the settings that jobs set for themselves.
std::string summary_csv(const Collected& collected);

/// JUnit XML as CI systems read it: a test case a job; one that failed is a failure, one that was not run an error.
std::string junit_xml(const Collected& collected, std::string_view suite);

/// Names of what is written beside the G-code: report.jsonl, summary.csv, junit.xml, or of a share report-3-of-20.jsonl
/// and so on.
/// @param suffix "" or "-3-of-20"
std::array<std::string, 3> summary_names(const std::string& suffix);

/// Writes DIR/report.jsonl, DIR/summary.csv and DIR/junit.xml, or for a share DIR/report-3-of-20.jsonl and so on.
/// @param suffix "" or "-3-of-20"  @throws Error{file}
void write_summaries(const Collected& collected, const std::filesystem::path& folder, const std::string& suffix);

}  // namespace weft::jobs
