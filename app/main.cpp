// SPDX-License-Identifier: GPL-3.0-or-later
#include "built_commit.h"
#include "built_with.h"
#include "command.h"
#include "core/version.h"
#include "limits.h"
#include "verbs.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>

#include <fmt/format.h>

namespace {
using namespace weft;
using namespace weft::app;

std::string overview() {
  std::string out = "weft: turns triangle meshes and ini profiles into audited G-code\n\n";
  for (const auto& verb : verbs)
    out += fmt::format("  weft {:<11} {}\n{:19}{}\n", verb.name, verb.usage, "", verb.purpose);
  return out + "\n" + common_help() +
         "\nEvery setting is an option too, as in --layer-height 0.2; `weft settings` lists them.\n";
}

/// The version, alone on the first line; then what this build was made of.
std::string version_text() {
  std::string out = fmt::format("weft {}\n", version);
  if (!built_commit.empty()) out += fmt::format("commit {}\n", built_commit);
  return out + fmt::format("with {}\n", built_with);
}

const Verb* find_verb(const std::string& name) {
  const auto at = std::find_if(verbs.begin(), verbs.end(), [&](const Verb& v) { return v.name == name; });
  return at == verbs.end() ? nullptr : &*at;
}

int run(Words words) {
  if (words.empty()) return fmt::print(stderr, "{}", overview()), exit_status(Error::Kind::usage);
  if (words[0] == "--version" || words[0] == "-V") return write_output("-", version_text()), 0;
  if (words[0] == "--help" || words[0] == "-h" || words[0] == "help") return write_output("-", overview()), 0;
  if (const auto* verb = find_verb(words[0])) return verb->run({words.begin() + 1, words.end()});
  // Hands used to PrusaSlicer: `weft -g part.stl` is `weft slice part.stl`.
  const auto is_export = [](const std::string& w) { return w == "-g" || w == "--export-gcode" || w == "--gcode"; };
  if (std::any_of(words.begin(), words.end(), is_export)) {
    std::erase_if(words, is_export);
    return app::slice(words);
  }
  if (std::find(words.begin(), words.end(), "--info") != words.end()) {
    std::erase(words, "--info");
    return inspect(words);
  }
  throw Error{Error::Kind::usage, "is not a verb", fmt::format("'{}'", words[0]), "see weft --help"};
}

/// Messages before a verb's own options are known still obey --log-format and -q.
Console early_console(const Words& words) {
  ConsoleOptions options;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == "--log-format=json" ||
        (words[i] == "--log-format" && i + 1 < words.size() && words[i + 1] == "json"))
      options.format = LogFormat::json;
    if (words[i] == "-q" || words[i] == "--quiet") options.verbosity = Verbosity::quiet;
  }
  options.progress = ProgressMode::never;
  return Console(options);
}

}  // namespace

int main(int count, char** arguments) {
  explain_termination();
  hold_standard_streams();
  const Words words(arguments + 1, arguments + std::max(count, 1));
  try {
    return run(words);
  } catch (const Error& error) {
    early_console(words).error(error);
    return exit_status(error.kind());
  } catch (const std::bad_alloc&) {
    const Error error{Error::Kind::interrupted, "the machine's memory is used up", {}, "nothing was written"};
    early_console(words).error(error);
    return exit_status(error.kind());
  } catch (const std::exception& error) {
    early_console(words).internal_error(error.what());
  }
  return 1;
}
