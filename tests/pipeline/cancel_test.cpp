// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/error.h"
#include "pipeline/pipeline.h"
#include "source.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>
#include <numbers>

#include <catch2/catch.hpp>
#include <unistd.h>

using namespace weft;

namespace {

Job box_job() {
  Job job;
  job.models = {tests::source / "examples/box.stl"};
  job.settings.machine.machine_width = job.settings.machine.machine_depth = 200_mm;
  return job;
}

/// A ring in mm, counter-clockwise around what is solid.
using MmRing = std::vector<std::array<double, 2>>;

/// A job of one layer: the sides of prisms over the rings, 0.2 mm high.
class OneLayer {
 public:
  explicit OneLayer(const std::vector<MmRing>& rings) {
    std::string bytes(84, '\0');
    std::uint32_t count = 0;
    const auto triangle = [&](std::array<std::array<double, 3>, 3> corners) {
      bytes.append(12, '\0');
      for (const auto& corner : corners)
        for (const double c : corner) {
          const auto v = static_cast<float>(c);
          bytes.append(reinterpret_cast<const char*>(&v), 4);
        }
      bytes.append(2, '\0');
      ++count;
    };
    for (const MmRing& ring : rings)
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const auto &a = ring[i], &b = ring[(i + 1) % ring.size()];
        triangle({{{a[0], a[1], 0}, {b[0], b[1], 0}, {b[0], b[1], 0.2}}});
        triangle({{{a[0], a[1], 0}, {b[0], b[1], 0.2}, {a[0], a[1], 0.2}}});
      }
    std::memcpy(bytes.data() + 80, &count, 4);
    int file = ::mkstemp(name_.data());
    REQUIRE(file >= 0);
    ::close(file);
    std::ofstream(name_, std::ios::binary) << bytes;
  }
  ~OneLayer() { std::remove(name_.c_str()); }
  OneLayer(const OneLayer&) = delete;
  OneLayer& operator=(const OneLayer&) = delete;

  Job job() const {
    Job out;
    out.models = {name_};
    out.settings.machine.machine_width = out.settings.machine.machine_depth = 500_mm;
    return out;
  }

 private:
  std::string name_ = (std::filesystem::temp_directory_path() / "weft-layer-XXXXXX").string();
};

MmRing square(double x, double y, double size) {
  return {{x, y}, {x + size, y}, {x + size, y + size}, {x, y + size}};
}

std::vector<MmRing> islands(int side) {
  std::vector<MmRing> out;
  for (int i = 0; i < side; ++i)
    for (int k = 0; k < side; ++k) out.push_back(square(i, k, 0.6));
  return out;
}

/// One region with side × side holes.
std::vector<MmRing> sieve(int side) {
  constexpr double pitch = 1.8;
  std::vector<MmRing> out{square(0, 0, pitch * side)};
  for (int i = 0; i < side; ++i)
    for (int k = 0; k < side; ++k) {
      MmRing hole = square(pitch * i + 0.4, pitch * k + 0.4, 1);
      std::reverse(hole.begin(), hole.end());
      out.push_back(std::move(hole));
    }
  return out;
}

/// One region, one ring of many corners.
std::vector<MmRing> gear(int teeth) {
  MmRing ring;
  for (int i = 0; i < 2 * teeth; ++i) {
    const double r = i % 2 == 0 ? 100 : 99, a = std::numbers::pi * i / teeth;
    ring.push_back({r * std::cos(a), r * std::sin(a)});
  }
  return {ring};
}

std::vector<MmRing> rings_in_rings(int count) {
  std::vector<MmRing> out;
  for (int i = count; i > 0; --i) {
    MmRing ring;
    const double r = 0.45 * i;
    for (int k = 0; k < 90; ++k) {
      const double a = 2 * std::numbers::pi * k / 90 * ((count - i) % 2 == 0 ? 1 : -1);
      ring.push_back({r * std::cos(a), r * std::sin(a)});
    }
    out.push_back(std::move(ring));
  }
  return out;
}

double cpu_s() {
  timespec t{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
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

TEST_CASE("pipeline: however much one layer holds, a job asks all the time", "[pipeline][law]") {
  // On one thread, by its time on the processor. What runs beside it still may lengthen one wait by chance; what never
  // asks is as long in each of three runs.
  const auto [name, rings] =
      GENERATE(table<std::string, std::vector<MmRing>>({{"islands", islands(120)},
                                                        {"sieve", sieve(60)},
                                                        {"gear", gear(10'000)},
                                                        {"rings in rings", rings_in_rings(200)}}));
  CAPTURE(name);
  const OneLayer layer(rings);
  Job job = layer.job();
  job.threads = 1;
  std::string stage, longest_in;
  double least_share = 1;
  for (int round = 0; round < 3; ++round) {
    std::size_t asked = 0;
    stage = "read";
    const double begin = cpu_s();
    double last = begin, longest = 0;
    const auto look = [&] {
      const double now = cpu_s();
      if (now - last > longest) longest = now - last, longest_in = stage;
      last = now;
    };
    Watch watch;
    watch.progress = [&](std::string_view now, double) { stage = now; };
    watch.cancelled = [&] {
      ++asked;
      look();
      return false;
    };
    Report report;
    REQUIRE(run(job, watch, report));
    look();
    CHECK(report.layers == 1);
    CHECK(asked > 1000);
    least_share = std::min(least_share, longest / (last - begin));
  }
  CAPTURE(longest_in);
  // The longest is some 7 % of the job (ways between thousands of islands), and half as long again beside much else.
  CHECK(least_share < 0.15);
}

TEST_CASE("pipeline: a job that is stopped wherever it asks leaves nothing behind", "[pipeline][law]") {
  const OneLayer layer(sieve(4));
  const Job job = layer.job();
  std::atomic<long> left = 0;
  const auto made = [&](long asks, StageCache* cache) {
    left = asks;
    Watch watch;
    watch.cancelled = [&] { return --left < 0; };
    Report report;
    return std::string(run(job, watch, report, cache)->gcode());
  };
  constexpr long many = 1L << 40;
  const auto whole = made(many, nullptr);
  const long asks = many - left;
  REQUIRE(asks > 200);
  StageCache cache({});
  int stopped = 0;
  for (long at = 0; at < asks; at += std::max(1L, asks / 150)) {
    try {
      made(at, at % 2 == 0 ? &cache : nullptr);
    } catch (const Error& error) {
      REQUIRE(error.kind() == Error::Kind::interrupted);
      ++stopped;
    }
    if (at % 5 == 0) REQUIRE((made(many, nullptr) == whole));
  }
  CHECK(stopped > 70);  // the cache spares some the work in which they would have been stopped
  CHECK((made(many, &cache) == whole));
}
