// SPDX-License-Identifier: GPL-3.0-or-later
#include "audit/audit.h"
#include "command.h"
#include "core/file_bytes.h"
#include "limited.h"
#include "page_file.h"
#include "preview/coverage.h"
#include "preview_file.h"
#include "settings/value.h"
#include "tasks/tasks.h"
#include "verbs.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <sstream>

#include <fmt/format.h>

namespace po = boost::program_options;

namespace weft::app {

po::options_description preview_options() {
  po::options_description out("Options of weft preview");
  out.add_options()("layer", po::value<int>()->value_name("N"),
                    "the layer to show, from 0; -1 is the last (default: the middle one; of a page: the last)")(
      "colour,color", po::value<std::string>()->value_name("WHAT")->default_value("feature"),
      "what colours tell: feature, tool, width, speed or flow")("travels", po::bool_switch(),
                                                                "show moves that do not extrude")(
      "window", po::value<std::string>()->value_name("X1xY1,X2xY2"),
      "two opposite corners, in mm, of what a picture shows (default: all of the layer)")(
      "size", po::value<int>()->value_name("PIXELS")->default_value(1600),
      "longer side of a picture, without its legend")(
      "audit", po::bool_switch(),
      "show the machine of the profile, its no-go areas and reach, and in red every move that the audit finds outside")(
      "view", po::value<std::string>()->value_name("DIRECTION"),
      "of a PNG: beads as solids, seen from iso, front, top or x,y,z")(
      "layers", po::value<std::string>()->value_name("FIRST:LAST"), "which layers --view shows (default: all)")(
      "model", po::value<std::vector<std::string>>()->value_name("FILE"),
      "of a page: the model that the file was made of, shown translucent (default: beside the file)");
  add_limit_options(out);
  return out;
}

namespace {

preview::Colour colour_of(const std::string& name) {
  if (const auto known = preview::colour_named(name)) return *known;
  throw Error{Error::Kind::usage, fmt::format("'{}' is not one of feature, tool, width, speed, flow", name),
              "--colour"};
}

/// The layer that --layer means. Pre: the file has layers.
std::optional<std::size_t> layer_of(const Command& command, std::size_t layers) {
  if (!command.options.count("layer")) return std::nullopt;
  const int typed = command.options["layer"].as<int>(), count = static_cast<int>(layers);
  const int index = typed < 0 ? count + typed : typed;
  if (index < 0 || index >= count)
    throw Error{Error::Kind::usage, fmt::format("there is no layer {}", typed), "--layer",
                fmt::format("the file has layers 0 … {}", count - 1)};
  return static_cast<std::size_t>(index);
}

std::optional<Box> window_of(const Command& command) {
  if (!command.options.count("window")) return std::nullopt;
  const auto& typed = command.options["window"].as<std::string>();
  Ring corners;
  try {
    value::parse(typed, Unit::none, corners);
  } catch (const std::invalid_argument&) {
    corners.clear();
  }
  const Box box = box_of(corners);
  if (corners.size() != 2 || box.size().x <= 0 || box.size().y <= 0)
    throw Error{Error::Kind::usage, fmt::format("'{}' is not two corners in mm", typed), "--window",
                "as in --window 90x90,130x120"};
  return box;
}

preview::Overlay audited(const Settings& settings, std::string_view gcode, Console& console) {
  auto listed = settings.audit;
  listed.audit_max_findings = 1'000'000;  // every one is drawn
  const auto report = audit::examine_text(settings.machine, settings.material, listed, gcode);
  console.info(audit::summary(report));
  return overlay_of(settings.machine, report);
}

/// Where --view looks from.
std::array<double, 3> eye_of(const std::string& typed) {
  constexpr std::pair<std::string_view, std::array<double, 3>> known[] = {
      {"iso", preview::from_above}, {"front", {0, -1, 0}}, {"top", {0, 0, 1}}};
  for (const auto& [name, eye] : known)
    if (typed == name) return eye;
  std::array<double, 3> eye{};
  std::istringstream in(typed);
  char comma = ',', other = ',';
  in >> eye[0] >> comma >> eye[1] >> other >> eye[2];
  const bool whole = in && comma == ',' && other == ',' && (in >> std::ws).eof();
  const double length2 = eye[0] * eye[0] + eye[1] * eye[1] + eye[2] * eye[2];
  if (!whole || !(length2 > 1e-12 && length2 < 1e12))
    throw Error{Error::Kind::usage, fmt::format("'{}' is neither iso, front, top nor a direction x,y,z", typed),
                "--view", "as in --view 1,-2,1"};
  return eye;
}

/// First and last layer of --layers.
std::pair<std::size_t, std::size_t> layers_of(const std::string& typed, std::size_t count) {
  int first = 0, last = -1;
  char colon = ':';
  std::istringstream in(typed);
  in >> first >> colon >> last;
  const auto from_end = [&](int i) { return i < 0 ? static_cast<int>(count) + i : i; };
  first = from_end(first), last = from_end(last);
  if (!in || colon != ':' || !(in >> std::ws).eof() || first < 0 || last < first || last >= static_cast<int>(count))
    throw Error{Error::Kind::usage, fmt::format("'{}' is no range of layers", typed), "--layers",
                fmt::format("the file has layers 0 … {}; as in --layers 0:-1", count - 1)};
  return {static_cast<std::size_t>(first), static_cast<std::size_t>(last)};
}

void set_solids(const Command& command, preview::Kind kind, std::size_t layers, preview::View& view) {
  const auto& o = command.options;
  if (o.count("view")) {
    if (kind != preview::Kind::png)
      throw Error{Error::Kind::usage, "is for pictures in PNG; a page turns by hand", "--view"};
    view.eye = eye_of(o["view"].as<std::string>());
  }
  if (!o.count("layers")) return;
  if (!view.eye) throw Error{Error::Kind::usage, "goes with --view", "--layers", "add --view iso"};
  view.layers = layers_of(o["layers"].as<std::string>(), layers);
}

/// Half a pixel of a window, however large the arcs are that it shows a part of.
preview::Chord chord_of(preview::Kind kind, const preview::View& view) {
  if (!view.window || kind == preview::Kind::html) return {};
  return {0.5 * to_mm(std::max(view.window->size().x, view.window->size().y)) / view.size, 0};
}

/// Tells of a window beside everything that the layer prints: the picture is empty, and no fault of the file.
void warn_if_beside(const preview::Toolpaths& paths, const preview::View& view, Console& console) {
  if (!view.window || view.eye) return;
  const std::size_t layer = preview::layer_shown(paths, view);
  const Box printed = preview::box_of_beads(paths.layers[layer], paths);
  if (printed.empty() || view.window->overlaps(printed)) return;
  console.warning(
      {"window_empty",
       fmt::format("--window shows nothing: layer {} prints from {:.2f}x{:.2f} to {:.2f}x{:.2f}", layer,
                   to_mm(printed.min.x), to_mm(printed.min.y), to_mm(printed.max.x), to_mm(printed.max.y))});
}

/// The bytes of the picture or page that the command asks for. @throws Error
std::string drawing(const Command& command, preview::Kind kind, Console& console) {
  const auto& o = command.options;
  const tasks::ThreadLimit threads(command.threads);
  const bool is_page = kind == preview::Kind::html;
  const auto& path = command.inputs[0];
  const Settings settings = is_page ? settings_for(command, path) : resolve(command).settings;
  const FileBytes file(path);
  const std::string_view gcode = file.view();
  preview::View view;
  view.colour = colour_of(o["colour"].as<std::string>());
  view.travels = o["travels"].as<bool>();
  view.size = o["size"].as<int>();
  if (view.size < 16 || view.size > 8192) throw Error{Error::Kind::usage, "must be 16 … 8192", "--size"};
  view.window = window_of(command);
  const auto paths = is_page ? toolpaths_of(gcode, settings, path)
                             : preview::read(gcode, diameter_of_e(settings), chord_of(kind, view));
  if (paths.layers.empty())
    throw Error{Error::Kind::file, "holds no motion that could be drawn", path, "is it G-code?"};
  view.layer = layer_of(command, paths.layers.size());
  set_solids(command, kind, paths.layers.size(), view);
  view.title = std::filesystem::path(path).filename().string();
  std::optional<preview::Overlay> overlay;
  if (o["audit"].as<bool>()) overlay = audited(settings, gcode, console);
  if (!is_page) {
    warn_if_beside(paths, view, console);
    return preview::draw(kind, paths, view, overlay);
  }
  std::vector<std::string> models;
  if (o.count("model")) models = o["model"].as<std::vector<std::string>>();
  return page_of(paths, gcode, path, view, overlay, models);
}

}  // namespace

preview::Kind preview_kind(const std::string& destination) {
  if (const auto kind = preview::kind_of(destination)) return *kind;
  throw Error{Error::Kind::usage, "is neither .html nor .svg nor .png", destination,
              "the extension tells the kind of picture"};
}

void write_preview(const std::string& destination, const audit::Passed& gcode, const Settings& settings,
                   const std::string& title, const std::vector<std::string>& models) {
  const auto kind = preview_kind(destination);
  if (kind == preview::Kind::html) {
    const auto paths = toolpaths_of(gcode.gcode(), settings, destination);
    const auto overlay = overlay_of(settings.machine, gcode.report());
    const std::string page = page_of(paths, gcode.gcode(), destination, {.title = title}, overlay, models);
    return write_output(destination, page);
  }
  const auto paths = preview::read(gcode.gcode(), diameter_of_e(settings));
  if (paths.layers.empty()) throw Error{Error::Kind::file, "there is no motion to draw", destination};
  write_output(destination, preview::draw(kind, paths, {.title = title}));
}

int preview(const Words& words) {
  const auto options = preview_options();
  const auto command = parse_command(words, options);
  if (command.help) {
    std::ostringstream out;
    out << "weft preview FILE.gcode -o OUT.(html|svg|png)    look at toolpaths\n\n"
           "svg and png show one layer, or with --view all of them as solids; html is a page that turns, for every\n"
           "layer, that needs no network. Beads are drawn as wide as their filament makes them. A page takes the "
           "machine\n"
           "from the file where neither profile nor setting is given.\n\n"
        << options << "\n"
        << common_help();
    return write_output("-", out.str()), 0;
  }
  if (command.inputs.size() != 1)
    throw Error{Error::Kind::usage, fmt::format("takes one G-code file, not {}", command.inputs.size()),
                "weft preview"};
  if (!command.output) throw Error{Error::Kind::usage, "no output was given", "weft preview", "as in -o layer.png"};
  const auto kind = preview_kind(*command.output);

  Console console(command.console);
  std::string drawn;
  within_limits(command, [&] { drawn = drawing(command, kind, console); });
  write_output(*command.output, drawn);
  return 0;
}

}  // namespace weft::app
