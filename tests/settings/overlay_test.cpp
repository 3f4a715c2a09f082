// SPDX-License-Identifier: GPL-3.0-or-later
#include "settings/overlay.h"

#include "settings/first_layer.h"
#include "settings/scopes.h"
#include "settings_error.h"

#include <algorithm>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::literals;
using Catch::Matchers::Contains;

namespace {
Overlay of_object() {
  return {.what = "object 'lid'", .scope = Scope::object};
}
std::string refused(Overlay overlay, const std::string& key, const std::string& text) {
  return weft::test::settings_error([&] { overlay.add(key, text, "lid.3mf"); });
}
}  // namespace

TEST_CASE("overlay: values are laid over the settings, the later one wins, and each knows where it came from") {
  Overlay lid = of_object();
  lid.add("wall_line_count", "4", "lid.3mf");
  lid.add("wall-line-count", "5", "--for lid");
  Settings settings;
  lay(settings, lid);
  CHECK(settings.walls.wall_line_count == 5);
  Overlay range{.what = "height range 1 … 2", .scope = Scope::layer};
  range.add("infill_sparse_density", "40 %", "ranges");
  CHECK(origin_of("wall_line_count", {&lid, &range})->where == "--for lid");
  CHECK(origin_of("infill_sparse_density", {&lid, &range})->where == "ranges");
  CHECK(origin_of("layer_height", {&lid, &range}) == nullptr);
}

TEST_CASE("overlay: every value of every setting is laid as it is read from its text") {
  for (const auto& row : catalogue()) {
    Settings settings;
    row.lay(settings, row.read(row.default_text));
    CHECK(row.print(settings) == row.default_text);
  }
}

TEST_CASE("overlay: a value where it may not differ is refused, and the message says for what it holds") {
  CHECK_THAT(refused(of_object(), "build_volume_temperature", "40"),
             Contains("lid.3mf: object 'lid': build_volume_temperature holds for the whole plate; set it there"));
  CHECK_THAT(refused(of_object(), "machine_width", "100"), Contains("machine_width holds for the whole machine"));
  CHECK_THAT(refused(of_object(), "retraction_amount", "1"), Contains("retraction_amount holds for a whole tool"));
  CHECK_THAT(refused(of_object(), "tool_select", "1"),
             Contains("tool_select holds for the whole machine; extruder_nr says which tool prints it"));
  const Overlay range{.what = "height range 1 … 2", .scope = Scope::layer};
  CHECK_THAT(refused(range, "slicing_mode", "even_odd"),
             Contains("height range 1 … 2: slicing_mode holds for a whole object"));
  const Overlay modifier{.what = "modifier 'grip'", .scope = Scope::region};
  CHECK_THAT(refused(modifier, "layer_height", "0.1"), Contains("layer_height holds for a whole layer"));
  const Overlay tool{.what = "tool 1", .scope = Scope::tool};
  CHECK_THAT(refused(tool, "layer_height", "0.3"), Contains("tool 1: layer_height holds for a whole layer"));
  CHECK_THAT(refused(tool, "slicing_mode", "even_odd"), Contains("tool 1: slicing_mode holds for a whole object"));
  CHECK_THAT(refused(of_object(), "infill_before_walls", "true"),
             Contains("infill_before_walls holds for the whole plate"));
  CHECK_THAT(refused(of_object(), "speed_travel", "100"), Contains("speed_travel holds for the whole plate"));
  CHECK_THAT(refused(of_object(), "wall_line_cont", "1"), Contains("did you mean 'wall_line_count'"));
  CHECK_THAT(refused(of_object(), "wall_line_count", "-1"), Contains("wall_line_count: -1 is outside"));
}

TEST_CASE("first layer: without settings of its own it differs by its speeds alone, and then not at all") {
  Settings settings;
  settings.speeds.speed_layer_0 = {5000, false};
  CHECK(exact::bytes_of(on_first_layer(settings)) == exact::bytes_of(settings));
}

