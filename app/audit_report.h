// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "pipeline/audit_files.h"

#include <string>
#include <vector>

namespace weft::app {

/// One file against one printer, and what came of it.
struct AuditEntry {
  std::string file;     ///< as the user typed it
  std::string printer;  ///< the profile, or the machine's name
  AuditOutcome outcome;
  bool clean() const { return outcome.report && outcome.report->clean(); }
};

/// The report of `weft audit` for programs.
std::string audit_json(const std::vector<AuditEntry>& entries);

/// The same as a JUnit test suite, a case for each file and printer, which CI servers show.
std::string audit_junit(const std::vector<AuditEntry>& entries);

}  // namespace weft::app
