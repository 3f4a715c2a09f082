// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "command.h"
#include "jobs/batch.h"
#include "jobs/shard.h"
#include "jobs/summary.h"

#include <string>

namespace weft::app {

/// Options that batch and sweep have in common, and their meaning.
boost::program_options::options_description running_options();
jobs::BatchOptions batch_options_of(const Command& command);

/// --cache and --cache-size.
void add_cache_options(boost::program_options::options_description& to);
/// @throws Error
CacheOptions cache_options_of(const Command& command);
/// What the cache saved, as a line for people; empty when it was not asked for anything.
std::string told(const StageCache& cache);

/// Resolves all jobs. Every error is told, then one stands for all of them. @throws Error
std::vector<jobs::Prepared> prepare_all(Console& console, jobs::JobList list, const Command& command);

/// No report of a run may be a file that it reads, its list included. @param suffix as below  @throws Error{usage}
void check_reports(const std::vector<jobs::Prepared>& jobs, const Command& command, const std::string& suffix);

/// Runs them with bar, messages and reports.
/// @param suffix of the reports' names: "" or "-3-of-20"
/// @return what is known of each job at the end
struct Finished {
  jobs::BatchResult result;
  jobs::Collected collected;
};
Finished run_jobs(Console& console, const std::vector<jobs::Prepared>& jobs, const jobs::BatchOptions& options,
                  const Command& command, const std::string& suffix);

/// The last line on standard error, --report, and the exit status.
int conclude(Console& console, const Finished& finished, const StageCache& cache, const Command& command);

}  // namespace weft::app
