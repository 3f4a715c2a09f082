// SPDX-License-Identifier: GPL-3.0-or-later
// Vases, arcs, ironing, rough walls and single walls, as users meet them.
#include "cli/print.h"
#include "source.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <sstream>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

/// A closed cone or cylinder about (0, 0), in `count` sides.
std::string cone_stl(float r0, float r1, float height, int count) {
  std::string out(84, '\0');
  std::uint32_t triangles = 0;
  const auto at = [&](float r, int i, float z) {
    const float a = 2 * 3.14159265F * static_cast<float>(i % count) / static_cast<float>(count);
    return std::array<float, 3>{r * std::cos(a), r * std::sin(a), z};
  };
  const auto add = [&](std::array<float, 3> a, std::array<float, 3> b, std::array<float, 3> c) {
    constexpr std::array<float, 3> none{};
    for (const auto& v : {none, a, b, c}) out.append(reinterpret_cast<const char*>(v.data()), 12);
    out.append(2, '\0');
    ++triangles;
  };
  for (int i = 0; i < count; ++i) {
    add(at(r0, i, 0), at(r0, i + 1, 0), at(r1, i + 1, height));
    add(at(r0, i, 0), at(r1, i + 1, height), at(r1, i, height));
    add({0, 0, 0}, at(r0, i + 1, 0), at(r0, i, 0));
    add({0, 0, height}, at(r1, i, height), at(r1, i + 1, height));
  }
  std::memcpy(out.data() + 80, &triangles, 4);
  return out;
}

struct Models : Print {
  Models() {
    scratch.write("pot.stl", cone_stl(12, 16, 12, 120));
    scratch.write("box.stl", box_stl(20, 20, 2));
  }
};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> out;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) out.push_back(line);
  return out;
}

double word(const std::string& line, char name, double otherwise) {
  const auto at = line.find(std::string(" ") + name);
  return at == std::string::npos ? otherwise : std::stod(line.substr(at + 2));
}

/// Everything but comments, which hold the settings.
std::string commands_of(const std::string& gcode) {
  std::string out;
  for (const auto& line : lines_of(gcode))
    if (!line.starts_with(";")) out += line + "\n";
  return out;
}

}  // namespace

TEST_CASE("surfaces: a vase rises without an end: above the bottom no travel, no line that only lifts, one speed") {
  const Models print;
  const auto gcode = print.slice({"pot.stl", "--set", "magic_spiralize=true", "--set", "cool_min_layer_time=0"});
  double x = 0, y = 0, z = 0, f = 0, highest = 0;
  std::size_t rising = 0, turns = 0;
  for (const auto& line : lines_of(gcode)) {
    if (line.starts_with(";Z:")) ++turns;
    if (!line.starts_with("G0 ") && !line.starts_with("G1 ")) continue;
    const double to_x = word(line, 'X', x), to_y = word(line, 'Y', y), to_z = word(line, 'Z', z),
                 to_f = word(line, 'F', f);
    if (rising > 0 && z < 12 - 0.011) {
      CHECK(line.starts_with("G1"));
      CHECK((line.find(" X") != std::string::npos || line.find(" Y") != std::string::npos));
      CHECK(line.find(" E-") == std::string::npos);
      CHECK(to_z - z < 0.05);
      CHECK(to_z >= z);
      if (rising > 1) CHECK(std::abs(to_f - f) <= 0.05 * f);
    }
    if (line.starts_with("G1") && to_z > z && line.find(" E") != std::string::npos) ++rising;
    x = to_x, y = to_y, z = to_z, f = to_f;
    if (line.starts_with("G1")) highest = std::max(highest, z);
  }
  CHECK(highest == Approx(12));
  CHECK(turns == 60);
  CHECK(rising > 55 * 40);
  const auto report = print.report();
  CHECK(report["audit"]["verdict"] == "pass");
  CHECK(report["features"]["infill"]["mm"] == 0);
  // A wall of 0.42 mm on 12 mm of height, and a bottom: some 460 mm³ and 0.5 mm of 452 mm².
  const double mm3 = report["filament"]["mm3"];
  CHECK(mm3 > 500);
  CHECK(mm3 < 900);
}

