// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "command.h"
#include "pipeline/pipeline.h"

#include <string>

/// What the verbs that slice a model have in common.
namespace weft::app {

/// The job that the options of `weft slice` ask for. @throws Error{usage}
Job job_of(const Command& command, const Settings& settings);

/// The value of an option that limits something. @throws Error{usage}
double limit_of(const boost::program_options::variables_map& options, const std::string& name);

/// The first `most` of each kind, and how many more there are: thousands of layers must not bury what matters. The
/// report has them all.
void warn(Console& console, const Notices& notices, std::size_t most);

/// --report, where it is asked for. While it is not known all that is read, it is written over no file that might be.
/// @throws Error{file}
void write_report(const Command& command, const Report& report, bool inputs_are_known);

/// "1.47 EUR"
std::string price(double amount, const std::string& currency);

}  // namespace weft::app
