// SPDX-License-Identifier: GPL-3.0-or-later
// What the nozzle does around a change of the tool, read from the file line by line.
#include "cli/program.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

using Lines = std::vector<std::string>;

Lines lines_of(const std::string& text) {
  Lines out;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) out.push_back(line);
  return out;
}

bool moves(const std::string& line) {
  return line.starts_with("G0 ") || line.starts_with("G1 ");
}
std::optional<double> word(const std::string& line, char letter) {
  if (!moves(line)) return std::nullopt;
  const auto at = line.find(std::string(" ") + letter);
  if (at == std::string::npos) return std::nullopt;
  return std::stod(line.substr(at + 2));
}

struct Boxes {
  Scratch scratch;
  Boxes() {
    scratch.write("a.stl", box_stl(10, 10, 2));
    scratch.write("b.stl", box_stl(10, 10, 2));
  }
  std::string slice(Lines more, int status = 0) const {
    Lines words{"slice", "a.stl",    "b.stl@T1", "-o", "out.gcode",
                "-q",    "--report", "out.json", "-s", "relative_extrusion=true"};
    words.insert(words.end(), more.begin(), more.end());
    const auto run = weft(words, scratch.path());
    INFO(run.err);
    REQUIRE(run.status == status);
    return status == 0 ? scratch.read("out.gcode") : run.err;
  }
  json report() const { return json::parse(scratch.read("out.json")); }
};

/// Where the nozzle is at each line, as far as the file says.
struct Place {
  std::optional<double> x, y, z;
};
std::vector<Place> places_of(const Lines& lines) {
  std::vector<Place> out;
  Place now;
  for (const auto& line : lines) {
    if (line.starts_with("G0") || line.starts_with("G1")) {
      if (const auto x = word(line, 'X')) now.x = x;
      if (const auto y = word(line, 'Y')) now.y = y;
      if (const auto z = word(line, 'Z')) now.z = z;
    }
    out.push_back(now);
  }
  return out;
}

/// The box of what is laid on the tower.
struct Tower {
  double left = 1e9, right = -1e9, front = 1e9, back = -1e9;
  explicit Tower(const Lines& lines) {
    const auto places = places_of(lines);
    std::string type;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      if (lines[i].starts_with(";TYPE:")) type = lines[i].substr(6);
      const auto e = word(lines[i], 'E');
      if (type != "Wipe tower" || !lines[i].starts_with("G1") || !e || *e <= 0 || !places[i].x || !places[i].y)
        continue;
      left = std::min(left, *places[i].x), right = std::max(right, *places[i].x);
      front = std::min(front, *places[i].y), back = std::max(back, *places[i].y);
    }
  }
  bool holds(const Place& p) const {
    return p.x && p.y && *p.x >= left && *p.x <= right && *p.y >= front && *p.y <= back;
  }
};

}  // namespace

TEST_CASE("change: the tool is changed over the tower, whoever swaps the filament") {
  const Boxes boxes;
  const std::vector<Lines> machines{
      {"-s", "tool_nozzles=0,0"},                                     // firmware swaps
      {"-s", "tool_nozzles=0,0", "-s", "parking_pos_retraction=80"},  // the file does
      {"-s", "nozzle_diameter=0.4,0.4", "-s", "prime_tower_enable=true"},
      {"-s", "nozzle_diameter=0.4,0.4", "-s", "prime_tower_enable=true", "-s", "retraction_hop=0.4"}};
  for (auto machine : machines) {
    INFO(Catch::StringMaker<Lines>::convert(machine));
    const auto lines = lines_of(boxes.slice(machine));
    const Tower tower(lines);
    const auto places = places_of(lines);
    int changes = 0;
    for (std::size_t i = 1; i < lines.size(); ++i)
      if ((lines[i] == "T0" || lines[i] == "T1") && changes++ > 0) CHECK(tower.holds(places[i]));
    CHECK(changes == 11);
  }
}

