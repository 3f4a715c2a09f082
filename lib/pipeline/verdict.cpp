// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/verdict.h"

#include "core/error.h"
#include "core/hash.h"
#include "pipeline/add_raft.h"
#include "pipeline/stopwatch.h"
#include "settings/value.h"

#include <algorithm>
#include <string>

#include <fmt/format.h>

namespace weft::pipeline {
namespace {

void note_audit(const audit::Report& a, Report& report) {
  auto& out = report.audit;
  out.verdict = audit::name_of(a.verdict);
  out.summary = audit::summary(a);
  out.checked_moves = static_cast<std::size_t>(a.checked_moves);
  out.not_audited = static_cast<std::size_t>(a.unaudited_moves);
  out.violation_count = static_cast<std::size_t>(a.violation_count);
  for (const auto& f : a.findings)
    out.violations.push_back({std::string(audit::name_of(f.move)),
                              f.feature,
                              std::string(audit::name_of(f.side)),
                              f.object,
                              f.text,
                              f.setting,
                              {to_mm(f.at.x), to_mm(f.at.y), to_mm(f.at.z)},
                              to_mm(f.outside),
                              f.layer,
                              static_cast<std::size_t>(f.line)});
  for (const auto& u : a.unaudited)
    out.gaps.push_back({u.cause.command, std::string(u.cause.why), static_cast<std::size_t>(u.cause.line),
                        static_cast<std::size_t>(u.count)});
  for (const auto& o : a.opaque) out.opaque.push_back(o.name);
  for (std::size_t i = 0; i < a.reach_beyond.size(); ++i)
    if (a.reach_beyond[i] > 0)
      out.reach_beyond_mm.emplace_back(audit::name_of(static_cast<audit::Side>(i)), to_mm(a.reach_beyond[i]));
  report.warnings.insert(report.warnings.end(), a.notices.begin(), a.notices.end());
  if (a.verdict == audit::Verdict::annotated)
    report.warnings.push_back({"audit_annotated", "the boundary audit found " + out.summary});
}

/// What to try: the audit knows the file, and not that it is a raft that lifts the print out of the machine.
std::string remedy_of(const audit::Rejected& rejected, const Settings& settings) {
  const Um lift = raft_lift(settings);
  const auto& findings = rejected.report().findings;
  const bool by_raft = !findings.empty() && std::all_of(findings.begin(), findings.end(), [lift](const auto& f) {
    return f.kind == audit::Finding::Kind::reach && f.side == audit::Side::plus_z && f.outside <= lift;
  });
  if (!by_raft) return rejected.hint();
  return fmt::format("the raft lifts the print by {} mm: print without it (adhesion_type), or with fewer layers of it",
                     value::number(to_mm(lift)));
}

}  // namespace

std::optional<audit::Passed> verdict_of(audit::Check& check, const Job& job, Report& report) {
  const Stopwatch stopwatch(report.timings_ms[Stage::audit]);
  try {
    auto passed = check.passed();
    note_audit(passed.report(), report);
    report.status =
        passed.report().verdict == audit::Verdict::annotated ? Report::Status::annotated : Report::Status::ok;
    if (job.hash_gcode) report.gcode_sha256 = sha256(passed.gcode());
    return passed;
  } catch (const audit::Rejected& rejected) {
    note_audit(rejected.report(), report);
    report.status = Report::Status::rejected;
    report.error =
        Error(Error::Kind::audit, rejected.problem(), rejected.where(), remedy_of(rejected, job.settings)).what();
    return std::nullopt;
  }
}

}  // namespace weft::pipeline
