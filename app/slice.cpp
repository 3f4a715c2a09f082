// SPDX-License-Identifier: GPL-3.0-or-later
#include "batch_run.h"
#include "command.h"
#include "core/figures.h"
#include "core/hash.h"
#include "core/write_file.h"
#include "gcode/file_name.h"
#include "limits.h"
#include "pipeline/arranged.h"
#include "pipeline/model_parts.h"
#include "pipeline/pipeline.h"
#include "preview_file.h"
#include "slice_job.h"
#include "transform_options.h"
#include "verbs.h"

#include <cmath>
#include <csignal>
#include <map>
#include <new>
#include <sstream>

#include <fmt/format.h>

namespace po = boost::program_options;

namespace weft::app {

po::options_description slice_options() {
  po::options_description out("Options of weft slice");
  out.add_options()("center", po::value<std::string>()->value_name("X,Y"),
                    "put the centre of the models' bounding box there (default: centre of the bed)")(
      "keep-position", po::bool_switch(), "keep the coordinates of the file")(
      "dont-arrange", po::bool_switch(), "keep the coordinates of the file, but stand on the bed; --center moves it")(
      "export-gcode,g", po::bool_switch(), "what weft slice does anyway")("gcode", po::bool_switch(), "the same")(
      "info", po::bool_switch(), "facts of the models, as weft inspect tells them; nothing is sliced")(
      "drop", po::bool_switch(), "with --keep-position: put down what floats or dips")(
      "rotate", po::value<double>()->value_name("DEG")->default_value(0.0, "0"), "rotation about Z, counter-clockwise")(
      "support-enforcer", po::value<std::vector<std::string>>()->value_name("FILE"),
      "support what lies in this mesh, or in box:x,y,z,x,y,z, of the model before it")(
      "support-blocker", po::value<std::vector<std::string>>()->value_name("FILE"), "support nothing in it")(
      "support-mesh", po::value<std::vector<std::string>>()->value_name("FILE"), "print it as support")(
      "modifier", po::value<std::vector<std::string>>()->value_name("FILE KEY=VALUE..."),
      "where this mesh, or box:…, meets the model before it, these settings hold; repeatable")(
      "negative", po::value<std::vector<std::string>>()->value_name("FILE"),
      "cut this mesh, or box:…, out of the model before it; repeatable")(
      "for", po::value<std::vector<std::string>>()->value_name("NAME KEY=VALUE..."),
      "settings of one object or part, by its name or its file's; repeatable")(
      "place", po::value<std::vector<std::string>>()->value_name("NAME=X,Y[,DEG]"),
      "put the middle of an object there, turned; the others are arranged around it; repeatable")(
      "arrange", po::bool_switch(), "put models close together by their true outlines, not in rows")(
      "fill", po::bool_switch(), "the same with as many copies as there is room for, of models in turns")(
      "plates", po::bool_switch(),
      "the same on as many plates as it takes: OUT.gcode, or OUT_plate_1.gcode, OUT_plate_2.gcode …")(
      "turn", po::value<double>()->value_name("DEG")->default_value(45, "45"),
      "with these three: things may be turned by multiples of it, where they have no room otherwise; 0 keeps them")(
      "plate", po::value<int>()->value_name("N"), "which plate of a project of several is printed")(
      "copies", po::value<std::vector<std::string>>()->value_name("[NAME=]N"),
      "N copies of each model, or of one object; arranged on the bed; repeatable")(
      "spacing", po::value<double>()->value_name("MM")->default_value(6.0, "6"), "between copies, and between models")(
      "duplicate", po::value<int>()->value_name("N"), "the same")(
      "audit", po::value<std::string>()->value_name("reject|annotate")->default_value("reject"),
      "what the boundary audit does with a move outside the build volume. It cannot be turned off")(
      "timeout", po::value<double>()->value_name("S")->default_value(0, "none"),
      "stop after so many seconds, with status 130 and a report of what was done")(
      "max-memory", po::value<double>()->value_name("MB")->default_value(0, "none"),
      "stop above so much resident memory, in the same way")("preview", po::value<std::string>()->value_name("FILE"),
                                                             "also write a preview (html, svg or png)");
  add_transform_options(out);
  add_cache_options(out);
  return out;
}

namespace {

Placement placement_of(const po::variables_map& o) {
  Placement p;
  if (o.count("center")) p.centre = parse_point(o["center"].as<std::string>(), "--center");
  p.keep_position = o["keep-position"].as<bool>();
  p.drop = o["drop"].as<bool>();
  if (o["dont-arrange"].as<bool>() && !p.centre) p.keep_position = p.drop = true;
  if (p.keep_position && p.centre)
    throw Error{Error::Kind::usage, "contradicts --center", "--keep-position", "give one of the two"};
  p.rotate_deg = o["rotate"].as<double>();
  if (!(std::abs(p.rotate_deg) <= 36000)) throw Error{Error::Kind::usage, "must be an angle in degrees", "--rotate"};
  if (o.count("duplicate"))
    p.copies = o["duplicate"].as<int>();
  else if (o.count("copies"))
    for (const auto& text : o["copies"].as<std::vector<std::string>>())
      if (text.find('=') == std::string::npos) p.copies = copies_in(text);
  p.arrange = o["arrange"].as<bool>(), p.fill = o["fill"].as<bool>(), p.plates = o["plates"].as<bool>();
  p.turn_deg = o["turn"].as<double>();
  if (!(p.turn_deg >= 0 && p.turn_deg <= 180)) throw Error{Error::Kind::usage, "must be 0 … 180 degrees", "--turn"};
  if (p.keep_position && p.by_outlines())
    throw Error{Error::Kind::usage, "contradicts --arrange, --fill and --plates", "--keep-position",
                "give one of them"};
  if (p.fill && p.plates)
    throw Error{Error::Kind::usage, "contradicts --plates", "--fill", "it prints one full plate, --plates all of them"};
  if (o.count("plate")) p.plate = o["plate"].as<int>();
  if (p.plate < 0 || p.plate > 10000 || (o.count("plate") && p.plate < 1))
    throw Error{Error::Kind::usage, fmt::format("{} is outside 1 … 10000", p.plate), "--plate"};
  if (p.copies < 1 || p.copies > 10000)
    throw Error{Error::Kind::usage, fmt::format("{} is outside 1 … 10000", p.copies), "--copies"};
  const double spacing_mm = o["spacing"].as<double>();
  if (!(spacing_mm >= 0 && spacing_mm <= 1000)) throw Error{Error::Kind::usage, "must be 0 … 1000 mm", "--spacing"};
  p.spacing = from_mm(spacing_mm);
  if (p.copies > 1 && p.keep_position)
    throw Error{Error::Kind::usage, "contradicts --copies", "--keep-position", "copies are arranged on the bed"};
  take_transforms(o, p);
  return p;
}

}  // namespace

Job job_of(const Command& command, const Settings& settings) {
  Job job;
  job.models = command.inputs;
  job.settings = settings;
  job.placement = placement_of(command.options);
  job.marks = command.marks;
  job.by_name = command.by_name;
  job.threads = command.threads;
  job.hash_gcode = command.report.has_value();
  const auto mode = command.options.count("audit") ? command.options["audit"].as<std::string>() : "reject";
  if (mode != "reject" && mode != "annotate")
    throw Error{Error::Kind::usage, fmt::format("'{}' is not one of reject, annotate", mode), "--audit",
                "the audit cannot be turned off"};
  job.audit = mode == "reject" ? audit::Mode::reject : audit::Mode::annotate;
  return job;
}

namespace {

/// What a job that is ended from outside leaves: the error, and the report of what was known.
void say_last(const Command& command, const Error& error, Report known) {
  auto options = command.console;
  options.progress = ProgressMode::never;
  Console console(options);
  console.error(error);
  known.status = Report::Status::failed;
  known.error = error.what();
  known.peak_memory_mb = peak_memory_mb();
  try {
    write_report(command, known, false);
  } catch (const Error& unwritten) {
    console.error(unwritten);
  }
}

}  // namespace

double limit_of(const po::variables_map& options, const std::string& name) {
  const double value = options[name].as<double>();
  if (!(value >= 0 && value <= 1e9))
    throw Error{Error::Kind::usage, fmt::format("{:g} is outside 0 … 1e9", value), "--" + name, "0 is no limit"};
  return value;
}

void warn(Console& console, const Notices& notices, std::size_t most) {
  std::map<std::string, std::size_t> said;
  for (const auto& notice : notices)
    if (++said[notice.code] <= most) console.warning(notice);
  for (const auto& [code, count] : said)
    if (count > most)
      console.warning(
          {code, fmt::format("{} more of the kind {}; -v shows them, --report lists them", count - most, code)});
}

std::string price(double amount, const std::string& currency) {
  return fmt::format("{:.2f}{}{}", amount, currency.empty() ? "" : " ", currency);
}

void write_report(const Command& command, const Report& report, bool inputs_are_known) {
  if (command.report && (inputs_are_known || !may_be_input(*command.report)))
    write_output(*command.report, to_json(report));
}

namespace {

std::string summary(const Report& r) {
  const auto cost = r.cost ? ", " + price(r.cost->total(), r.currency) : std::string();
  const auto& audit = r.audit;  // of an annotated print the summary has been the warning before this line
  const auto judged = audit.verdict == "pass" ? audit.summary : fmt::format("{} moves checked", audit.checked_moves);
  return fmt::format("{} layers, {:.2f} mm high, {} to print, {:.2f} m of filament ({:.1f} g){}; audit: {}, {}",
                     r.layers, r.height_mm, short_duration(r.print_time_s), r.filament_mm / 1000, r.filament_g, cost,
                     audit.verdict, judged);
}

/// Where the preview goes; empty: none is asked for.
std::string preview_of(const Command& command) {
  return command.options.count("preview") ? command.options["preview"].as<std::string>() : std::string();
}

/// Where the G-code goes: where -o says, else beside the model, by output_filename_format. What is not known before the
/// print is made counts as nothing. @throws Error{usage} where that is a file that is read
std::string destination_of(const Command& command, const Profile& profile, const Report& report) {
  if (command.output) return *command.output;
  Statistics made;
  made.print_time_s = report.print_time_s;
  made.filament_mm = report.filament_mm, made.filament_mm3 = report.filament_mm3, made.filament_g = report.filament_g;
  const std::filesystem::path model(pipeline::parts_of(command.inputs.front()).front().file);
  const PrintPlan plan;
  const auto name = gcode::file_name({profile.settings, plan, made, model.stem().string(), {}});
  const auto path = (model.parent_path() / name).string();
  files_of(command, profile).writes(path, "output_filename_format");
  return path;
}

/// What is refused before the work, not after it. @throws Error{usage}
void refuse_nonsense(const Command& command) {
  if (command.inputs.empty())
    throw Error{Error::Kind::usage, "no model was given", "weft slice",
                "as in weft slice part.stl -p printer.ini -o part.gcode"};
  if (command.output == "-" && command.report == "-")
    throw Error{Error::Kind::usage, "G-code and report cannot both go to standard output", "--report",
                "name a file for one of them"};

  if (const auto preview = preview_of(command); !preview.empty()) (void)preview_kind(preview);
}

std::string help(const po::options_description& options) {
  std::ostringstream out;
  out << "weft slice MODEL... -p PROFILE [-s KEY=VALUE]... -o OUT.gcode\n\n" << options << "\n" << common_help();
  return out.str();
}

/// --info
int inform(const Command& command) {
  Words said = command.inputs;
  for (auto& word : transform_arguments(placement_of(command.options))) said.push_back(std::move(word));
  return inspect(said);
}

/// One run of the verb, of which there is one a plate.
struct Slicing {
  const Command& command;
  Console& console;
  const Limits& limits;
  const Profile& profile;
  StageCache* cache;
  std::size_t plate = 0;  ///< 0: the only one