TEST_CASE("surfaces: a vase takes one object, no support, and says where it ends") {
  const Models print;
  CHECK_THAT(print.slice({"pot.stl", "--copies", "2", "--set", "magic_spiralize=true"}, 3),
             Contains("magic_spiralize: 2 objects on the plate; a spiral takes one"));
  CHECK_THAT(print.slice({"pot.stl", "--set", "magic_spiralize=true", "--set", "support_enable=true"}, 3),
             Contains("magic_spiralize: support_enable is on"));
  print.scratch.write("two.stl", boxes_stl(5, 5, 3, 2, 8));
  print.slice({"two.stl", "--set", "magic_spiralize=true"});
  const auto warnings = print.report()["warnings"];
  CHECK(std::any_of(warnings.begin(), warnings.end(), [](const json& w) { return w["code"] == "spiral_ends"; }));
}

TEST_CASE("surfaces: a vase that is slowed down to cool keeps its speed to its end, where two turns are on one level") {
  const Models print;
  const auto gcode = print.slice({"pot.stl", "--set", "magic_spiralize=true", "--set", "cool_min_layer_time=6"});
  double z = 0, f = 0, slowest = 1e9, fastest = 0;
  for (const auto& line : lines_of(gcode)) {
    if (!line.starts_with("G0 ") && !line.starts_with("G1 ")) continue;
    z = word(line, 'Z', z), f = word(line, 'F', f);
    if (z < 11 || line.find(" E") == std::string::npos || line.find(" E-") != std::string::npos) continue;
    if (line.find(" X") == std::string::npos && line.find(" Y") == std::string::npos) continue;
    slowest = std::min(slowest, f), fastest = std::max(fastest, f);
  }
  CHECK(slowest < 60 * 18);  // a turn of a hundred millimetres takes six seconds
  CHECK(fastest <= 1.05 * slowest);
}

TEST_CASE("surfaces: one at a time, each object is a vase of its own") {
  const Models print;
  print.scratch.write("vase.stl", cone_stl(14, 12, 12, 120));
  const auto gcode = print.slice({"pot.stl", "vase.stl", "--place", "pot=60,60", "--place", "vase=160,160", "--set",
                                  "magic_spiralize=true", "--set", "print_sequence=one_at_a_time", "--set",
                                  "machine_head_profile=0: -10x-10, 10x-10, 10x10, -10x10"});
  double z = 0;
  std::size_t rises = 0, steps = 0;  // times that plastic is laid at the top, and moves that climb while they lay it
  for (const auto& line : lines_of(gcode)) {
    if (!line.starts_with("G0 ") && !line.starts_with("G1 ")) continue;
    const double to_z = word(line, 'Z', z);
    if (line.find(" E") != std::string::npos && line.find(" X") != std::string::npos && to_z > z) {
      ++steps;
      if (to_z == Approx(12)) ++rises;
    }
    z = to_z;
  }
  CHECK(rises == 2);
  CHECK(steps > 2 * 55 * 40);
}

TEST_CASE("surfaces: arcs make a round part's file smaller, lay the same plastic, and pass the audit") {
  const Models print;
  const auto plain = print.slice({"pot.stl"});
  const auto before = print.report();
  const auto arcs = print.slice({"pot.stl", "--set", "arc_fitting=true"});
  const auto after = print.report();
  CHECK_FALSE(before.contains("arcs"));
  CHECK(after["arcs"]["count"] > 100);
  CHECK(after["arcs"]["worst_um"] <= 14.5);  // 0.013 mm and 1.5 µm for the centre's place
  CHECK(arcs.size() < plain.size());
  CHECK(after["audit"]["verdict"] == "pass");
  CHECK(static_cast<double>(after["filament"]["mm3"]) == static_cast<double>(before["filament"]["mm3"]));
  double e_plain = 0, e_arcs = 0;  // E is relative
  for (const auto& [gcode, sum] : {std::pair{&plain, &e_plain}, {&arcs, &e_arcs}})
    for (const auto& line : lines_of(*gcode))
      if (line.starts_with("G1 ") || line.starts_with("G2 ") || line.starts_with("G3 ")) *sum += word(line, 'E', 0);
  CHECK(e_arcs == Approx(e_plain).epsilon(1e-5));
  std::size_t right = 0, left = 0;
  for (const auto& line : lines_of(arcs)) right += line.starts_with("G2 "), left += line.starts_with("G3 ");
  CHECK(right + left == after["arcs"]["count"]);
  // A page and a picture are drawn of it.
  const auto preview = weft({"preview", "out.gcode", "-o", "out.html", "-q"}, print.scratch.path());
  CHECK(preview.status == 0);
}

