// SPDX-License-Identifier: GPL-3.0-or-later
#include "audit_report.h"
#include "command.h"
#include "core/figures.h"
#include "limited.h"
#include "pipeline/profile_file.h"
#include "verbs.h"

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <sstream>

#include <fmt/format.h>

namespace po = boost::program_options;

namespace weft::app {
namespace {

/// A machine that files are held against.
struct Printer {
  std::string name;
  Settings settings;
};

std::vector<Printer> printers_of(const Command& command, Console& console) {
  std::vector<Printer> out;
  const Profile base = resolve(command);
  if (command.options.count("against")) {
    for (const auto& file : command.options["against"].as<std::vector<std::string>>()) {
      Profile profile;
      for (const auto& p : command.profiles) apply_profile(profile, p, command.import);
      apply_profile(profile, file, command.import);
      for (const auto& [key, text] : command.settings) apply_value(profile, key, text, "--set " + key);
      check_consistency(profile);
      out.push_back({file, profile.settings});
    }
    return out;
  }
  const auto& m = base.settings.machine;
  if (command.profiles.empty() && command.settings.empty())
    console.warning({"audit_default_machine",
                     fmt::format("no profile was given: audited against {:g} x {:g} x {:g} mm", to_mm(m.machine_width),
                                 to_mm(m.machine_depth), to_mm(m.machine_height))});
  std::string name = m.machine_name;
  if (name.empty()) name = command.profiles.empty() ? "default" : command.profiles.back().string();
  out.push_back({name, base.settings});
  return out;
}

void tell(Console& console, const AuditEntry& entry, bool name_printer) {
  const std::string where = name_printer ? fmt::format("{} on {}", entry.file, entry.printer) : entry.file;
  if (entry.outcome.error) return console.error(*entry.outcome.error);
  const auto& r = *entry.outcome.report;
  for (const auto& notice : r.notices) console.warning({notice.code, where + ": " + notice.message});
  for (const auto& o : r.opaque)
    console.detail(fmt::format("{}: opaque: {} ({}x, first on line {})", where, o.name, o.count, o.first_line));
  for (const auto& u : r.unaudited)
    console.detail(fmt::format("{}: {} moves not audited: {}", where, u.count, audit::describe(u.cause)));
  for (const auto& f : r.findings) console.detail(fmt::format("{}: {}", where, audit::describe(f)));
  for (const auto& t : r.totals) {
    const bool has_side = t.kind == audit::Finding::Kind::surface || t.kind == audit::Finding::Kind::reach;
    console.detail(fmt::format("{}: {} x {}{}{}, worst {:.3f} mm", where, t.count,
                               t.feature.empty() ? "move" : t.feature,
                               t.kind == audit::Finding::Kind::damaged ? " damaged"
                               : t.kind == audit::Finding::Kind::head  ? " into what is printed"
                               : t.kind == audit::Finding::Kind::no_go ? fmt::format(" inside no-go area {}", t.area)
                                                                       : " beyond ",
                               has_side ? audit::name_of(t.side) : "", to_mm(t.worst)));
  }
  for (const auto& c : r.conflicts)
    if (c.blocks)
      console.detail(fmt::format("{}: {}, on {} layers", where, audit::describe(c), c.layers));
    else
      console.warning({"paths_touch", fmt::format("{}: {}", where, audit::describe(c))});
  if (entry.outcome.seconds)
    console.info(fmt::format("{}: {} without heating and waiting", where, short_duration(*entry.outcome.seconds)));
  if (r.clean())
    console.info(fmt::format("{}: pass, {}{}", where, audit::summary(r),
                             r.labelled ? "" : "; overlaps not audited, for no object is labelled"));
  else
    console.error(Error{Error::Kind::audit, audit::summary(r), where, audit::remedy(r)});
}

/// The table of commands that move the nozzle or change what coordinates mean.
std::string table_of_commands() {
  std::string out;
  for (const auto& m : audit::Reader::meanings()) out += fmt::format("{:<12} {}\n", m.command, m.what);
  return out;
}

}  // namespace

po::options_description audit_options() {
  po::options_description out("Options of weft audit");
  out.add_options()("against", po::value<std::vector<std::string>>()->multitoken()->value_name("FILE..."),
                    "printer profiles: says of each whether the files may run there")(
      "format", po::value<std::string>()->value_name("json|junit")->default_value("json"), "form of the report")(
      "time", po::bool_switch(), "says what the moves take, as the firmware of the profile plans them")(
      "commands", po::bool_switch(),
      "says of each G- and M-code that moves the nozzle or changes what coordinates mean what the audit does with it");
  add_limit_options(out);
  return out;
}

int audit_verb(const Words& words) {
  const auto options = audit_options();
  const auto command = parse_command(words, options);
  if (command.help) {
    std::ostringstream out;
    out << "weft audit FILE.gcode... -p PROFILE: checks any slicer's G-code against a build volume\n\n"
        << options << "\n"
        << common_help();
    return write_output("-", out.str()), 0;
  }
  if (command.options["commands"].as<bool>()) return fmt::print("{}", table_of_commands()), 0;
  const auto format = command.options["format"].as<std::string>();
  if (format != "json" && format != "junit")
    throw Error{Error::Kind::usage, fmt::format("'{}' is not one of json, junit", format), "--format"};
  if (command.inputs.empty())
    throw Error{Error::Kind::usage, "no G-code file was given", {}, "as in weft audit part.gcode -p printer.ini"};

  Console console(command.console);
  const auto printers = printers_of(command, console);
  std::vector<AuditJob> jobs;
  std::vector<AuditEntry> entries;
  for (const auto& printer : printers)
    for (const auto& file : command.inputs) {
      jobs.push_back({file, &printer.settings, command.options["time"].as<bool>()});
      entries.push_back({file, printer.name, {}});
    }
  std::vector<AuditOutcome> outcomes;
  within_limits(command, [&] { outcomes = audit_files(jobs, command.threads); });
  for (std::size_t i = 0; i < entries.size(); ++i) {
    entries[i].outcome = std::move(outcomes[i]);
    tell(console, entries[i], printers.size() > 1);
  }
  const auto destination = command.report ? command.report : command.output;
  if (destination || !command.options["format"].defaulted())
    write_output(destination.value_or("-"), format == "junit" ? audit_junit(entries) : audit_json(entries));
  // A finding outweighs a file that could not be read: the first is about a printer.
  const auto found = [](const AuditEntry& e) { return e.outcome.report && !e.outcome.report->clean(); };
  if (std::any_of(entries.begin(), entries.end(), found)) return exit_status(Error::Kind::audit);
  for (const auto& e : entries)
    if (e.outcome.error) return exit_status(e.outcome.error->kind());
  return 0;
}

}  // namespace weft::app
