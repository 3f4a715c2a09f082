// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "jobs/job_list.h"

#include <filesystem>
#include <span>
#include <string>

namespace weft::jobs {

/// The folder of the results while a run is at work in it. Several runs may be (shares of one list on one file system);
/// one that is there alone first clears away what a killed run left half written.
class Workplace {
 public:
  /// Makes the folder, and those that outputs need. @throws Error{file}
  Workplace(const std::filesystem::path& folder, std::span<const std::string> outputs);
  ~Workplace();
  Workplace(const Workplace&) = delete;
  Workplace& operator=(const Workplace&) = delete;

 private:
  int lock_ = -1;
};

}  // namespace weft::jobs
