// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>

namespace weft::jobs {

/// Decides how many jobs may run at once in bounded memory. An estimate of each from its models admits it; what the
/// process really holds corrects the estimates upwards and, when they were wrong, has the youngest job stopped to be
/// begun again later. One job may always run.
/// Not safe for use by several threads at once.
class MemoryGate {
 public:
  /// @param limit bytes; 0: no limit
  /// @param held  bytes held before the first job
  MemoryGate(std::uint64_t limit, std::uint64_t held) : limit_(limit), before_(held) {}

  /// Whether a job of that estimate may begin beside those that run.
  bool admits(std::uint64_t estimate) const;
  void begin(std::size_t job, std::uint64_t estimate) {
    running_.emplace(job, estimate), order_.emplace(++begun_, job);
  }
  void end(std::size_t job);

  enum class Advice : std::uint8_t {
    go_on,
    free_memory,  ///< beyond the limit with a single job: give back what was freed, then look again
    put_back,     ///< stop `job` and begin it again when others have ended
  };
  struct Verdict {
    Advice advice = Advice::go_on;
    std::size_t job = 0;
  };
  /// What to do when the process holds that many bytes.
  Verdict look(std::uint64_t held);

  std::uint64_t limit() const { return limit_; }
  std::size_t running() const { return running_.size(); }

 private:
  std::uint64_t sum() const;

  std::uint64_t limit_, before_;
  double correction_ = 1;  // measured over estimated, never falling
  std::uint64_t begun_ = 0;
  std::map<std::size_t, std::uint64_t> running_;  // job, estimate
  std::map<std::uint64_t, std::size_t> order_;    // when it began, job
  bool leaving_ = false;                          // a job was told to stop and has not ended yet
};

}  // namespace weft::jobs
