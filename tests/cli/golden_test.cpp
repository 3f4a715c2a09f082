// SPDX-License-Identifier: GPL-3.0-or-later
// Golden G-code: small models whose every move is known, so that a change of what is printed is seen as what it is.
// WEFT_GOLDEN=write test_cli "golden*" writes the files anew; read the difference before you commit it.
#include "program.h"
#include "source.h"

#include <cstdlib>
#include <fstream>
#include <sstream>

#include <catch2/catch.hpp>

namespace fs = std::filesystem;

namespace {

struct Golden {
  std::string name, model;
  std::vector<std::string> options;
};

const std::vector<Golden>& golden() {
  static const std::vector<Golden> all{
      {"fin", "fin.stl", {}},
      {"portal", "portal.stl", {"-p", "profiles/quality/fine.ini"}},
      {"block-klipper", "block.stl", {"-s", "firmware=klipper", "-s", "infill_pattern=gyroid", "-s", "top_layers=2"}},
      {"blocks", "block.stl", {"--copies", "2", "-s", "brim_width=2", "-s", "retraction_hop=0.3", "--scale", "0.5"}},
  };
  return all;
}

/// What a printer reads, and what names it: without the settings, hashes and pictures, which change with every setting
/// that is new.
std::vector<std::string> moves_of(const std::string& gcode) {
  std::vector<std::string> lines;
  std::istringstream in(gcode);
  for (std::string line; std::getline(in, line);)
    if (line != ";" && !line.starts_with("; ")) lines.push_back(std::move(line));
  return lines;
}

/// The first place where two files differ, as a reader wants it: three lines before, and what either has there.
std::string difference(const std::vector<std::string>& was, const std::vector<std::string>& is) {
  std::size_t at = 0;
  while (at < was.size() && at < is.size() && was[at] == is[at]) ++at;
  if (at == was.size() && at == is.size()) return {};
  std::ostringstream out;
  out << "line " << at + 1 << " of " << was.size() << " (now " << is.size() << "):\n";
  for (std::size_t i = at < 3 ? 0 : at - 3; i < at; ++i) out << "   " << was[i] << '\n';
  for (std::size_t i = at; i < std::min(at + 6, was.size()); ++i) out << " - " << was[i] << '\n';
  for (std::size_t i = at; i < std::min(at + 6, is.size()); ++i) out << " + " << is[i] << '\n';
  return out.str();
}

}  // namespace

TEST_CASE("golden: small models give the G-code that they gave", "[cli][golden]") {
  const fs::path data = tests::source / "tests/data/golden";
  const char* const mode = std::getenv("WEFT_GOLDEN");
  for (const Golden& each : golden()) {
    std::vector<std::string> words{"slice", (data / each.model).string(),      "-q", "-o", "-",
                                   "-p",    "profiles/printers/marlin-220.ini"};
    words.insert(words.end(), each.options.begin(), each.options.end());
    const Run run = weft(words, tests::source);
    CAPTURE(each.name, run.err);
    REQUIRE(run.status == 0);
    const auto is = moves_of(run.out);
    const fs::path file = data / (each.name + ".gcode");
    if (mode != nullptr && std::string(mode) == "write") {
      std::ofstream out(file);
      for (const std::string& line : is) out << line << '\n';
      WARN("written: " << file.string());
      continue;
    }
    std::ifstream in(file);
    REQUIRE(in);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    const std::string changed = difference(moves_of(text), is);
    INFO(changed);
    CHECK(changed.empty());
  }
}
