// SPDX-License-Identifier: GPL-3.0-or-later
#include "command.h"
#include "completion_table.h"
#include "core/join.h"
#include "verbs.h"

#include <algorithm>
#include <array>
#include <sstream>

#include <fmt/format.h>

namespace weft::app {
namespace {

std::string replaced(std::string text, std::string_view what, std::string_view with) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += with.size())
    text.replace(at, what.size(), with);
  return text;
}

/// A word of any shell that stands for itself.
std::string shell_word(const std::string& text) {
  return "'" + replaced(text, "'", "'\\''") + "'";
}

std::string joined_names(const std::vector<OptionWords>& options) {
  std::string out;
  for (const auto& option : options)
    for (const auto& name : option.names) out += (out.empty() ? "" : " ") + name;
  return out;
}

/// Every option, those of all verbs together: an option means the same wherever it is.
std::vector<OptionWords> all_options(const CompletionTable& table) {
  auto out = table.common;
  for (const auto& verb : table.verbs) out.insert(out.end(), verb.options.begin(), verb.options.end());
  out.insert(out.end(), table.settings.begin(), table.settings.end());
  return out;
}

/// The rows of a `case` by option, for options with the same kind of argument.
std::string bash_cases(const CompletionTable& table) {
  constexpr std::array commands{
      std::pair{Argument::file, "compgen -f -- \"$2\""}, std::pair{Argument::folder, "compgen -d -- \"$2\""},
      std::pair{Argument::profile, "compgen -W \"$(_weft_profiles)\" -- \"$2\"; compgen -f -- \"$2\""},
      std::pair{Argument::setting, "compgen -W \"$_weft_keys\" -- \"$2\""}, std::pair{Argument::free_text, ":"}};
  std::string out;
  std::vector<std::string> seen;
  for (const auto& option : all_options(table)) {
    if (option.argument == Argument::none) continue;
    std::string names;
    for (const auto& name : option.names)
      if (std::find(seen.begin(), seen.end(), name) == seen.end()) {
        seen.push_back(name);
        names += (names.empty() ? "" : "|") + name;
      }
    if (names.empty()) continue;
    std::string command = fmt::format("compgen -W '{}' -- \"$2\"", joined(option.choices, " "));
    for (const auto& [argument, text] : commands)
      if (argument == option.argument) command = text;
    out += fmt::format("    {}) {};;\n", names, command);
  }
  return out;
}

constexpr std::string_view bash_frame =
    R"bash(# What bash completes the words of weft with: made by `weft completions bash` from the tables that weft parses with.
_weft_profiles() { weft profile list 2> /dev/null | sed -n 's/^\([^#[:space:]]*\).*/\1/p'; }
_weft_keys='@KEYS@'
# The values of an option that begin like a word; status 1 when it takes none.
_weft_values() {
  local IFS=$' \t\n'
  case $1 in
@CASES@    *) return 1;;
  esac
  return 0
}
_weft() {
  local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]} verb= word key
  # bash cuts words at '=': --option=value is three of them.
  if [[ $cur == = ]]; then cur=; elif [[ $prev == = ]]; then prev=${COMP_WORDS[COMP_CWORD-2]}; fi
  for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
    case $word in @VERBS_OR@) verb=$word; break;; esac
  done
  local IFS=$'\n'
  if [[ $prev == *_* || ( $prev != -* && ${COMP_WORDS[COMP_CWORD-1]} == = ) ]]; then  # --set KEY=…
    key=${prev//_/-}; COMPREPLY=($(_weft_values "--$key" "$cur")); return
  fi
  if [[ $prev == -* ]]; then
    COMPREPLY=($(_weft_values "$prev" "$cur")) && { [[ $prev == -s || $prev == --set ]] && compopt -o nospace; return; }
  fi
  if [[ $cur == -* ]]; then
    local own=
    case $verb in
@OWN@    esac
    IFS=' '; COMPREPLY=($(compgen -W "@COMMON@ $own @SETTINGS@" -- "$cur")); return
  fi
  case $verb in
    '') IFS=' '; COMPREPLY=($(compgen -W '@VERBS@' -- "$cur"));;
    settings) IFS=' '; COMPREPLY=($(compgen -W "@SECTIONS@ ${_weft_keys//=/}" -- "$cur"));;
    *) COMPREPLY=($(compgen -f -- "$cur"));;
  esac
}
complete -o filenames -F _weft weft
)bash";

