// SPDX-License-Identifier: GPL-3.0-or-later
#include "batch_run.h"
#include "jobs/work.h"
#include "verbs.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <sstream>

#include <fmt/format.h>

namespace po = boost::program_options;

namespace weft::app {

po::options_description batch_options() {
  po::options_description out("Options of weft batch");
  out.add_options()("shard", po::value<std::string>()->value_name("I/N"),
                    "run the I-th of N shares (from 1). Slurm arrays, AWS Batch arrays, GitLab and Buildkite parallel "
                    "jobs and indexed Kubernetes Jobs need not say it; "
                    "auto/N gives only the count; 1/1 runs everything")(
      "keep-going", po::bool_switch(),
      "run the others when a model of the list is not there or cannot be opened; its job counts as failed")(
      "name", po::value<std::string>()->value_name("NAME"),
      "of the list, where several share a folder: reports are report-NAME.jsonl and so on, outputs lie in NAME/ where "
      "the list does not say; auto is the name of the list's file")(
      "collect", po::bool_switch(), "run nothing: merge what shares have left in the folder into one report");
  out.add(running_options());
  return out;
}

namespace {

std::optional<std::string> environment(const char* name) {
  const char* v = std::getenv(name);
  return v ? std::optional<std::string>(v) : std::nullopt;
}

/// The share to run: as told, else as a scheduler's environment says, else everything.
jobs::Shard shard_of(const Command& command, Console& console) {
  std::optional<unsigned> count;
  if (command.options.count("shard")) {
    const auto text = command.options["shard"].as<std::string>();
    if (!text.starts_with("auto/")) return jobs::parse_shard(text);
    count = jobs::parse_shard(fmt::format("1{}", text.substr(4))).count;
  }
  const auto found = jobs::shard_of_environment(environment, count);
  if (!found) {
    if (count)
      throw Error{Error::Kind::usage, "no scheduler says which share this is", "--shard auto", "give --shard I/N"};
    return {};
  }
  if (found->shard.count > 1)
    console.info(fmt::format("{}: share {} of {}", found->by, found->shard.index + 1, found->shard.count));
  return found->shard;
}

/// The jobs of one share. Of all lists alike: every machine has to see the same list and the same models.
std::vector<jobs::Prepared> share_of(std::vector<jobs::Prepared> jobs, const jobs::Shard& shard) {
  std::vector<jobs::Dealt> all;
  for (const auto& job : jobs) all.push_back({job.line.id, jobs::estimated_work(job.job)});
  const auto shares = jobs::deal(all, shard.count);
  std::vector<jobs::Prepared> out;
  for (std::size_t i = 0; i < jobs.size(); ++i)
    if (shares[i] == shard.index) out.push_back(std::move(jobs[i]));
  return out;
}

/// What --name calls the list; empty: nothing. @throws Error{usage}
std::string list_name(const Command& command) {
  if (!command.options.count("name")) return {};
  auto name = command.options["name"].as<std::string>();
  if (name == "auto") name = std::filesystem::path(command.inputs.front()).stem().string();
  const auto fits = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' || c == '.';
  };
  if (name.empty() || name.size() > 100 || name.front() == '.' || !std::all_of(name.begin(), name.end(), fits))
    throw Error{Error::Kind::usage, fmt::format("'{}' is no name for a file", name), "--name",
                "letters, digits, '-', '_' and '.'"};
  return name;
}

int collect_only(Console& console, const std::vector<jobs::Prepared>& jobs, const jobs::BatchOptions& options,
                 const std::string& suffix) {
  const auto collected = jobs::collect(jobs, options.folder, options.check_full);
  jobs::write_summaries(collected, options.folder, suffix);
  for (const auto& entry : collected.entries) {
    if (!entry.record)
      console.failure({"job_missing", fmt::format("{} ({}): was not run", entry.line.id, entry.line.where)});
    else if (!entry.ok())
      console.failure({"job_failed", fmt::format("{} ({}): {}; status {}", entry.line.id, entry.line.where,
                                                 entry.record->error, entry.record->exit_status)});
  }
  console.info(fmt::format("{} jobs: {} there, {} failed, {} not run", collected.entries.size(), collected.ok,
                           collected.failed, collected.missing));
  return collected.failed + collected.missing > 0 ? 7 : 0;
}

}  // namespace

int batch(const Words& words) {
  const auto options = app::batch_options();
  const auto command = parse_command(words, options);
  if (command.help) {
    std::ostringstream out;
    out << "weft batch JOBS -o DIR\n\nJOBS is a list (a JSON object a line, or CSV), a folder of models, a pattern, or "
           "models. A line:\n"
           R"(  {"id": "a", "models": ["a.stl"], "profiles": ["p.ini"], "set": {"layer_height": 0.2}, "output": "a.gcode"})"
           "\nOnly models are needed. -p and -s hold for every job; a job's own profiles and settings come after "
           "them.\n\n"
        << options << "\n"
        << common_help();
    return write_output("-", out.str()), 0;
  }
  if (command.inputs.empty())
    throw Error{Error::Kind::usage, "no list of jobs was given", "weft batch",
                "as in weft batch jobs.jsonl -p printer.ini -o results"};
  auto batch_options = batch_options_of(command);
  StageCache cache(cache_options_of(command));
  batch_options.cache = &cache;
  Console console(command.console);
  const auto name = list_name(command);
  auto jobs = prepare_all(console, jobs::read_jobs(command.inputs, name), command);
  const auto named = name.empty() ? name : "-" + name;
  if (command.options["collect"].as<bool>()) {
    check_reports(jobs, command, named);
    return collect_only(console, jobs, batch_options, named);
  }
  const auto shard = shard_of(command, console);
  jobs = share_of(std::move(jobs), shard);
  const auto suffix = named + (shard.count > 1 ? fmt::format("-{}-of-{}", shard.index + 1, shard.count) : "");
  return conclude(console, run_jobs(console, jobs, batch_options, command, suffix), cache, command);
}

}  // namespace weft::app
