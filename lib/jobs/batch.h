// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "jobs/hook.h"
#include "jobs/prepare.h"
#include "jobs/record.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace weft::jobs {

struct BatchOptions {
  std::filesystem::path folder;  ///< where results go; made when it is not there
  unsigned threads = 0;          ///< 0: all cores
  std::uint64_t max_memory = 0;  ///< bytes; 0: four fifths of what is available
  double timeout_s = 0;          ///< of one job; 0: none
  StageCache* cache = nullptr;   ///< what jobs have in common is done once; null: each job does everything
  unsigned retries = 0;          ///< how often a job is begun again that could not read, write or go on (status 6, 130)
  Hook hook;                     ///< run when a job has ended, in the job's thread
  bool check_full = false;       ///< files are read to know that they have not changed, whatever their stamps say
  bool resume = false;  ///< verdicts stand: what was refused for its settings, model or moves is not tried again
};

/// What became of a job in this run.
enum class Fate : std::uint8_t {
  made,       ///< run, and its G-code is there
  unchanged,  ///< its G-code was there already
  failed,     ///< run, or with `resume` known, to have no G-code
  not_run,    ///< the run was interrupted before its end
};

/// How far a run is.
struct Progress {
  std::size_t jobs = 0, made = 0, unchanged = 0, failed = 0, running = 0;
  std::size_t layers = 0;  ///< of the jobs made
  double share = 0;        ///< of the work, 0 … 1
  double seconds = 0;      ///< since the beginning
  double layers_per_s = 0;
  std::optional<double> left_s;  ///< until the end, as far as can be told
};

/// How a caller watches a run. Never called by two threads at once; what is thrown changes nothing.
struct BatchWatch {
  std::function<void(const Progress&)> progress = [](const Progress&) {};
  std::function<void(const JobLine&, Fate, const Outcome&)> ended = [](const JobLine&, Fate, const Outcome&) {};
  std::function<bool()> interrupted = [] { return false; };  ///< asked often, from any thread
};

struct BatchResult {
  std::vector<Fate> fates;       ///< one a job
  Progress progress;             ///< at the end
  std::size_t put_back = 0;      ///< times that a job was stopped and begun again later because memory was short
  std::uint64_t max_memory = 0;  ///< bytes, as it was
  std::size_t retried = 0;       ///< times that a job was begun again because it had failed
  std::size_t hooks_failed = 0;  ///< hooks that did not go well in the end
  bool interrupted = false;
};

/// Runs the jobs, several at once, each as `weft slice` alone would: the bytes are the same. A job that fails keeps no
/// other from being run. Results appear whole or not at all; an unchanged job whose G-code is there is not run again.
/// Memory stays within bounds as far as one job alone does: others wait, or are put back.
/// @throws Error{file} when the folder cannot be made or is not to be written to
BatchResult run_batch(const std::vector<Prepared>& jobs, const BatchOptions& options, const BatchWatch& watch);

}  // namespace weft::jobs
