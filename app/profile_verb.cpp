#include "command.h"
#include "pipeline/profile_file.h"
#include "profile/rules.h"
#include "profile_folders.h"
#include "prusaslicer/export.h"
#include "settings/catalogue.h"
#include "settings/near.h"
#include "verbs.h"

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
    const auto near = nearest_setting(key);
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
  const auto translation = import_prusaslicer(profile, profile_text(path), path, options);
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
std::string listed(const std::filesystem::path& path, const prusaslicer::PresetChoice& choice) {
  using prusaslicer::PresetKind;
  const auto entries = parse_ini(read_profile(path), path.string());
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
  if (command.help || words.empty()) {
    std::ostringstream out;
    out << "weft profile check FILE...   validate profiles, laid over each other in their order\n"
           "weft profile import FILE     translate a configuration of PrusaSlicer, SuperSlicer or Slic3r (config.ini, "
           "bundle, .gcode, .3mf), and say what becomes of each line\n"
           "weft profile show FILE...    print every setting as resolved\n"
           "weft profile diff A B        what is not the same in two profiles, and where it comes from\n"
           "weft profile list            the profiles that -p finds by name, in the folders of WEFT_PROFILES and "
           "beside "
           "the program\n"
           "weft profile list BUNDLE     the presets of a PrusaSlicer bundle; with --preset printer=NAME those that "
           "fit it\n\n"
        << options << "\n"
        << common_help();
    return write_output("-", out.str()), words.empty() ? 2 : 0;
  }
  if (command.inputs.empty())
    throw Error{Error::Kind::usage, "check, diff, import, list or show?", "weft profile",
                "as in weft profile show printer.ini"};
  const std::string what = command.inputs.front();
  for (std::size_t i = 1; i < command.inputs.size(); ++i) command.profiles.emplace_back(command.inputs[i]);
  if (what != "check" && what != "import" && what != "list" && what != "diff" && what != "show")
    throw Error{Error::Kind::usage, fmt::format("'{}' is not one of check, diff, import, list, show", what),
                "weft profile"};
  if (what == "list" && command.profiles.empty())
    return write_output(command.output.value_or("-"), list_of_profiles(command.import.folders)), 0;
  if (command.profiles.empty()) throw Error{Error::Kind::usage, "no profile was given", "weft profile " + what};

  if (what == "import" || what == "list") {
    if (command.profiles.size() != 1) throw Error{Error::Kind::usage, "takes one file", "weft profile " + what};
    const auto file = profile_file(command.profiles.front(), {}, command.import.folders);
    return write_output(command.output.value_or("-"),
                        what == "import" ? imported(file, command.import) : listed(file, command.import.presets)),
           0;
  }

  if (what == "diff") {
    if (command.profiles.size() != 2) throw Error{Error::Kind::usage, "takes two files", "weft profile diff"};
    return write_output(command.output.value_or("-"), differences(resolved_file(command, command.profiles[0]),
                                                                  resolved_file(command, command.profiles[1]))),
           0;
  }
  const auto format = command.options["format"].as<std::string>();
  if (format != "weft" && format != "prusaslicer")
    throw Error{Error::Kind::usage, fmt::format("'{}' is not one of weft, prusaslicer", format), "--format"};

  Console console(command.console);
  const auto profile = resolve(command);
  for (const auto& notice : profile.notices) console.warning(notice);
  if (what == "check") {
    const auto doubts = doubts_about(profile);
    for (const auto& doubt : doubts) console.warning(doubt);
    return console.info(fmt::format("{} settings are valid{}", catalogue().size(),
                                    doubts.empty() ? "" : fmt::format(", {} of them doubtful", doubts.size()))),
           0;
  }
  std::string out;
  if (command.options.count("explain"))
    for (const auto& key : command.options["explain"].as<std::vector<std::string>>()) {
      if (key != "all")
        out += explained(profile, key);
      else
        for (const auto& e : catalogue())
          if (profile.origins.count(std::string(e.key)) != 0) out += explained(profile, std::string(e.key)) + "\n";
    }
  write_output(command.output.value_or("-"), !out.empty()       ? out
                                             : format == "weft" ? resolved(profile)
                                                                : as_prusaslicer(profile));
  return 0;
}

}  // namespace weft::app