TEST_CASE("surfaces: ironing comes last on its layer, and is told as what it is") {
  const Models print;
  const auto plain = print.slice({"box.stl"});
  const auto gcode = print.slice({"box.stl", "--set", "ironing_enabled=true"});
  const auto report = print.report();
  CHECK(report["features"]["ironing"]["mm"] > 2500);  // 17 mm squared less half a nozzle, lines of 0.1 mm
  CHECK(report["audit"]["verdict"] == "pass");
  CHECK_THAT(gcode, Contains(";TYPE:Ironing"));
  const auto last = gcode.rfind(";TYPE:Ironing"), end = gcode.rfind(";TYPE:Custom");
  CHECK(gcode.find(";TYPE:", last + 1) == end);  // behind it comes the end G-code
  CHECK_THAT(plain, !Contains(";TYPE:Ironing"));
}

TEST_CASE("surfaces: ironing that lets plastic stand in the melt for minutes is told") {
  const Models print;
  print.scratch.write("plate.stl", box_stl(60, 60, 1));
  print.slice({"plate.stl", "--set", "ironing_enabled=true"});
  const auto told = [&] {
    const auto warnings = print.report()["warnings"];
    return std::any_of(warnings.begin(), warnings.end(), [](const json& w) { return w["code"] == "ironing_slow"; });
  };
  CHECK(told());
  print.slice({"plate.stl", "--set", "ironing_enabled=true", "--set", "ironing_flow=60"});
  CHECK_FALSE(told());
}

TEST_CASE("surfaces: in a layer of many minutes M73 goes on counting") {
  const Models print;
  print.scratch.write("plate.stl", box_stl(100, 100, 0.4F));
  const auto gcode = print.slice({"plate.stl", "--set", "speed_topbottom=20", "--set", "speed_top_skin=20"});
  std::size_t within = 0;
  int minutes = 1'000'000;
  bool moved = false;
  for (const auto& line : lines_of(gcode)) {
    if (line.starts_with(";LAYER_CHANGE")) moved = false;
    if (line.starts_with("G1 ") && line.find(" E") != std::string::npos) moved = true;
    if (!line.starts_with("M73 ")) continue;
    const int left = std::stoi(line.substr(line.find('R') + 1));
    CHECK(left <= minutes);
    minutes = left;
    within += moved ? 1 : 0;
  }
  CHECK(within > 10);
}

TEST_CASE("surfaces: rough walls are the same for any number of threads, and off they change nothing") {
  const Models print;
  const auto plain = print.slice({"pot.stl"});
  const auto fuzzy = print.slice({"pot.stl", "--set", "magic_fuzzy_skin_enabled=true", "--threads", "1"});
  CHECK(print.slice({"pot.stl", "--set", "magic_fuzzy_skin_enabled=true", "--threads", "3"}) == fuzzy);
  CHECK(commands_of(fuzzy) != commands_of(plain));
  CHECK(commands_of(print.slice({"pot.stl", "--set", "magic_fuzzy_skin_thickness=1", "--set", "fuzzy_skin_seed=5",
                                 "--set", "ironing_flow=30", "--set", "arc_tolerance=0.05"})) == commands_of(plain));
}

TEST_CASE("surfaces: values that make no sense are refused by name") {
  const Models print;
  CHECK_THAT(print.slice({"box.stl", "--set", "ironing_flow=150"}, 3), Contains("ironing_flow"));
  CHECK_THAT(print.slice({"box.stl", "--set", "arc_tolerance=1"}, 3), Contains("arc_tolerance"));
  CHECK_THAT(print.slice({"box.stl", "--set", "top_one_wall=some"}, 3), Contains("top_one_wall"));
  CHECK_THAT(print.slice({"box.stl", "--set", "machine_minimum_cruise_ratio=100"}, 3),
             Contains("machine_minimum_cruise_ratio"));
}

