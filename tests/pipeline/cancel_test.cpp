#include "core/error.h"
#include "pipeline/pipeline.h"

#include <atomic>
#include <map>
#include <mutex>

#include <catch2/catch.hpp>

using namespace weft;

namespace {

Job box_job() {
  Job job;
  job.models = {std::string(WEFT_SOURCE_DIR) + "/examples/box.stl"};
  job.settings.machine.machine_width = job.settings.machine.machine_depth = 200_mm;
  return job;
}

}  // namespace

TEST_CASE("pipeline: a job asks in each stage, for every few layers, whether to go on", "[pipeline]") {
  std::mutex mutex;
  std::string stage;
  std::map<std::string, std::size_t> asked;
  Watch watch;
  watch.progress = [&](std::string_view name, double) {
    const std::lock_guard lock(mutex);
    stage = name;
  };
  watch.cancelled = [&] {
    const std::lock_guard lock(mutex);
    ++asked[stage];
    return false;
  };
  Report report;
  REQUIRE(run(box_job(), watch, report));
  REQUIRE(report.layers > 40);
  for (const char* one_pass : {"slicing", "walls", "G-code"}) {
    CAPTURE(one_pass);
    CHECK(asked[one_pass] >= report.layers);
  }
  CHECK(asked["infill"] >= report.layers + report.layers / 8);  // shells by runs of layers, then fill
  CHECK(asked["travel"] >= 2 * report.layers);                  // order, then routes
}

TEST_CASE("pipeline: a job that is stopped in any stage ends as interrupted", "[pipeline]") {
  const std::string last = GENERATE("slicing", "walls", "infill", "travel", "G-code");
  std::atomic<bool> reached = false;
  Watch watch;
  watch.progress = [&](std::string_view stage, double) { reached = reached || stage == last; };
  watch.cancelled = [&] { return reached.load(); };
  Report report;
  try {
    run(box_job(), watch, report);
    FAIL("was not stopped");
  } catch (const Error& error) {
    CHECK(error.kind() == Error::Kind::interrupted);
  }
}
