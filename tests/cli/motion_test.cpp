// SPDX-License-Identifier: GPL-3.0-or-later
// Heights of layers, flow, pressure and the fan, as users meet them.
#include "cli/print.h"

#include <cmath>
#include <sstream>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

struct Boxes : Print {
  Boxes() {
    scratch.write("box.stl", box_stl(20, 20, 5.37F));
    scratch.write("thin.stl", box_stl(20, 20, 2));
  }
  std::string refused(const std::string& line) const {
    scratch.write("p.ini", "# 1\n# 2\n" + line + "\n");
    return slice({"box.stl", "-p", "p.ini"}, 3);
  }
};

std::vector<double> heights_of(const std::string& gcode) {
  std::vector<double> out;
  std::istringstream in(gcode);
  for (std::string line; std::getline(in, line);)
    if (line.starts_with(";Z:")) out.push_back(std::stod(line.substr(3)));
  return out;
}

std::string commands_of(const std::string& gcode) {
  std::istringstream in(gcode);
  std::string out;
  for (std::string line; std::getline(in, line);)
    if (!line.starts_with(";")) out += line + "\n";
  return out;
}

}  // namespace

TEST_CASE("heights: layers meet the top, by ranges and by the surface") {
  const Boxes print;
  const auto plain = heights_of(print.slice({"box.stl"}));
  CHECK(plain.back() != Approx(5.37));
  const auto adaptive = heights_of(print.slice({"box.stl", "--set", "adaptive_layer_height_enabled=true"}));
  CHECK(adaptive.back() == Approx(5.37));
  CHECK(adaptive.size() == 1 + 18);  // 5.17 mm in layers of up to 0.3
  CHECK(print.report()["surface"]["faces_missed_um"] == 0);
  const auto stretched = heights_of(print.slice({"box.stl", "--set", "adaptive_layer_height_flats=true"}));
  CHECK(stretched.back() == Approx(5.37));
  const auto bands = heights_of(print.slice({"box.stl", "--set", "layer_height_ranges=1-2:0.1; 3-4:0.3"}));
  REQUIRE(bands.size() > 20);
  for (std::size_t i = 1; i < bands.size(); ++i) {
    const double bottom = bands[i - 1], height = bands[i] - bottom;
    CHECK(height == Approx(bottom >= 1 - 1e-9 && bottom < 2 - 1e-9   ? 0.1
                           : bottom >= 3 - 1e-9 && bottom < 4 - 1e-9 ? 0.3
                                                                     : 0.2));
  }
}

TEST_CASE("heights: objects of one plate have layers of their own, which are printed by height") {
  const Boxes print;
  const auto gcode = print.slice({"box.stl", "thin.stl", "--for", "thin", "layer_height_ranges=0.2-2:0.15"});
  double before = 0;
  const auto heights = heights_of(gcode);
  for (const double z : heights) {
    CHECK(z > before);
    before = z;
  }
  const auto has = [&](double z) {
    return std::any_of(heights.begin(), heights.end(), [&](double each) { return std::abs(each - z) < 1e-6; });
  };
  CHECK(has(0.35));  // of the one
  CHECK(has(0.4));   // of the other
}

TEST_CASE("motion: what is wrong with a setting is said with its line") {
  const Boxes print;
  CHECK_THAT(print.refused("adaptive_layer_height_max = 0.25\nadaptive_layer_height_min = 0.3"),
             Contains("p.ini:4: adaptive_layer_height_min: 0.3 mm is more than adaptive_layer_height_max, 0.25 mm"));
  CHECK_THAT(print.refused("layer_height_ranges = 5-20:0.2; 18-30:0.1"),
             Contains("p.ini:3: layer_height_ranges: 5-20 and 18-30 overlap"));
  CHECK_THAT(print.refused("layer_height_ranges = 0-5:0.5"),
             Contains("layer_height_ranges: 0.5 mm is more than nozzle_diameter 0.4 mm"));
  CHECK_THAT(print.refused("pressure_advance_model = 0.04,3,1000; 0.04,8,1000; 0,04,3.96,3000"),
             Contains("p.ini:3: pressure_advance_model: row 3: \"0,04\" is no number; write 0.04"));
}

TEST_CASE("motion: doubts about slopes and arcs say what they do") {
  const Boxes print;
  const auto doubt = [&](const std::string& lines) {
    print.scratch.write("p.ini", lines);
    const auto run = weft({"profile", "check", "p.ini"}, print.scratch.path());
    CHECK(run.status == 0);
    return run.err;
  };
  CHECK_THAT(doubt("max_extrusion_rate_slope = 200\nwall_line_width_0 = 0.45\n"),
             Contains("max_extrusion_rate_slope: 200 mm³/s² is more than 1500 mm/s² asks for (135): no effect"));
  CHECK_THAT(doubt("max_extrusion_rate_slope = 100\nwall_line_width_0 = 0.45\n"), !Contains("no effect"));
  CHECK_THAT(doubt("arc_fitting = true\nfirmware = klipper\n"),
             Contains("klipper needs [gcode_arcs]; its pieces of 1 mm leave arcs below 9.62 mm radius as lines"));
}

