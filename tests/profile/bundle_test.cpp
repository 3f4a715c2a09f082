// SPDX-License-Identifier: GPL-3.0-or-later
#include "prusaslicer/bundle.h"

#include "core/error.h"
#include "profile/profile.h"
#include "settings_error.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

#include <catch2/catch.hpp>
#include <fmt/format.h>

using namespace weft;
using Catch::Matchers::Contains;
using weft::test::settings_error;
namespace ps = weft::prusaslicer;

namespace {

const std::string vendor_bundle = R"(# a vendor's bundle
[vendor]
name = Test Works

[printer_model:ONE]
name = The One
variants = 0.4

[print:*base*]
layer_height = 0.2
perimeters = 2
perimeter_speed = 40
compatible_printers_condition = printer_model=="ONE" and nozzle_diameter[0]==0.4

[print:*fast*]
perimeter_speed = 80
external_perimeter_speed = 50%

[print:Quality]
inherits = *base*

[print:Speed]
inherits = *base*; *fast*
perimeters = 3
renamed_from = "Old Speed"

[print:Coarse]
inherits = *base*
layer_height = 0.6
compatible_printers_condition = nozzle_diameter[0]>=0.8

[filament:PLA]
temperature = 210
filament_type = PLA
filament_retract_length = nil

[filament:Flex]
temperature = 230
filament_type = FLEX
filament_retract_length = 3.5
filament_retract_lift = 0
compatible_prints_condition = layer_height == 0.2 and ! (perimeters > 2)

[printer:One 0.4]
printer_model = ONE
nozzle_diameter = 0.4
retract_length = 0.8
retract_lift = 0.4
default_print_profile = Quality
default_filament_profile = PLA

[printer:One 0.8]
inherits = One 0.4
nozzle_diameter = 0.8
default_print_profile = Coarse
)";

ps::Bundle bundle_of(const std::string& text) {
  return ps::read_bundle(parse_ini(text, "b.ini"), "b.ini");
}

Profile applied(const std::string& text, const ImportOptions& options = {}) {
  Profile profile;
  apply_text(profile, text, "b.ini", options);
  check_consistency(profile);
  return profile;
}

/// Does a print with that condition fit a printer with a list of nozzles and notes?
bool asked(const std::string& condition) {
  const auto bundle =
      bundle_of("[print:P]\ncompatible_printers_condition = " + condition +
                "\n[printer:Q]\nnozzle_diameter = 0.4,0.6\nprinter_notes = Keep, "
                "please.\\nPRINTER_VENDOR_X\\nPRINTER_MODEL_MK3.9\nprinter_model = MK3S\nprinter_variant = 0.4\n");
  return ps::fits_printer(bundle, bundle.presets[0], bundle.presets[1]);
}

}  // namespace

TEST_CASE("bundle: conditions are asked of the printer's own keys, and of PrusaSlicer's defaults for the rest") {
  for (const auto* yes :
       {"", "nozzle_diameter[0]==0.4", "nozzle_diameter[1] == 0.6", "printer_model==\"MK3S\"",
        "printer_notes=~/.*PRINTER_VENDOR_X.*/", "printer_variant==\"0.4\"",
        "printer_notes=~/.*MK3\\.9/ and ! single_extruder_multi_material", "printer_model!~/.*MINI.*/ or 1>2",
        "num_extruders==2", "!(printer_notes=~/.*FLEX.*/)", "max_print_height == 200"}) {
    INFO(yes);
    CHECK(asked(yes));
  }
  for (const auto* no : {"nozzle_diameter[0]==0.6", "printer_notes=~/PRINTER_VENDOR_X/",
                         "single_extruder_multi_material", "printer_model==\"MK3\"", "num_extruders==1"}) {
    INFO(no);
    CHECK_FALSE(asked(no));
  }
  for (const auto* bad : {"no_such_key==1", "nozzle_diameter[0]==", "(1==1", "printer_model=~/(/", "1 1"}) {
    INFO(bad);
    CHECK_THAT(settings_error([&] { asked(bad); }), Contains("b.ini:2, compatible_printers_condition of [print:P]"));
  }
}