TEST_CASE("surfaces: PrusaSlicer's keys for them are taken over") {
  const Scratch scratch;
  scratch.write("ps.ini",
                "layer_height = 0.2\nnozzle_diameter = 0.4\nperimeters = 2\nspiral_vase = 1\nfuzzy_skin = "
                "external\nfuzzy_skin_thickness = 0.2\nironing = 1\nironing_type = topmost\nironing_flowrate = "
                "20%\ntop_one_perimeter_type = top\nonly_one_perimeter_first_layer = 1\narc_fitting = "
                "emit_center\nmachine_max_jerk_z = 0.3,0.4\nmachine_max_jerk_e = 4,4\n");
  const auto run = weft({"profile", "import", "ps.ini"}, scratch.path());
  INFO(run.err);
  REQUIRE(run.status == 0);
  for (const auto* line :
       {"magic_spiralize = true", "magic_fuzzy_skin_enabled = true", "magic_fuzzy_skin_outside_only = true",
        "magic_fuzzy_skin_thickness = 0.2", "ironing_enabled = true", "ironing_surfaces = topmost", "ironing_flow = 20",
        "top_one_wall = top", "initial_layer_one_wall = true", "arc_fitting = true", "machine_max_jerk_z = 0.3",
        "machine_max_jerk_e = 4"}) {
    INFO(line);
    CHECK_THAT(run.out, Contains(std::string("\n") + line));
  }
  CHECK_THAT(run.out + run.err, !Contains("not supported yet"));
}

TEST_CASE("surfaces: a vase begins and ends with as much plastic as it is told") {
  const Models print;
  const auto mm3 = [&](const std::string& key, const std::string& percent) {
    print.slice({"pot.stl", "-s", "magic_spiralize=true", "-s", key + "=" + percent});
    return print.report()["filament"]["mm3"].get<double>();
  };
  const double plain = mm3("spiral_start_flow", "0");
  for (const auto* key : {"spiral_start_flow", "spiral_finish_flow"}) {
    INFO(key);
    const double half = mm3(key, "50") - plain, all = mm3(key, "100") - plain;
    CHECK(half > 0);
    CHECK(all == Approx(2 * half).epsilon(0.02));  // it grows, or falls, evenly along the turn
  }
}

TEST_CASE("surfaces: smaller waves lie over those of rough walls, with the same plastic") {
  const Models print;
  const auto rough = [&](const char* octaves) {
    return commands_of(print.slice({"pot.stl", "-s", "magic_fuzzy_skin_enabled=true", "-s", "fuzzy_skin_noise=perlin",
                                    "-s", std::string("fuzzy_skin_octaves=") + octaves}));
  };
  const auto one = rough("1");
  const double mm3 = print.report()["filament"]["mm3"];
  CHECK(rough("4") != one);
  CHECK(print.report()["filament"]["mm3"].get<double>() == Approx(mm3).epsilon(0.01));
}

TEST_CASE("surfaces: branches of lightning are the shorter the more they draw back and straighten, or walls carry") {
  const Models print;
  const auto mm_of = [&](const std::string& key, const char* degrees) {
    print.slice({(tests::source / "examples/bracket.stl").string(), "-s", "infill_pattern=lightning", "-s",
                 "infill_sparse_density=20", "-s", key + "=" + degrees});
    return print.report()["features"]["infill"]["mm"].get<double>();
  };
  for (const auto* key : {"lightning_infill_prune_angle", "lightning_infill_straightening_angle"}) {
    INFO(key);
    CHECK(mm_of(key, "10") > mm_of(key, "80"));
  }
  const auto* walls = "lightning_infill_overhang_angle";  // at 89° a layer of 0.2 mm carries 11 mm beside a wall
  CHECK(mm_of(walls, "10") > 2 * mm_of(walls, "89"));
}
