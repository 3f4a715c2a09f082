// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/batch.h"

#include "core/build_id.h"
#include "core/stop.h"
#include "jobs/hook_environment.h"
#include "jobs/memory.h"
#include "jobs/memory_gate.h"
#include "jobs/workplace.h"
#include "tasks/crew.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <deque>
#include <mutex>
#include <thread>

#include <fmt/format.h>

namespace weft::jobs {
namespace fs = std::filesystem;
namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// Why a running job is told to stop.
enum class Stop : std::uint8_t { no, timeout, put_back, too_large };

struct Running {
  Clock::time_point begin;
  std::atomic<Stop> stop = Stop::no;
  std::atomic<double> share = 0;
};

/// Bytes that a job is expected to hold. Meshes are a small part; beads and text grow with the part's surface, of which
/// the file's size is the only cheap sign. What is measured corrects it.
std::uint64_t estimate_of(const Job& job) {
  std::uint64_t bytes = 0;
  for (const auto& input : inputs_of(job)) {
    std::error_code ignored;
    const auto size = fs::file_size(input, ignored);
    if (!ignored) bytes += size;
  }
  const auto copies = static_cast<std::uint64_t>(job.placement.copies);
  return (std::uint64_t{32} << 20) * copies + 6 * bytes;
}

class Run {
 public:
  Run(const std::vector<Prepared>& jobs, const BatchOptions& options, const BatchWatch& watch)
      : jobs_(jobs),
        options_(options),
        watch_(watch),
        attempts_(jobs.size()),
        running_(jobs.size()),
        gate_(limit_of(options), resident_bytes()) {
    result_.fates.assign(jobs.size(), Fate::not_run);
    result_.max_memory = gate_.limit();
    for (std::size_t i = 0; i < jobs.size(); ++i) waiting_.push_back(i);
  }

  BatchResult work() {
    const auto broken = tasks::run_crew(
        options_.threads, [this] { return next(); }, [this](std::size_t i) { run_one(i); });
    const std::lock_guard lock(mutex_);
    for (const auto& piece : broken) result_.fates[piece.piece] = Fate::failed;  // not even its end could be noted
    result_.interrupted = watch_.interrupted();
    result_.progress = progress();
    return result_;
  }

 private:
  static std::uint64_t limit_of(const BatchOptions& options) {
    return options.max_memory != 0 ? options.max_memory : available_bytes() / 5 * 4;
  }

  /// The first job that waits, when memory admits it: in the order of the list, so that a large one is not put off for
  /// ever.
  std::optional<std::size_t> next() {
    const std::lock_guard lock(mutex_);
    if (waiting_.empty() || watch_.interrupted()) return std::nullopt;
    const auto i = waiting_.front();
    const auto estimate = estimate_of(jobs_[i].job);
    if (!gate_.admits(estimate)) return std::nullopt;
    waiting_.pop_front();
    gate_.begin(i, estimate);
    running_[i].emplace();
    running_[i]->begin = Clock::now();
    return i;
  }

  void run_one(std::size_t i) {
    auto& running = *running_[i];
    const std::function<bool()> whether = [&] {
      return look_around(i), running.stop != Stop::no || watch_.interrupted();
    };
    if (attempts_[i] > 0) {
      pause(attempts_[i]);
      running.begin = Clock::now();
    }
    Outcome outcome;
    outcome.attempts = ++attempts_[i];
    Fate fate = Fate::failed;
    bool known = false;
    try {
      const StopWhen stop_when(&whether);  // ends with the work: what became of it is noted also when it is to stop
      const auto before = fate_before(i, outcome);
      known = before.has_value();
      fate = known ? *before : make(i, whether, outcome);
    } catch (...) {
      fate = after_error(i, outcome);
    }
    if (!known && fate != Fate::not_run) conclude(i, outcome);
    if (fate == Fate::not_run)
      return end(i, fate, outcome,
                 running.stop == Stop::put_back && !watch_.interrupted() ? Again::put_back : Again::no);
    if (!known && fails_for_now(outcome) && attempts_[i] <= options_.retries && !watch_.interrupted())
      return end(i, Fate::not_run, outcome, Again::retry);
    if (!options_.hook.words.empty()) hand_over(i, outcome);
    end(i, fate, outcome, Again::no);
  }