/// One `_arguments` row a name.
std::string zsh_rows(const std::vector<OptionWords>& options, std::string_view indent) {
  std::string out;
  for (const auto& option : options)
    for (const auto& name : option.names) {
      auto meaning = replaced(replaced(option.meaning, "[", "\\["), "]", "\\]");
      std::string row = "*" + name;
      if (option.argument != Argument::none && name.starts_with("--")) row += "=";
      row += "[" + meaning + "]";
      if (option.argument != Argument::none) row += ":" + replaced(option.placeholder, ":", "\\:") + ":";
      if (option.argument == Argument::choice) row += "(" + joined(option.choices, " ") + ")";
      if (option.argument == Argument::file) row += "_files";
      if (option.argument == Argument::folder) row += "_files -/";
      if (option.argument == Argument::profile) row += "_weft_profiles";
      if (option.argument == Argument::setting) row += "_weft_settings";
      out += fmt::format("{}{}\n", indent, shell_word(row));
    }
  return out;
}

constexpr std::string_view zsh_frame = R"zsh(#compdef weft
# What zsh completes the words of weft with: made by `weft completions zsh` from the tables that weft parses with.
_weft_profiles() {
  local -a names
  names=(${(f)"$(weft profile list 2> /dev/null | sed -n 's/^\([^#[:space:]]*\).*/\1/p')"})
  compadd -a names
  _files
}
_weft_settings() {
  local -a keys
  keys=(@KEYS@)
  compadd -S '' -a keys
}
_weft_named() { compadd @SECTIONS@ @NAMES@ }
_weft() {
  local -a verbs common own settings
  verbs=(
@VERBS@  )
  common=(
@COMMON@  )
  settings=(
@SETTINGS@  )
  if (( CURRENT == 2 )) && [[ $words[2] != -* ]]; then
    _describe verb verbs
    return
  fi
  case $words[2] in
@OWN@  esac
  local named=_files
  [[ $words[2] == settings ]] && named=_weft_named
  _arguments -s $common $own $settings "*:name:$named"
}
_weft "$@"
)zsh";

std::string fish_row(const OptionWords& option, std::string_view condition) {
  std::string out = "complete -c weft";
  if (!condition.empty()) out += fmt::format(" -n {}", shell_word(std::string(condition)));
  for (const auto& name : option.names)
    out += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  switch (option.argument) {
    case Argument::none:
      break;
    case Argument::choice:
      out += fmt::format(" -x -a {}", shell_word(joined(option.choices, " ")));
      break;
    case Argument::folder:
      out += " -x -a '(__fish_complete_directories)'";
      break;
    case Argument::profile:
      out += " -r -a '(__weft_profiles)'";
      break;
    case Argument::file:
      out += " -r -F";
      break;
    case Argument::setting:
      out += " -x -a '(__weft_settings)'";
      break;
    case Argument::free_text:
      out += " -x";
      break;
  }
  return out + fmt::format(" -d {}\n", shell_word(option.meaning));
}

/// The keys of all settings, each with what stands behind it.
std::string keys_of(const CompletionTable& table, std::string_view end = "=") {
  std::string out;
  for (const auto& setting : table.settings)
    out += fmt::format("{}{}{}", out.empty() ? "" : " ", replaced(setting.names.front().substr(2), "-", "_"), end);
  return out;
}

}  // namespace

