// SPDX-License-Identifier: GPL-3.0-or-later
// libFuzzer target for lists of jobs: the bytes as JSON lines and as CSV. What is wrong is an error with its line, what
// is taken has a name and models, and the whole is the same twice.
#include "core/error.h"
#include "jobs/job_list.h"

#include <cstdint>
#include <cstdlib>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace weft;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto require = [](bool holds) {
    if (!holds) std::abort();
  };
  for (const auto read : {jobs::read_jsonl, jobs::read_csv}) {
    try {
      const auto list = read(text, "list", "folder"), again = read(text, "list", "folder");
      require(list.jobs.size() == again.jobs.size() && list.errors.size() == again.errors.size());
      for (const auto& error : list.errors) require(error.where().starts_with("list:"));
      for (const auto& job : list.jobs) require(!job.where.empty());
    } catch (const Error& error) {
      require(error.kind() == Error::Kind::usage && !std::string_view(error.what()).empty());
    }
  }
  return 0;
}
