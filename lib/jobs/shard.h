#pragma once
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace weft::jobs {

/// One share of a list of jobs, of which each machine takes another.
struct Shard {
  unsigned index = 0;  ///< from 0
  unsigned count = 1;
  friend bool operator==(const Shard&, const Shard&) = default;
};

/// Whether the job belongs to the share. By a hash of its id alone: the order of the list, the machine and the other
/// jobs do not matter, and every job belongs to exactly one share.
bool belongs(const Shard& shard, std::string_view id);

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