TEST_CASE("change: a nozzle that firmware swaps filament in is not drawn back meanwhile, one that waits is") {
  const Boxes boxes;
  const auto before_changes = [](const Lines& lines) {  // filament that is drawn back at each change but the first, mm
    std::vector<double> out;
    double drawn = 0;
    bool first = true;
    for (const auto& line : lines) {
      const auto e = word(line, 'E');
      if (line.starts_with("G1") && e && !word(line, 'X') && !word(line, 'Y')) drawn -= *e;
      if (line != "T0" && line != "T1") continue;
      if (!first) out.push_back(drawn);
      first = false, drawn = 0;
    }
    return out;
  };
  for (const double mm : before_changes(lines_of(boxes.slice({"-s", "tool_nozzles=0,0"}))))
    CHECK(mm == Approx(0).margin(1e-4));
  const auto own = before_changes(lines_of(boxes.slice({"-s", "nozzle_diameter=0.4,0.4"})));
  for (std::size_t i = 2; i < own.size(); ++i)  // T0 and T1 have been drawn back, and pushed forward
    CHECK(own[i] == Approx(0).margin(1e-4));    // in between each pass ends as far as it began
}

TEST_CASE("change: while filament is drawn out and pushed in the nozzle goes on along the tower") {
  const Boxes boxes;
  const auto lines = lines_of(
      boxes.slice({"-s", "tool_nozzles=0,0", "-s", "parking_pos_retraction=80", "-s", "firmware=marlin2", "-s",
                   "filament_ramming_parameters=120 100 6.6 6.8", "-s", "machine_extruder_start_code=M900 K0.05"}));
  const auto change = std::find(
      lines.begin() + std::distance(lines.begin(), std::find(lines.begin(), lines.end(), "T0")) + 1, lines.end(), "T1");
  REQUIRE(change != lines.end());
  const auto moves_of_filament = [&](auto from, auto to) {
    int stands = 0, most = 0;
    for (; from != to; ++from) {
      if (from->starts_with("G0") || word(*from, 'X') || word(*from, 'Y'))
        stands = 0;
      else if (from->starts_with("G1") && word(*from, 'E') && *word(*from, 'E') > 0)
        most = std::max(most, ++stands);
    }
    return most;
  };
  CHECK(moves_of_filament(change - 40, change) <= 1);
  CHECK(moves_of_filament(change, change + 30) <= 1);
  // The user's speed and pressure advance are off from the first line that is rammed, until the other is in.
  const std::string before = [&] {
    std::string out;
    for (auto line = change - 60; line != change; ++line) out += *line + "\n";
    return out;
  }();
  CHECK_THAT(before, Contains("M220 B\nM220 S100\nM900 K0\n"));
  const std::string after = [&] {
    std::string out;
    for (auto line = change; line != change + 60; ++line) out += *line + "\n";
    return out;
  }();
  CHECK_THAT(after, Contains("M900 K0.05\n") && Contains("M220 R\n"));
}

TEST_CASE("change: between two cooling moves the tip is stamped, as far and as fast as is said") {
  const Boxes boxes;
  const auto lines =
      lines_of(boxes.slice({"-s", "tool_nozzles=0,0", "-s", "parking_pos_retraction=80", "-s", "cooling_tube_length=10",
                            "-s", "cooling_tube_retraction=60", "-s", "filament_cooling_moves=3", "-s",
                            "filament_stamping_distance=40", "-s", "filament_stamping_loading_speed=29"}));
  int pushed = 0, drawn = 0, changes = 0;
  for (const auto& line : lines) {
    if (line == "T0" || line == "T1") ++changes;
    if (line.starts_with("G1 E45 F1740")) ++pushed;  // 40 mm and half the tube, 29 mm/s
    if (line.starts_with("G1 E-45 F5400")) ++drawn;  // at the unloading speed, 90 mm/s
  }
  CHECK(changes == 11);
  CHECK(pushed == 2 * (changes - 1));  // not before the first cooling move, nor behind the last
  CHECK(drawn == pushed);
}

