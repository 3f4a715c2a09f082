// SPDX-License-Identifier: GPL-3.0-or-later
#include "gcode/substitutions.h"

#include "settings_error.h"

#include <string>
#include <thread>
#include <vector>

#include <catch2/catch.hpp>

using namespace weft;
using Catch::Matchers::Contains;
using gcode::Substitutions;

namespace {
std::string done(const std::string& setting, const std::string& text) {
  return Substitutions(setting).done(text);
}
std::string message(const std::string& setting, const std::string& text = "") {
  return test::settings_error([&] { done(setting, text); });
}
}  // namespace

TEST_CASE("substitutions: plain texts stand for themselves, whatever they mean in an expression") {
  CHECK(done("", "M204 S900\n") == "M204 S900\n");
  CHECK(done("s/M204 S900/M204 S500/", "M204 S900\nG1 X1\nM204 S900\n") == "M204 S500\nG1 X1\nM204 S500\n");
  CHECK(done("s/X1.5*(2)/$1\\\\/", "X1.5*(2) X155(2)") == "$1\\ X155(2)");
  CHECK(done("s/M107\\n//", "M106 S1\nM107\nM107\nG1\n") == "M106 S1\nG1\n");
  CHECK(done("s|a/b|c|", "a/b") == "c");
  CHECK(done("s/a\\/b/c\\/d/", "a/b") == "c/d");
  CHECK(done("s/\\E/x/", "\\E E") == "x E");
}

TEST_CASE("substitutions: expressions are Perl's, and a line's ends are where it begins and ends") {
  CHECK(done(R"(s/^M73 P(\d+) R\d+$/M117 $1 percent/r)", "M73 P10 R5\nG1 ; M73 P9 R1\nM73 P11 R4\n") ==
        "M117 10 percent\nG1 ; M73 P9 R1\nM117 11 percent\n");
  CHECK(done(R"(s/^;.*\n//r)", ";a\nG1\n;b\n;c\n") == "G1\n");
  CHECK(done(R"(s/A.B/-/r)", "A\nB AxB") == "A\nB -");
  CHECK(done(R"(s/A.B/-/rs)", "A\nB AxB") == "- -");
  CHECK(done("s/g1/G0/i", "G1 g1") == "G0 G0");
  CHECK(done("s/G1/G0/w", "G1 G10 XG1") == "G0 G10 XG1");
  CHECK(done("s/G1|M1/x/rw", "G1 G10 M1") == "x G10 x");
  CHECK(done(R"(s/(?=X)/ /r)", "G1X1") == "G1 X1");
}

TEST_CASE("substitutions: they are done in their order, each on what the one before it left") {
  CHECK(done("s/a/b/\n\n  s/b/c/  \n", "a b") == "c c");
}

TEST_CASE("substitutions: what is wrong is told with its line") {
  CHECK_THAT(message("s/a/b/\nx/a/b/"), Contains("gcode_substitutions, line 2") && Contains("is no substitution"));
  CHECK_THAT(message("s/a/b"), Contains("line 1") && Contains("a '/' is missing"));
  CHECK_THAT(message("s//b/"), Contains("nothing to look for"));
  CHECK_THAT(message("s/a/b/g"), Contains("'g' is no flag"));
  CHECK_THAT(message("s/(a/b/r"), Contains("line 1") && Contains("parenthes"));
  CHECK_THAT(message("s/a/$9/r", "a"), Contains("line 1"));
  CHECK_THAT(message("s\\a\\b\\"), Contains("is no substitution"));
}

TEST_CASE("substitutions: an expression that runs wild ends with an error") {
  CHECK_THAT(message(R"(s/(a|aa)+[bc]/x/r)", std::string(5'000, 'a') + "\n"), Contains("tries too many ways"));
}

TEST_CASE("substitutions: lines that double each other's text end with an error, not with the memory") {
  std::string doubling;
  for (int i = 0; i < 60; ++i) doubling += "s/a/aa/\n";
  CHECK_THAT(message(doubling, std::string(1'000, 'a')), Contains("gcode_substitutions, line 11: makes 1 MB of"));
}

TEST_CASE("substitutions: a text that grows much has room, and many threads may do them at once") {
  const Substitutions longer("s/a/0123456789012345678901234567890123456789/\ns/9/99/");
  std::string wanted;
  for (int i = 0; i < 10'000; ++i) wanted += "01234567899012345678990123456789901234567899";
  std::vector<std::string> results(4);
  std::vector<std::thread> threads;
  for (auto& result : results) threads.emplace_back([&] { result = longer.done(std::string(10'000, 'a')); });
  for (auto& thread : threads) thread.join();
  for (const auto& result : results) CHECK(result == wanted);
}
