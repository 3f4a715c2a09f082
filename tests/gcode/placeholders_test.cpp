#include "gcode/placeholders.h"

#include "core/error.h"
#include "gcode/writer.h"
#include "settings/profile.h"

#include <filesystem>
#include <functional>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::gcode;

namespace {
std::string expanded(std::string_view text) {
  Settings s;
  s.material.material_type = "PETG";
  auto variables = variables_of(s);
  variables["first_layer_print_min"] = {"10.5", "20"};
  return expand(text, variables, "machine_start_gcode").text;
}
std::string message_of(std::string_view text) {
  try {
    expanded(text);
  } catch (const Error& e) {
    CHECK(e.kind() == Error::Kind::settings);
    return e.what();
  }
  return "nothing was thrown";
}
}  // namespace

TEST_CASE("gcode: placeholders take weft's names and PrusaSlicer's, in braces and brackets") {
  CHECK(expanded("M109 S{material_print_temperature}") == "M109 S210");
  CHECK(expanded("M109 S[temperature]") == "M109 S210");
  CHECK(expanded("M140 S{ first_layer_bed_temperature[0] }") == "M140 S60");
  CHECK(expanded("[first_layer_temperature_0]") == "210");
  CHECK(expanded("X{first_layer_print_min[0]} Y{first_layer_print_min[1]}") == "X10.5 Y20");
  CHECK(expanded("{first_layer_print_min}") == "10.5,20");
  CHECK(expanded("[first_layer_print_min_1]") == "20");
  CHECK(expanded("{filament_type}") == "PETG");
  CHECK(expanded("{extrusion_multiplier} {material_flow}") == "1 100");
}

TEST_CASE("gcode: a first-layer value that is auto stands for what it resolves to") {
  CHECK(expanded("{material_print_temperature_layer_0} {initial_layer_height}") == "210 0.2");
}

TEST_CASE("gcode: brackets that hold no name stand for themselves") {
  CHECK(expanded("POLYGON=[[1,2],[3,4]] [ [a") == "POLYGON=[[1,2],[3,4]] [ [a");
  CHECK(expanded("") == "");
}

TEST_CASE("gcode: an unknown placeholder is an error with its line and column, and the nearest name") {
  CHECK(message_of("G28\nM109 S{first_layer_temprature}") ==
        "machine_start_gcode:2:7: unknown placeholder 'first_layer_temprature'; did you mean "
        "'material_print_temperature_layer_0'?");
  CHECK(message_of("[nonsense_and_more_nonsense]").find("machine_start_gcode:1:1: unknown placeholder") == 0);
  CHECK(message_of("{first_layer_print_min[2]}").find("has 2 values") != std::string::npos);
  CHECK(message_of("{if layer_num == 0}").find("expressions are not supported") != std::string::npos);
  CHECK(message_of("G1 X{1+").find("'{' without '}'") != std::string::npos);
  CHECK(message_of("{machine_reach_z_max}").find("is auto") != std::string::npos);
}

TEST_CASE("gcode: no name smuggles a command in") {
  CHECK(escaped_name("part\nM104 S300;\"x\"{y}") == "part_M104 S300__x__y_");
  Settings s;
  s.material.material_type = "PLA\nM104 S300";
  CHECK(expand("; {material_type}", variables_of(s), "x").text.find('\n') == std::string::npos);
}

TEST_CASE("gcode: the custom G-code of every profile expands") {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(std::string(WEFT_SOURCE_DIR) + "/profiles/printers")) {
    INFO(entry.path().filename());
    Profile profile;
    apply_file(profile, entry.path());
    CHECK_NOTHROW(check_custom_code(profile.settings));
    ++count;
  }
  CHECK(count >= 5);
}
