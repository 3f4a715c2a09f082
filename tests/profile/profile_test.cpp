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