  /// @throws Error{usage} where that is something that is read
  std::string named(const std::string& file, const std::string& option) const {
    if (plate == 0 || file == "-") return file;
    auto out = pipeline::name_of_plate(file, plate);
    files_of(command, profile).writes(out, option);
    return out;
  }
};

void finish(const Slicing& of, Report& report) {
  const bool all = of.command.console.verbosity == Verbosity::detail;
  warn(of.console, report.warnings, all ? report.warnings.size() : 3);
  report.peak_memory_mb = peak_memory_mb();
  if (of.command.report) write_output(of.named(*of.command.report, "--report"), to_json(report));
}

[[nodiscard]] Error memory_used_up(const Command& command) {
  return {Error::Kind::interrupted, "the machine's memory is used up", command.inputs.front(),
          "nothing was written; try a coarser mesh or layer_height, or fewer copies"};
}

/// @throws Error when nothing was written, once it is in the report
void slice_one(const Slicing& of, const Job& job) {
  const auto& command = of.command;
  Report report;
  report.warnings = of.profile.notices;
  if (command.report) report.figures.emplace();
  if (command.report && command.console.verbosity == Verbosity::detail) report.tours.emplace();  // figures to debug by
  const auto failed = [&](const Error& error) {
    report.status = Report::Status::failed;
    report.error = error.what();
    finish(of, report);
    return error;
  };
  Watchdog watchdog(of.limits, [&](const Error& error, Report known) { say_last(command, error, std::move(known)); });
  try {
    const auto destination = [&] { return of.named(destination_of(command, of.profile, report), "--output"); };
    check_writable(destination());  // refused before the work, not after it
    const Watch watch{
        [&](std::string_view stage, double share) { of.console.progress(stage, share), watchdog.remember(report); },
        [&] { return of.limits.reached(); }};
    const auto gcode = run(job, watch, report, of.cache);
    watchdog.dismiss();
    if (of.cache) of.console.detail("cache: " + told(*of.cache));
    if (const auto preview = preview_of(command); gcode && !preview.empty())
      write_preview(of.named(preview, "--preview"), *gcode, of.profile.settings,
                    std::filesystem::path(command.inputs.front()).filename().string(), command.inputs);
    if (gcode) write_gcode(destination(), *gcode);
    finish(of, report);
    if (!gcode) throw Error{Error::Kind::audit, report.error, {}, {}};
    of.console.info(summary(report));
  } catch (const std::bad_alloc&) {
    watchdog.dismiss();
    throw failed(memory_used_up(command));
  } catch (const Error& error) {
    watchdog.dismiss();
    if (report.status == Report::Status::rejected) throw;
    throw failed(error.kind() == Error::Kind::interrupted ? of.limits.error() : error);
  }
}

/// What could not even be begun is in the report as well.
/// @param begin is given what to tell when what is read is known: else a report might be written over one of them
template <class Begin>
auto begun(const Command& command, const Limits& limits, const Begin& begin) {
  bool inputs_are_known = false;
  const auto failed = [&](const Error& error) {
    Report report;
    report.error = error.what();
    report.peak_memory_mb = peak_memory_mb();
    write_report(command, report, inputs_are_known);
    return error;
  };
  Watchdog watchdog(limits, [&](const Error& error, Report known) { say_last(command, error, std::move(known)); });
  try {
    auto out = begin(inputs_are_known);
    watchdog.dismiss();
    return out;
  } catch (const std::bad_alloc&) {
    watchdog.dismiss();
    throw failed(memory_used_up(command));
  } catch (const Error& error) {
    watchdog.dismiss();
    throw failed(error.kind() == Error::Kind::interrupted ? limits.error() : error);
  }
}

}  // namespace

int slice(const Words& words) {
  const auto options = slice_options();
  const auto command = parse_command(words, options);
  if (command.help) return write_output("-", help(options)), 0;
  if (command.options["info"].as<bool>()) return inform(command);
  refuse_nonsense(command);

  Console console(command.console);
  const Limits limits(limit_of(command.options, "timeout"), limit_of(command.options, "max-memory"));
  const auto cache_options = cache_options_of(command);
  std::optional<StageCache> cache;
  std::size_t plates = 1;
  const auto [profile, job] = begun(command, limits, [&](bool& inputs_are_known) {
    auto resolved = resolve(command);
    inputs_are_known = true;
    auto asked = job_of(command, resolved.settings);
    if (!cache_options.folder.empty()) cache.emplace(cache_options);
    const Watch watch{{}, [&] { return limits.reached(); }};
    plates = plates_of(asked, watch, cache ? &*cache : nullptr);
    if (plates > 1 && (command.output == "-" || command.report == "-"))
      throw Error{Error::Kind::usage, fmt::format("{} plates cannot all go to standard output", plates), "--plates",
                  "name files for them"};
    return std::pair(std::move(resolved), std::move(asked));
  });
  for (std::size_t plate = 1; plate <= plates; ++plate) {
    Job own = job;
    own.placement.on_plate = static_cast<int>(plate);
    slice_one({command, console, limits, profile, cache ? &*cache : nullptr, plates > 1 ? plate : 0}, own);
  }
  return 0;
}

}  // namespace weft::app
