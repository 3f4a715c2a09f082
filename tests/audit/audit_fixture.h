// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "audit/audit.h"

#include <string>
#include <string_view>

#include <catch2/catch.hpp>

namespace weft::audit {
using namespace weft::literals;

/// A machine of 200 × 200 × 200 mm that homes to its origin, and an audit of text against it.
struct Bench {
  MachineSettings machine;
  MaterialSettings material;
  AuditSettings settings;
  Bench() {
    machine.machine_width = machine.machine_depth = machine.machine_height = 200_mm;
    machine.home_position = Ring{{0, 0}};
  }
  Report operator()(std::string_view gcode) const { return examine_text(machine, material, settings, gcode); }
  Report moves(std::string_view gcode) const { return (*this)(std::string(preamble) + std::string(gcode)); }
  /// Homed, absolute, relative E, inside a layer: 6 lines; what follows starts on line 7.
  static constexpr std::string_view preamble =
      "G28\nG90\nM83\n;LAYER_CHANGE\n;TYPE:External perimeter\nG1 X100 Y100 Z0.2 F9000\n";
};

inline std::int64_t count_of(const Report& report, Finding::Kind kind, Side side) {
  std::int64_t n = 0;
  for (const auto& t : report.totals)
    if (t.kind == kind && t.side == side) n += t.count;
  return n;
}

}  // namespace weft::audit
