// SPDX-License-Identifier: GPL-3.0-or-later
#include "command.h"

#include "core/write_file.h"
#include "key_options.h"
#include "pipeline/field_files.h"
#include "pipeline/made_at.h"
#include "pipeline/model_parts.h"
#include "pipeline/profile_file.h"
#include "pipeline/project.h"
#include "profile/tool_values.h"
#include "profile_folders.h"
#include "settings/catalogue.h"
#include "settings/value.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <unistd.h>

namespace po = boost::program_options;

namespace weft::app {

po::options_description common_options() {
  po::options_description out("Options of every verb");
  out.add_options()(
      "profile,p", po::value<std::vector<std::string>>()->value_name("FILE"),
      "an ini profile, by path or by name (`weft profile list`); repeatable, a later one overrides an earlier one")(
      "load", po::value<std::vector<std::string>>()->value_name("FILE"), "the same")(
      "preset", po::value<std::vector<std::string>>()->value_name("KIND=NAME"),
      "which preset of a PrusaSlicer bundle: print=NAME, filament=NAME, printer=NAME; repeatable")(
      "profile-root", po::value<std::string>()->value_name("DIR"),
      "profiles, and those they inherit, are read only from this folder and those of `weft profile list`")(
      "strict", po::bool_switch(), "what a PrusaSlicer profile would lose is an error, not a warning")(
      "set,s", po::value<std::vector<std::string>>()->value_name("KEY=VALUE"),
      "one setting; repeatable; overrides every profile. `--key VALUE` does the same")(
      "tool", po::value<std::vector<std::string>>()->value_name("N=FILE"),
      "the filament of tool N, an ini profile; repeatable")(
      "pause", po::value<std::vector<std::string>>()->value_name("Z[=TEXT]"),
      "the printer waits at that height (pause_at_heights); repeatable")(
      "color-change", po::value<std::vector<std::string>>()->value_name("Z[=TEXT]"),
      "other filament is put in by hand there (color_change_at_heights); repeatable")(
      "change", po::value<std::vector<std::string>>()->value_name("Z=TOOL"),
      "from there on everything is printed with T1, T0 … (tool_change_at_heights); repeatable")(
      "output,o", po::value<std::string>()->value_name("PATH"), "where the result goes; - is standard output")(
      "report", po::value<std::string>()->value_name("FILE"), "machine-readable JSON report; - is standard output")(
      "threads,j", po::value<unsigned>()->value_name("N"),
      "worker threads (default: all cores); the output does not depend on it")(
      "quiet,q", po::bool_switch(), "errors only")("verbose,v", po::bool_switch(), "debug detail")(
      "loglevel", po::value<int>()->value_name("N"),
      "the same as PrusaSlicer counts it: 0 … 5, from errors only to debug detail")(
      "log-format", po::value<std::string>()->value_name("text|json")->default_value("text"),
      "form of the messages on standard error")(
      "progress", po::value<std::string>()->value_name("auto|always|never")->default_value("auto"),
      "auto: a bar on a terminal, nothing in a pipe")("help,h", po::bool_switch(), "this text");
  return out;
}

namespace {

/// Options that are followed by a word and any number of settings: they become one word, a line each.
std::vector<std::string> gathered(const std::vector<std::string>& words) {
  const auto is_setting = [](const std::string& word) {
    const auto equals = word.find('=');
    const auto in_key = [](char c) { return c == '_' || c == '.' || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'); };
    return equals != std::string::npos && equals > 0 &&
           std::all_of(word.begin(), word.begin() + static_cast<std::ptrdiff_t>(equals), in_key);
  };
  std::vector<std::string> out;
  for (std::size_t i = 0; i < words.size(); ++i) {
    std::string word = words[i];
    const auto equals = std::min(word.find('='), word.size());
    if (const auto option = word.substr(0, equals); option == "--for" || option == "--modifier") {
      if (equals == word.size() && i + 1 < words.size()) word += "=" + words[++i];
      while (i + 1 < words.size() && is_setting(words[i + 1])) word += "\n" + words[++i];
    }
    out.push_back(std::move(word));
  }
  return out;
}

/// Program_options takes "-90" for an option: a number behind a long option is joined to it. Underscores become dashes.
std::vector<std::string> normalised(const std::vector<std::string>& words, const po::options_description& settings,
                                    const po::options_description& theirs) {
  const auto switched_off = [&](const std::string& word) -> std::string {  // --no-wipe
    if (word.rfind("--no-", 0) != 0) return {};
    const std::string key = dashed(word.substr(5));
    for (const auto* options : {&settings, &theirs})
      if (const auto* option = options->find_nothrow(key, false); option && option->semantic()->min_tokens() == 0)
        return "--" + key + (options == &settings ? "=false" : "=0");
    return {};
  };
  std::vector<std::string> out;
  for (const auto& word : words) {
    const bool number =
        word.size() > 1 && word[0] == '-' && (std::isdigit(static_cast<unsigned char>(word[1])) != 0 || word[1] == '.');
    if (number && !out.empty() && out.back().rfind("--", 0) == 0 && out.back().find('=') == std::string::npos) {
      out.back() += "=" + word;
    } else if (const auto off = switched_off(word); !off.empty()) {
      out.push_back(off);
    } else if (word.rfind("--", 0) == 0) {
      const auto equals = std::min(word.find('='), word.size());
      out.push_back(dashed(word.substr(0, equals)) + word.substr(equals));
    } else {
      out.push_back(word);
    }
  }
  return out;
}

template <class E>
E choice(const std::string& option, const std::string& text, std::initializer_list<std::pair<const char*, E>> choices) {
  std::string known;
  for (const auto& [name, value] : choices) {
    if (text == name) return value;
    known += std::string(known.empty() ? "" : ", ") + name;
  }
  throw Error{Error::Kind::usage, fmt::format("'{}' is not one of {}", text, known), option};
}

std::pair<std::string, std::string> assignment(const std::string& text, const std::string& option = "--set") {
  const auto equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    throw Error{Error::Kind::usage, fmt::format("'{}' is not KEY=VALUE", text), option,
                "as in " + option + (option == "--set" ? "" : " …") + " layer_height=0.2"};
  return {std::string(value::trimmed(text.substr(0, equals))), text.substr(equals + 1)};
}

void take_preset(prusaslicer::PresetChoice& presets, const std::string& text) {
  const auto equals = text.find('=');
  const auto kind = text.substr(0, equals);
  auto* name = kind == "print"      ? &presets.print
               : kind == "filament" ? &presets.filament
               : kind == "printer"  ? &presets.printer
                                    : nullptr;
  if (!name || equals == std::string::npos || equals + 1 == text.size())
    throw Error{Error::Kind::usage, fmt::format("'{}' is not print=NAME, filament=NAME or printer=NAME", text),
                "--preset"};
  *name = text.substr(equals + 1);
}

[[noreturn]] void rethrow_as_usage(const po::error& problem) {
  if (const auto* unknown = dynamic_cast<const po::unknown_option*>(&problem)) {
    const auto name = unknown->get_option_name();
    const auto near = nearest_key(name.substr(std::min(name.find_first_not_of('-'), name.size())));
    throw Error{Error::Kind::usage, "unknown option", name,
                near.empty() ? "see --help" : fmt::format("did you mean --{}?", dashed(near))};
  }
  throw Error{Error::Kind::usage, problem.what(), {}, "see --help"};
}

/// Options of verbs whose value is a file that is written.
constexpr std::array written = {"output", "report", "preview"};

/// @throws Error{usage} for what is no folder
std::filesystem::path checked_folder(const std::string& typed) {
  std::error_code error;
  if (typed.empty() || !std::filesystem::is_directory(typed, error))
    throw Error{Error::Kind::usage, fmt::format("'{}' is not a folder", typed), "--profile-root"};
  return typed;
}

/// What is read is known before anything that is written is looked at.
void check_files(Command& command, Result result) {
  for (const auto& input : pipeline::files_of(command.inputs)) command.files.reads(input);
  for (const auto& mark : command.marks)
    if (!mark.source.starts_with("box:")) command.files.reads(mark.source);
  for (const auto& profile : command.profiles) command.files.reads(profile.string());
  for (const std::string option : written)
    if (command.options.count(option))
      command.files.writes(command.options[option].as<std::string>(), option == "output" ? "-o" : "--" + option,
                           option == "output" && result == Result::profile);
  for (const auto* option : {"report", "preview"})
    if (command.options.count(option)) check_writable(command.options[option].as<std::string>());
}

/// How much is said, and in which form.
ConsoleOptions console_options(const po::variables_map& o) {
  ConsoleOptions console;
  console.verbosity = o["quiet"].as<bool>()     ? Verbosity::quiet
                      : o["verbose"].as<bool>() ? Verbosity::detail
                                                : Verbosity::normal;
  if (o.count("loglevel")) {
    const int level = o["loglevel"].as<int>();
    if (level < 0 || level > 5)
      throw Error{Error::Kind::usage, fmt::format("{} is outside 0 … 5", level), "--loglevel"};
    console.verbosity = level <= 1 ? Verbosity::quiet : level >= 4 ? Verbosity::detail : console.verbosity;
  }
  console.format = choice<LogFormat>("--log-format", o["log-format"].as<std::string>(),
                                     {{"text", LogFormat::text}, {"json", LogFormat::json}});
  console.progress = choice<ProgressMode>(
      "--progress", o["progress"].as<std::string>(),
      {{"auto", ProgressMode::automatic}, {"always", ProgressMode::always}, {"never", ProgressMode::never}});
  return console;
}

}  // namespace

int copies_in(const std::string& text) {
  int count = 0;
  try {
    value::parse(text, Unit::none, count);
  } catch (const std::invalid_argument&) {
    throw Error{Error::Kind::usage, fmt::format("'{}' is not N, and not NAME=N", text), "--copies",
                "as in --copies 4, or --copies lid=4"};
  }
  if (count < 1 || count > 10000)
    throw Error{Error::Kind::usage, fmt::format("{} is outside 1 … 10000", count), "--copies"};
  return count;
}

namespace {

/// What an option marks of the model before it.
std::optional<mesh::MarkKind> mark_of(std::string_view option) {
  if (option == "support-enforcer") return mesh::MarkKind::support_enforcer;
  if (option == "support-blocker") return mesh::MarkKind::support_blocker;
  if (option == "support-mesh") return mesh::MarkKind::support;
  if (option == "modifier") return mesh::MarkKind::modifier;
  if (option == "negative") return mesh::MarkKind::negative;
  return std::nullopt;
}

/// The setting that an option adds a height to; null: it is none of them.
const CatalogueEntry* heights_of(std::string_view option) {
  constexpr std::array<std::array<std::string_view, 2>, 3> options{{{"pause", "pause_at_heights"},
                                                                    {"color-change", "color_change_at_heights"},
                                                                    {"change", "tool_change_at_heights"}}};
  for (const auto& [name, key] : options)
    if (option == name) return find_setting(key);
  return nullptr;
}

/// --tool 1=petg.ini
std::pair<int, std::string> tool_of(const std::string& text) {
  const auto equals = text.find('=');
  const std::size_t begin = text.starts_with('T') ? 1 : 0;
  int number = -1;
  try {
    value::parse(text.substr(begin, equals == std::string::npos ? 0 : equals - begin), Unit::none, number);
  } catch (const std::invalid_argument&) {
    number = -1;
  }
  if (equals == std::string::npos || equals + 1 == text.size() || number < 0 || number > 31)
    throw Error{Error::Kind::usage, fmt::format("'{}' is not N=FILE", text), "--tool",
                "as in --tool 1=petg.ini; tools are counted from 0"};
  return {number, text.substr(equals + 1)};
}

/// One setting of the command line; an option beside profiles where it is one.
void apply_setting(Profile& profile, const std::string& key, const std::string& text, const ImportOptions& options) {
  constexpr std::string_view file_of_tool = ".inherits";
  if (key.starts_with("tool.") && key.ends_with(file_of_tool)) {
    const auto [number, file] = tool_of(key.substr(5, key.size() - 5 - file_of_tool.size()) + "=" + text);
    return apply_tool_file(profile, number, file, options);
  }
  if (const auto* heights = key.starts_with("--") ? heights_of(key.substr(2)) : nullptr) {
    const auto before = heights->print(profile.settings);
    return apply_value(profile, std::string(heights->key), before + (before.empty() ? "" : "; ") + text, key);
  }
  apply_value(profile, key, text, "--set " + key);
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> out;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) out.push_back(line);
  if (out.empty()) out.emplace_back();
  return out;
}

/// NAME=…, of which the name may hold `=` itself. @throws Error{usage}
std::pair<Named, std::string> named_value(const std::string& text, const std::string& option, const char* form) {
  const auto equals = text.rfind('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
    throw Error{Error::Kind::usage, fmt::format("'{}' is not {}", text, form), option, fmt::format("as in {}", form)};
  return {Named{text.substr(0, equals), {}, {}}, text.substr(equals + 1)};
}

ByName::Place place_in(const std::string& text) {
  constexpr auto form = "NAME=X,Y[,DEG]";
  const auto [named, rest] = named_value(text, "--place", form);
  std::vector<double> numbers;
  std::istringstream in(rest);
  try {
    for (std::string number; std::getline(in, number, ',');) value::parse(number, Unit::none, numbers.emplace_back());
  } catch (const std::invalid_argument&) {
    numbers.clear();
  }
  const auto beyond = [](double v) { return !(std::abs(v) <= 16000); };
  if (numbers.size() < 2 || numbers.size() > 3 || std::any_of(numbers.begin(), numbers.end(), beyond))
    throw Error{Error::Kind::usage, fmt::format("'{}' is not {} in mm and degrees", text, form), "--place",
                "as in --place lid=60,40,90"};
  return {named, {from_mm(numbers[0]), from_mm(numbers[1])}, numbers.size() > 2 ? numbers[2] : 0.0};
}

/// What is said of single objects.
void take_by_name(Command& command, const po::option& option) {
  if (option.string_key == "place") command.by_name.places.push_back(place_in(option.value.at(0)));
  if (option.string_key == "copies") {
    const auto& text = option.value.at(0);
    if (text.find('=') == std::string::npos) return;
    const auto [named, count] = named_value(text, "--copies", "NAME=N");
    command.by_name.copies.push_back({named, copies_in(count)});
  }
  if (option.string_key != "for") return;
  const auto lines = lines_of(option.value.at(0));
  if (lines.size() < 2)
    throw Error{Error::Kind::usage, fmt::format("'{}': no setting follows", lines.front()), "--for",
                "as in --for lid infill_sparse_density=60"};
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const auto [key, text] = assignment(lines[i], "--for");
    command.by_name.settings.push_back({{lines.front(), {}, {}}, key, text, "--for " + lines.front()});
  }
}

/// A word whose place among the others matters: models and their marks, profiles, settings.
/// @param settings, theirs the options that are weft's and PrusaSlicer's keys
void take_in_order(Command& command, const po::option& option, const po::options_description& settings,
                   const po::options_description& theirs) {
  if (const auto kind = mark_of(option.string_key)) {
    if (command.inputs.empty())
      throw Error{Error::Kind::usage, "stands before any model", "--" + option.string_key, "name the model first"};
    auto lines = lines_of(option.value.at(0));
    ModelMark mark{command.inputs.size() - 1, *kind, lines.front()};
    for (std::size_t i = 1; i < lines.size(); ++i) mark.settings.push_back(assignment(lines[i], "--modifier"));
    if (*kind == mesh::MarkKind::modifier && mark.settings.empty())
      throw Error{Error::Kind::usage, fmt::format("'{}' is to modify nothing", lines.front()), "--modifier",
                  "as in --modifier grip.stl infill_sparse_density=60"};
    command.marks.push_back(std::move(mark));
  }
  take_by_name(command, option);
  if (option.string_key == "tool") {
    const auto [number, file] = tool_of(option.value.at(0));
    command.settings.emplace_back(fmt::format("tool.{}.inherits", number), file);
  }
  if (heights_of(option.string_key)) command.settings.emplace_back("--" + option.string_key, option.value.at(0));
  if (option.string_key == "set")
    command.settings.push_back(assignment(option.value.at(0)));
  else if (settings.find_nothrow(option.string_key, false))
    command.settings.emplace_back(option.string_key, option.value.empty() ? "true" : option.value[0]);
  else if (theirs.find_nothrow(option.string_key, false))
    command.import.options.emplace_back(underscored(option.string_key), option.value.empty() ? "1" : option.value[0]);
  else if (option.string_key == "profile" || option.string_key == "load")
    command.profiles.emplace_back(option.value.at(0));
  else if (option.string_key == "input")
    command.inputs.push_back(option.value.at(0));
}

}  // namespace

Command parse_command(const std::vector<std::string>& words, const po::options_description& verb_options,
                      Result result) {
  po::options_description all, hidden;
  hidden.add_options()("input", po::value<std::vector<std::string>>());
  const auto joined = gathered(words);
  const auto keys = keys_typed(joined);
  const auto settings = setting_options(keys), foreign = prusaslicer_options(keys);
  po::options_description theirs;  // what the verb itself understands means that
  for (const auto& option : foreign.options())
    if (verb_options.find_nothrow(option->long_name(), false) == nullptr) theirs.add(option);
  all.add(common_options()).add(verb_options).add(hidden).add(settings).add(theirs);
  po::positional_options_description positional;
  positional.add("input", -1);

  Command command;
  try {
    const auto typed = normalised(joined, settings, foreign);
    const auto style = po::command_line_style::unix_style & ~po::command_line_style::allow_guessing;
    const auto parsed = po::command_line_parser(typed).options(all).positional(positional).style(style).run();
    po::store(parsed, command.options);
    po::notify(command.options);
    for (const auto& option : parsed.options) take_in_order(command, option, settings, theirs);
  } catch (const po::error& problem) {
    rethrow_as_usage(problem);
  }
  const auto& o = command.options;
  if (o.count("output")) command.output = o["output"].as<std::string>();
  if (o.count("report")) command.report = o["report"].as<std::string>();
  if (o.count("threads")) {
    command.threads = o["threads"].as<unsigned>();
    if (command.threads == 0 || command.threads > 1024)
      throw Error{Error::Kind::usage, "must be 1 … 1024", "--threads"};
  }
  command.import.folders = profile_folders();
  if (const char* epoch = std::getenv("SOURCE_DATE_EPOCH")) command.made_at = pipeline::parse_epoch(epoch);
  command.import.strict = o["strict"].as<bool>();
  if (o.count("profile-root")) command.import.root = checked_folder(o["profile-root"].as<std::string>());
  if (o.count("preset"))
    for (const auto& text : o["preset"].as<std::vector<std::string>>()) take_preset(command.import.presets, text);
  command.help = o["help"].as<bool>();
  command.console = console_options(o);
  if (!command.help) check_files(command, result);
  return command;
}

std::string common_help() {
  std::ostringstream out;
  out << common_options();
  return out.str();
}

Profile resolve(const Command& command) {
  Profile profile;
  for (const auto& file : command.profiles) apply_profile(profile, file, command.import);
  const int plate = command.options.count("plate") ? command.options["plate"].as<int>() : 0;
  (void)apply_project(profile, command.inputs, command.profiles.empty(), plate, command.import);
  apply_options(profile, command.import);
  for (const auto& [key, text] : command.settings) apply_setting(profile, key, text, command.import);
  for (const auto& field : pipeline::field_files(profile.settings, command.by_name, command.marks))
    refuse_outside(field, command.import);
  check_consistency(profile);
  if (command.made_at) pipeline::tell_time(profile, *command.made_at);
  (void)files_of(command, profile);
  return profile;
}

Files files_of(const Command& command, const Profile& profile) {
  Files files = command.files;
  for (const auto& parent : profile.parents) files.reads(parent.string());
  for (const auto& field : pipeline::field_files(profile.settings, command.by_name, command.marks)) files.reads(field);
  return files;
}

Point parse_point(const std::string& text, const std::string& option) {
  Ring point;
  std::string spelled = text;
  std::replace(spelled.begin(), spelled.end(), ',', 'x');
  try {
    value::parse(spelled, Unit::none, point);
  } catch (const std::invalid_argument&) {
    point.clear();
  }
  if (point.size() != 1)
    throw Error{Error::Kind::usage, fmt::format("'{}' is not X,Y in mm", text), option, "as in " + option + " 110,110"};
  return point.front();
}

void write_output(const std::string& destination, std::string_view text) {
  if (destination == "-")
    write_standard_output(text);
  else
    write_file(destination, text);
}

}  // namespace weft::app
