// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "cli/program.h"

#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

/// A folder in which models are sliced to `out.gcode`, with a report beside it.
struct Print {
  Scratch scratch;

  /// The G-code; where the program is to fail, what it says of it.
  std::string slice(std::vector<std::string> more, int status = 0) const {
    std::vector<std::string> words{"slice", "-o", "out.gcode", "--report", "report.json", "-q"};
    words.insert(words.end(), more.begin(), more.end());
    const auto run = weft(words, scratch.path());
    INFO(run.err);
    REQUIRE(run.status == status);
    return status == 0 ? scratch.read("out.gcode") : run.err;
  }
  nlohmann::json report() const { return nlohmann::json::parse(scratch.read("report.json")); }
};
