// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/estimate.h"

#include "batch_run.h"
#include "core/figures.h"
#include "core/stop.h"
#include "limited.h"
#include "limits.h"
#include "pipeline/arranged.h"
#include "slice_job.h"
#include "verbs.h"

#include <algorithm>
#include <array>
#include <sstream>

#include <fmt/format.h>

namespace po = boost::program_options;

namespace weft::app {

Options estimate_options() {
  // Of slicing, but for what is done with G-code.
  constexpr std::array<std::string_view, 5> of_gcode{"audit", "preview", "export-gcode", "gcode", "info"};
  Options out("Options of weft estimate");
  const auto slicing = slice_options();
  for (const auto& option : slicing.options())
    if (std::find(of_gcode.begin(), of_gcode.end(), option->long_name()) == of_gcode.end()) out.add(option);
  out.add_options()("exact", po::bool_switch(),
                    "plan every layer: the very figures that weft slice would report, in most of its time");
  return out;
}

namespace {

/// The figures, for people and for `cut`: a name and a value a line.
std::string figures(const Report& r, const Settings& settings, std::size_t planned) {
  std::string out = fmt::format("time      {} ({:.0f} s)\n", short_duration(r.print_time_s), r.print_time_s);
  out += fmt::format("filament  {:.2f} m, {:.1f} g of {}\n", r.filament_mm / 1000, r.filament_g,
                     settings.material.material_type);
  if (r.cost)
    out += fmt::format("cost      {} (filament {:.2f}, machine {:.2f})\n", price(r.cost->total(), r.currency),
                       r.cost->filament, r.cost->machine);
  out += fmt::format("layers    {}, {:.2f} mm high{}\n", r.layers, r.height_mm,
                     planned < r.layers ? fmt::format("; {} of them planned", planned) : "");
  return out;
}

std::string help() {
  std::ostringstream out;
  out << "weft estimate MODEL... -p PROFILE [-s KEY=VALUE]... [-o FILE]\n\n"
         "What a print would take: time, filament and, with filament_cost or machine_hourly_cost, what it costs. No "
         "G-code is made, and nothing is audited.\n\n"
      << estimate_options() << "\n"
      << common_help();
  return out.str();
}

/// Fills in the report, also with what went wrong. @return the figures, of each plate where there are several
std::string estimated(const Command& command, const Profile& profile, Console& console, Report& report) {
  Watch watch;
  watch.progress = [&](std::string_view stage, double share) { console.progress(stage, share); };
  watch.cancelled = *StopWhen::current();
  const auto cache_options = cache_options_of(command);
  std::optional<StageCache> cache;
  if (!cache_options.folder.empty()) cache.emplace(cache_options);
  const EstimateOptions how{.exact = command.options["exact"].as<bool>()};
  auto job = job_of(command, profile.settings);
  const auto plates = plates_of(job, watch, cache ? &*cache : nullptr);
  if (plates > 1 && command.report == "-")
    throw Error{Error::Kind::usage, fmt::format("{} plates have a report each", plates), "--report", "name a file"};
  std::string out;
  double seconds = 0, metres = 0;
  for (std::size_t plate = 1; plate <= plates; ++plate) {
    job.placement.on_plate = static_cast<int>(plate);
    Report own;
    own.warnings = report.warnings;
    if (how.exact && command.report) own.figures.emplace();
    const auto planned = estimate(job, how, watch, own, cache ? &*cache : nullptr);
    seconds += own.print_time_s, metres += own.filament_mm / 1000;
    if (plates > 1) out += fmt::format("plate {} of {}\n", plate, plates);
    out += figures(own, profile.settings, planned);
    if (plates > 1 && command.report && *command.report != "-")
      write_output(pipeline::name_of_plate(*command.report, plate), to_json(own));
    if (plate == plates) report = std::move(own);
  }
  if (plates > 1)
    out += fmt::format("all       {} ({:.0f} s), {:.2f} m of filament\n", short_duration(seconds), seconds, metres);
  return out;
}

}  // namespace

int estimate_verb(const Words& words) {
  const auto command = parse_command(words, estimate_options());
  if (command.help) return write_output("-", help()), 0;
  if (command.inputs.empty())
    throw Error{Error::Kind::usage, "no model was given", "weft estimate",
                "as in weft estimate part.stl -p printer.ini"};
  if (command.output) check_writable(*command.output);
  if (command.report == "-" && command.output == "-")
    throw Error{Error::Kind::usage, "figures and report cannot both go to standard output", "--report",
                "name a file for one of them"};
  Console console(command.console);
  Report report;
  std::string text;
  bool inputs_are_known = false;  // else a report might be written over one of them
  try {
    within_limits(command, [&] {
      const auto profile = resolve(command);
      inputs_are_known = true;
      report.warnings = profile.notices;
      text = estimated(command, profile, console, report);
    });
  } catch (const Error& error) {
    report.status = Report::Status::failed;
    report.error = error.what();
    write_report(command, report, inputs_are_known);
    throw;
  }
  warn(console, report.warnings, command.console.verbosity == Verbosity::detail ? report.warnings.size() : 3);
  report.peak_memory_mb = peak_memory_mb();
  if (report.plates.size() < 2) write_report(command, report, true);
  if (command.output)
    write_output(*command.output, text);
  else if (command.report != "-")
    write_output("-", text);
  return 0;
}

}  // namespace weft::app
