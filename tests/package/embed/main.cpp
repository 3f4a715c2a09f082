// SPDX-License-Identifier: GPL-3.0-or-later
// embeds_weft MODEL: slices it, and says of how many layers.
#include "pipeline/pipeline.h"

#include <cstdio>

int main(int count, char** words) {
  if (count != 2) return 2;
  weft::Job job;
  job.models = {words[1]};
  weft::Report report;
  const auto gcode = weft::run(job, {}, report);
  std::printf("%zu layers\n", report.layers);
  return gcode ? 0 : 1;
}
