// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/shard.h"

#include "core/error.h"
#include "core/number.h"

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>
#include <queue>

#include <fmt/format.h>

namespace weft::jobs {
namespace {

/// A scheduler, and the variables in which it tells a process which of how many it is.
struct Scheduler {
  std::string_view name;
  const char* index;
  const char* first;     ///< least index, where it is not fixed
  unsigned fixed_first;  ///< least index where `first` is null
  const char* count;
  const char* step;  ///< between indices, where it may differ from 1
};
constexpr std::array schedulers{
    Scheduler{"Slurm job array", "SLURM_ARRAY_TASK_ID", "SLURM_ARRAY_TASK_MIN", 0, "SLURM_ARRAY_TASK_COUNT",
              "SLURM_ARRAY_TASK_STEP"},
    Scheduler{"AWS Batch array job", "AWS_BATCH_JOB_ARRAY_INDEX", nullptr, 0, "AWS_BATCH_JOB_ARRAY_SIZE", nullptr},
    Scheduler{"Buildkite parallel job", "BUILDKITE_PARALLEL_JOB", nullptr, 0, "BUILDKITE_PARALLEL_JOB_COUNT", nullptr},
    Scheduler{"GitLab parallel job", "CI_NODE_INDEX", nullptr, 1, "CI_NODE_TOTAL", nullptr},
    Scheduler{"Kubernetes indexed Job", "JOB_COMPLETION_INDEX", nullptr, 0, "WEFT_SHARD_COUNT", nullptr},
};

unsigned number(std::string_view text, const std::string& where) {
  const auto out = as_number<unsigned>(text);
  if (!out) throw Error{Error::Kind::usage, fmt::format("'{}' is not a number", text), where};
  return *out;
}

}  // namespace

std::vector<unsigned> deal(const std::vector<Dealt>& jobs, unsigned count) {
  std::vector<unsigned> out(jobs.size(), 0);
  if (count <= 1) return out;
  std::vector<std::size_t> order(jobs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return jobs[a].work != jobs[b].work ? jobs[a].work > jobs[b].work : jobs[a].id < jobs[b].id;
  });
  using Load = std::pair<double, unsigned>;  // of equal ones the first share
  std::priority_queue<Load, std::vector<Load>, std::greater<>> loads;
  for (unsigned share = 0; share < count; ++share) loads.emplace(0, share);
  for (const auto i : order) {
    auto [work, share] = loads.top();
    loads.pop();
    out[i] = share;
    loads.emplace(work + jobs[i].work, share);
  }
  return out;
}

std::optional<FoundShard> shard_of_environment(const Environment& environment, std::optional<unsigned> told) {
  for (const auto& s : schedulers) {
    const auto index = environment(s.index);
    if (!index || index->empty()) continue;
    const auto count_text = environment(s.count);
    if (!told && (!count_text || count_text->empty()))
      throw Error{Error::Kind::usage, fmt::format("{} says which share this is, but not of how many", s.index),
                  fmt::format("{} in the environment", s.name), fmt::format("set {}, or give --shard auto/N", s.count)};
    const unsigned count = told ? *told : number(*count_text, s.count);
    unsigned first = s.fixed_first, step = 1;
    if (s.first)
      if (const auto v = environment(s.first)) first = number(*v, s.first);
    if (s.step)
      if (const auto v = environment(s.step)) step = std::max(1u, number(*v, s.step));
    const unsigned i = number(*index, s.index);
    if (i < first || (i - first) % step != 0 || (i - first) / step >= count)
      throw Error{Error::Kind::usage, fmt::format("{} = {} is not one of {} shares from {}", s.index, i, count, first),
                  fmt::format("{} in the environment", s.name), "indices must be without gaps, or give --shard I/N"};
    return FoundShard{{(i - first) / step, count}, std::string(s.name)};
  }
  return std::nullopt;
}

Shard parse_shard(const std::string& text) {
  const auto slash = text.find('/');
  if (slash == std::string::npos)
    throw Error{Error::Kind::usage, fmt::format("'{}' is not I/N", text), "--shard",
                "as in --shard 3/20, the third of twenty"};
  const unsigned i = number(std::string_view(text).substr(0, slash), "--shard"),
                 n = number(std::string_view(text).substr(slash + 1), "--shard");
  if (i < 1 || i > n)
    throw Error{Error::Kind::usage, fmt::format("{} is not one of 1 … {}", i, n), "--shard",
                "shares are counted from 1"};
  return {i - 1, n};
}

}  // namespace weft::jobs
