// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace weft::app {

/// What stands behind an option.
enum class Argument {
  none,      ///< a switch
  choice,    ///< one of OptionWords::choices
  file,      ///< a path
  folder,    ///< a path of a folder
  profile,   ///< a path, or the name of a profile that is found by it
  setting,   ///< KEY=VALUE
  free_text  ///< nothing that a shell could guess
};

/// An option as a shell completes it.
struct OptionWords {
  std::vector<std::string> names;  ///< with their dashes: "--profile", "-p"
  Argument argument = Argument::none;
  std::string placeholder;           ///< "FILE"; empty for a switch
  std::vector<std::string> choices;  ///< of Argument::choice
  std::string meaning;               ///< one line
};

struct VerbWords {
  std::string name, purpose;
  std::vector<OptionWords> options;  ///< its own
};

/// Everything that completions know, read from the tables that the program itself parses with.
struct CompletionTable {
  std::vector<VerbWords> verbs;
  std::vector<OptionWords> common;    ///< of every verb
  std::vector<OptionWords> settings;  ///< each setting as an option
  std::vector<std::string> sections;  ///< of settings, which `weft settings` takes as names, too
};
CompletionTable completion_table();

std::string bash_completion(const CompletionTable& table);
std::string zsh_completion(const CompletionTable& table);
std::string fish_completion(const CompletionTable& table);

}  // namespace weft::app