TEST_CASE("change: a nozzle that is put away lays what it is to be emptied of on the tower, quickly") {
  const Boxes boxes;
  boxes.slice({"-s", "nozzle_diameter=0.4,0.4", "-s", "prime_tower_enable=true"});
  const auto plain = boxes.report();
  const auto gcode = boxes.slice({"-s", "nozzle_diameter=0.4,0.4", "-s", "prime_tower_enable=true", "-s",
                                  "filament_multitool_ramming_volume=10", "-s", "filament_multitool_ramming_flow=20"});
  const auto rammed = boxes.report();
  CHECK(rammed["features"]["wipe_tower"]["mm3"].get<double>() >
        plain["features"]["wipe_tower"]["mm3"].get<double>() - 1);
  CHECK(rammed["filament"]["mm3"].get<double>() ==
        Approx(plain["filament"]["mm3"].get<double>() + 10 * 10).margin(10));  // ten changes
  CHECK(rammed["audit"]["verdict"] == "pass");
}

TEST_CASE("change: RepRapFirmware selects the first tool before it waits for its heat, and has the others stand by") {
  const Boxes boxes;
  const auto gcode = boxes.slice({"-s", "nozzle_diameter=0.4,0.4", "-s", "firmware=reprapfirmware"});
  CHECK_THAT(gcode, Contains("\nT0\nG10 P0 S"));
  const auto lines = lines_of(gcode);
  CHECK(std::count(lines.begin(), lines.end(), "M116 P0") > 0);
  CHECK(std::find(lines.begin(), lines.end(), "T0") < std::find(lines.begin(), lines.end(), "M116 P0"));
  CHECK(std::find(lines.begin(), lines.end(), "M568 P1 A1") < std::find(lines.begin(), lines.end(), "T1"));
  CHECK(std::find(lines.begin(), lines.end(), "M568 P0 A1") > std::find(lines.begin(), lines.end(), "T1"));
}

TEST_CASE("change: filaments that share a nozzle without a tower are told to mix") {
  const Boxes boxes;
  const auto run = weft(
      {"slice", "a.stl", "b.stl@T1", "-o", "out.gcode", "-s", "tool_nozzles=0,0", "-s", "prime_tower_enable=false"},
      boxes.scratch.path());
  CHECK(run.status == 0);
  CHECK_THAT(run.err, Contains("T0 (PLA) and T1 (PLA) share a nozzle") && Contains("10 changes"));
}

TEST_CASE("change: each tool lays a line at the front of the bed before anything else") {
  const Boxes boxes;
  const auto lines = lines_of(boxes.slice({"-s", "nozzle_diameter=0.4,0.4", "-s", "prime_line=true", "-s",
                                           "adhesion_type=none", "-s", "firmware=marlin2"}));
  const auto places = places_of(lines);
  std::optional<std::string> tool;
  std::vector<std::string> primed;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i] == "T0" || lines[i] == "T1") tool = lines[i];
    const auto e = word(lines[i], 'E');
    if (!tool || !e || *e <= 0 || !lines[i].starts_with("G1") || !places[i].y) continue;
    if (!word(lines[i], 'X') && !word(lines[i], 'Y')) continue;
    CHECK(*places[i].y < 10);  // mm: in front
    primed.push_back(*tool);
    tool.reset();  // the first bead of each is enough
    if (primed.size() == 2) break;
  }
  CHECK(primed == Lines{"T0", "T1"});
}

