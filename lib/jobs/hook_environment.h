// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "jobs/record.h"

#include <string>
#include <utility>
#include <vector>

namespace weft::jobs {

/// What a hook is told in its environment: WEFT_ID, WEFT_STATUS (ok, rejected, failed), WEFT_EXIT_STATUS, WEFT_ERROR,
/// WEFT_OUTPUT (absolute path of the G-code; empty when there is none), WEFT_NAME (its path in the results),
/// WEFT_FOLDER, WEFT_REPORT (absolute path of the job's record), WEFT_PRINT_TIME_S, WEFT_FILAMENT_G, WEFT_COST and
/// WEFT_CURRENCY where there are prices, and each free field: WEFT_LABEL, WEFT_X_CUSTOMER of "x-customer".
std::vector<std::pair<std::string, std::string>> hook_environment(const std::filesystem::path& folder,
                                                                  const JobLine& job, const Record& record);

}  // namespace weft::jobs