std::string bash_completion(const CompletionTable& table) {
  std::string names, own;
  for (const auto& verb : table.verbs) {
    names += (names.empty() ? "" : " ") + verb.name;
    own += fmt::format("      {}) own='{}';;\n", verb.name, joined_names(verb.options));
  }
  std::string out(bash_frame);
  out = replaced(out, "@KEYS@", keys_of(table));
  out = replaced(out, "@SECTIONS@", joined(table.sections, " "));
  out = replaced(out, "@CASES@", bash_cases(table));
  out = replaced(out, "@OWN@", own);
  out = replaced(out, "@COMMON@", joined_names(table.common));
  out = replaced(out, "@SETTINGS@", joined_names(table.settings));
  out = replaced(out, "@VERBS_OR@", replaced(names, " ", "|"));
  return replaced(out, "@VERBS@", names);
}

std::string zsh_completion(const CompletionTable& table) {
  std::string names, own;
  for (const auto& verb : table.verbs) {
    names += "    " + shell_word(verb.name + ":" + replaced(verb.purpose, ":", "\\:")) + "\n";
    own += fmt::format("    {})\n      own=(\n{}      );;\n", verb.name, zsh_rows(verb.options, "        "));
  }
  std::string out(zsh_frame);
  out = replaced(out, "@KEYS@", keys_of(table));
  out = replaced(out, "@SECTIONS@", joined(table.sections, " "));
  out = replaced(out, "@NAMES@", keys_of(table, ""));
  out = replaced(out, "@OWN@", own);
  out = replaced(out, "@COMMON@", zsh_rows(table.common, "    "));
  out = replaced(out, "@SETTINGS@", zsh_rows(table.settings, "    "));
  return replaced(out, "@VERBS@", names);
}

std::string fish_completion(const CompletionTable& table) {
  std::string out =
      "# What fish completes the words of weft with: made by `weft completions fish` from the tables that weft parses "
      "with.\n"
      "function __weft_profiles\n"
      "  weft profile list 2> /dev/null | string match -rg '^([^#\\s]\\S*)'\nend\n";
  out += fmt::format("function __weft_settings\n  printf '%s\\n' {}\nend\n", keys_of(table));
  for (const auto& verb : table.verbs)
    out +=
        fmt::format("complete -c weft -n __fish_use_subcommand -x -a {} -d {}\n", verb.name, shell_word(verb.purpose));
  for (const auto& option : table.common) out += fish_row(option, {});
  for (const auto& option : table.settings) out += fish_row(option, {});
  for (const auto& verb : table.verbs)
    for (const auto& option : verb.options) out += fish_row(option, "__fish_seen_subcommand_from " + verb.name);
  out += fmt::format("complete -c weft -n '__fish_seen_subcommand_from settings' -f -a '{} {}'\n",
                     joined(table.sections, " "), keys_of(table, ""));
  return out;
}

Options completions_options() {
  return Options("Options of weft completions");
}

int completions(const Words& words) {
  const auto command = parse_command(words, completions_options());
  if (command.help) {
    std::ostringstream out;
    out << "weft completions bash|zsh|fish: what the shell completes weft's words with, on standard output.\nPackages "
           "install it; else: source <(weft completions bash)\n\n"
        << common_help();
    return fmt::print("{}", out.str()), 0;
  }
  using TextOf = std::string (*)(const CompletionTable&);
  constexpr std::array<std::pair<std::string_view, TextOf>, 3> shells{
      {{"bash", bash_completion}, {"zsh", zsh_completion}, {"fish", fish_completion}}};
  if (command.inputs.size() == 1)
    for (const auto& [name, text_of] : shells)
      if (command.inputs[0] == name) return write_output(command.output.value_or("-"), text_of(completion_table())), 0;
  throw Error{Error::Kind::usage, "bash, zsh or fish?", "weft completions", "as in weft completions bash"};
}

}  // namespace weft::app
