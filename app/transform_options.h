// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "pipeline/pipeline.h"

#include <string>
#include <vector>

#include <boost/program_options.hpp>

namespace weft::app {

/// --unit, --scale, --mirror, --rotate-x and what else is done with models before they are placed.
void add_transform_options(boost::program_options::options_description& to);

/// What of them was typed. @throws Error{usage}
void take_transforms(const boost::program_options::variables_map& options, Placement& placement);

/// They as they would be typed.
std::vector<std::string> transform_arguments(const Placement& placement);

}  // namespace weft::app
