// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/program.h"

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

const fs::path vendors = "/usr/share/PrusaSlicer/profiles";

/// The names behind `kind=` of what `weft profile list` prints.
std::vector<std::string> names_of(const std::string& kind, const std::string& listed) {
  std::vector<std::string> out;
  std::istringstream lines(listed);
  for (std::string line; std::getline(lines, line);)
    if (line.rfind(kind + "=", 0) == 0) out.push_back(line.substr(kind.size() + 1));
  return out;
}

struct Combination {
  fs::path bundle;
  std::string print, filament, printer;
};

/// About `count` combinations, as many of each bundle as of the others, spread over its presets.
std::vector<Combination> sample(std::size_t count) {
  std::vector<Combination> out;
  std::set<fs::path> bundles;
  for (const auto& entry : fs::directory_iterator(vendors))
    if (entry.path().extension() == ".ini") bundles.insert(entry.path());
  const std::size_t each = (count + bundles.size() - 1) / bundles.size();
  for (const auto& bundle : bundles) {
    const auto printers = names_of("printer", weft({"profile", "list", bundle.string()}).out);
    for (std::size_t i = 0; i < each && !printers.empty() && out.size() < count; ++i) {
      const auto& printer = printers[(i * printers.size() + printers.size() / 2) / each % printers.size()];
      const auto listed = weft({"profile", "list", bundle.string(), "--preset", "printer=" + printer}).out;
      const auto prints = names_of("print", listed);
      if (prints.empty()) continue;
      const auto& print = prints[(7 * i + 1) % prints.size()];
      const auto filaments = names_of("filament", weft({"profile", "list", bundle.string(), "--preset",
                                                        "printer=" + printer, "--preset", "print=" + print})
                                                      .out);
      if (!filaments.empty()) out.push_back({bundle, print, filaments[(11 * i + 3) % filaments.size()], printer});
    }
  }
  return out;
}

void slice_sample(std::size_t count) {
  if (!fs::is_directory(vendors)) {
    WARN("SKIPPED: " << vendors.string() << " is not there (Debian's package prusa-slicer brings it)");
    return;
  }
  Scratch scratch;
  scratch.write("part.stl", box_stl(20, 20, 5));
  std::size_t passed = 0, reach = 0;
  const auto all = sample(count);
  for (const auto& c : all) {
    INFO(c.bundle.filename().string() << ": " << c.print << " / " << c.filament << " / " << c.printer);
    const auto run = weft({"slice", "part.stl", "-p", c.bundle.string(), "--preset", "print=" + c.print, "--preset",
                           "filament=" + c.filament, "--preset", "printer=" + c.printer, "-s", "thumbnails=", "-o",
                           "part.gcode", "--report", "part.json"},
                          scratch.path());
    INFO(run.err);
    const bool too_high = run.status == 3 && run.err.find("is more than nozzle_diameter") != std::string::npos;
    // The vendor's own slip, which PrusaSlicer does not see: the end G-code of the 235 mm machine is that of the 330 mm
    // one.
    const bool slip = run.status == 5 && c.printer.find("Snapmaker A250") != std::string::npos &&
                      run.err.find("beyond +z") != std::string::npos;
    CHECK((run.status == 0 || too_high || slip));
    if (run.err.find("machine_reach") != std::string::npos) ++reach;
    if (run.status != 0) continue;
    CHECK(nlohmann::json::parse(scratch.read("part.json"))["audit"]["verdict"] == "pass");
    ++passed;
  }
  WARN(passed << " of " << all.size() << " combinations of vendors' presets sliced and passed the audit, " << reach
              << " with a derived reach");
}

}  // namespace

TEST_CASE("vendors: combinations of PrusaSlicer's vendor presets slice and pass the audit") {
  slice_sample(18);
}

TEST_CASE("vendors: fifty of them (a minute)", "[.vendor-sample]") {
  slice_sample(50);
}

TEST_CASE(
    "vendors: a bundle is listed, its presets chosen, wrong names answered with near ones, and values explained") {
  Scratch scratch;
  scratch.write(
      "b.ini",
      "[vendor]\nname = V\n[print:*common*]\nperimeter_speed = 45\n[print:Fine]\ninherits = *common*\nlayer_height = "
      "0.1\n[print:Fast]\ninherits = *common*\nlayer_height = 0.3\nfirst_layer_height = "
      "0.3\n[filament:PLA]\ntemperature = 205\n[printer:Box]\nnozzle_diameter = 0.4\navoid_crossing_curled_overhangs = "
      "1\n");
  const auto said = [&](std::vector<std::string> words) { return weft(words, scratch.path()); };
  CHECK(said({"profile", "list", "b.ini"}).out == "printer=Box\nprint=Fine\nprint=Fast\nfilament=PLA\n");
  const auto open = said({"profile", "show", "b.ini"});
  CHECK(open.status == 3);
  CHECK_THAT(
      open.err,
      Contains(
          "weft: error: b.ini: is a bundle with 2 print presets; choose with --preset print=NAME: 'Fine', 'Fast'"));
  const auto wrong = said({"profile", "show", "b.ini", "--preset", "print=Fats"});
  CHECK(wrong.status == 3);
  CHECK_THAT(wrong.err, Contains("did you mean 'Fast'?"));
  const auto explained = said({"profile", "show", "b.ini", "--preset", "print=Fast", "--explain", "speed_wall_x"});
  CHECK(explained.status == 0);
  CHECK_THAT(explained.out, Contains("speed_wall_x = 45 mm/s") &&
                                Contains("set by  b.ini:4 = 45, from [print:*common*] perimeter_speed = 45"));
  CHECK(said({"profile", "check", "b.ini", "--preset", "print=Fast"}).status == 0);
  const auto strict = said({"profile", "check", "b.ini", "--preset", "print=Fast", "--strict"});
  CHECK(strict.status == 3);
  CHECK_THAT(strict.err, Contains("b.ini:16: avoid_crossing_curled_overhangs = 1 is not supported"));
  CHECK(said({"profile", "show", "b.ini", "--preset", "colour=red"}).status == 2);
}

TEST_CASE("profile: diff names what differs and where it comes from, show writes PrusaSlicer's words") {
  Scratch scratch;
  scratch.write("a.ini", "layer_height = 0.2\n");
  scratch.write("b.ini", "layer_height = 0.3\n");
  const auto diff = weft({"profile", "diff", "a.ini", "b.ini"}, scratch.path());
  CHECK(diff.status == 0);
  CHECK(diff.out == "layer_height, mm\n  0.2 (a.ini:1)\n  0.3 (b.ini:1)\n");
  const auto shown = weft({"profile", "show", "b.ini", "--format", "prusaslicer", "-o", "ps.ini"}, scratch.path());
  CHECK(shown.status == 0);
  CHECK_THAT(scratch.read("ps.ini"), Contains("\nlayer_height = 0.3\n") && Contains("\nperimeters = 3\n"));
  CHECK(weft({"profile", "check", "ps.ini"}, scratch.path()).status == 0);
  CHECK(weft({"profile", "show", "b.ini", "--format", "orca"}, scratch.path()).status == 2);
}