  enum class Again : std::uint8_t { no, put_back, retry };

  /// A disk or a network may be back, and a machine less busy; what is wrong with a model or a setting stays.
  static bool fails_for_now(const Outcome& outcome) {
    return outcome.exit_status == exit_status(Error::Kind::file) ||
           outcome.exit_status == exit_status(Error::Kind::interrupted);
  }

  /// Before a job is begun again: 1, 2, 4, 8 s.
  void pause(unsigned attempts) const {
    const auto end = Clock::now() + std::chrono::seconds(1 << std::min(attempts - 1, 3U));
    while (Clock::now() < end && !watch_.interrupted()) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }

  /// Runs the hook for a job that has ended, unless it was and went well, and notes what it did.
  void hand_over(std::size_t i, Outcome& outcome) {
    try {
      const auto record = read_record(options_.folder, jobs_[i].line);
      if (!record || record->hook_done) return;
      outcome.hook = run_hook(options_.hook, hook_environment(options_.folder, jobs_[i].line, *record),
                              record->line + "\n", watch_.interrupted);
      if (outcome.hook->attempts == 0)
        outcome.hook.reset();  // interrupted before its first
      else
        write_hook(options_.folder, jobs_[i].line, *outcome.hook);
    } catch (const std::exception&) {  // the record cannot be written: then the hook is run again the next time
    }
  }

  /// What an earlier run has made of the same job, where that stands. Post: the hash of its inputs is in the outcome.
  /// @throws whatever a job can throw
  std::optional<Fate> fate_before(std::size_t i, Outcome& outcome) {
    const auto& job = jobs_[i];
    outcome.report.warnings = job.notices;
    if (job.refused) throw Error(*job.refused);
    refuse_what_never_fits(i);
    const auto record = read_record(options_.folder, job.line);
    if (record && !options_.check_full)
      for (const auto& file : record->files) files_.trust(file);
    outcome.inputs_sha256 = inputs_hash(job.job, files_);
    outcome.files = files_.known(inputs_of(job.job));
    if (!record || record->inputs_sha256 != outcome.inputs_sha256 || record->build != build_id() || !stands(*record))
      return std::nullopt;
    outcome.exit_status = record->exit_status, outcome.error = record->error;
    if (record->exit_status != 0) return Fate::failed;
    restamp(job.line, *record, outcome.files);
    return Fate::unchanged;
  }

  /// @throws whatever a job can throw; then it has made nothing
  Fate make(std::size_t i, const std::function<bool()>& whether, Outcome& outcome) {
    const auto& job = jobs_[i];
    auto& running = *running_[i];
    Watch watch;
    watch.progress = [&](std::string_view, double share) { running.share = share, look_around(i); };
    watch.cancelled = whether;
    const auto gcode = run(job.job, watch, outcome.report, options_.cache);
    outcome.exit_status = gcode ? 0 : exit_status(Error::Kind::audit);
    outcome.error = outcome.report.error;
    if (gcode) {
      write_gcode(options_.folder / job.line.output, *gcode);
      outcome.output = stamp_of(options_.folder / job.line.output);
    }
    return outcome.exit_status == 0 ? Fate::made : Fate::failed;
  }

  /// Whether what is known of an unchanged job makes running it needless.
  bool stands(const Record& record) const {
    if (record.exit_status == 0) return has_gcode(options_.folder, record, options_.check_full);
    return options_.resume && record.exit_status >= 3 && record.exit_status <= 5;
  }

