#include "pipeline/audit_files.h"

#include "pipeline/parallel.h"

#include <tbb/task_arena.h>

namespace weft {

std::vector<AuditOutcome> audit_files(const std::vector<AuditJob>& jobs, unsigned threads) {
  const auto one = [&](std::size_t i) {
    AuditOutcome outcome;
    const auto& s = *jobs[i].settings;
    try {
      outcome.report = audit::examine(s.machine, s.material, s.audit, jobs[i].file);
    } catch (const Error& error) {
      outcome.error = error;
    }
    return outcome;
  };
  tbb::task_arena arena(threads == 0 ? tbb::task_arena::automatic : static_cast<int>(threads));
  return arena.execute([&] { return pipeline::parallel_map(jobs.size(), one); });
}

}  // namespace weft