TEST_CASE("tower: ribs and a cone stand beside its walls, widest at the bed, and the audit passes them") {
  const Boxes boxes;
  boxes.scratch.write("tall.stl", box_stl(10, 10, 40));
  const auto reaches_beyond = [&](const std::string& shape) {
    const auto run = weft({"slice",
                           "tall.stl+b.stl@T1",
                           "-o",
                           "out.gcode",
                           "-q",
                           "--report",
                           "out.json",
                           "-s",
                           "firmware=marlin2",
                           "-s",
                           "tool_nozzles=0,0",
                           "-s",
                           "adhesion_type=none",
                           "-s",
                           "infill_extruder_nr=1",
                           "-s",
                           "prime_tower_shape=" + shape,
                           "-s",
                           "prime_tower_flare_angle=0",
                           "-s",
                           "prime_tower_cone_angle=90",
                           "-s",
                           "layer_height=0.3"},
                          boxes.scratch.path());
    INFO(shape << run.err);
    REQUIRE(run.status == 0);
    CHECK(boxes.report()["audit"]["verdict"] == "pass");
    // How far what is laid on the tower reaches to the left, low and high up.
    const auto lines = lines_of(boxes.scratch.read("out.gcode"));
    const auto places = places_of(lines);
    double low = 1e9, high = 1e9;
    std::string type;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      if (lines[i].starts_with(";TYPE:")) type = lines[i].substr(6);
      if (type != "Wipe tower" || !word(lines[i], 'E') || *word(lines[i], 'E') <= 0 || !places[i].z) continue;
      if (*places[i].z > 0.5 && *places[i].z < 2) low = std::min(low, *places[i].x);
      if (*places[i].z > 36) high = std::min(high, *places[i].x);
    }
    return high - low;
  };
  CHECK(reaches_beyond("plain") == Approx(0).margin(0.01));
  CHECK(reaches_beyond("ribs") > 1);  // 12 % of the height, along the diagonal
  CHECK(reaches_beyond("cone") > 2);
}

TEST_CASE("tower: one that is not kept up lies lower, the nozzle goes down to it, and a head without room is refused") {
  const Boxes boxes;
  boxes.scratch.write("high.stl", box_stl(10, 10, 8));
  Lines words{"slice",     "high.stl",
              "b.stl@T1",  "-o",
              "out.gcode", "-q",
              "-s",        "tool_nozzles=0,0",
              "-s",        "firmware=marlin2",
              "-s",        "relative_extrusion=true",
              "-s",        "prime_tower_sparse=false",
              "-s",        "tool_change_at_heights=2 = 0; 6 = 1",
              "-s",        "adhesion_type=none"};
  const auto run = [&](const Lines& more) {
    auto all = words;
    all.insert(all.end(), more.begin(), more.end());
    return weft(all, boxes.scratch.path());
  };
  CHECK_THAT(run({}).err, Contains("machine_head_profile does not say how wide the head is"));
  CHECK(run({"-s", "machine_head_profile=0: -60x-60, 60x-60, 60x60, -60x60"}).status == 5);
  const auto passed = run({"-s", "machine_head_profile=0: -1x-1, 1x-1, 1x1, -1x1; 20: -60x-60, 60x-60, 60x60, -60x60"});
  INFO(passed.err);
  REQUIRE(passed.status == 0);
  // The change at 6 mm is purged at a section just above those of the first 2 mm.
  const auto lines = lines_of(boxes.scratch.read("out.gcode"));
  const auto places = places_of(lines);
  std::string type;
  double highest = 0, above = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].starts_with(";TYPE:")) type = lines[i].substr(6);
    const auto e = word(lines[i], 'E');
    if (!lines[i].starts_with("G1") || !e || *e <= 0 || !(word(lines[i], 'X') || word(lines[i], 'Y'))) continue;
    double& to = type == "Wipe tower" ? highest : above;
    to = std::max(to, *places[i].z);
  }
  CHECK(above == Approx(8));
  CHECK(highest < 2.5);
  CHECK(highest > 2);
}

