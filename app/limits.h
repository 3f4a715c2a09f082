#pragma once
#include <chrono>
#include <optional>
#include <string>

#include "core/error.h"

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

  /// Should the work end? Cheap enough to ask for every layer, from any thread.
  bool reached() const;
  /// What was reached, as the error that ends the job: status 130, nothing is written.
  Error error() const;

 private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  double timeout_s_, max_memory_mb_;
};

/// Makes std::terminate say what happened where the system refused memory or a thread while one was being made, which the
/// thread library does not report otherwise: an error of one line and status 130; 1 for anything else.
void explain_termination();

}  // namespace weft::app
