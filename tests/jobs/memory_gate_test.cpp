// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/memory_gate.h"

#include <catch2/catch.hpp>

using namespace weft::jobs;
using Advice = MemoryGate::Advice;

TEST_CASE("memory: jobs are admitted as long as their estimates fit, and one always is") {
  MemoryGate gate(1000, 100);
  CHECK(gate.admits(5000));
  gate.begin(0, 400);
  CHECK(gate.admits(500));
  CHECK_FALSE(gate.admits(501));
  gate.begin(1, 500);
  CHECK_FALSE(gate.admits(1));
  gate.end(0);
  CHECK(gate.admits(400));
}

TEST_CASE("memory: what is measured corrects the estimates") {
  MemoryGate gate(1000, 0);
  gate.begin(0, 100);
  CHECK(gate.admits(100));
  CHECK(gate.look(600).advice == Advice::go_on);  // six times the estimate
  CHECK_FALSE(gate.admits(100));
  gate.end(0);
  CHECK(gate.admits(100));
}

TEST_CASE("memory: beyond the limit the youngest job is put back, one at a time, and the last is not") {
  MemoryGate gate(1000, 0);
  gate.begin(7, 100);
  gate.begin(3, 100);
  gate.begin(5, 100);
  auto verdict = gate.look(1001);
  CHECK(verdict.advice == Advice::put_back);
  CHECK(verdict.job == 5);
  CHECK(gate.look(1200).advice == Advice::go_on);  // it is on its way out
  gate.end(5);
  CHECK(gate.look(1200).job == 3);
  gate.end(3);
  CHECK(gate.look(1200).advice == Advice::free_memory);
}

TEST_CASE("memory: without a limit everything is admitted") {
  MemoryGate gate(0, 0);
  gate.begin(0, 1ull << 60);
  CHECK(gate.admits(1ull << 60));
  CHECK(gate.look(~0ull).advice == Advice::go_on);
}
