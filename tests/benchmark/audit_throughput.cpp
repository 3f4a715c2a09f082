// SPDX-License-Identifier: GPL-3.0-or-later
// How fast the boundary audit reads: `benchmark_audit FILE.gcode [MEGABYTES]` repeats the file to that size (500) in
// memory, audits it on one core, and says megabytes and moves a second. Without a file it writes an ordinary print of
// its own.
#include "audit/audit.h"

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iterator>

#include <fmt/format.h>

namespace {

std::string print_of_its_own() {
  std::string out = "G28\nG90\nM83\n";
  for (int layer = 0; layer < 100; ++layer) {
    out +=
        fmt::format(";LAYER_CHANGE\n;Z:{0:.2f}\n;HEIGHT:0.2\nG1 Z{0:.2f} F600\n;TYPE:External perimeter\n;WIDTH:0.45\n",
                    0.2 * (layer + 1));
    for (int i = 0; i < 1000; ++i)
      out += fmt::format("G1 X{:.3f} Y{:.3f} E{:.5f}\n", 110 + 0.05 * i * std::cos(0.1 * i),
                         105 + 0.05 * i * std::sin(0.1 * i), 0.01234 + 1e-5 * i);
  }
  return out;
}

}  // namespace

int main(int count, char** arguments) {
  using namespace weft;
  std::string once;
  if (count > 1) {
    std::ifstream file(arguments[1], std::ios::binary);
    once.assign(std::istreambuf_iterator<char>(file), {});
    if (once.empty()) return fmt::print(stderr, "{}: cannot be read, or is empty\n", arguments[1]), 6;
  } else {
    once = print_of_its_own();
  }
  const std::size_t wanted =
      1'000'000 * static_cast<std::size_t>(count > 2 ? std::max(1, std::atoi(arguments[2])) : 500);
  std::string gcode;
  gcode.reserve(wanted + once.size());
  while (gcode.size() < wanted) gcode += once;

  MachineSettings machine;
  machine.machine_width = Um{250'000};
  machine.machine_depth = Um{210'000};
  machine.home_position = Ring{{0, 0}};
  const auto start = std::chrono::steady_clock::now();
  const auto cpu_start = std::clock();
  const auto report = audit::examine_text(machine, {}, {}, gcode);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const double cpu_s = static_cast<double>(std::clock() - cpu_start) / CLOCKS_PER_SEC;
  const double megabytes = static_cast<double>(gcode.size()) / 1e6;
  fmt::print("{:.0f} MB in {:.2f} s ({:.2f} s of processor): {:.0f} MB/s, {:.1f} million moves/s; {}\n", megabytes,
             seconds, cpu_s, megabytes / cpu_s, static_cast<double>(report.checked_moves) / cpu_s / 1e6,
             audit::summary(report));
}
