// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "cli/program.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

/// What filament and machine cost in the tests, as options.
inline const std::vector<std::string> prices{"--filament-cost", "25", "--machine-hourly-cost", "1.5",
                                             "--currency",      "EUR"};

/// The report of a run that succeeds: `words`, then `more`, then the options that ask for it.
inline nlohmann::json report_of(const Scratch& scratch, std::vector<std::string> words,
                                const std::vector<std::string>& more = {}) {
  words.insert(words.end(), more.begin(), more.end());
  words.insert(words.end(), {"--report", "report.json", "-q"});
  const auto run = weft(words, scratch.path());
  INFO(run.err);
  REQUIRE(run.status == 0);
  return nlohmann::json::parse(scratch.read("report.json"));
}
