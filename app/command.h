// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "console.h"
#include "outputs.h"
#include "pipeline/pipeline.h"
#include "profile/profile.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <boost/program_options.hpp>

namespace weft::app {

/// What the user typed, parsed: the options of the verb and those that every verb understands.
struct Command {
  std::vector<std::string> inputs;                            ///< positional arguments, in order
  std::vector<std::filesystem::path> profiles;                ///< -p, --load
  std::vector<std::pair<std::string, std::string>> settings;  ///< -s KEY=VALUE and --key value, in the order typed
  ImportOptions import;                                       ///< --preset, --strict
  std::optional<std::string> output, report;
  unsigned threads = 0;                 ///< 0: all cores
  std::optional<std::int64_t> made_at;  ///< SOURCE_DATE_EPOCH: what custom G-code may tell of the time
  ConsoleOptions console;
  bool help = false;
  std::vector<ModelMark> marks;                   ///< --support-enforcer and its like, of the model before them
  ByName by_name;                                 ///< --for, --place, --copies NAME=N
  boost::program_options::variables_map options;  ///< of the verb
  Files files;                                    ///< that are read, and written
};

/// What -o of a verb may be.
enum class Result : bool { never_a_profile, profile };

/// Parses the words behind the verb.
/// @param verb_options what this verb understands beside the common options
/// @throws Error{usage} naming the option, with the nearest known one; or where a file would be read and written, or
/// written twice
Command parse_command(const std::vector<std::string>& words,
                      const boost::program_options::options_description& verb_options,
                      Result result = Result::never_a_profile);

/// The table of options that every verb understands.
boost::program_options::options_description common_options();

/// The help text of the options that every verb understands.
std::string common_help();

/// Profiles and settings of the command, laid over the defaults in the order of the contract: files, then options.
/// @throws Error; {usage} when a file that a profile names is an output
Profile resolve(const Command& command);

/// The files of the command, with those that its profiles and settings name besides: what infill is laid by.
/// @throws Error{usage} when one of them is an output
Files files_of(const Command& command, const Profile& profile);

/// Two numbers separated by a comma, mm. @throws Error{usage}
Point parse_point(const std::string& text, const std::string& option);

/// A number of copies. @throws Error{usage}
int copies_in(const std::string& text);

/// Writes a report or a picture where the user wants it: a path (through a neighbour that is renamed when complete), or
/// "-". G-code goes through pipeline/write_gcode.h.
/// @throws Error{file}
void write_output(const std::string& destination, std::string_view text);

}  // namespace weft::app
