// SPDX-License-Identifier: GPL-3.0-or-later
// What another tool prints has lines of that tool's nozzle.
#include "model_of_boxes.h"
#include "plain_job.h"
#include "settings/overlay.h"

#include <algorithm>
#include <map>
#include <sstream>
#include <string>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::literals;
using weft::test::ModelOfBoxes;

namespace {

/// The widest and the highest bead of each kind that the comments of G-code tell, mm.
struct Beads {
  std::map<std::string, double> widest, highest;
};

Beads printed(const std::vector<std::pair<std::string, std::string>>& said) {
  const ModelOfBoxes tee({{-3, -10, 0, 3, 10, 16}, {-20, -10, 15, 20, 10, 18}});
  Job job = test::plain_job({tee.path()});
  auto& s = job.settings;
  s.support.support_enable = true;
  s.support.support_structure = SupportStructure::normal;
  for (const auto& [key, text] : said) {
    const auto* entry = find_setting(key);
    REQUIRE(entry != nullptr);
    entry->lay(s, read_value(*entry, text, "test"));
  }
  Report report;
  const auto passed = run(job, {}, report);
  REQUIRE(passed);
  Beads out;
  std::istringstream lines{std::string(passed->gcode())};
  std::string kind;
  double width = 0, height = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(";TYPE:")) kind = line.substr(6);
    if (line.starts_with(";WIDTH:")) width = std::stod(line.substr(7));
    if (line.starts_with(";HEIGHT:")) height = std::stod(line.substr(8));
    if (!line.starts_with("G1") || line.find(" E") == std::string::npos) continue;
    out.widest[kind] = std::max(out.widest[kind], width);
    out.highest[kind] = std::max(out.highest[kind], height);
  }
  return out;
}

const std::vector<std::pair<std::string, std::string>> two{{"extruders_enabled_count", "2"},
                                                           {"tool_settings", "1.nozzle_diameter = 0.8"}};

auto with(std::vector<std::pair<std::string, std::string>> more) {
  more.insert(more.begin(), two.begin(), two.end());
  return more;
}

}  // namespace

TEST_CASE("nozzles: support that a wider nozzle prints has its lines, and layers that both of two can print") {
  const auto usual = printed(with({}));
  CHECK(usual.widest.at("Support material") < 0.45);
  const auto wide = printed(with({{"support_infill_extruder_nr", "1"}, {"support_interface_extruder_nr", "1"}}));
  CHECK(wide.widest.at("Support material") == Approx(0.8).margin(0.06));
  CHECK(wide.widest.at("Support material interface") > 0.7);
  CHECK(wide.highest.at("Support material") > 0.4);
  const auto both = printed(with({{"support_infill_extruder_nr", "1"}, {"support_interface_extruder_nr", "0"}}));
  CHECK(both.widest.at("Support material") == Approx(0.8).margin(0.06));
  CHECK(both.highest.at("Support material") <= 0.3 + 1e-6);
}

TEST_CASE("nozzles: a raft and a skirt have lines of the tool that prints them") {
  const auto raft = printed(with({{"adhesion_type", "raft"}, {"adhesion_extruder_nr", "1"}}));
  CHECK(raft.highest.at("Support material") == Approx(0.6).margin(0.001));  // three quarters of its nozzle
  const auto skirt = printed(with({{"skirt_line_count", "2"}, {"adhesion_extruder_nr", "1"}}));
  CHECK(skirt.widest.at("Skirt/Brim") > 0.75);
}
