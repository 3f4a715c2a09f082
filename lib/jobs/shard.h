// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace weft::jobs {

/// One share of a list of jobs, of which each machine takes another.
struct Shard {
  unsigned index = 0;  ///< from 0
  unsigned count = 1;
  friend bool operator==(const Shard&, const Shard&) = default;
};

/// A job as it is dealt out.
struct Dealt {
  std::string_view id;
  double work = 1;  ///< about what it takes, in whatever unit
};

/// Which share each job belongs to, from 0, so that all have about as much to do: the largest first, each to the share
/// that has least so far (Graham 1969, "Bounds on multiprocessing timing anomalies"). Ids and work alone decide, not
/// the order of the list or the machine: who deals the same jobs deals them alike.
std::vector<unsigned> deal(const std::vector<Dealt>& jobs, unsigned count);

/// Reads an environment variable; absent: nullopt.
using Environment = std::function<std::optional<std::string>(const char* name)>;

/// The share that a scheduler gave to this process, without being told: Slurm arrays, Kubernetes indexed Jobs, AWS
/// Batch arrays, GitLab and Buildkite parallel jobs. nullopt: none of them is at work. Kubernetes does not say how many
/// there are: WEFT_SHARD_COUNT does, or `count` from the command line.
/// @throws Error{usage} when an index is there without a count, or the numbers are none
struct FoundShard {
  Shard shard;
  std::string by;  ///< "Slurm job array"
};
std::optional<FoundShard> shard_of_environment(const Environment& environment, std::optional<unsigned> count = {});

/// `I/N` with 1 <= I <= N, as typed. @throws Error{usage}
Shard parse_shard(const std::string& text);

}  // namespace weft::jobs
