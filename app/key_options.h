// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <boost/program_options.hpp>

/// Settings, and keys of PrusaSlicer, as options of the command line; hidden from the help, which points to
/// `weft settings`.
namespace weft::app {

/// A key as an option is written, and the other way round.
std::string dashed(std::string_view key);
std::string underscored(std::string key);

/// The keys that the words may name, as in --key, --key=value and --no-key. Only these become options: to describe all
/// the hundreds that there are takes longer than to read the model of a small part.
std::set<std::string> keys_typed(const std::vector<std::string>& words);

/// Those of the keys that are settings.
boost::program_options::options_description setting_options(const std::set<std::string>& keys);

/// Those that are PrusaSlicer's, and neither settings of weft's nor options of every verb.
boost::program_options::options_description prusaslicer_options(const std::set<std::string>& keys);

}  // namespace weft::app