  /// What had to be read to know that it is the same need not be the next time.
  void restamp(const JobLine& line, const Record& record, const std::vector<KnownFile>& files) const {
    const auto output = stamp_of(options_.folder / record.output);
    if (files == record.files && output == record.output_stamp) return;
    try {
      write_stamps(options_.folder, line, files, output);
    } catch (const Error&) {  // then it is read again
    }
  }

  double timeout_of(std::size_t i) const {
    return jobs_[i].line.timeout_s > 0 ? jobs_[i].line.timeout_s : options_.timeout_s;
  }

  /// A mesh or grid takes no less memory than its file: what is larger than all of it need not be read for minutes
  /// first.
  void refuse_what_never_fits(std::size_t i) {
    for (const auto& input : inputs_of(jobs_[i].job)) {
      std::error_code unknown;
      if (const auto size = fs::file_size(input, unknown); unknown || gate_.limit() == 0 || size <= gate_.limit())
        continue;
      running_[i]->stop = Stop::too_large;
      throw Stopped{};
    }
  }

  /// What becomes of a job that the error at hand has ended. Pre: in a handler.
  Fate after_error(std::size_t i, Outcome& outcome) const {
    const auto& running = *running_[i];
    outcome.exit_status = 1;
    try {
      throw;
    } catch (const Error& error) {
      outcome.exit_status = exit_status(error.kind());
      outcome.error = error.what();
    } catch (const Stopped&) {
      outcome.exit_status = exit_status(Error::Kind::interrupted);
    } catch (const std::bad_alloc&) {
      outcome.exit_status = exit_status(Error::Kind::interrupted);
      outcome.error = "the machine's memory is used up; try a lower --max-memory, or fewer --threads";
      return Fate::failed;
    } catch (const std::exception& error) {
      outcome.error = fmt::format("internal error: {}; this is a bug, please report it", error.what());
    } catch (...) {
      outcome.error = "internal error; this is a bug, please report it";
    }
    if (outcome.exit_status != exit_status(Error::Kind::interrupted)) return Fate::failed;
    if (watch_.interrupted() || running.stop == Stop::put_back) return Fate::not_run;
    outcome.error = why(i, running.stop);
    return Fate::failed;
  }

  /// Completes the outcome and keeps it.
  void conclude(std::size_t i, Outcome& outcome) {
    if (outcome.exit_status != 0 && outcome.report.status != Report::Status::rejected)
      outcome.report.status = Report::Status::failed;
    outcome.report.peak_memory_mb = peak_memory_mb();
    outcome.seconds = seconds_since(running_[i]->begin);
    note(i, outcome);
  }

  std::string why(std::size_t i, Stop stop) const {
    if (stop == Stop::timeout)
      return fmt::format("stopped after {:g} s; give it more with {}", timeout_of(i),
                         jobs_[i].line.timeout_s > 0 ? "timeout" : "--job-timeout");
    if (stop == Stop::no) return "was broken off; nothing was written";
    return fmt::format("stopped: alone it needs more than {} MB; give it more with --max-memory", gate_.limit() >> 20);
  }

  /// Keeps the outcome. A disk that has no room for it must not end the run: the job is run again then.
  void note(std::size_t i, Outcome& outcome) {
    try {
      write_record(options_.folder, jobs_[i].line, outcome);
    } catch (const Error& error) {
      if (outcome.exit_status == 0) outcome.exit_status = exit_status(error.kind()), outcome.error = error.what();
    } catch (const std::exception& error) {
      if (outcome.exit_status == 0) outcome.exit_status = 1, outcome.error = error.what();
    }
  }

  void end(std::size_t i, Fate fate, const Outcome& outcome, Again again) {
    const std::lock_guard lock(mutex_);
    gate_.end(i);
    running_[i].reset();
    if (again == Again::put_back) {
      ++result_.put_back;
      --attempts_[i];  // not its own fault
      waiting_.push_front(i);
      return;
    }
    if (again == Again::retry) {
      ++result_.retried;
      waiting_.push_back(i);
      return;
    }
    result_.hooks_failed += outcome.hook && !outcome.hook->ok();
    result_.fates[i] = outcome.exit_status != 0 && fate == Fate::made ? Fate::failed : fate;
    layers_ += result_.fates[i] == Fate::made ? outcome.report.layers : 0;
    if (fate == Fate::not_run) return;
    tell([&] { watch_.ended(jobs_[i].line, result_.fates[i], outcome), watch_.progress(progress()); });
  }

