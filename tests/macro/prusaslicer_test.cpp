// SPDX-License-Identifier: GPL-3.0-or-later
#include "macro/macro.h"
#include "source.h"

#include <fstream>
#include <string>

#include <catch2/catch.hpp>

using namespace weft::macro;

namespace {

/// The printer of tests/data/macro, and what the print variables were when PrusaSlicer was asked.
Variables printer() {
  Variables out;
  std::ifstream in(tests::source / "tests/data/macro/printer.ini");
  for (std::string line; std::getline(in, line);) {
    const auto equals = line.find(" = ");
    if (line[0] == '#' || equals == std::string::npos) continue;
    std::string text;
    for (std::size_t i = equals + 3; i < line.size(); ++i) {
      const bool line_end = line.compare(i, 2, "\\n") == 0;
      text += line_end ? '\n' : line[i];
      if (line_end) ++i;
    }
    out[line.substr(0, equals)] = variable_of(text);
  }
  out["print_bed_min"] = variable_of("0,0");
  out["print_bed_max"] = variable_of("250,210");
  out["first_layer_print_min"] = variable_of("120,100");
  out["first_layer_print_size"] = variable_of("10,10");
  out["total_layer_count"] = variable(std::int64_t{10});
  for (const auto* zero : {"initial_tool", "initial_extruder", "current_extruder"})
    out[zero] = variable(std::int64_t{0});
  out["num_objects"] = variable(std::int64_t{1});
  out["has_wipe_tower"] = variable(false);
  out["input_filename_base"] = variable(std::string("cube"));
  return out;
}

}  // namespace

TEST_CASE("macro: what PrusaSlicer 2.5 makes of custom G-code, weft makes of it", "[golden]") {
  const auto variables = printer();
  std::ifstream in(tests::source / "tests/data/macro/expressions.txt");
  std::size_t count = 0;
  for (std::string line; std::getline(in, line); ++count) {
    const auto tab = line.find('\t');
    REQUIRE(tab != std::string::npos);
    const auto code = line.substr(0, tab);
    INFO(code);
    Scope scope;
    Variables globals;
    const Template read(code, "start_gcode");
    CHECK_NOTHROW(read.check(variables, globals));
    CHECK(read.expand(variables, scope) == line.substr(tab + 1));
  }
  CHECK(count >= 100);
}
