// SPDX-License-Identifier: GPL-3.0-or-later
#include "profile/profile.h"

#include "core/error.h"
#include "core/file_bytes.h"
#include "profile/tool_values.h"
#include "prusaslicer/embedded.h"
#include "prusaslicer/import.h"
#include "prusaslicer/keys.h"
#include "settings/catalogue.h"
#include "settings/ini.h"
#include "settings/modifier_list.h"
#include "settings/tools.h"
#include "settings/value.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

namespace weft {
namespace {

/// A configuration of PrusaSlicer's family as flat lines.
struct Foreign {
  std::vector<IniEntry> lines;
  prusaslicer::PresetValues histories;  ///< of a bundle: where each line comes from, and what it shadows
  bool complete = false;                ///< what is not said is PrusaSlicer's default
  Notices notices;
};

void refuse_twice(const std::vector<IniEntry>& entries, const std::string& path) {
  std::map<std::pair<int, std::string_view>, int> seen;
  for (const auto& e : entries) {
    const auto [first, is_new] =
        seen.emplace(std::pair<int, std::string_view>(tool_of_section(e.section).value_or(-1), e.key), e.line);
    if (!is_new)
      throw Error{Error::Kind::settings, fmt::format("'{}' was already given on line {}", e.key, first->second),
                  fmt::format("{}:{}", path, e.line), "keep one of the two"};
  }
}

Foreign chosen_of(const std::vector<IniEntry>& entries, const std::string& path, const ImportOptions& options) {
  const auto bundle = prusaslicer::read_bundle(entries, path);
  auto selection = prusaslicer::select(bundle, options.presets);
  Foreign out{{}, prusaslicer::flattened(selection), true, std::move(selection.notices)};
  for (const auto& [key, history] : out.histories) out.lines.push_back(history.back());
  return out;
}

/// Line numbers below 0 are those of options.
std::string place_of(const std::string& path, int line, const std::string& key) {
  if (line == 0) return path + ", PrusaSlicer's default";
  if (line > 0) return fmt::format("{}:{}", path, line);
  std::string option = "--" + key;
  std::replace(option.begin(), option.end(), '_', '-');
  return option;
}

/// Where a profile said the reach of this machine itself, and did not derive it from custom G-code; null: nowhere.
const Origin* known_reach(const Profile& profile, const std::string& key) {
  const auto origins = profile.origins.find(key);
  if (origins == profile.origins.end() || !origins->second.back().source.empty()) return nullptr;
  return &origins->second.back();
}

/// PrusaSlicer's profiles hold no reach: theirs is where their custom G-code goes. Where a profile before it has said
/// how far this machine goes, that holds, and such moves are judged by it.
/// @param bed the print surface that the profile before was for
void take_reach(Profile& profile, const prusaslicer::Assignment& a, const std::string& path, const Box& bed) {
  const auto why = a.source.substr(a.source.rfind(", and ") + 6);
  const auto* known = known_reach(profile, a.key);
  if (known != nullptr && box_of(print_surface(profile.settings.machine)) == bed) {
    profile.notices.push_back(
        {"reach_kept", fmt::format("{}: {}; {} = {} ({}) holds", path, why, a.key, known->text, known->where)});
    return;
  }
  apply_value(profile, a.key, a.text, place_of(path, a.line, a.theirs));
  profile.origins[a.key].back().source = a.source;
  profile.notices.push_back(
      {"reach_derived", fmt::format("{}: {} = {}: PrusaSlicer's profiles hold no reach, {}; set it to what the printer "
                                    "can do",
                                    path, a.key, a.text, why)});
}

prusaslicer::Translation apply_foreign(Profile& profile, Foreign foreign, const std::string& path) {
  const auto translated = prusaslicer::translate(std::move(foreign.lines), path, foreign.complete);
  const Box bed = box_of(print_surface(profile.settings.machine));
  for (const auto& a : translated.assignments) {
    if (a.key.starts_with("machine_reach")) continue;
    if (const auto known = foreign.histories.find(a.theirs); known != foreign.histories.end())
      for (const auto& e : known->second)
        if (e.line != a.line)
          profile.origins[a.key].push_back(
              {fmt::format("{}:{}", path, e.line), e.value, fmt::format("[{}] {} = {}", e.section, e.key, e.value)});
    apply_value(profile, a.key, a.text, place_of(path, a.line, a.theirs));
    profile.origins[tool_key(a.key) ? "tool_settings" : a.key].back().source = a.source;
  }
  for (const auto& a : translated.assignments)
    if (a.key.starts_with("machine_reach")) take_reach(profile, a, path, bed);
  profile.notices.insert(profile.notices.end(), foreign.notices.begin(), foreign.notices.end());
  return translated;
}

/// All the keys of one fate in one notice, each with its line, so that none is silent and none buries another.
void note(Profile& profile, const char* code, const std::vector<prusaslicer::Remark>& remarks, const std::string& path,
          std::string_view what, std::size_t most) {
  if (remarks.empty()) return;
  std::string list;
  for (std::size_t i = 0; i < remarks.size() && i < most; ++i)
    list += fmt::format("{}{} = {} ({}{}{})", i == 0 ? "" : ", ", remarks[i].key, remarks[i].text.substr(0, 40),
                        remarks[i].line < 0 ? "option" : fmt::format("line {}", remarks[i].line),
                        remarks[i].why.empty() ? "" : ": ", remarks[i].why);
  if (remarks.size() > most)
    list += fmt::format(" and {} more, which `weft profile import` lists", remarks.size() - most);
  profile.notices.push_back({code, fmt::format("{}: {}: {}", path, what, list)});
}

void note_losses(Profile& profile, const prusaslicer::Translation& translated, const std::string& path) {
  note(profile, "prusaslicer_key_approximated", translated.approximated, path, "translated to the nearest", 1000);
  note(profile, "prusaslicer_key_unsupported", translated.unsupported, path,
       "would change the print and has no effect here", 1000);
  note(profile, "prusaslicer_key_unknown", translated.unknown, path, "not one of PrusaSlicer's keys, without effect",
       12);
}

void refuse_losses(const prusaslicer::Translation& translated, const std::string& path) {
  for (const auto& [list, what] : {std::pair{&translated.unsupported, "is not supported and would change the print"},
                                   {&translated.approximated, "can only be translated to the nearest"},
                                   {&translated.unknown, "is not one of PrusaSlicer's keys"}})
    if (!list->empty()) {
      const auto& r = list->front();
      const auto all = translated.unsupported.size() + translated.approximated.size() + translated.unknown.size();
      throw Error{Error::Kind::settings, fmt::format("{} = {} {}", r.key, r.text.substr(0, 40), what),
                  fmt::format("{}:{}", path, r.line),
                  all > 1 ? fmt::format("--strict; {} more such lines, `weft profile import` lists them", all - 1)
                          : "--strict"};
    }
}

/// What was said beside the file holds instead of what it says.
void take_in(Foreign& foreign, const ImportOptions& options) {
  for (const auto& [key, text] : options.options) {
    std::erase_if(foreign.lines, [&key = key](const IniEntry& e) { return e.key == key; });
    foreign.histories.erase(key);
    foreign.lines.push_back({{}, key, text, -1});
  }
}

/// The text as lines of PrusaSlicer's family, or nothing when it is weft's own.
std::optional<Foreign> foreign_of(std::string_view text, const std::string& path, const std::vector<IniEntry>& entries,
                                  bool embedded, const ImportOptions& options) {
  Foreign out;
  if (!embedded && prusaslicer::is_bundle(entries))
    out = chosen_of(entries, path, options);
  else if (prusaslicer::recognises(embedded ? std::string_view() : text, entries))
    out.lines = entries;
  else
    return std::nullopt;
  take_in(out, options);
  return out;
}

/// Does the text begin with `#FF8000`, and with nothing more of a word?
bool is_colour(std::string_view text) {
  const auto end = text.find_first_not_of("0123456789abcdefABCDEF", 1);
  return text.front() == '#' && std::min(end, text.size()) == 7 &&
         (end == std::string_view::npos || text[end] == ',' || text[end] == ' ' || text[end] == '\t');
}

/// A value without the comment behind it: ` #` or ` ;` and what follows. Texts may hold both, and G-code has comments
/// of its own; `;` also parts areas.
std::string without_comment(const IniEntry& e) {
  const auto* entry = find_setting(e.key);
  if (!entry || entry->type == "text") return e.value;
  for (std::size_t i = 0; i < e.value.size(); ++i) {
    if (e.value[i] != '#' && (e.value[i] != ';' || entry->type == "polygons")) continue;
    if (entry->type == "colour" && is_colour(std::string_view(e.value).substr(i))) continue;
    if (i == 0 || e.value[i - 1] == ' ' || e.value[i - 1] == '\t')
      return std::string(value::trimmed(std::string_view(e.value).substr(0, i)));
  }
  return e.value;
}

/// The path without links and dots. @throws Error{settings} for links in a circle, and names that no system takes
std::filesystem::path canonical(const std::filesystem::path& path, const std::string& where) {
  std::error_code error;
  auto out = std::filesystem::weakly_canonical(path, error);
  if (error)
    throw Error{Error::Kind::settings, fmt::format("'{}' leads nowhere: {}", path.string(), error.message()), where,
                "check the path"};
  return out;
}

/// A value that names a file, from the folder of the profile that says it; others as they are.
std::string beside(const std::filesystem::path& profile, std::string_view key, std::string value) {
  const auto at = [&](const std::string& file) { return (profile.parent_path() / file).lexically_normal().string(); };
  if (key == "infill_modifiers") try {
      auto meshes = parse_modifier_list(value);
      for (auto& mesh : meshes) mesh.file = at(mesh.file);
      return text_of(meshes);
    } catch (const std::invalid_argument&) {
      return value;  // refused by check_infill
    }
  if (value.empty() || std::find(infill_files.begin(), infill_files.end(), key) == infill_files.end()) return value;
  return at(value);
}

/// @param chain files that are being read @throws Error{settings} when `parent` is one of them
void refuse_circle(const std::vector<std::filesystem::path>& chain, const std::filesystem::path& parent,
                   const std::string& called, const std::string& where) {
  if (std::find(chain.begin(), chain.end(), canonical(parent, where)) != chain.end())
    throw Error{Error::Kind::settings, fmt::format("inherits '{}', which inherits this file", called), where,
                "break the circle"};
  if (chain.size() > 100) throw Error{Error::Kind::settings, "more than 100 generations of ancestors", where, {}};
}

/// What a file says of single tools, over what it says of all.
void apply_tools(Profile& profile, const std::vector<IniEntry>& entries, const std::filesystem::path& path,
                 ImportOptions options, const std::vector<std::filesystem::path>& chain) {
  options.within = chain;
  for (const auto& e : entries) {
    const auto tool = tool_of_section(e.section);
    if (!tool) continue;
    const auto where = fmt::format("{}:{}", path.string(), e.line);
    if (e.key != "inherits") {
      apply_value(profile, fmt::format("tool.{}.{}", *tool, e.key), without_comment(e), where);
      continue;
    }
    const auto parent =
        find_profile(e.value, path.parent_path(), options.folders).value_or(path.parent_path() / e.value);
    refuse_circle(chain, parent, e.value, where);
    apply_tool_file(profile, *tool, parent, options);
  }
}

void apply_text(Profile& profile, std::string_view text, const std::filesystem::path& path,
                const ImportOptions& options, std::vector<std::filesystem::path>& chain) {
  const auto name = path.string();
  auto embedded = prusaslicer::embedded_config(text, name);
  const auto entries = embedded ? std::move(*embedded) : parse_ini(text, name);
  const bool bundle = !embedded && prusaslicer::is_bundle(entries);
  if (!bundle) refuse_twice(entries, name);
  if (auto foreign = foreign_of(text, name, entries, embedded.has_value(), options)) {
    const auto translated = apply_foreign(profile, std::move(*foreign), name);
    if (options.strict) refuse_losses(translated, name);
    return note_losses(profile, translated, name);
  }
  refuse_odd_tools(entries, name);
  chain.push_back(canonical(path, name));
  for (const auto& e : entries) {
    if (e.key != "inherits" || tool_of_section(e.section)) continue;
    const auto where = fmt::format("{}:{}", name, e.line);
    const auto found = find_profile(e.value, path.parent_path(), options.folders);
    const auto parent = found.value_or(path.parent_path() / e.value);
    refuse_circle(chain, parent, e.value, where);
    if (std::error_code unknown; !std::filesystem::is_regular_file(parent, unknown))
      throw Error{Error::Kind::settings, fmt::format("inherits '{}', which is not there", parent.string()), where,
                  "the path is relative to this file, or a name that `weft profile list` knows"};
    profile.parents.push_back(parent);
    apply_text(profile, read_profile(parent, options), parent, options, chain);
  }
  for (const auto& e : entries)
    if (e.key != "inherits" && !tool_of_section(e.section))
      apply_value(profile, e.key, beside(path, e.key, without_comment(e)), fmt::format("{}:{}", name, e.line));
  apply_tools(profile, entries, path, options, chain);
  chain.pop_back();
}

/// Is the file, where all links lead, in the folder?
bool is_in(const std::filesystem::path& file, const std::filesystem::path& folder) {
  std::error_code error;
  const auto whole = std::filesystem::canonical(folder, error);
  return !error && std::mismatch(whole.begin(), whole.end(), file.begin(), file.end()).first == whole.end();
}

}  // namespace

void refuse_outside(const std::filesystem::path& path, const ImportOptions& options) {
  if (options.root.empty()) return;
  const auto file = canonical(path, path.string());
  if (is_in(file, options.root)) return;
  for (const auto& folder : options.folders)
    if (is_in(file, folder)) return;
  throw Error{Error::Kind::file, "lies outside the folder that profiles and what they name may come from",
              path.string(), fmt::format("--profile-root is {}", options.root.string())};
}

std::string read_profile(const std::filesystem::path& path, const ImportOptions& options) {
  refuse_outside(path, options);
  std::error_code error;
  if (std::filesystem::is_directory(path, error))
    throw Error{Error::Kind::file, "is a folder, not a profile", path.string(), "name an ini file in it"};
  constexpr std::uintmax_t most_bytes = std::uintmax_t{2} << 30;  // G-code that holds one may be large
  if (const auto bytes = std::filesystem::file_size(path, error); !error && bytes > most_bytes)
    throw Error{Error::Kind::file, fmt::format("of {} MB is no profile", bytes >> 20), path.string(), "check the path"};
  return std::string(FileBytes(path.string()).view());
}

void apply_text(Profile& profile, std::string_view text, const std::filesystem::path& path,
                const ImportOptions& options) {
  auto chain = options.within;
  apply_text(profile, text, path, options, chain);
}

void apply_options(Profile& profile, const ImportOptions& options) {
  if (options.options.empty()) return;
  const auto taken = [&](const std::string& key) {
    for (const auto& [ours, history] : profile.origins)
      for (const auto& origin : history)
        if (origin.where == place_of({}, -1, key)) return true;
    return false;
  };
  ImportOptions rest = options;
  std::erase_if(rest.options, [&](const auto& option) { return taken(option.first); });
  if (rest.options.empty()) return;
  const auto& s = profile.settings;
  Foreign foreign;  // what shares are of
  foreign.lines = {{{}, "nozzle_diameter", value::print(s.machine.nozzle_diameter, Unit::mm), 0},
                   {{}, "layer_height", value::print(s.layers.layer_height, Unit::mm), 0}};
  take_in(foreign, rest);
  const auto translated = apply_foreign(profile, std::move(foreign), "the command line");
  if (options.strict) refuse_losses(translated, "the command line");
  note_losses(profile, translated, "the command line");
}

void apply_file(Profile& profile, const std::filesystem::path& path, const ImportOptions& options) {
  const auto found = profile_file(path, {}, options.folders);
  apply_text(profile, read_profile(found, options), found, options);
}

prusaslicer::Translation import_prusaslicer(Profile& profile, std::string_view text, const std::filesystem::path& path,
                                            const ImportOptions& options) {
  const auto name = path.string();
  auto embedded = prusaslicer::embedded_config(text, name);
  const auto entries = embedded ? std::move(*embedded) : parse_ini(text, name);
  if (embedded || !prusaslicer::is_bundle(entries)) refuse_twice(entries, name);
  auto foreign = foreign_of(text, name, entries, embedded.has_value(), options);
  if (!foreign)
    throw Error{Error::Kind::settings, "holds no configuration of PrusaSlicer, SuperSlicer or Slic3r", name,
                "weft's own profiles need no import"};
  const auto translated = apply_foreign(profile, std::move(*foreign), name);
  if (options.strict) refuse_losses(translated, name);
  return translated;
}

std::string_view nearest_key(std::string_view wrong) {
  return nearest_setting(wrong, prusaslicer::name_of);
}

namespace {

/// What is none may be a line of a file that is no profile, and is not said.
bool looks_like_a_key(std::string_view text) {
  return text.size() <= 64 && std::all_of(text.begin(), text.end(), [](char c) {
           return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
         });
}

}  // namespace

void apply_value(Profile& profile, const std::string& key, const std::string& text, const std::string& where) {
  if (const auto of_tool = tool_key(key))
    return apply_tool_value(profile, of_tool->first, of_tool->second, text, where);
  const auto* entry = find_setting(key);
  if (!entry) {
    const auto near = nearest_key(key);
    throw Error{Error::Kind::settings, looks_like_a_key(key) ? fmt::format("unknown setting '{}'", key) : "no setting",
                where, near.empty() ? "`weft settings` lists them all" : fmt::format("did you mean '{}'?", near)};
  }
  if (listed_by_tool(*entry)) {
    // One value holds for all tools.
    std::erase_if(profile.settings.tools.tool_settings, [&](const ToolValue& v) { return v.key == entry->key; });
    if (text.find(',') != std::string::npos) return apply_list(profile, *entry, text, where);
  }
  entry->lay(profile.settings, read_value(*entry, text, where));
  profile.origins[std::string(entry->key)].push_back({where, text, {}});
}

std::string origin_of(const Profile& profile, const std::string& key) {
  const auto at = profile.origins.find(key);
  return at == profile.origins.end() ? "default" : at->second.back().where;
}

}  // namespace weft
