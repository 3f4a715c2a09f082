// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/profile_file.h"

#include "core/error.h"
#include "mesh/zip_fixture.h"
#include "settings_error.h"

#include <fstream>

#include <catch2/catch.hpp>
#include <unistd.h>

using namespace weft;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

/// A file as long as it is looked at.
struct Written {
  explicit Written(const std::string& bytes) { std::ofstream(path, std::ios::binary) << bytes; }
  ~Written() { fs::remove(path); }
  Written(const Written&) = delete;
  Written& operator=(const Written&) = delete;
  fs::path path = fs::temp_directory_path() / ("weft-profile-file-" + std::to_string(::getpid()) + ".3mf");
};

std::string refusal(const std::string& bytes) {
  Profile profile;
  return test::settings_error([&] { apply_profile(profile, Written(bytes).path); });
}

}  // namespace

TEST_CASE("profile file: a 3MF of PrusaSlicer's is a profile, by the configuration in it") {
  std::string config;
  for (const auto* line : {"layer_height = 0.15", "perimeters = 4", "fill_density = 12%", "temperature = 222"})
    config += std::string("; ") + line + "\n";
  for (int i = 0; i < 20; ++i) config += "; made_up_" + std::to_string(i) + " = 1\n";
  Profile profile;
  apply_profile(profile, Written(fixtures::three_mf("<model/>", {{"Metadata/Slic3r_PE.config", config}})).path);
  CHECK(profile.settings.layers.layer_height == 150);
  CHECK(profile.settings.walls.wall_line_count == 4);
  CHECK(profile.settings.material.material_print_temperature == 222);
  CHECK_THAT(origin_of(profile, "wall_line_count"), Contains(".3mf:2"));
}

TEST_CASE("profile file: a 3MF without one, one of Orca's, and a damaged one are refused with the reason") {
  CHECK_THAT(refusal(fixtures::three_mf("<model/>")), Contains("3MF without a configuration of PrusaSlicer's"));
  CHECK_THAT(refusal(fixtures::three_mf("<model/>", {{"Metadata/project_settings.config", "{}"}})),
             Contains("those of Orca or Bambu"));
  CHECK_THAT(refusal("PK\3\4junk"), Contains("damaged archive"));
}
