// SPDX-License-Identifier: GPL-3.0-or-later
#include "completion_table.h"

#include "command.h"
#include "core/parts.h"
#include "settings/catalogue.h"
#include "verbs.h"

#include <algorithm>
#include <cctype>

namespace po = boost::program_options;

namespace weft::app {
namespace {

/// "text|json" says its choices by itself; words in capitals are placeholders.
bool is_choice(std::string_view word) {
  return !word.empty() && std::all_of(word.begin(), word.end(), [](char c) {
    return std::islower(static_cast<unsigned char>(c)) != 0 || std::isdigit(static_cast<unsigned char>(c)) != 0 ||
           c == '_' || c == '-';
  });
}

Argument argument_of(std::string_view name, std::string_view placeholder) {
  if (placeholder.empty()) return Argument::none;
  if (name == "profile" || name == "load" || name == "against") return Argument::profile;
  if (placeholder.starts_with("FILE") || placeholder.starts_with("PATH")) return Argument::file;
  if (placeholder.starts_with("DIR")) return Argument::folder;
  if (name == "set") return Argument::setting;
  return Argument::free_text;
}

OptionWords words_of(const po::option_description& option) {
  OptionWords out;
  const auto [long_names, count] = option.long_names();
  for (std::size_t i = 0; i < count; ++i) out.names.push_back("--" + long_names[i]);
  const auto shortest = option.canonical_display_name(po::command_line_style::allow_dash_for_short);
  if (shortest.size() == 2 && shortest[0] == '-') out.names.push_back(shortest);
  auto shown = option.format_parameter();
  out.placeholder = shown.substr(0, std::min(shown.find(" ("), shown.size()));
  if (out.placeholder.starts_with("[=")) out.placeholder.clear();
  out.argument = argument_of(out.names.front().substr(2), out.placeholder);
  const auto words = parts(out.placeholder, '|');
  if (words.size() > 1 && std::all_of(words.begin(), words.end(), is_choice))
    out.argument = Argument::choice, out.choices = {words.begin(), words.end()};
  out.meaning = option.description();
  return out;
}

std::vector<OptionWords> words_of(const po::options_description& table) {
  std::vector<OptionWords> out;
  for (const auto& option : table.options()) out.push_back(words_of(*option));
  return out;
}

OptionWords words_of(const CatalogueEntry& entry) {
  std::string name(entry.key);
  std::replace(name.begin(), name.end(), '_', '-');
  OptionWords out{{"--" + name}, Argument::free_text, "VALUE", {}, std::string(entry.meaning)};
  for (const auto choice : entry.choices) out.choices.emplace_back(choice);
  if (entry.type == "flag") out.choices = {"true", "false"};
  if (!out.choices.empty()) out.argument = Argument::choice;
  return out;
}

}  // namespace

CompletionTable completion_table() {
  CompletionTable out;
  for (const auto& verb : verbs)
    out.verbs.push_back({std::string(verb.name), std::string(verb.purpose), words_of(verb.options())});
  out.common = words_of(common_options());
  for (const auto& entry : catalogue()) {
    out.settings.push_back(words_of(entry));
    if (out.sections.empty() || out.sections.back() != entry.section) out.sections.emplace_back(entry.section);
  }
  return out;
}

}  // namespace weft::app
