// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "pipeline/pipeline.h"

namespace weft::jobs {

/// About how much there is to do for a job, without opening its models: the more the larger their files, the thinner
/// the layers and the more copies. For dealing jobs out, where all must come to the same figure; it is no time.
double estimated_work(const Job& job);

}  // namespace weft::jobs
