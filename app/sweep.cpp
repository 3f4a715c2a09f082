// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/sweep.h"

#include "batch_run.h"
#include "core/file_bytes.h"
#include "core/write_file.h"
#include "page_file.h"
#include "preview/preview.h"
#include "tasks/crew.h"
#include "verbs.h"

#include <algorithm>
#include <filesystem>
#include <sstream>

#include <fmt/format.h>

namespace po = boost::program_options;

namespace weft::app {

po::options_description sweep_options() {
  po::options_description out("Options of weft sweep");
  out.add_options()("vary", po::value<std::vector<std::string>>()->value_name("KEY=V1,V2,..."),
                    "a setting and its values; or KEY=FROM:TO:STEP; repeatable: every combination is tried")(
      "zip", po::bool_switch(), "the first values of all settings together, then the second ones, and so on")(
      "sample", po::value<std::size_t>()->value_name("N"),
      "N combinations spread evenly (a Latin hypercube); ranges may then be KEY=FROM:TO")(
      "seed", po::value<std::uint64_t>()->value_name("N")->default_value(1),
      "of --sample: the same seed, the same combinations")(
      "picture-layer", po::value<double>()->value_name("PERCENT")->default_value(50, "50"),
      "which layer the small pictures show, as a share of the height");
  out.add(running_options());
  return out;
}

namespace {

jobs::SweepOptions combine_of(const Command& command) {
  const auto& o = command.options;
  jobs::SweepOptions out;
  out.seed = o["seed"].as<std::uint64_t>();
  if (o["zip"].as<bool>() && o.count("sample"))
    throw Error{Error::Kind::usage, "contradicts --sample", "--zip", "give one of the two"};
  if (o["zip"].as<bool>()) out.combine = jobs::Combine::zip;
  if (o.count("sample")) {
    out.combine = jobs::Combine::sample;
    out.samples = o["sample"].as<std::size_t>();
    if (out.samples < 1 || out.samples > 1'000'000) throw Error{Error::Kind::usage, "must be 1 … 1000000", "--sample"};
  }
  return out;
}

/// The layer nearest to that share of them that has sparse infill, which is what most settings change; else that one.
std::size_t telling_layer(const preview::Toolpaths& paths, double share) {
  const auto count = paths.layers.size();
  const auto wanted = std::min(count - 1, static_cast<std::size_t>(share * static_cast<double>(count)));
  const auto has_infill = [&](std::size_t i) {
    return std::any_of(paths.layers[i].strokes.begin(), paths.layers[i].strokes.end(),
                       [&](const preview::Stroke& s) { return s.extrudes() && paths.features[s.feature] == "infill"; });
  };
  for (std::size_t off = 0; off < count; ++off) {
    if (wanted + off < count && has_infill(wanted + off)) return wanted + off;
    if (off <= wanted && has_infill(wanted - off)) return wanted - off;
  }
  return wanted;
}

/// Writes the page of a trial beside its G-code, and draws a layer. Nothing when there is nothing to draw.
void look_at(jobs::Trial& trial, const std::filesystem::path& folder, const Settings& settings, double share) {
  try {
    const auto path = folder / trial.output;
    const FileBytes file(path.string());
    const auto paths = toolpaths_of(file.view(), settings, path.string());
    preview::View view;
    view.size = 420;
    view.layer = telling_layer(paths, share);
    view.legend = false;
    const auto png = preview::png(paths, view);
    trial.picture.assign(png.begin(), png.end());
    const std::string page = trial.output + ".html";
    write_file(folder / page, page_of(paths, file.view(), path.string(), {.title = trial.id}, {}, {}));
    trial.viewer = page;
  } catch (const Error&) {
    // the table does without
  }
}

void write_page(const std::vector<jobs::Prepared>& jobs, const Finished& finished, const std::vector<jobs::Axis>& axes,
                const jobs::BatchOptions& options, const std::string& title, double picture_share) {
  std::vector<jobs::Trial> trials(jobs.size());
  std::size_t begun = 0;
  const auto fill = [&](std::size_t i) {
    const auto& entry = finished.collected.entries[i];
    auto& t = trials[i];
    t.id = entry.line.id;
    t.output = entry.line.output;
    for (const auto& [key, text] : entry.line.settings) t.values.push_back(text);
    t.error = entry.record ? entry.record->error : "was not run";
    if (!entry.ok()) return;
    t.ok = true;
    t.time_s = entry.record->print_time_s;
    t.material_g = entry.record->filament_g;
    t.layers = entry.record->layers;
    t.cost = entry.record->cost;
    t.currency = entry.record->currency;
    t.strength = jobs::strength_estimate(*entry.record, jobs[i].job.settings);
    look_at(t, options.folder, jobs[i].job.settings, picture_share);
  };
  const auto broken = tasks::run_crew(
      options.threads,
      [&]() -> std::optional<std::size_t> { return begun < jobs.size() ? std::optional(begun++) : std::nullopt; },
      fill);
  if (!broken.empty()) std::rethrow_exception(broken.front().error);
  jobs::mark_best(trials);
  std::vector<std::string> names;
  for (const auto& axis : axes) names.push_back(axis.key);
  write_file(options.folder / "index.html", jobs::sweep_page(title, names, trials));
}

}  // namespace

int sweep(const Words& words) {
  const auto options = sweep_options();
  const auto command = parse_command(words, options);
  if (command.help) {
    std::ostringstream out;
    out << "weft sweep MODEL... -p PROFILE --vary KEY=V1,V2,... [--vary ...] -o DIR\n\n"
           "Slices a model with every combination of settings. DIR/index.html compares time, material and strength, "
           "and "
           "leads to a page of each trial's toolpaths; none needs the network.\n\n"
        << options << "\n"
        << common_help();
    return write_output("-", out.str()), 0;
  }
  if (command.inputs.empty())
    throw Error{Error::Kind::usage, "no model was given", "weft sweep",
                "as in weft sweep part.stl --vary layer_height=0.1,0.2 -o results"};
  if (!command.options.count("vary"))
    throw Error{Error::Kind::usage, "which settings should vary?", "weft sweep", "add --vary layer_height=0.1,0.2,0.3"};
  std::vector<jobs::Axis> axes;
  for (const auto& text : command.options["vary"].as<std::vector<std::string>>()) {
    axes.push_back(jobs::parse_axis(text));
    for (std::size_t i = 0; i + 1 < axes.size(); ++i)
      if (axes[i].key == axes.back().key)
        throw Error{Error::Kind::usage, fmt::format("'{}' is varied twice", axes.back().key), "--vary"};
  }
  const double picture = command.options["picture-layer"].as<double>();
  if (!(picture >= 0 && picture <= 100)) throw Error{Error::Kind::usage, "must be 0 … 100", "--picture-layer"};

  auto run_options = batch_options_of(command);
  StageCache cache(cache_options_of(command));
  run_options.cache = &cache;
  Console console(command.console);
  const auto jobs = prepare_all(console, jobs::sweep_jobs(command.inputs, axes, combine_of(command)), command);
  const auto finished = run_jobs(console, jobs, run_options, command, {});
  write_page(jobs, finished, axes, run_options, std::filesystem::path(command.inputs.front()).filename().string(),
             picture / 100);
  console.info(fmt::format("compare them in {}", (run_options.folder / "index.html").string()));
  return conclude(console, finished, cache, command);
}

}  // namespace weft::app
