// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/memory_gate.h"

#include <algorithm>

namespace weft::jobs {

std::uint64_t MemoryGate::sum() const {
  std::uint64_t total = 0;
  for (const auto& [job, estimate] : running_) total += estimate;
  return total;
}

bool MemoryGate::admits(std::uint64_t estimate) const {
  if (limit_ == 0 || running_.empty()) return true;
  return static_cast<double>(before_) + correction_ * static_cast<double>(sum() + estimate) <=
         static_cast<double>(limit_);
}

void MemoryGate::end(std::size_t job) {
  running_.erase(job);
  std::erase_if(order_, [&](const auto& entry) { return entry.second == job; });
  leaving_ = false;
}

MemoryGate::Verdict MemoryGate::look(std::uint64_t held) {
  if (limit_ == 0 || running_.empty()) return {};
  if (held > before_)
    correction_ = std::max(correction_, static_cast<double>(held - before_) / static_cast<double>(sum()));
  if (held <= limit_ || leaving_) return {};
  if (running_.size() == 1) return {Advice::free_memory, running_.begin()->first};
  leaving_ = true;
  return {Advice::put_back, order_.rbegin()->second};
}

}  // namespace weft::jobs