TEST_CASE("tower: objects that are printed one after the other purge side by side on the bed, a tool after the other") {
  const Boxes boxes;
  boxes.scratch.write("high.stl", box_stl(10, 10, 12));
  Lines words{"slice",
              "high.stl",
              "b.stl@T1",
              "--copies",
              "high=2",
              "--arrange",
              "-o",
              "out.gcode",
              "-q",
              "-s",
              "tool_nozzles=0,0",
              "-s",
              "firmware=marlin2",
              "-s",
              "relative_extrusion=true",
              "-s",
              "print_sequence=one_at_a_time",
              "-s",
              "machine_head_profile=0: -1x-1, 1x-1, 1x1, -1x1; 8: -15x-15, 15x-15, 15x15, -15x15"};
  const auto run = [&](const Lines& more) {
    auto all = words;
    all.insert(all.end(), more.begin(), more.end());
    return weft(all, boxes.scratch.path());
  };
  const auto passed = run({});
  INFO(passed.err);
  REQUIRE(passed.status == 0);  // the audit has followed the head
  const auto lines = lines_of(boxes.scratch.read("out.gcode"));
  const Tower tower(lines);
  const auto places = places_of(lines);
  std::string type;
  Lines changes;
  double purged = 0, highest = 0;
  std::size_t changed = 0, skirt = 0, first_purged = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].starts_with(";TYPE:")) type = lines[i].substr(6);
    if (lines[i] == "T0" || lines[i] == "T1") {
      changes.push_back(lines[i]);
      if (changes.size() != 2) continue;
      CHECK(tower.holds(places[i]));
      changed = i;
    }
    if (changed != 0 && skirt == 0 && type == "Skirt/Brim" && i > changed && word(lines[i], 'E')) skirt = i;
    const auto e = word(lines[i], 'E');
    if (type != "Wipe tower" || !e || *e <= 0 || !(word(lines[i], 'X') || word(lines[i], 'Y'))) continue;
    if (first_purged == 0) first_purged = i;
    purged += *e;
    highest = std::max(highest, *places[i].z);
  }
  CHECK(changes == Lines{"T1", "T0"});  // the lowest first, then both of the other
  CHECK(highest == Approx(0.2));
  CHECK(purged * 2.405 >= 140);  // mm³ of 1.75 mm filament
  CHECK(first_purged < skirt);   // which is of the filament that is loaded then
  CHECK(run({"-s", "adhesion_type=raft"}).status == 3);
  CHECK_THAT(run({"-s", "ooze_shield_enabled=true"}).err, Contains("ooze_shield_enabled: it is a wall around all"));
  const auto nowhere = run({"-s", "prime_tower_position_x=100", "-s", "prime_tower_position_y=100"});
  CHECK(nowhere.status == 5);
  const auto off = run({"-s", "prime_tower_enable=false"});
  CHECK(off.status == 0);
  CHECK_THAT(boxes.scratch.read("out.gcode"), !Contains(";TYPE:Wipe tower"));
}

TEST_CASE("gradient: stripes across the bed are as wide as their shares") {
  const Boxes boxes;
  boxes.scratch.write("wide.stl", box_stl(40, 20, 2));
  const auto run = weft({"slice",
                         "wide.stl",
                         "-o",
                         "out.gcode",
                         "-q",
                         "--report",
                         "out.json",
                         "-s",
                         "extruders_enabled_count=2",
                         "-s",
                         "gradient_tools=0,1",
                         "-s",
                         "gradient_axis=x",
                         "-s",
                         "gradient_mode=stripes",
                         "-s",
                         "gradient_stops=0:25",
                         "-s",
                         "gradient_stripe_period=4",
                         "-s",
                         "adhesion_type=none",
                         "-s",
                         "infill_sparse_density=100"},
                        boxes.scratch.path());
  INFO(run.err);
  REQUIRE(run.status == 0);
  const auto report = boxes.report();
  const double first = report["tools"][0]["filament"]["mm3"], second = report["tools"][1]["filament"]["mm3"];
  CHECK(second / (first + second) == Approx(0.25).margin(0.02));
}

TEST_CASE("sweep: a setting of one tool can be varied") {
  const Boxes boxes;
  const auto run = weft(
      {"sweep", "b.stl@T1", "-s", "extruders_enabled_count=2", "--vary", "tool.1.material_flow=90,100", "-o", "swept"},
      boxes.scratch.path());
  INFO(run.err);
  CHECK(run.status == 0);
  CHECK(std::filesystem::exists(boxes.scratch.path() / "swept" / "tool.1.material_flow=90.gcode"));
}
