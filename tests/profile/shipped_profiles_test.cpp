// SPDX-License-Identifier: GPL-3.0-or-later
#include "profile/profile.h"
#include "profile/rules.h"
#include "settings/groups/machine.h"
#include "source.h"

#include <filesystem>
#include <set>

#include <catch2/catch.hpp>

using namespace weft;
namespace fs = std::filesystem;

namespace {

/// The profiles of that folder that come with weft, in order of name.
std::vector<fs::path> shipped(const char* folder) {
  std::set<fs::path> out;
  for (const auto& entry : fs::directory_iterator(tests::source / "profiles" / folder))
    if (entry.path().extension() == ".ini") out.insert(entry.path());
  return {out.begin(), out.end()};
}

/// "0.25" of "fine-0.25.ini" and of "marlin-220-nozzle-0.25.ini"; the ones without a number are for 0.4.
std::string nozzle_of(const fs::path& file) {
  const auto name = file.stem().string();
  for (const char* nozzle : {"0.25", "0.8"})
    if (name.ends_with(std::string("-") + nozzle)) return nozzle;
  return "0.4";
}

}  // namespace

TEST_CASE("profiles: each one that comes with weft is valid by itself", "[settings][profiles]") {
  std::size_t count = 0;
  for (const char* folder : {"printers", "materials", "quality"})
    for (const auto& file : shipped(folder)) {
      INFO(file.filename().string());
      Profile profile;
      CHECK_NOTHROW(apply_file(profile, file));
      CHECK(profile.notices.empty());
      ++count;
    }
  CHECK(count >= 45);
}

TEST_CASE("profiles: every printer prints every material in every quality made for its nozzle",
          "[settings][profiles]") {
  std::size_t combinations = 0;
  for (const auto& printer : shipped("printers"))
    for (const auto& material : shipped("materials"))
      for (const auto& quality : shipped("quality")) {
        if (nozzle_of(printer) != nozzle_of(quality)) continue;
        INFO(printer.filename().string() << ", " << material.filename().string() << ", "
                                         << quality.filename().string());
        Profile profile;
        for (const auto& file : {printer, material, quality}) apply_file(profile, file);
        CHECK_NOTHROW(check_consistency(profile));
        const auto& machine = profile.settings.machine;
        const auto& layers = profile.settings.layers;
        CHECK(to_mm(machine.nozzle_diameter) == Approx(std::stod(nozzle_of(printer))));
        CHECK(layers.layer_height * 4 <= machine.nozzle_diameter * 3);  // a bead higher than that does not bond
        CHECK(layers.initial_layer_height.value_or(layers.layer_height) * 4 <= machine.nozzle_diameter * 3);
        CHECK(reach_z_max(machine) >= machine.machine_height + 5000);  // the end G-code lifts by 5 mm
        ++combinations;
      }
  CHECK(combinations >= 30 * 4 * 3);
}

TEST_CASE("profiles: a printer that comes with weft leaves nothing to doubt, and has a name of its own",
          "[settings][profiles]") {
  std::set<std::string> names;
  for (const auto& printer : shipped("printers")) {
    INFO(printer.filename().string());
    Profile profile;
    apply_file(profile, printer);
    apply_file(profile, shipped("materials").begin()->parent_path() / "pla.ini");
    const auto nozzle = nozzle_of(printer);
    apply_file(profile,
               tests::source / "profiles/quality" / (nozzle == "0.4" ? "standard.ini" : "standard-" + nozzle + ".ini"));
    for (const auto& doubt : doubts_about(profile)) FAIL_CHECK(doubt.message);
    CHECK(names.insert(profile.settings.machine.machine_name + nozzle).second);
  }
  CHECK(names.size() >= 25);
}
