// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/audit_files.h"

#include "core/file_bytes.h"
#include "preview/file_time.h"
#include "tasks/parallel.h"
#include "tasks/tasks.h"

namespace weft {

std::vector<AuditOutcome> audit_files(const std::vector<AuditJob>& jobs, unsigned threads) {
  const auto one = [&](std::size_t i) {
    AuditOutcome outcome;
    const auto& s = *jobs[i].settings;
    try {
      outcome.report = audit::examine(s.machine, s.material, s.audit, jobs[i].file, s.plate);
      if (jobs[i].with_time) outcome.seconds = preview::time_of(FileBytes(jobs[i].file.string()).view(), s).seconds;
    } catch (const Error& error) {
      outcome.error = error;
    }
    return outcome;
  };
  std::vector<AuditOutcome> outcomes;
  tasks::with_threads(threads, [&] { outcomes = tasks::parallel_map(jobs.size(), one); });
  return outcomes;
}

}  // namespace weft