TEST_CASE("bundle: of several ancestors the later wins, and the preset's own lines over all") {
  const auto bundle = bundle_of(vendor_bundle);
  CHECK(bundle.vendor == "Test Works");
  const auto* speed = ps::find_preset(bundle, ps::PresetKind::print, "Speed");
  REQUIRE(speed);
  CHECK(speed->values.at("perimeter_speed").back().value == "80");
  CHECK(speed->values.at("perimeters").back().value == "3");
  CHECK(speed->values.at("layer_height").back().value == "0.2");
  CHECK(speed->values.at("perimeter_speed").size() == 2);
  CHECK(ps::find_preset(bundle, ps::PresetKind::print, "Old Speed") == speed);
  CHECK_FALSE(ps::find_preset(bundle, ps::PresetKind::filament, "Speed"));
}

TEST_CASE("bundle: presets are listed when they fit, abstract ones never") {
  const auto bundle = bundle_of(vendor_bundle);
  CHECK(ps::presets_of(bundle, ps::PresetKind::print).size() == 3);
  const auto* printer = ps::find_preset(bundle, ps::PresetKind::printer, "One 0.4");
  const auto* quality = ps::find_preset(bundle, ps::PresetKind::print, "Quality");
  const auto* speed = ps::find_preset(bundle, ps::PresetKind::print, "Speed");
  CHECK(ps::presets_of(bundle, ps::PresetKind::print, printer).size() == 2);
  CHECK(ps::presets_of(bundle, ps::PresetKind::filament, printer, quality).size() == 2);
  CHECK(ps::presets_of(bundle, ps::PresetKind::filament, printer, speed).size() == 1);
}

TEST_CASE("bundle: what is not chosen follows from the printer, and what is missing from PrusaSlicer's defaults") {
  const auto p = applied(vendor_bundle, {{"", "", "One 0.4"}, false});
  CHECK(p.settings.speeds.speed_wall_x == 40);
  CHECK(p.settings.walls.wall_line_count == 2);
  CHECK(p.settings.material.material_print_temperature == 210);
  CHECK(p.settings.retraction.retraction_amount == 800);
  CHECK(p.settings.shells.top_layers == 3);  // nobody says it
  CHECK(p.origins.at("wall_line_count").back().source == "[print:*base*] perimeters = 2");
  CHECK_THAT(origin_of(p, "wall_line_count"), Contains("b.ini:11"));
  CHECK_THAT(origin_of(p, "top_layers"), Contains("default"));
  CHECK(std::count_if(p.notices.begin(), p.notices.end(), [](const Notice& n) { return n.code == "preset_chosen"; }) ==
        2);
}

TEST_CASE("bundle: a filament overrides the printer's retraction where it does not say nil") {
  const auto p = applied(vendor_bundle, {{"Quality", "Flex", "One 0.4"}, false});
  CHECK(p.settings.retraction.retraction_amount == 3500);
  CHECK(p.settings.retraction.retraction_hop == 0);
  CHECK_THAT(p.origins.at("retraction_amount").back().source, Contains("[filament:Flex]"));
}

TEST_CASE("bundle: an error names the presets that there are, or those that fit") {
  CHECK_THAT(settings_error([] { applied(vendor_bundle); }),
             Contains("2 printer presets") && Contains("--preset printer=NAME: 'One 0.4', 'One 0.8'"));
  CHECK_THAT(settings_error([] {
               applied(vendor_bundle, {{"Sped", "", "One 0.4"}, false});
             }),
             Contains("did you mean 'Speed'"));
  CHECK_THAT(settings_error([] {
               applied(vendor_bundle, {{"Coarse", "", "One 0.4"}, false});
             }),
             Contains("not made for the printer 'One 0.4'"));
  CHECK_THAT(settings_error([] {
               applied(vendor_bundle, {{"Speed", "Flex", "One 0.4"}, false});
             }),
             Contains("not made for the print preset"));
  CHECK_THAT(settings_error([] { applied("[vendor]\nname = V\n[print:A]\ninherits = B\n[print:B]\ninherits = A\n"); }),
             Contains("b.ini:6") || Contains("inherits itself"));
  CHECK_THAT(settings_error([] { applied("[vendor]\nname = V\n[print:A]\ninherits = *none*\n"); }),
             Contains("b.ini:4") && Contains("inherits '*none*', which is not there"));
  CHECK_THAT(settings_error([] { applied("[print:A]\nperimeters = 1\nperimeters = 2\n"); }),
             Contains("b.ini:3") && Contains("already given on line 2"));
}

