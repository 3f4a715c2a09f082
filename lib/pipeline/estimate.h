// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "pipeline/pipeline.h"

namespace weft {

/// What a job would take, for quotes: no text is made, nothing is written and nothing is audited.
struct EstimateOptions {
  bool exact = false;  ///< every layer is planned: the figures are those of `run`. Else every fourth one is, and stands
                       ///< for its neighbours; measured, that is within 1 to 2 %, and 4 % where a single
                       ///< layer of bridges counts
};

/// Fills in the report as `run` does, but for hashes and audit: its verdict is "unaudited".
/// @return how many layers were planned
/// @throws Error as `run`
std::size_t estimate(const Job& job, const EstimateOptions& options, const Watch& watch, Report& report,
                     StageCache* cache = nullptr);

}  // namespace weft
