#include "pipeline/estimate.h"

#include "batch_run.h"
#include "core/figures.h"
#include "limits.h"
#include "slice_job.h"
#include "verbs.h"

#include <new>
#include <sstream>

#include <fmt/format.h>

namespace po = boost::program_options;

namespace weft::app {

Options estimate_options() {
  auto out = slice_options();
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

}  // namespace

int estimate_verb(const Words& words) {
  const auto command = parse_command(words, estimate_options());
  if (command.help) {
    std::ostringstream out;
    out << "weft estimate MODEL... -p PROFILE [-s KEY=VALUE]...\n\n"
           "What a print would take: time, filament and, with filament_cost or machine_hourly_cost, what it costs. No "
           "G-code is made, and nothing is audited.\n\n"
        << estimate_options() << "\n"
        << common_help();
    return fmt::print("{}", out.str()), 0;
  }
  if (command.inputs.empty())
    throw Error{Error::Kind::usage, "no model was given", "weft estimate",
                "as in weft estimate part.stl -p printer.ini"};
  if (command.options.count("preview"))
    throw Error{Error::Kind::usage, "there is no G-code to be shown", "--preview", "weft slice takes it"};
  Console console(command.console);
  const Limits limits(limit_of(command.options, "timeout"), limit_of(command.options, "max-memory"));
  Watch watch;
  watch.progress = [&](std::string_view stage, double share) { console.progress(stage, share); };
  watch.cancelled = [&] { return limits.reached(); };
  const auto cache_options = cache_options_of(command);
  std::optional<StageCache> cache;
  if (!cache_options.folder.empty()) cache.emplace(cache_options);
  const auto profile = resolve(command);
  Report report;
  report.warnings = profile.notices;
  try {
    const auto planned = estimate(job_of(command, profile.settings), {.exact = command.options["exact"].as<bool>()},
                                  watch, report, cache ? &*cache : nullptr);
    warn(console, report.warnings, command.console.verbosity == Verbosity::detail ? report.warnings.size() : 3);
    report.peak_memory_mb = peak_memory_mb();
    if (command.report) write_output(*command.report, to_json(report));
    if (command.report != "-") write_output(command.output.value_or("-"), figures(report, profile.settings, planned));
    return 0;
  } catch (const std::bad_alloc&) {
    throw Error{Error::Kind::interrupted, "the machine's memory is used up", command.inputs.front(),
                "try a coarser mesh or layer_height, or fewer copies"};
  } catch (const Error& error) {
    if (error.kind() == Error::Kind::interrupted) throw limits.error();
    throw;
  }
}

}  // namespace weft::app
