// SPDX-License-Identifier: GPL-3.0-or-later
// libFuzzer target for the audit's reader: any bytes, against a rectangular, a round and a concave machine. Beyond
// crashes, hangs and leaks it checks that the pieces a file arrives in do not matter, and that annotating keeps every
// byte.
//   cmake -B build/fuzz -DCMAKE_CXX_COMPILER=clang++ -DWEFT_FUZZ=ON -DWEFT_SANITIZE=fuzzer-no-link,address,undefined
//   cmake --build build/fuzz --target fuzz_audit
//   build/fuzz/tests/fuzz_audit -max_total_time=600 -max_len=4096 corpus/ examples/
#include "audit/auditor.h"

#include <cstdint>
#include <cstdlib>
#include <string>

namespace {

using namespace weft;

MachineSettings machine_for(std::uint8_t choice) {
  MachineSettings machine;
  if (choice & 1) machine.home_position = Ring{{0, 0}};
  if (choice & 2)
    machine.bed_exclude_areas = {{{0, 0}, {20'000, 0}, {0, 20'000}},
                                 {{90'000, 90'000}, {99'000, 95'000}, {80'000, 99'000}}};
  if (choice & 4) machine.bed_shape = BedShape::circle;
  if (choice & 8) {
    machine.bed_shape = BedShape::polygon;
    machine.bed_polygon = {
        {0, 0},      {200'000, 0}, {200'000, 200'000}, {150'000, 200'000}, {100'000, 50'000}, {50'000, 200'000},
        {0, 200'000}};
  }
  return machine;
}

audit::Report in_pieces(const MachineSettings& machine, std::string_view text, std::size_t piece) {
  audit::Auditor auditor(machine, {}, {}, {}, false);
  for (std::size_t i = 0; i < text.size(); i += piece) {
    const std::string own(text.substr(i, piece));  // so that reading past a piece is seen
    auditor.feed(own);
  }
  return auditor.finish();
}

void require(bool holds) {
  if (!holds) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string text(reinterpret_cast<const char*>(data) + 1, size - 1);
  const auto machine = machine_for(data[0]);
  const auto whole = audit::examine_text(machine, {}, {}, text);
  const auto pieces = in_pieces(machine, text, 1 + data[0] / 16);
  require(whole.checked_moves == pieces.checked_moves && whole.unaudited_moves == pieces.unaudited_moves);
  require(whole.violation_count == pieces.violation_count && whole.worst_outside == pieces.worst_outside);
  const auto passed = audit::check(machine, {}, {}, text, audit::Mode::annotate);
  require(passed.report().violation_count == whole.violation_count);
  require(passed.gcode().find("; weft_audit = ") != std::string_view::npos);
  for (const auto& f : whole.findings) require(!audit::describe(f).empty());
  return 0;
}
