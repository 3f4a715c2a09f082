// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "audit/audit.h"
#include "settings/settings.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace weft {

/// A file to be held against a machine.
struct AuditJob {
  std::filesystem::path file;
  const Settings* settings = nullptr;
  bool with_time =
      false;  ///< what its moves take is reckoned, too: in memory for those between two rests, and its bytes
};

/// What came of it: a report, or why there is none.
struct AuditOutcome {
  std::optional<audit::Report> report;
  std::optional<Error> error;
  std::optional<double> seconds{};  ///< of its moves, where it was asked for
};

/// Audits files of any slicer, several at a time, in constant memory each. Outcomes are in the order of the jobs; one
/// that cannot be read does not keep the others from being audited.
/// @param threads 0: all cores
std::vector<AuditOutcome> audit_files(const std::vector<AuditJob>& jobs, unsigned threads);

}  // namespace weft
