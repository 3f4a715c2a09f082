// SPDX-License-Identifier: GPL-3.0-or-later
#include "command.h"
#include "core/join.h"
#include "labels.h"
#include "prusaslicer/keys.h"
#include "settings/catalogue.h"
#include "verbs.h"

#include <algorithm>
#include <cstdio>
#include <iterator>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace po = boost::program_options;

namespace weft::app {
namespace {

std::string range_of(const CatalogueEntry& e) {
  if (!e.choices.empty()) return joined(e.choices, " | ");
  if (e.least.empty()) return e.type == "flag" ? "true | false" : std::string(e.type);
  return fmt::format("{} … {}{}{}{}", e.least, e.most, e.unit.empty() ? "" : " ", e.unit,
                     e.automatic ? ", or auto" : "");
}

std::string as_json(const std::vector<const CatalogueEntry*>& entries, const Labels& labels) {
  auto out = nlohmann::ordered_json::array();
  for (const auto* e : entries) {
    nlohmann::ordered_json row{{"key", e->key},
                               {"label", labels.of(e->key)},
                               {"section", e->section},
                               {"scope", name_of(e->scope)},
                               {"type", e->type},
                               {"unit", e->unit},
                               {"default", e->default_text}};
    if (!e->least.empty()) row["min"] = e->least, row["max"] = e->most;
    if (!e->choices.empty()) row["choices"] = e->choices;
    row["auto"] = e->automatic;
    row["meaning"] = e->meaning;
    if (const auto theirs = prusaslicer::name_of(e->key); !theirs.empty()) row["prusaslicer"] = theirs;
    out.push_back(std::move(row));
  }
  return out.dump(2) + "\n";
}

/// @param labels absent: no column for them
std::string as_markdown(const std::vector<const CatalogueEntry*>& entries, const Labels* labels) {
  std::string out, section;
  for (const auto* e : entries) {
    if (e->section != section) {
      section = e->section;
      out += fmt::format("{}## {}\n\n| key |{} default | range | differs by | meaning |\n|---|{}---|---|---|---|\n",
                         out.empty() ? "" : "\n", section, labels ? " label |" : "", labels ? "---|" : "");
    }
    std::string range = range_of(*e);
    for (auto at = range.find('|'); at != std::string::npos; at = range.find('|', at + 2)) range.replace(at, 1, "\\|");
    out +=
        fmt::format("| `{}` |{} {} | {} | {} | {} |\n", e->key, labels ? fmt::format(" {} |", labels->of(e->key)) : "",
                    e->default_text, range, name_of(e->scope), e->meaning);
  }
  return out;
}

std::string as_plain(const std::vector<const CatalogueEntry*>& entries, const Labels* labels) {
  std::string out, section;
  for (const auto* e : entries) {
    if (e->section != section) out += fmt::format("{}[{}]\n", out.empty() ? "" : "\n", section = e->section);
    // A number alone is followed by its unit; a share says its own.
    const bool bare = e->unit.empty() || e->default_text.ends_with('%') || e->default_text == "auto";
    out +=
        fmt::format("{} = {}{}{}\n    {}{} ({}; {})\n", e->key, e->default_text, bare ? "" : " ", bare ? "" : e->unit,
                    labels ? labels->of(e->key) + ": " : "", e->meaning, range_of(*e), name_of(e->scope));
  }
  return out;
}

/// The settings that a name stands for: a key, a section, or with '*' at its end all keys that begin so.
/// @throws Error{settings} where there is none
std::vector<const CatalogueEntry*> named_by(const std::string& name) {
  if (const auto* e = find_setting(name)) return {e};
  const bool open = name.ends_with('*');
  const std::string_view start = std::string_view(name).substr(0, name.size() - (open ? 1 : 0));
  std::vector<const CatalogueEntry*> out;
  for (const auto& e : catalogue())
    if (open ? e.key.starts_with(start) : e.section == start) out.push_back(&e);
  const auto near = nearest_key(name);
  if (out.empty())
    throw Error{Error::Kind::settings,
                fmt::format("unknown setting '{}'", name),
                {},
                near.empty() ? "" : fmt::format("did you mean '{}'?", near)};
  return out;
}

/// Those of all names, in their order; without any name, every setting.
std::vector<const CatalogueEntry*> named_by(const std::vector<std::string>& names) {
  std::vector<const CatalogueEntry*> out;
  for (const auto& name : names.empty() ? std::vector<std::string>{"*"} : names)
    std::ranges::copy(named_by(name), std::back_inserter(out));
  return out;
}

}  // namespace

po::options_description settings_options() {
  po::options_description out("Options of weft settings");
  out.add_options()("format", po::value<std::string>()->value_name("text|json|markdown")->default_value("text"),
                    "form of the list")("lang", po::value<std::string>()->value_name("LANGUAGE"),
                                        "names settings in en, fr, ja, zh_CN or zh_TW");
  return out;
}

int settings(const Words& words) {
  const auto options = settings_options();
  const auto command = parse_command(words, options);
  if (command.help) {
    std::ostringstream out;
    out << "weft settings [NAME...]: every setting, or those named: a key, a section (support, walls …), or keys\nthat "
           "begin alike ('wall_*')\n\n"
        << options << "\n"
        << common_help();
    return write_output("-", out.str()), 0;
  }
  const auto entries = named_by(command.inputs);
  const auto format = command.options["format"].as<std::string>();
  if (format != "text" && format != "json" && format != "markdown")
    throw Error{Error::Kind::usage, fmt::format("'{}' is not one of text, json, markdown", format), "--format"};
  const bool named = command.options.count("lang") > 0;
  const Labels labels(named ? command.options["lang"].as<std::string>() : "");
  const Labels* shown = named ? &labels : nullptr;
  write_output(command.output.value_or("-"), format == "json"       ? as_json(entries, labels)
                                             : format == "markdown" ? as_markdown(entries, shown)
                                                                    : as_plain(entries, shown));
  return 0;
}

}  // namespace weft::app