TEST_CASE("bundle: what was selected in the window when a bundle was exported is what it stands for") {
  const auto text = vendor_bundle + "\n[presets]\nprint = Speed\nfilament = PLA\nprinter = One 0.4\n";
  const auto p = applied(text);
  CHECK(p.settings.walls.wall_line_count == 3);
  CHECK(p.settings.speeds.speed_wall_0 == 40);
}

TEST_CASE("bundle: a chain of ancestors without end is an error, not a crash") {
  std::string text = "[vendor]\nname = V\n";
  for (int i = 0; i < 5000; ++i) text += fmt::format("[print:P{}]\ninherits = P{}\n", i, i + 1);
  CHECK_THAT(settings_error([&] { bundle_of(text + "[print:P5000]\nperimeters = 1\n"); }), Contains("generations"));
}

namespace {

/// What became of the combinations that PrusaSlicer's own vendor bundles mark as compatible.
struct Tally {
  std::size_t bundles = 0, combinations = 0, resolved = 0, too_high = 0;
  std::set<std::string> unknown;
};

/// @param whole all of each printer's prints times filaments; else each print once and each filament once
Tally resolve_vendors(bool whole) {
  namespace fs = std::filesystem;
  Tally tally;
  std::set<fs::path> files;
  for (const auto& file : fs::directory_iterator("/usr/share/PrusaSlicer/profiles"))
    if (file.path().extension() == ".ini") files.insert(file.path());
  for (const auto& file : files) {
    ++tally.bundles;
    const auto bundle =
        ps::read_bundle(parse_ini(read_profile(file, {}), file.filename().string()), file.filename().string());
    for (const auto* printer : ps::presets_of(bundle, ps::PresetKind::printer)) {
      std::size_t prints = 0;
      const auto fitting = ps::presets_of(bundle, ps::PresetKind::filament, printer);
      for (const auto* print : ps::presets_of(bundle, ps::PresetKind::print, printer)) {
        std::size_t filaments = 0;
        for (const auto* filament : fitting) {
          if (!ps::fits_print(bundle, *filament, *print)) continue;
          ++tally.combinations;
          if (filaments++ > 0 && prints > 0 && !whole) continue;
          INFO(bundle.path << ": " << print->name << " / " << filament->name << " / " << printer->name);
          std::vector<IniEntry> lines;
          for (const auto& [key, history] : ps::flattened({print, filament, printer, {}}))
            lines.push_back(history.back());
          try {
            Profile profile;
            const auto translated = ps::translate(std::move(lines), bundle.path, true);
            for (const auto& a : translated.assignments)
              apply_value(profile, a.key, a.text, fmt::format("{}:{}", bundle.path, a.line));
            const bool high = profile.settings.layers.layer_height > profile.settings.machine.nozzle_diameter;
            if (high)
              ++tally.too_high;  // PrusaSlicer refuses these as well, when it slices
            else
              check_consistency(profile);
            for (const auto& r : translated.unknown) tally.unknown.insert(r.key);
            ++tally.resolved;
          } catch (const Error& e) {
            FAIL_CHECK(e.what());
          }
        }
        ++prints;
      }
    }
  }
  return tally;
}

void check_vendors(bool whole) {
  if (!std::filesystem::is_directory("/usr/share/PrusaSlicer/profiles")) {
    WARN("SKIPPED: /usr/share/PrusaSlicer/profiles is not there (Debian's package prusa-slicer brings it)");
    return;
  }
  const auto tally = resolve_vendors(whole);
  WARN(tally.bundles << " bundles, " << tally.combinations << " compatible combinations, " << tally.resolved
                     << " resolved, of which " << tally.too_high << " have layers higher than the nozzle; "
                     << tally.unknown.size() << " keys that are not PrusaSlicer's");
  CHECK(tally.bundles >= 10);
  CHECK(tally.combinations > 10'000);
  CHECK(tally.too_high * 100 < tally.resolved);
}

}  // namespace

TEST_CASE("bundle: each print and each filament of PrusaSlicer's vendor bundles resolves on each printer that it fits",
          "[vendor]") {
  check_vendors(false);
}

TEST_CASE("bundle: every compatible combination of PrusaSlicer's vendor bundles resolves (minutes)",
          "[.vendor-product]") {
  check_vendors(true);
}
