// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/shard.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <catch2/catch.hpp>
#include <fmt/format.h>

using namespace weft;
using namespace weft::jobs;

namespace {
Environment environment(std::map<std::string, std::string> variables) {
  return [variables = std::move(variables)](const char* name) {
    const auto at = variables.find(name);
    return at == variables.end() ? std::nullopt : std::optional(at->second);
  };
}
}  // namespace

TEST_CASE("shards: every share has about as much to do, however unlike the jobs are") {
  std::vector<std::string> ids;
  for (int job = 0; job < 500; ++job) ids.push_back(fmt::format("job {}", job));
  std::vector<Dealt> jobs;
  double all = 0, largest = 0;
  for (int job = 0; job < 500; ++job) {
    const double work = 1 + job % 7 * job % 97;  // some a hundred times as much as others
    jobs.push_back({ids[static_cast<std::size_t>(job)], work});
    all += work, largest = std::max(largest, work);
  }
  for (const unsigned count : {1u, 2u, 7u, 20u}) {
    const auto shares = deal(jobs, count);
    std::vector<double> loads(count);
    for (std::size_t i = 0; i < jobs.size(); ++i) loads.at(shares[i]) += jobs[i].work;
    for (const double load : loads) CHECK(std::abs(load - all / count) <= largest);
  }
}

TEST_CASE("shards: the share of a job does not depend on the order of the list") {
  const std::vector<Dealt> jobs{{"a", 5}, {"b", 5}, {"c", 2}, {"d", 2}, {"e", 1}};
  auto turned = jobs;
  std::reverse(turned.begin(), turned.end());
  const auto shares = deal(jobs, 2);
  auto of_turned = deal(turned, 2);
  std::reverse(of_turned.begin(), of_turned.end());
  CHECK(shares == of_turned);
  CHECK(shares == std::vector<unsigned>{0, 1, 0, 1, 0});
  CHECK(deal(jobs, 1) == std::vector<unsigned>(5, 0));
  CHECK(deal({}, 3).empty());
}

TEST_CASE("shards: schedulers say which share this is") {
  struct Case {
    std::map<std::string, std::string> variables;
    Shard shard;
  };
  const std::vector<Case> cases{
      {{{"SLURM_ARRAY_TASK_ID", "7"}, {"SLURM_ARRAY_TASK_MIN", "1"}, {"SLURM_ARRAY_TASK_COUNT", "20"}}, {6, 20}},
      {{{"SLURM_ARRAY_TASK_ID", "10"},
        {"SLURM_ARRAY_TASK_MIN", "0"},
        {"SLURM_ARRAY_TASK_COUNT", "6"},
        {"SLURM_ARRAY_TASK_STEP", "5"}},
       {2, 6}},
      {{{"AWS_BATCH_JOB_ARRAY_INDEX", "0"}, {"AWS_BATCH_JOB_ARRAY_SIZE", "3"}}, {0, 3}},
      {{{"BUILDKITE_PARALLEL_JOB", "3"}, {"BUILDKITE_PARALLEL_JOB_COUNT", "4"}}, {3, 4}},
      {{{"CI_NODE_INDEX", "1"}, {"CI_NODE_TOTAL", "5"}}, {0, 5}},
      {{{"JOB_COMPLETION_INDEX", "4"}, {"WEFT_SHARD_COUNT", "5"}}, {4, 5}},
  };
  for (const auto& c : cases) {
    const auto found = shard_of_environment(environment(c.variables));
    REQUIRE(found);
    INFO(found->by);
    CHECK(found->shard == c.shard);
  }
  CHECK_FALSE(shard_of_environment(environment({{"CI", "true"}})));
  CHECK(shard_of_environment(environment({{"JOB_COMPLETION_INDEX", "4"}}), 9)->shard == Shard{4, 9});
}

TEST_CASE("shards: an environment that says half of it is refused, not taken for everything") {
  CHECK_THROWS_AS(shard_of_environment(environment({{"JOB_COMPLETION_INDEX", "4"}})), Error);
  CHECK_THROWS_AS(shard_of_environment(environment({{"CI_NODE_INDEX", "0"}, {"CI_NODE_TOTAL", "5"}})), Error);
  CHECK_THROWS_AS(shard_of_environment(environment({{"CI_NODE_INDEX", "x"}, {"CI_NODE_TOTAL", "5"}})), Error);
  CHECK_THROWS_AS(shard_of_environment(environment(
                      {{"SLURM_ARRAY_TASK_ID", "9"}, {"SLURM_ARRAY_TASK_MIN", "1"}, {"SLURM_ARRAY_TASK_COUNT", "3"}})),
                  Error);
}

TEST_CASE("shards: I/N counts from one") {
  CHECK(parse_shard("1/1") == Shard{0, 1});
  CHECK(parse_shard("3/20") == Shard{2, 20});
  for (const auto* wrong : {"0/3", "4/3", "3", "a/3", "1/", "/3", "-1/3", "1/3x"})
    CHECK_THROWS_AS(parse_shard(wrong), Error);
}