TEST_CASE("motion: what is off changes no byte, and what is on is in the file") {
  const Boxes print;
  const auto plain = commands_of(print.slice({"box.stl"}));
  for (const char* off :
       {"brim_ears_max_angle=90", "fuzzy_skin_scale=2", "spiral_smoothing=50", "pressure_advance_step=0.01",
        "adaptive_layer_height_error=0.2", "z_contour_min_height=0.1", "cool_fan_lead=0", "speed_curvature_even=0",
        "small_area_flow_length=0", "arc_segment_length=2", "acceleration_overhang=300", "ironing_prime=2"}) {
    INFO(off);
    CHECK(commands_of(print.slice({"box.stl", "--set", off})) == plain);
  }
  const std::string rows = "pressure_advance_model=0.05,1,1500; 0.03,8,1500";
  CHECK_THAT(print.slice({"box.stl", "--set", rows, "--set", "firmware=marlin2"}), Contains("\nM900 K0.0"));
  CHECK_THAT(print.slice({"box.stl", "--set", rows, "--set", "firmware=klipper"}),
             Contains("\nSET_PRESSURE_ADVANCE ADVANCE=0.0"));
  CHECK_THAT(print.slice({"box.stl", "--set", rows, "--set", "firmware=reprapfirmware"}), Contains("\nM572 D0 S0.0"));
  CHECK(commands_of(print.slice({"box.stl", "--set", "brim_width=3"})) !=
        commands_of(print.slice({"box.stl", "--set", "brim_width=3", "--set", "brim_ears=true"})));
}

TEST_CASE("motion: a report tells what a print asks of nozzle, fan and eye") {
  const Boxes print;
  print.slice({"box.stl", "--set", "ironing_enabled=true"});
  const auto r = print.report();
  CHECK(r["per_layer"].size() == r["layers"]);
  CHECK(r["per_layer"][5]["ratio"].get<double>() > 0.2);
  CHECK(r["per_layer"][5]["least_rest_s"].get<double>() > 0);
  double seconds = 0;
  for (const auto& s : r["flow"]["s_by_mm3_s"]) seconds += s.get<double>();
  CHECK(seconds > 0.5 * r["print_time_s"].get<double>());
  CHECK(seconds < r["print_time_s"].get<double>());
  CHECK(r["walls"]["outer_at_one_speed_percent"].get<double>() > 0);
  CHECK(r["time"]["accelerating_percent"].get<double>() > 0);
  CHECK(r["time"]["accelerating_percent"].get<double>() < 100);
  CHECK(r["ironing"]["longest_s"].get<double>() > 0);
  CHECK(r["ironing"]["least_mm3_s"].get<double>() < 0.2);
}

TEST_CASE("motion: where the machine has a silent mode, M73 tells its times, too") {
  const Boxes print;
  const std::string limits = "machine_silent_limits=50,50,5,20,300,300,100,1000,4,0.2,2";
  const auto gcode = print.slice({"box.stl", "--set", limits});
  CHECK_THAT(gcode, Contains("\nM73 P0 R") && Contains("\nM73 Q0 S") && Contains("\nM73 Q100 S0\n") &&
                        Contains("; estimated printing time (silent mode) = "));
  CHECK_THAT(print.slice({"box.stl"}), !Contains("M73 Q"));
  CHECK_THAT(print.refused("machine_silent_limits = 1,2,3,4,5"),
             Contains("p.ini:3: machine_silent_limits: 5 values for 11 limits"));
}

TEST_CASE("audit: --time tells what a file's moves take, about as its slicer did") {
  const Boxes print;
  for (const char* firmware : {"klipper", "marlin2", "reprapfirmware"}) {
    INFO(firmware);
    const std::string set = std::string("firmware=") + firmware;
    print.slice({"box.stl", "--set", set, "--set", "acceleration_enabled=true", "--set", "cool_min_layer_time=0"});
    const auto run =
        weft({"audit", "out.gcode", "--set", set, "--time", "--report", "audit.json"}, print.scratch.path());
    INFO(run.err);
    REQUIRE(run.status == 0);
    const double found = json::parse(print.scratch.read("audit.json"))["audits"][0]["print_time_s"];
    CHECK(found == Approx(print.report()["print_time_s"].get<double>()).epsilon(0.01));
  }
}
