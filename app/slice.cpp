// SPDX-License-Identifier: GPL-3.0-or-later
#include "batch_run.h"
#include "command.h"
#include "core/figures.h"
#include "core/hash.h"
#include "core/write_file.h"
#include "gcode/file_name.h"
#include "limits.h"
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
  p.arrange = o["arrange"].as<bool>(), p.fill = o["fill"].as<bool>();
  if (p.keep_position && (p.arrange || p.fill))
    throw Error{Error::Kind::usage, "contradicts --arrange and --fill", "--keep-position", "give one of them"};
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

}  // namespace

int slice(const Words& words) {
  const auto options = slice_options();
  const auto command = parse_command(words, options);
  if (command.help) return write_output("-", help(options)), 0;
  if (command.options["info"].as<bool>()) return inform(command);
  refuse_nonsense(command);
  const auto preview = preview_of(command);

  Console console(command.console);
  const Limits limits(limit_of(command.options, "timeout"), limit_of(command.options, "max-memory"));

  Report report;
  if (command.report) report.figures.emplace();
  if (command.report && command.console.verbosity == Verbosity::detail) report.tours.emplace();  // figures to debug by
  bool inputs_are_known = false;  // else a report might be written over one of them
  const auto finish = [&] {
    warn(console, report.warnings, command.console.verbosity == Verbosity::detail ? report.warnings.size() : 3);
    report.peak_memory_mb = peak_memory_mb();
    write_report(command, report, inputs_are_known);
  };
  const auto failed = [&](const Error& error) {
    report.status = Report::Status::failed;
    report.error = error.what();
    finish();
    return error;
  };
  Watchdog watchdog(limits, [&](const Error& error, Report known) { say_last(command, error, std::move(known)); });
  try {
    const auto profile = resolve(command);
    inputs_are_known = true;
    report.warnings = profile.notices;
    check_writable(destination_of(command, profile, report));  // refused before the work, not after it
    const Watch watch{
        [&](std::string_view stage, double share) { console.progress(stage, share), watchdog.remember(report); },
        [&] { return limits.reached(); }};
    const auto cache_options = cache_options_of(command);
    std::optional<StageCache> cache;
    if (!cache_options.folder.empty()) cache.emplace(cache_options);
    const auto gcode = run(job_of(command, profile.settings), watch, report, cache ? &*cache : nullptr);
    watchdog.dismiss();
    if (cache) console.detail("cache: " + told(*cache));
    if (gcode && !preview.empty())
      write_preview(preview, *gcode, profile.settings,
                    std::filesystem::path(command.inputs.front()).filename().string(), command.inputs);
    if (gcode) write_gcode(destination_of(command, profile, report), *gcode);
    finish();
    if (!gcode) throw Error{Error::Kind::audit, report.error, {}, {}};
    console.info(summary(report));
    return 0;
  } catch (const std::bad_alloc&) {
    watchdog.dismiss();
    throw failed({Error::Kind::interrupted, "the machine's memory is used up", command.inputs.front(),
                  "nothing was written; try a coarser mesh or layer_height, or fewer copies"});
  } catch (const Error& error) {
    watchdog.dismiss();
    if (report.status == Report::Status::rejected) throw;
    throw failed(error.kind() == Error::Kind::interrupted ? limits.error() : error);
  }
}

}  // namespace weft::app
