// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/error.h"
#include "pipeline/report.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace weft::app {

/// What a job may use before it is stopped, and whether someone stopped it: SIGINT, SIGTERM, --timeout, --max-memory.
/// One at a time may exist.
class Limits {
 public:
  /// Listens to the signals from now on.
  /// @param timeout_s, max_memory_mb 0: none
  Limits(double timeout_s, double max_memory_mb);
  ~Limits();
  Limits(const Limits&) = delete;
  Limits& operator=(const Limits&) = delete;

  /// Should the work end? Cheap enough to ask every 10 µs, from any thread: memory is looked at every 10 ms.
  bool reached() const;
  /// What was reached, as the error that ends the job: status 130, nothing is written.
  Error error() const;

 private:
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin_ = Clock::now();
  mutable std::atomic<Clock::rep> next_look_ = 0;  ///< at memory
  double timeout_s_, max_memory_mb_;
};

/// Ends the program where a limit was reached and the work does not end by itself soon after: it asks every few
/// milliseconds, but what a library does in one go, or a disk that does not answer, it cannot ask in.
class Watchdog {
 public:
  /// @param last_words says why, from the watchdog's thread, with what the report knew; then the status is 130
  Watchdog(const Limits& limits, std::function<void(const Error&, Report)> last_words);
  /// Dismisses.
  ~Watchdog();
  Watchdog(const Watchdog&) = delete;
  Watchdog& operator=(const Watchdog&) = delete;

  /// Keeps a copy of what is known, at most ten a second.
  void remember(const Report& report);
  /// From here on nothing is ended from outside: the result is being written, or the work has ended by itself.
  void dismiss();

 private:
  void watch();

  const Limits& limits_;
  const std::function<void(const Error&, Report)> last_words_;
  std::mutex mutex_;  ///< of all below
  std::condition_variable changed_;
  bool dismissed_ = false;
  Report known_;
  std::chrono::steady_clock::time_point remembered_{};
  std::thread thread_;
};

/// Makes std::terminate say what happened where the system refused memory or a thread while one was being made, which
/// the thread library does not report otherwise: an error of one line and status 130; 1 for anything else.
void explain_termination();

/// Makes of standard streams what the program counts on: one that is closed is not the next file that is opened, whose
/// bytes would then have messages among them, and one whose reader has gone is an error of writing, no end by a signal.
void hold_standard_streams();

}  // namespace weft::app
