// SPDX-License-Identifier: GPL-3.0-or-later
#include "command.h"
#include "gcode/writer.h"
#include "pipeline/check.h"
#include "pipeline/profile_file.h"
#include "profile/rules.h"
#include "profile_folders.h"
#include "prusaslicer/export.h"
#include "settings/catalogue.h"
#include "settings/near.h"
#include "verbs.h"

#include <algorithm>
#include <array>
#include <sstream>

#include <fmt/format.h>

namespace po = boost::program_options;

namespace weft::app {
namespace {

std::string shortened(const std::string& text) {
  return text.size() <= 160 ? text : text.substr(0, 157) + "...";
}

std::string explained(const Profile& profile, const std::string& key) {
  const auto* entry = find_setting(key);
  if (!entry) {
    const auto near = nearest_key(key);
    throw Error{Error::Kind::settings, fmt::format("unknown setting '{}'", key), "--explain",
                near.empty() ? "" : fmt::format("did you mean '{}'?", near)};
  }
  std::string out =
      fmt::format("{} = {} {}\n  {}\n", entry->key, entry->print(profile.settings), entry->unit, entry->meaning);
  const auto at = profile.origins.find(std::string(entry->key));
  if (at == profile.origins.end()) return out + "  the default\n";
  for (auto origin = at->second.rbegin(); origin != at->second.rend(); ++origin) {
    const bool holds = origin == at->second.rbegin();
    if (origin->source.empty())
      out += fmt::format("  {} {} = {}\n", holds ? "set by " : "shadows", origin->where, origin->text);
    else if (holds)
      out += fmt::format("  set by  {} = {}, from {}\n", origin->where, origin->text, shortened(origin->source));
    else
      out += fmt::format("  shadows {}: {}\n", origin->where, shortened(origin->source));
  }
  return out + fmt::format("  shadows default = {}\n", entry->default_text);
}

std::string resolved(const Profile& profile) {
  std::string out, section;
  for (const auto& e : catalogue()) {
    if (e.section != section) out += fmt::format("{}[{}]\n", out.empty() ? "" : "\n", section = e.section);
    out += fmt::format("{} = {}\n", e.key, e.print(profile.settings));
  }
  return out;
}

/// A configuration of PrusaSlicer's family as one of weft's, with the fate of each line that has none here.
std::string imported(const std::filesystem::path& path, const ImportOptions& options) {
  Profile profile;
  const auto translation = import_prusaslicer(profile, profile_text(path, options), path, options);
  std::string out = fmt::format("; from {}\n", path.filename().string());
  for (const auto& notice : profile.notices) out += fmt::format("; {}\n", notice.message);
  std::string section;
  for (const auto& e : catalogue()) {
    if (profile.origins.find(std::string(e.key)) == profile.origins.end()) continue;
    if (e.section != section) out += fmt::format("\n[{}]\n", section = e.section);
    out += fmt::format("{} = {}\n", e.key, e.print(profile.settings));
  }
  const auto list = [&](std::string_view title, const std::vector<prusaslicer::Remark>& remarks) {
    if (remarks.empty()) return;
    out += fmt::format("\n; {} ({}):\n", title, remarks.size());
    for (const auto& r : remarks)
      out += fmt::format(";   line {}: {} = {}{}{}\n", r.line, r.key, r.text.substr(0, 60), r.why.empty() ? "" : ": ",
                         r.why);
  };
  list("translated to the nearest", translation.approximated);
  list("not supported yet, and set to a value that would change the print", translation.unsupported);
  list("not needed here", translation.not_needed);
  list("not one of PrusaSlicer's keys", translation.unknown);
  return out;
}

/// The presets of a bundle; for a printer, those that fit it.
std::string listed(const std::filesystem::path& path, const ImportOptions& options) {
  using prusaslicer::PresetKind;
  const auto entries = parse_ini(read_profile(path, options), path.string());
  const auto& choice = options.presets;
  if (!prusaslicer::is_bundle(entries))
    throw Error{Error::Kind::settings, "is not a bundle of presets", path.string(),
                "it holds one configuration: use it as it is"};
  const auto bundle = prusaslicer::read_bundle(entries, path.string());
  const auto chosen = [&](PresetKind kind, const std::string& name) -> const prusaslicer::Preset* {
    if (name.empty()) return nullptr;
    if (const auto* p = prusaslicer::find_preset(bundle, kind, name)) return p;
    std::vector<std::string> names;
    for (const auto* p : prusaslicer::presets_of(bundle, kind)) names.push_back(p->name);
    throw Error{Error::Kind::settings, fmt::format("holds no {} preset '{}'", prusaslicer::name_of(kind), name),
                path.string(), did_you_mean(name, names)};
  };
  const auto* printer = chosen(PresetKind::printer, choice.printer);
  const auto* print = chosen(PresetKind::print, choice.print);
  std::string out;
  for (const auto kind : {PresetKind::printer, PresetKind::print, PresetKind::filament}) {
    if (kind == PresetKind::printer && printer) continue;
    for (const auto* p : prusaslicer::presets_of(bundle, kind, printer, kind == PresetKind::filament ? print : nullptr))
      out += fmt::format("{}={}\n", prusaslicer::name_of(kind), p->name);
  }
  return out;
}

/// What is not the same in two profiles.
std::string differences(const Profile& a, const Profile& b) {
  std::string out;
  for (const auto& e : catalogue()) {
    const auto x = e.print(a.settings), y = e.print(b.settings);
    if (x == y) continue;
    const std::string key(e.key);
    out += fmt::format("{}{}{}\n  {} ({})\n  {} ({})\n", key, e.unit.empty() ? "" : ", ", e.unit, x, origin_of(a, key),
                       y, origin_of(b, key));
  }
  return out;
}

Profile resolved_file(const Command& command, const std::filesystem::path& file) {
  auto one = command;
  one.profiles = {file};
  return resolve(one);
}

std::string as_prusaslicer(const Profile& profile) {
  auto exported = prusaslicer::exported(profile.settings);
  if (!exported.lost.empty()) exported.text += "\n# PrusaSlicer has no words for:\n";
  for (const auto& line : exported.lost) exported.text += "#   " + line + "\n";
  return exported.text;
}

void print(const Command& command, const std::string& text) {
  write_output(command.output.value_or("-"), text);
}

/// The profiles as resolved, with what was noticed on standard error.
Profile resolved_aloud(const Command& command, Console& console) {
  auto profile = resolve(command);
  for (const auto& notice : profile.notices) console.warning(notice);
  return profile;
}

std::string format_of(const Command& command) {
  auto format = command.options["format"].as<std::string>();
  if (format != "weft" && format != "prusaslicer")
    throw Error{Error::Kind::usage, fmt::format("'{}' is not one of weft, prusaslicer", format), "--format"};
  return format;
}

void check(const Command& command) {
  (void)format_of(command);
  Console console(command.console);
  const auto profile = resolved_aloud(command, console);
  gcode::check_custom_code(profile.settings);
  auto doubts = doubts_about(profile);
  for (auto& notice : pipeline::check(profile.settings)) doubts.push_back(std::move(notice));
  for (const auto& doubt : doubts) console.warning(doubt);
  console.info(fmt::format("{} settings are valid{}", catalogue().size(),
                           doubts.empty() ? "" : fmt::format(", {} of them doubtful", doubts.size())));
}

void diff(const Command& command) {
  print(command, differences(resolved_file(command, command.profiles[0]), resolved_file(command, command.profiles[1])));
}

void import_one(const Command& command) {
  print(command, imported(profile_file(command.profiles.front(), {}, command.import.folders), command.import));
}

void list(const Command& command) {
  const auto& folders = command.import.folders;
  print(command, command.profiles.empty()
                     ? list_of_profiles(folders)
                     : listed(profile_file(command.profiles.front(), {}, folders), command.import));
}

void show(const Command& command) {
  const auto format = format_of(command);
  Console console(command.console);
  const auto profile = resolved_aloud(command, console);
  std::string out;
  if (command.options.count("explain"))
    for (const auto& key : command.options["explain"].as<std::vector<std::string>>()) {
      if (key != "all")
        out += explained(profile, key);
      else
        for (const auto& e : catalogue())
          if (profile.origins.count(std::string(e.key)) != 0) out += explained(profile, std::string(e.key)) + "\n";
    }
  print(command, !out.empty() ? out : format == "weft" ? resolved(profile) : as_prusaslicer(profile));
}

/// What can be done with profiles.
struct Deed {
  std::string_view name;
  std::size_t files;  ///< how many it takes; 0: one or more
  void (*run)(const Command&);
  bool none_too = false;  ///< it means something without a file
};
constexpr std::array deeds{Deed{"check", 0, check}, Deed{"diff", 2, diff}, Deed{"import", 1, import_one},
                           Deed{"list", 1, list, true}, Deed{"show", 0, show}};

/// The deed that the first word names. @throws Error{usage} for another word, or another number of files
const Deed& deed_of(const Command& command) {
  if (command.inputs.empty())
    throw Error{Error::Kind::usage, "check, diff, import, list or show?", "weft profile",
                "as in weft profile show printer.ini"};
  const auto& what = command.inputs.front();
  const auto found = std::find_if(deeds.begin(), deeds.end(), [&](const Deed& d) { return d.name == what; });
  if (found == deeds.end())
    throw Error{Error::Kind::usage, fmt::format("'{}' is not one of check, diff, import, list, show", what),
                "weft profile"};
  const auto where = "weft profile " + what;
  if (command.profiles.empty() && found->none_too) return *found;
  if (command.profiles.empty()) throw Error{Error::Kind::usage, "no profile was given", where};
  if (found->files != 0 && command.profiles.size() != found->files)
    throw Error{Error::Kind::usage, found->files == 1 ? "takes one file" : "takes two files", where};
  return *found;
}

std::string help(const po::options_description& options) {
  std::ostringstream out;
  out << "weft profile check FILE...   validate profiles, laid over each other in their order\n"
         "weft profile import FILE     translate a configuration of PrusaSlicer, SuperSlicer or Slic3r (config.ini, "
         "bundle, .gcode, .3mf), and say what becomes of each line\n"
         "weft profile show FILE...    print every setting as resolved\n"
         "weft profile diff A B        what is not the same in two profiles, and where it comes from\n"
         "weft profile list            the profiles that -p finds by name, in the folders of WEFT_PROFILES and beside "
         "the program\n"
         "weft profile list BUNDLE     the presets of a PrusaSlicer bundle; with --preset printer=NAME those that "
         "fit it\n\n"
      << options << "\n"
      << common_help();
  return out.str();
}

}  // namespace

po::options_description profile_options() {
  po::options_description out("Options of weft profile");
  out.add_options()(
      "explain", po::value<std::vector<std::string>>()->value_name("KEY"),
      "show: where the value of KEY comes from, and what it shadows; all: of every setting that a profile sets")(
      "format", po::value<std::string>()->value_name("weft|prusaslicer")->default_value("weft"),
      "show: in whose words");
  return out;
}

int profile(const Words& words) {
  const auto options = profile_options();
  auto command = parse_command(words, options, Result::profile);
  if (command.help) return write_output("-", help(options)), 0;
  for (std::size_t i = 1; i < command.inputs.size(); ++i) command.profiles.emplace_back(command.inputs[i]);
  deed_of(command).run(command);
  return 0;
}

}  // namespace weft::app
