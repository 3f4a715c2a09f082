// SPDX-License-Identifier: GPL-3.0-or-later
#include "profile/profile.h"

#include "core/error.h"
#include "settings/catalogue.h"
#include "settings/ini.h"
#include "settings_error.h"

#include <filesystem>
#include <fstream>
#include <functional>

#include <catch2/catch.hpp>
#include <unistd.h>

using namespace weft;
using Catch::Matchers::Contains;
using weft::test::settings_error;

namespace {
/// A folder of its own for profiles, gone with the test.
struct Folder {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("weft-profile-test-" + std::to_string(::getpid()));
  Folder() { std::filesystem::create_directories(path); }
  ~Folder() { std::filesystem::remove_all(path); }
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path / name, std::ios::binary) << text;
    return path / name;
  }
};

}  // namespace

TEST_CASE("settings: every setting's text is read back to the same text, and its default lies in its range") {
  for (const auto& e : catalogue()) {
    INFO(e.key);
    CHECK_FALSE(e.meaning.empty());
    Settings s;
    REQUIRE_NOTHROW(e.parse(s, e.default_text));
    CHECK(e.print(s) == e.default_text);
  }
}

TEST_CASE("settings: keys are distinct") {
  for (const auto& e : catalogue()) CHECK(find_setting(e.key) == &e);
}

TEST_CASE("settings: values carry their unit or none, and nothing else") {
  Profile p;
  apply_value(p, "layer_height", "0.25 mm", "--set");
  CHECK(p.settings.layers.layer_height == 250);
  apply_value(p, "layer-height", "0.3", "--set");
  CHECK(p.settings.layers.layer_height == 300);
  CHECK(p.origins["layer_height"].size() == 2);
  for (const auto* bad : {"0.2abc", "0,2", "", "0.2 %", "nan", "inf", "0.2 0.3", "0.12345"}) {
    INFO(bad);
    CHECK_THAT(settings_error([&] { apply_value(p, "layer_height", bad, "--set"); }), Contains("is not a length"));
  }
  CHECK(p.settings.layers.layer_height == 300);
}

TEST_CASE("settings: a value out of range names the range") {
  Profile p;
  CHECK_THAT(settings_error([&] { apply_value(p, "layer_height", "20", "--set"); }), Contains("outside 0.02 … 2 mm"));
}

TEST_CASE("settings: an unknown key is an error with the nearest known one") {
  Profile p;
  CHECK_THAT(settings_error([&] { apply_value(p, "layer_heigth", "0.2", "--set"); }),
             Contains("did you mean 'layer_height'?"));
  // What is switched on by it is named, too.
  CHECK_THAT(settings_error([&] { apply_value(p, "support", "1", "--set"); }),
             Contains("did you mean 'support_enable'?"));
  CHECK_THAT(settings_error([&] { apply_value(p, "ironing", "1", "--set"); }),
             Contains("did you mean 'ironing_enabled'?"));
}

TEST_CASE("settings: a child overrides its parent, and the history is kept") {
  Folder folder;
  folder.write("base.ini", "[layers]\nlayer_height = 0.3\nwall_line_count = 2\n");
  const auto child = folder.write("child.ini", "; a comment\ninherits = base.ini\nlayer_height = 0.1\n");
  Profile p;
  apply_file(p, child);
  CHECK(p.settings.layers.layer_height == 100);
  CHECK(p.settings.walls.wall_line_count == 2);
  CHECK_THAT(origin_of(p, "layer_height"), Contains("child.ini:3"));
  CHECK(origin_of(p, "machine_width") == "default");
}

TEST_CASE("settings: broken profiles are refused with file and line") {
  Folder folder;
  Profile p;
  const auto said = [&](const std::string& text) {
    return settings_error([&] { apply_file(p, folder.write("bad.ini", text)); });
  };
  CHECK_THAT(said("layer_height = 0.2\nlayer_height = 0.3\n"),
             Contains("bad.ini:2") && Contains("already given on line 1"));
  CHECK_THAT(said("layer_height\n"), Contains("bad.ini:1") && Contains("is not 'key = value'"));
  CHECK_THAT(said("inherits = bad.ini\n"), Contains("break the circle"));
  CHECK_THAT(said("inherits = none.ini\n"), Contains("which is not there"));
  CHECK_THAT(said("machine_name = \xFF\xFE\n"), Contains("not UTF-8"));
  CHECK_THAT(said(std::string("a\0b = 1\n", 8)), Contains("NUL"));
  CHECK_THAT(said("bed_shape = triangle\n"), Contains("one of rectangle, circle, polygon"));
}

TEST_CASE("settings: settings that contradict each other are refused") {
  Profile p;
  apply_value(p, "nozzle_diameter", "0.25", "--set");
  apply_value(p, "layer_height", "0.3", "--set");
  CHECK_THAT(settings_error([&] { check_consistency(p); }), Contains("layer_height") && Contains("--set"));
}

TEST_CASE("profiles: a file of densities is looked for beside the profile that names it") {
  const Folder folder;
  std::ofstream(folder.path / "wear.pgm") << "P2 1 1 1\n0\n";
  const auto ini = folder.write("part.ini", "infill_density_image = wear.pgm\n");
  Profile profile;
  apply_file(profile, ini);
  CHECK(profile.settings.infill.infill_density_image == (folder.path / "wear.pgm").string());
  CHECK_NOTHROW(check_consistency(profile));
  // one that inherits it has it from there
  std::filesystem::create_directories(folder.path / "deeper");
  Profile child;
  apply_file(child, folder.write("deeper/child.ini", "inherits = ../part.ini\n"));
  CHECK(std::filesystem::path(child.settings.infill.infill_density_image).lexically_normal() ==
        (folder.path / "wear.pgm").lexically_normal());
}

TEST_CASE("profiles: a file of densities that is not there, and patterns that are none, are named with their line") {
  const Folder folder;
  const auto problem_of = [&](const std::string& text) {
    return settings_error([&] {
      Profile profile;
      apply_file(profile, folder.write("my.ini", text));
      check_consistency(profile);
    });
  };
  const std::string ini = (folder.path / "my.ini").string();
  for (const char* key : {"infill_density_image", "infill_density_field", "infill_direction_field"})
    CHECK(problem_of("layer_height = 0.2\n" + std::string(key) + " = a.vtk\n") ==
          ini + ":2: " + key + ": '" + (folder.path / "a.vtk").string() +
              "' is not there; the path is relative to this file");
  CHECK(problem_of("infill_pattern_by_density = 0:bees\n") ==
        ini + ":1: infill_pattern_by_density: 'bees' is no pattern; as in: 0:honeycomb, 30:grid, 70:concentric");
  CHECK(problem_of("infill_modifiers = boss.stl:80\n") == ini + ":1: infill_modifiers: '" +
                                                              (folder.path / "boss.stl").string() +
                                                              "' is not there; the path is relative to this file");
  CHECK(problem_of("infill_modifiers = boss.stl\n") ==
        ini +
            ":1: infill_modifiers: 'boss.stl' is not file:% or file:%:pattern with 0 … 100 %; as in: boss.stl:80, "
            "core.stl:5:gyroid");
  Profile profile;
  apply_value(profile, "infill_density_field", "b.csv", "--set");
  CHECK(settings_error([&] { check_consistency(profile); }) ==
        "--set: infill_density_field: 'b.csv' is not there; the path is relative to where weft is started");
}