  /// Who watches cannot break what he watches.
  template <class Tell>
  static void tell(const Tell& what) {
    try {
      what();
    } catch (const std::exception&) {  // it was a message, no more
    }
  }

  /// Every few milliseconds of a job: is it late, is memory short, is it time to tell how far things are?
  void look_around(std::size_t i) {
    auto& running = *running_[i];
    if (const double timeout_s = timeout_of(i); timeout_s > 0 && seconds_since(running.begin) > timeout_s) {
      Stop none = Stop::no;
      running.stop.compare_exchange_strong(none, Stop::timeout);
    }
    const auto now = Clock::now().time_since_epoch().count();
    auto due = next_look_.load();
    constexpr auto interval = std::chrono::duration_cast<Clock::duration>(std::chrono::milliseconds(20)).count();
    if (now < due || !next_look_.compare_exchange_strong(due, now + interval)) return;
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock) return;
    heed(gate_.look(resident_bytes()));
    tell([&] { watch_.progress(progress()); });
  }

  void heed(MemoryGate::Verdict verdict) {
    if (verdict.advice == MemoryGate::Advice::go_on) return;
    Stop none = Stop::no;
    if (verdict.advice == MemoryGate::Advice::put_back) {
      running_[verdict.job]->stop.compare_exchange_strong(none, Stop::put_back);
      return;
    }
    if (options_.cache) options_.cache->forget();
    release_freed_memory();
    if (resident_bytes() > gate_.limit()) running_[verdict.job]->stop.compare_exchange_strong(none, Stop::too_large);
  }

  Progress progress() const {
    Progress p;
    p.jobs = jobs_.size();
    double done = 0;
    for (const auto fate : result_.fates) {
      p.made += fate == Fate::made;
      p.unchanged += fate == Fate::unchanged;
      p.failed += fate == Fate::failed;
    }
    for (const auto& running : running_)
      if (running) ++p.running, done += running->share;
    done += static_cast<double>(p.made + p.unchanged + p.failed);
    p.layers = layers_;
    p.seconds = seconds_since(begin_);
    p.share = p.jobs == 0 ? 1 : done / static_cast<double>(p.jobs);
    p.layers_per_s = p.seconds > 0 ? static_cast<double>(layers_) / p.seconds : 0;
    const double worked = done - static_cast<double>(p.unchanged);  // what was there already says nothing of the speed
    if (worked > 0.5) p.left_s = p.seconds / worked * (static_cast<double>(p.jobs) - done);
    return p;
  }

  const std::vector<Prepared>& jobs_;
  const BatchOptions& options_;
  const BatchWatch& watch_;
  const Clock::time_point begin_ = Clock::now();
  std::atomic<Clock::rep> next_look_ = 0;
  FileHashes files_;

  std::vector<unsigned> attempts_;  // one a job, read and changed by the thread that has it

  std::mutex mutex_;  // guards what follows; a job's own entry of running_ is read without it while the job runs
  std::vector<std::optional<Running>> running_;
  std::deque<std::size_t> waiting_;
  MemoryGate gate_;
  BatchResult result_;
  std::size_t layers_ = 0;
};

}  // namespace

BatchResult run_batch(const std::vector<Prepared>& jobs, const BatchOptions& options, const BatchWatch& watch) {
  std::vector<std::string> outputs;
  for (const auto& job : jobs) outputs.push_back(job.line.output);
  const Workplace workplace(options.folder, outputs);
  return Run(jobs, options, watch).work();
}

}  // namespace weft::jobs
