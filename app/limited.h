// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "command.h"

#include <functional>

namespace weft::app {

/// --timeout and --max-memory.
void add_limit_options(boost::program_options::options_description& to);

/// Does the work within those limits, and until a signal comes. Where it does not see itself that it should end, the
/// program ends a second later. Pre: the work writes nothing; what it makes is written when it has ended.
/// @throws what the work throws; Error{interrupted} when a limit was reached
void within_limits(const Command& command, const std::function<void()>& work);

}  // namespace weft::app