TEST_CASE("first layer: heights, widths, outlines and temperatures follow from what is set for it") {
  Settings settings;
  settings.layers.initial_layer_height = 300;
  settings.layers.initial_layer_line_width = 550;
  settings.walls.xy_offset = 50, settings.walls.xy_offset_layer_0 = -200;
  settings.material.material_print_temperature_layer_0 = 222;
  settings.material.material_bed_temperature_layer_0 = 66;
  const auto first = on_first_layer(settings);
  CHECK(first.layers.layer_height == 300);
  for (const auto width : {first.walls.wall_line_width_0, first.walls.wall_line_width_x, first.infill.infill_line_width,
                           first.shells.skin_line_width, first.shells.top_skin_line_width})
    CHECK(width == 550);
  CHECK(first.walls.xy_offset == -150);
  CHECK(first.material.material_print_temperature == 222);
  CHECK(first.material.material_bed_temperature == 66);
  const auto overlay = first_layer_of(settings);
  CHECK(origin_of("xy_offset", {&overlay})->source == "xy_offset_layer_0");
  CHECK(origin_of("xy_offset", {&overlay})->where == "first layer");
}

TEST_CASE("first layer: on a raft it has speeds and accelerations of its own, and nothing else") {
  Settings settings;
  settings.layers.initial_layer_height = 300;
  settings.walls.xy_offset_layer_0 = -200;
  settings.speeds.acceleration_enabled = true, settings.speeds.acceleration_layer_0 = 700;
  settings.speeds.speed_wall_0 = 40, settings.speeds.speed_infill = 80;
  settings.raft.speed_layer_0_over_raft = SpeedOrShare{75, true};
  settings.raft.acceleration_layer_0_over_raft = 333;
  Scopes scopes{settings};
  const Settings& first = scopes[scopes.on_raft(0)];
  CHECK(first.layers.layer_height == settings.layers.layer_height);
  CHECK(first.walls.xy_offset == 0);
  CHECK(first.speeds.speed_wall_0 == 30);
  CHECK(first.speeds.speed_infill == 60);
  CHECK(first.speeds.acceleration_print == 333);
  CHECK(scopes.above_first_layer(scopes.on_raft(0)) == 0);
  settings.raft.speed_layer_0_over_raft = std::nullopt;
  Scopes usual{settings};
  CHECK(usual[usual.on_raft(0)].speeds.speed_wall_0 == settings.speeds.speed_layer_0.of(40));
}

TEST_CASE("scopes: equal settings are one scope, and a first layer knows what it is above") {
  Scopes scopes{Settings{}};
  Overlay lid = of_object();
  const Overlay nothing = lid;
  const std::vector<const Overlay*> none{&nothing}, some{&lid};
  CHECK(scopes.with(0, none) == 0);
  lid.add("wall_line_count", "3", "lid.3mf");
  lid.add("wall_line_count", "4", "lid.3mf");
  const auto id = scopes.with(0, some);
  CHECK(id != 0);
  CHECK(scopes.with(0, some) == id);
  CHECK(scopes[id].walls.wall_line_count == 4);
  const auto first = scopes.on_first_layer(id);
  CHECK(first != id);
  CHECK(scopes.on_first_layer(id) == first);
  CHECK(scopes.above_first_layer(first) == id);
  CHECK(scopes.above_first_layer(id) == id);
  // Settings that are the first layer's everywhere are another scope: it has no other one above.
  const auto same = scopes.of(scopes[first]);
  CHECK(same != first);
  CHECK(scopes.above_first_layer(same) == same);
}

TEST_CASE("scopes: a stage tells those apart that differ in what it is handed, and no others") {
  Scopes scopes{Settings{}};
  Overlay walls = of_object(), infill = of_object();
  walls.add("wall_line_count", "4", "x");
  infill.add("infill_sparse_density", "50", "x");
  const std::vector<const Overlay*> a{&walls}, b{&infill}, both{&walls, &infill};
  const auto with_walls = scopes.with(0, a), with_infill = scopes.with(0, b), with_both = scopes.with(0, both);
  const Take read{WholeGroup{&Settings::walls, wall_schema},
                  OneValue{&Settings::machine, &MachineSettings::nozzle_diameter}};
  const Handed handed(read, scopes);
  CHECK(handed.alike(with_infill) == handed.alike(0));
  CHECK(handed.alike(with_walls) == handed.alike(with_both));
  CHECK(handed.alike(with_walls) != handed.alike(0));
  CHECK(handed.bytes_of(with_walls) == handed.bytes_of(with_both));
  const auto& [group, nozzle] = handed[with_walls];
  CHECK(&group == &scopes[with_walls].walls);
  CHECK(nozzle == 400);
}
