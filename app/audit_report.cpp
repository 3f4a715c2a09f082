// SPDX-License-Identifier: GPL-3.0-or-later
#include "audit_report.h"

#include "core/escape.h"
#include "core/json_text.h"
#include "core/version.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace weft::app {
namespace {

using Json = nlohmann::ordered_json;

std::string_view kind_of(audit::Finding::Kind kind) {
  switch (kind) {
    case audit::Finding::Kind::surface:
      return "print_surface";
    case audit::Finding::Kind::reach:
      return "reach";
    case audit::Finding::Kind::no_go:
      return "no_go_area";
    case audit::Finding::Kind::head:
      return "head";
    case audit::Finding::Kind::damaged:
      break;
  }
  return "damaged";
}

std::string side_of(audit::Side side, int area) {
  return side == audit::Side::no_go ? fmt::format("no_go_{}", area) : std::string(audit::name_of(side));
}

Json violation_of(const audit::Finding& f) {
  Json out{{"kind", kind_of(f.kind)}};
  if (f.kind == audit::Finding::Kind::damaged) {
    out["problem"] = f.problem;
  } else {
    out["move"] = audit::name_of(f.move);
    out["feature"] = f.feature;
    out["side"] = side_of(f.side, f.area);
    out["at"] = {to_mm(f.at.x), to_mm(f.at.y), to_mm(f.at.z)};
    out["outside_mm"] = to_mm(f.outside);
    if (f.kind == audit::Finding::Kind::head) {
      out["above_tip_mm"] = to_mm(f.above_tip);
      out["met"] = {to_mm(f.met.x), to_mm(f.met.y)};
    }
  }
  if (!f.object.empty()) out["object"] = f.object;
  if (!f.setting.empty()) out["setting"] = f.setting;
  out["layer"] = f.layer;
  out["line"] = f.line;
  out["text"] = f.text;
  return out;
}

Json conflict_of(const audit::Conflict& c) {
  return {{"a", c.a},
          {"b", c.b},
          {"support", {c.support_a, c.support_b}},
          {"features", {c.feature_a, c.feature_b}},
          {"at", {to_mm(c.at.x), to_mm(c.at.y), to_mm(c.at.z)}},
          {"depth_mm", to_mm(c.depth)},
          {"layer", c.layer},
          {"layers", c.layers},
          {"blocks", c.blocks}};
}

Json reach_beyond(const audit::Report& r) {
  Json out = Json::object();
  for (std::size_t i = 0; i < r.reach_beyond.size(); ++i)
    if (r.reach_beyond[i] > 0) out[std::string(audit::name_of(static_cast<audit::Side>(i)))] = to_mm(r.reach_beyond[i]);
  return out;
}

Json entry_of(const AuditEntry& entry) {
  Json out{{"file", entry.file}, {"printer", entry.printer}};
  if (!entry.outcome.report) {
    out["verdict"] = "failed";
    out["error"] = entry.outcome.error ? entry.outcome.error->what() : "";
    return out;
  }
  const auto& r = *entry.outcome.report;
  out["verdict"] = audit::name_of(r.verdict);
  out["checked_moves"] = r.checked_moves;
  out["not_audited"] = r.unaudited_moves;
  out["coverage"] = std::round(r.coverage() * 1e6) / 1e6;
  out["violation_count"] = r.violation_count;
  out["damaged_count"] = r.damaged_count;
  out["worst_outside_mm"] = to_mm(r.worst_outside);
  out["tolerance_mm"] = to_mm(r.tolerance);
  out["lines"] = r.lines;
  out["bytes"] = r.bytes;
  out["violations"] = Json::array();
  for (const auto& f : r.findings) out["violations"].push_back(violation_of(f));
  out["totals"] = Json::array();
  for (const auto& t : r.totals)
    out["totals"].push_back({{"kind", kind_of(t.kind)},
                             {"side", side_of(t.side, t.area)},
                             {"feature", t.feature},
                             {"count", t.count},
                             {"worst_mm", to_mm(t.worst)}});
  out["conflicts_audited"] = r.labelled;
  out["conflicts"] = Json::array();
  for (const auto& c : r.conflicts) out["conflicts"].push_back(conflict_of(c));
  out["opaque"] = Json::array();
  for (const auto& o : r.opaque)
    out["opaque"].push_back({{"command", o.name}, {"count", o.count}, {"first_line", o.first_line}});
  out["not_audited_because"] = Json::array();
  for (const auto& u : r.unaudited)
    out["not_audited_because"].push_back(
        {{"command", u.cause.command}, {"line", u.cause.line}, {"why", u.cause.why}, {"moves", u.count}});
  if (entry.outcome.seconds) out["print_time_s"] = std::round(*entry.outcome.seconds * 1000) / 1000;
  out["summary"] = audit::summary(r);
  out["reach_beyond_surface_mm"] = reach_beyond(r);
  out["warnings"] = Json::array();
  for (const auto& n : r.notices) out["warnings"].push_back({{"code", n.code}, {"message", n.message}});
  return out;
}

}  // namespace

std::string audit_json(const std::vector<AuditEntry>& entries) {
  const bool failed =
      std::any_of(entries.begin(), entries.end(), [](const AuditEntry& e) { return !e.outcome.report; });
  const bool clean = std::all_of(entries.begin(), entries.end(), [](const AuditEntry& e) { return e.clean(); });
  Json out{{"weft", version}, {"status", clean ? "ok" : failed ? "failed" : "rejected"}, {"audits", Json::array()}};
  for (const auto& e : entries) out["audits"].push_back(entry_of(e));
  return json_text(std::move(out), 2) + "\n";
}

std::string audit_junit(const std::vector<AuditEntry>& entries) {
  std::size_t failures = 0, errors = 0;
  std::string cases;
  for (const auto& e : entries) {
    cases += fmt::format("  <testcase classname=\"{}\" name=\"{}\"", escape::xml(e.printer), escape::xml(e.file));
    if (e.clean()) {
      cases += fmt::format(">\n    <system-out>{}</system-out>\n  </testcase>\n",
                           escape::xml(audit::summary(*e.outcome.report)));
    } else if (e.outcome.report) {
      ++failures;
      const auto& r = *e.outcome.report;
      cases += fmt::format(">\n    <failure type=\"boundary\" message=\"{}\">", escape::xml(audit::summary(r)));
      for (const auto& f : r.findings) cases += escape::xml(audit::describe(f)) + "\n";
      for (const auto& u : r.unaudited)
        cases += escape::xml(fmt::format("{} moves not audited: {}", u.count, audit::describe(u.cause))) + "\n";
      cases += "</failure>\n  </testcase>\n";
    } else {
      ++errors;
      cases += fmt::format(">\n    <error type=\"file\" message=\"{}\"/>\n  </testcase>\n",
                           escape::xml(e.outcome.error ? e.outcome.error->what() : ""));
    }
  }
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuite name=\"weft audit\" tests=\"{}\" failures=\"{}\" "
      "errors=\"{}\">\n{}</testsuite>\n",
      entries.size(), failures, errors, cases);
}

}  // namespace weft::app
