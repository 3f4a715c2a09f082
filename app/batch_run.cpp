// SPDX-License-Identifier: GPL-3.0-or-later
#include "batch_run.h"

#include "core/figures.h"
#include "core/version.h"

#include <algorithm>
#include <atomic>
#include <csignal>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace fs = std::filesystem;
namespace po = boost::program_options;

namespace weft::app {
namespace {

using Json = nlohmann::ordered_json;

std::atomic<bool> interrupted = false;
/// The first signal has running jobs stop; the second ends the program at once.
extern "C" void note_batch_interrupt(int signal) {
  interrupted = true;
  std::signal(signal, SIG_DFL);
}

void show(Console& console, const jobs::Progress& p) {
  const auto done = p.made + p.unchanged + p.failed;
  const auto failed = p.failed == 0 ? std::string() : fmt::format(", {} failed", p.failed);
  const auto left = p.left_s ? fmt::format(", {} left", short_duration(*p.left_s)) : std::string();
  Json facts{{"stage", "batch"},
             {"share", rounded3(p.share)},
             {"jobs", p.jobs},
             {"made", p.made},
             {"unchanged", p.unchanged},
             {"failed", p.failed},
             {"running", p.running},
             {"layers_per_s", rounded3(p.layers_per_s)},
             {"seconds", rounded3(p.seconds)}};
  if (p.left_s) facts["left_s"] = rounded3(*p.left_s);
  console.progress_of(p.share,
                      fmt::format("{}/{} jobs{}, {:.0f} layers/s{}", done, p.jobs, failed, p.layers_per_s, left),
                      facts.dump());
}

void tell(Console& console, const jobs::JobLine& line, jobs::Fate fate, const jobs::Outcome& outcome) {
  switch (fate) {
    case jobs::Fate::made:
      return console.detail(fmt::format("{}: {} layers in {:.2f} s", line.id, outcome.report.layers, outcome.seconds));
    case jobs::Fate::unchanged:
      return console.detail(fmt::format("{}: unchanged", line.id));
    case jobs::Fate::failed:
      return console.failure({"job_failed", fmt::format("{} ({}): {}; status {}", line.id, line.where, outcome.error,
                                                        outcome.exit_status)});
    case jobs::Fate::not_run:
      break;
  }
}

/// What a run writes stays in the folder of its results, wherever links in it lead. @throws Error{usage}
void refuse_leading_out(const fs::path& folder, const fs::path& inside, const std::string& where) {
  std::error_code unknown;
  auto whole = fs::weakly_canonical(folder, unknown);
  if (!whole.has_filename()) whole = whole.parent_path();  // "out/"
  const auto path = fs::weakly_canonical(folder / inside, unknown);
  if (unknown || std::mismatch(whole.begin(), whole.end(), path.begin(), path.end()).first != whole.end())
    throw Error{Error::Kind::usage, fmt::format("{} leads out of the folder of the results", inside.string()), where,
                "a symbolic link is in its way"};
}

/// No result may be a file that some job reads. What jobs leave beside their G-code is checked by its names.
void check_files(const std::vector<jobs::Prepared>& jobs, const Command& command, std::vector<Error>& errors) {
  Files files = command.files;
  const auto noted = [&](const jobs::Prepared& job, const auto& check) {
    try {
      check();
    } catch (const Error& error) {
      errors.emplace_back(error.kind(), fmt::format("output {}", error.problem()), job.line.where, error.hint());
    }
  };
  for (const auto& job : jobs)
    noted(job, [&] {
      for (const auto& path : job.read) files.reads(path.string());
    });
  for (const auto& job : jobs) noted(job, [&] { refuse_leading_out(*command.output, job.line.output, "output"); });
  for (const auto& job : jobs)
    noted(job, [&] { files.writes((fs::path(*command.output) / job.line.output).string(), "output"); });
}

void tell_hook(Console& console, const jobs::JobLine& line, const jobs::Outcome& outcome) {
  if (!outcome.hook || outcome.hook->ok()) return;
  console.warning(
      {"exec_failed", fmt::format("{} ({}): --exec ended with status {} ({} runs); the next run of the batch "
                                  "tries it again",
                                  line.id, line.where, outcome.hook->status, outcome.hook->attempts)});
}

std::uint64_t bytes_from(const std::string& text, const std::string& option) {
  std::size_t end = 0;
  double v = 0;
  try {
    v = std::stod(text, &end);
  } catch (const std::exception&) {
    end = 0;
  }
  auto unit = text.substr(end);
  if (unit.ends_with("B") || unit.ends_with("b")) unit.pop_back();
  const double factor = unit.empty() || unit == "M" || unit == "m" ? 1 << 20
                        : unit == "G" || unit == "g"               ? 1 << 30
                        : unit == "K" || unit == "k"               ? 1 << 10
                                                                   : 0;
  if (end == 0 || factor == 0 || !(v > 0 && v * factor < 1e18))
    throw Error{Error::Kind::usage, fmt::format("'{}' is not a size", text), option,
                "as in " + option + " 4G, or 512 for megabytes"};
  return static_cast<std::uint64_t>(v * factor);
}

}  // namespace

po::options_description running_options() {
  po::options_description out("Options of batch and sweep");
  out.add_options()("max-memory", po::value<std::string>()->value_name("SIZE"),
                    "run fewer jobs at once rather than hold more (4G, 512M; default: four fifths of what is free)")(
      "job-timeout", po::value<double>()->value_name("SECONDS"),
      "a job that takes longer is stopped and counts as failed")(
      "resume", po::bool_switch(),
      "go on where a run ended: what was refused for its settings, model or moves is not tried again")(
      "retries", po::value<unsigned>()->value_name("N")->default_value(0),
      "begin a job again, up to N times, that could not read or write (status 6) or was stopped (130)")(
      "check", po::value<std::string>()->value_name("quick|full")->default_value("quick"),
      "how files are known to be unchanged: by size, times and place, or by reading all of them")(
      "exec", po::value<std::string>()->value_name("COMMAND"),
      "run that program when a job has ended, with what became of it in the environment (WEFT_OUTPUT, WEFT_STATUS …) "
      "and its report on standard input; no shell is in between")(
      "exec-retries", po::value<unsigned>()->value_name("N")->default_value(2),
      "run it again, up to N times, when it fails")(
      "exec-timeout", po::value<double>()->value_name("SECONDS")->default_value(600), "end it when it takes longer");
  add_cache_options(out);
  return out;
}

void add_cache_options(po::options_description& to) {
  to.add_options()(
      "cache", po::value<std::string>()->value_name("DIR"),
      "keep results of stages there, for later runs and other processes: a mesh is read, sliced and walled once")(
      "cache-size", po::value<std::string>()->value_name("SIZE")->default_value("4G"),
      "most that the folder of --cache may hold");
}

CacheOptions cache_options_of(const Command& command) {
  CacheOptions out;
  if (command.options.count("cache")) out.folder = command.options["cache"].as<std::string>();
  out.max_disk = bytes_from(command.options["cache-size"].as<std::string>(), "--cache-size");
  return out;
}

std::string told(const StageCache& cache) {
  std::string out;
  for (const auto& c : cache.counts())
    out += fmt::format("{}{} made {}, from memory {}, from disk {}", out.empty() ? "" : "; ", c.stage, c.made,
                       c.from_memory, c.from_disk);
  if (cache.damaged() > 0) out += fmt::format("; {} damaged entries were made again", cache.damaged());
  if (cache.unwritten() > 0) out += fmt::format("; {} results could not be kept on disk", cache.unwritten());
  return out;
}

namespace {

unsigned count_of(const po::variables_map& options, const char* name) {
  const auto count = options[name].as<unsigned>();
  if (count > 1000) throw Error{Error::Kind::usage, "must be 0 … 1000", fmt::format("--{}", name)};
  return count;
}

jobs::Hook hook_of(const po::variables_map& options) {
  jobs::Hook out;
  if (options.count("exec")) out.words = jobs::hook_words(options["exec"].as<std::string>());
  out.retries = count_of(options, "exec-retries");
  out.timeout_s = options["exec-timeout"].as<double>();
  if (!(out.timeout_s > 0 && out.timeout_s <= 1e9))
    throw Error{Error::Kind::usage, "must be a number of seconds above 0", "--exec-timeout"};
  return out;
}

bool check_full(const Command& command) {
  const auto how = command.options["check"].as<std::string>();
  if (how != "quick" && how != "full")
    throw Error{Error::Kind::usage, fmt::format("'{}' is not one of quick, full", how), "--check"};
  return how == "full";
}

}  // namespace

jobs::BatchOptions batch_options_of(const Command& command) {
  jobs::BatchOptions out;
  const auto& o = command.options;
  if (!command.output || *command.output == "-")
    throw Error{Error::Kind::usage, "in which folder should the results be?", "-o", "add -o DIR"};
  out.folder = *command.output;
  out.threads = command.threads;
  out.resume = o["resume"].as<bool>();
  out.retries = count_of(o, "retries");
  out.check_full = check_full(command);
  out.hook = hook_of(o);
  if (o.count("max-memory")) out.max_memory = bytes_from(o["max-memory"].as<std::string>(), "--max-memory");
  if (o.count("job-timeout")) {
    out.timeout_s = o["job-timeout"].as<double>();
    if (!(out.timeout_s > 0 && out.timeout_s <= 1e9))
      throw Error{Error::Kind::usage, "must be a number of seconds above 0", "--job-timeout"};
  }
  return out;
}

std::vector<jobs::Prepared> prepare_all(Console& console, jobs::JobList list, const Command& command) {
  const bool keep_going = command.options.count("keep-going") && command.options["keep-going"].as<bool>();
  auto jobs =
      jobs::prepare(std::move(list.jobs),
                    {command.profiles, command.settings, command.import, keep_going, command.made_at}, list.errors);
  if (list.errors.empty()) check_files(jobs, command, list.errors);
  if (list.errors.empty()) return jobs;
  constexpr std::size_t most = 20;  // a list with a wrong column has an error on every line
  const auto count = list.errors.size();
  for (std::size_t i = 0; i + 1 < std::min(count, most); ++i) console.error(list.errors[i]);
  if (count > most)
    throw Error{list.errors.front().kind(), fmt::format("{} lines cannot be run; nothing was", count),
                list.errors[most - 1].where(), "the first 19 are above"};
  throw list.errors.back();
}

void check_reports(const std::vector<jobs::Prepared>& jobs, const Command& command, const std::string& suffix) {
  Files files = command.files;
  for (const auto& job : jobs)
    for (const auto& path : job.read) files.reads(path.string());
  std::vector<std::string> names{"index.html", ".weft/jobs"};
  for (auto& name : jobs::summary_names(suffix)) names.push_back(std::move(name));
  for (const auto& name : names) {
    refuse_leading_out(*command.output, name, "-o");
    files.writes((fs::path(*command.output) / name).string(), "-o");
  }
}

Finished run_jobs(Console& console, const std::vector<jobs::Prepared>& jobs, const jobs::BatchOptions& options,
                  const Command& command, const std::string& suffix) {
  check_reports(jobs, command, suffix);
  std::signal(SIGINT, note_batch_interrupt);
  std::signal(SIGTERM, note_batch_interrupt);
  jobs::BatchWatch watch;
  watch.interrupted = [] { return interrupted.load(); };
  watch.progress = [&](const jobs::Progress& p) { show(console, p); };
  watch.ended = [&](const jobs::JobLine& line, jobs::Fate fate, const jobs::Outcome& outcome) {
    tell(console, line, fate, outcome);
    tell_hook(console, line, outcome);
  };
  Finished out;
  out.result = jobs::run_batch(jobs, options, watch);
  out.collected = jobs::collect(jobs, options.folder, options.check_full);
  jobs::write_summaries(out.collected, options.folder, suffix);
  return out;
}

int conclude(Console& console, const Finished& finished, const StageCache& cache, const Command& command) {
  const auto& [result, collected] = finished;
  const auto& p = result.progress;
  const int status = result.interrupted ? 130 : collected.failed + collected.missing + result.hooks_failed > 0 ? 7 : 0;
  const auto text = fmt::format(
      "{} jobs: {} made, {} unchanged, {} failed{}; {} layers in {}, {:.0f} layers/s, {:.2f} jobs/s, peak {:.0f} MB",
      p.jobs, p.made, p.unchanged, p.failed, collected.missing ? fmt::format(", {} not run", collected.missing) : "",
      p.layers, short_duration(p.seconds), p.layers_per_s,
      p.seconds > 0 ? static_cast<double>(p.made) / p.seconds : 0.0, peak_memory_mb());
  console.info(text);
  console.detail("cache: " + told(cache));
  if (cache.unwritten() > 0)
    console.warning({"cache_not_written",
                     fmt::format("{} results could not be kept in --cache; is the disk full?", cache.unwritten())});
  if (command.report) {
    Json stages = Json::object();
    for (const auto& c : cache.counts())
      stages[c.stage] = {{"made", c.made}, {"from_memory", c.from_memory}, {"from_disk", c.from_disk}};
    stages["damaged"] = cache.damaged();
    stages["unwritten"] = cache.unwritten();
    const Json report{{"weft", version},
                      {"status", status == 0   ? "ok"
                                 : status == 7 ? "failed"
                                               : "interrupted"},
                      {"jobs", p.jobs},
                      {"made", p.made},
                      {"unchanged", p.unchanged},
                      {"failed", collected.failed},
                      {"not_run", collected.missing},
                      {"put_back", result.put_back},
                      {"retried", result.retried},
                      {"exec_failed", result.hooks_failed},
                      {"layers", p.layers},
                      {"seconds", rounded3(p.seconds)},
                      {"layers_per_s", rounded3(p.layers_per_s)},
                      {"cache", std::move(stages)},
                      {"max_memory_mb", result.max_memory >> 20},
                      {"peak_memory_mb", rounded3(peak_memory_mb())}};
    write_output(*command.report, report.dump(2) + "\n");
  }
  if (result.interrupted)
    throw Error{
        Error::Kind::interrupted, "interrupted", {}, "what is made stays; the same command with --resume goes on"};
  return status;
}

}  // namespace weft::app
