#include "batch_run.h"
#include "verbs.h"

#include <cstdlib>
#include <sstream>

#include <fmt/format.h>

namespace po = boost::program_options;

namespace weft::app {
namespace {

po::options_description batch_options() {
  po::options_description out("Options of weft batch");
  out.add_options()("shard", po::value<std::string>()->value_name("I/N"),
                    "run the I-th of N shares (from 1). Slurm arrays, AWS Batch arrays, GitLab and Buildkite parallel "
                    "jobs and indexed Kubernetes Jobs need not say it; "
                    "auto/N gives only the count; 1/1 runs everything")(
      "collect", po::bool_switch(), "run nothing: merge what shares have left in the folder into one report");
  out.add(running_options());
  return out;
}

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

int collect_only(Console& console, const std::vector<jobs::Prepared>& jobs, const std::filesystem::path& folder) {
  const auto collected = jobs::collect(jobs, folder);
  jobs::write_summaries(collected, folder, {});
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
  const auto options = batch_options();
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
  auto jobs = prepare_all(console, jobs::read_jobs(command.inputs), command);
  if (command.options["collect"].as<bool>()) return collect_only(console, jobs, batch_options.folder);
  const auto shard = shard_of(command, console);
  std::erase_if(jobs, [&](const jobs::Prepared& job) { return !jobs::belongs(shard, job.line.id); });
  const auto suffix = shard.count > 1 ? fmt::format("-{}-of-{}", shard.index + 1, shard.count) : std::string();
  return conclude(console, run_jobs(console, jobs, batch_options, suffix), cache, command);
}

}  // namespace weft::app
