// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "jobs/job_list.h"
#include "profile/profile.h"

#include <cstdint>
#include <optional>

namespace weft::jobs {

/// What every job of a list has beside its own: profiles below the job's, settings above the job's profiles and below
/// the job's own settings.
struct Common {
  std::vector<std::filesystem::path> profiles;
  std::vector<std::pair<std::string, std::string>> settings;
  ImportOptions import;     ///< how profiles of PrusaSlicer's family are read
  bool keep_going = false;  ///< a model that cannot be opened is a job that will fail, not an error of the list
  std::optional<std::int64_t> made_at{};  ///< the time of day that custom G-code may tell (pipeline/made_at.h)
};

/// A job with its settings resolved: ready to run.
struct Prepared {
  JobLine line;
  Job job;
  Notices notices;                          ///< of its profiles
  std::optional<Error> refused{};           ///< why it is going to fail: its project cannot be read, or fits no printer
  std::vector<std::filesystem::path> read;  ///< models, marks, profiles with inherited ones, fields of infill
};

/// Resolves and checks every job before the first is run: profiles and settings as `weft slice` would, models by
/// whether they can be opened, custom G-code by its placeholders. Each profile is read once for all jobs that begin
/// with it. A job of several plates becomes one a plate: of `id` and `output` those of plate 2 are `id_plate_2` and
/// `output_plate_2.gcode`.
/// @param errors gets one for each job that cannot be run, naming its line
std::vector<Prepared> prepare(std::vector<JobLine> jobs, const Common& common, std::vector<Error>& errors);

}  // namespace weft::jobs
