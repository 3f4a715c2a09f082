#include <fmt/format.h>

#include <sstream>

#include "command.h"
#include "settings/catalogue.h"
#include "verbs.h"

namespace po = boost::program_options;

namespace weft::app {
namespace {

std::string explained(const Profile& profile, const std::string& key) {
  const auto* entry = find_setting(key);
  if (!entry) {
    const auto near = nearest_setting(key);
    throw Error{Error::Kind::settings, fmt::format("unknown setting '{}'", key), "--explain", near.empty() ? "" : fmt::format("did you mean '{}'?", near)};
  }
  std::string out = fmt::format("{} = {} {}\n  {}\n", entry->key, entry->print(profile.settings), entry->unit, entry->meaning);
  const auto at = profile.origins.find(std::string(entry->key));
  if (at == profile.origins.end()) return out + "  the default\n";
  for (auto origin = at->second.rbegin(); origin != at->second.rend(); ++origin)
    out += fmt::format("  {} {} = {}\n", origin == at->second.rbegin() ? "set by " : "shadows", origin->where, origin->text);
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

/// A PrusaSlicer config.ini as one of weft's, with the fate of each line that has none here.
std::string imported(const std::filesystem::path& path) {
  Profile profile;
  const auto translation = import_prusaslicer(profile, path);
  std::string out = fmt::format("; from {}\n\n", path.filename().string());
  std::string section;
  for (const auto& e : catalogue()) {
    const auto at = profile.origins.find(std::string(e.key));
    if (at == profile.origins.end()) continue;
    if (e.section != section) out += fmt::format("[{}]\n", section = e.section);
    out += fmt::format("{} = {}\n", e.key, e.print(profile.settings));
  }
  const auto list = [&](std::string_view title, const std::vector<prusaslicer::Remark>& remarks) {
    if (remarks.empty()) return;
    out += fmt::format("\n; {} ({}):\n", title, remarks.size());
    for (const auto& r : remarks) out += fmt::format(";   line {}: {} = {}{}{}\n", r.line, r.key, r.text.substr(0, 60), r.why.empty() ? "" : ": ", r.why);
  };
  list("translated to the nearest", translation.approximated);
  list("not supported yet, and set to a value that would change the print", translation.unsupported);
  list("not needed here", translation.not_needed);
  list("not one of PrusaSlicer's keys", translation.unknown);
  return out;
}

}  // namespace

int profile(const Words& words) {
  po::options_description options("Options of weft profile");
  options.add_options()("explain", po::value<std::vector<std::string>>()->value_name("KEY"), "show: where the value of KEY comes from, and what it shadows");
  auto command = parse_command(words, options);
  if (command.help || words.empty()) {
    std::ostringstream out;
    out << "weft profile check FILE...   validate profiles, laid over each other in their order\n"
           "weft profile import FILE     translate a PrusaSlicer, SuperSlicer or Slic3r config.ini, and say what becomes of each line\n"
           "weft profile show FILE...    print every setting as resolved\n\n"
        << options << "\n" << common_help();
    return fmt::print("{}", out.str()), words.empty() ? 2 : 0;
  }
  if (command.inputs.empty()) throw Error{Error::Kind::usage, "check, import or show?", "weft profile", "as in weft profile show printer.ini"};
  const std::string what = command.inputs.front();
  for (std::size_t i = 1; i < command.inputs.size(); ++i) command.profiles.emplace_back(command.inputs[i]);
  if (what != "check" && what != "import" && what != "show")
    throw Error{Error::Kind::usage, fmt::format("'{}' is not one of check, import, show", what), "weft profile"};
  if (command.profiles.empty()) throw Error{Error::Kind::usage, "no profile was given", "weft profile " + what};

  if (what == "import") {
    if (command.profiles.size() != 1) throw Error{Error::Kind::usage, "takes one file", "weft profile import"};
    return write_output(command.output.value_or("-"), imported(command.profiles.front())), 0;
  }

  Console console(command.console);
  const auto profile = resolve(command);
  for (const auto& notice : profile.notices) console.warning(notice);
  if (what == "check") return console.info(fmt::format("{} settings are valid", catalogue().size())), 0;
  std::string out;
  if (command.options.count("explain"))
    for (const auto& key : command.options["explain"].as<std::vector<std::string>>()) out += explained(profile, key);
  write_output(command.output.value_or("-"), out.empty() ? resolved(profile) : out);
  return 0;
}

}  // namespace weft::app
