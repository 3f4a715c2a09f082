// SPDX-License-Identifier: GPL-3.0-or-later
// Plates of several objects, as users meet them: settings, places and copies of single ones, modifiers, holes.
#include "cli/program.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

struct Boxes {
  Scratch scratch;
  Boxes() {
    scratch.write("base.stl", box_stl(20, 20, 4));
    scratch.write("lid.stl", box_stl(20, 20, 4));
    scratch.write("p.ini",
                  "machine_width = 200\nmachine_depth = 200\nfirmware = klipper\ngcode_label_objects = firmware\n"
                  "home_position = 0x0\nmachine_start_gcode = G28\n");
  }
  Run slice(std::vector<std::string> more) const {
    std::vector<std::string> words{"slice"};
    words.insert(words.end(), more.begin(), more.end());
    words.insert(words.end(), {"-p", "p.ini", "-o", "out.gcode", "-q", "--report", "report.json"});
    return weft(words, scratch.path());
  }
  json sliced(const std::vector<std::string>& more) const {
    const auto run = slice(more);
    INFO(run.err);
    REQUIRE(run.status == 0);
    return json::parse(scratch.read("report.json"));
  }
  std::string gcode() const { return scratch.read("out.gcode"); }
  void check_verified() const {
    const auto run = weft({"verify", "out.gcode", "-q"}, scratch.path());
    INFO(run.err);
    CHECK(run.status == 0);
  }
};

std::size_t count_of(const std::string& text, const std::string& what) {
  std::size_t out = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++out;
  return out;
}

}  // namespace

TEST_CASE("weft slice: --for gives one object settings of its own, over those of the command line") {
  const Boxes boxes;
  const double sparse = boxes.sliced({"base.stl", "lid.stl"})["filament"]["mm3"];
  const double one =
      boxes.sliced({"base.stl", "lid.stl", "--for", "lid", "infill_sparse_density=100"})["filament"]["mm3"];
  CHECK_THAT(boxes.gcode(), Contains("; weft_overlay = object 'lid': infill_sparse_density = 100 (--for lid)"));
  boxes.check_verified();
  const double both = boxes.sliced({"base.stl", "lid.stl", "-s", "infill_sparse_density=100"})["filament"]["mm3"];
  CHECK(one - sparse == Approx(both - one).epsilon(0.02));  // the skirt is the same, the objects are alike
  CHECK(one > 1.2 * sparse);
  // Several settings behind one name, and names as files have them.
  boxes.sliced({"base.stl", "--for", "base.stl", "infill_sparse_density=100", "wall_line_count=3", "lid.stl"});
  CHECK_THAT(boxes.gcode(), Contains("object 'base': wall_line_count = 3 (--for base.stl)"));

  const auto unknown = boxes.slice({"base.stl", "--for", "led", "infill_sparse_density=50"});
  CHECK(unknown.status == 2);
  CHECK_THAT(unknown.err, Contains("no object and no part is called 'led'") && Contains("there are base"));
  const auto wide = boxes.slice({"base.stl", "--for", "base", "material_bed_temperature=50"});
  CHECK(wide.status == 3);
  CHECK_THAT(wide.err, Contains("object 'base': material_bed_temperature holds for"));
  const auto nothing = boxes.slice({"base.stl", "--for", "base"});
  CHECK(nothing.status == 2);
  CHECK_THAT(nothing.err, Contains("no setting follows"));
}

TEST_CASE("weft slice: --for gives a part settings of its own") {
  const Boxes boxes;
  boxes.scratch.write("pin.stl", box_stl(5, 5, 6));
  const double plain = boxes.sliced({"base.stl+pin.stl"})["filament"]["mm3"];
  const double dense =
      boxes.sliced({"base.stl+pin.stl", "--for", "pin", "infill_sparse_density=100"})["filament"]["mm3"];
  CHECK(dense > plain + 10);
  CHECK(dense < plain + 150);  // 5 × 5 × 6 mm
  CHECK_THAT(boxes.gcode(), Contains("; weft_overlay = part 'pin': infill_sparse_density = 100"));
}

TEST_CASE("weft slice: --place puts an object there, turned, and the others beside it") {
  const Boxes boxes;
  boxes.scratch.write("bar.stl", box_stl(40, 10, 2));
  boxes.sliced({"bar.stl", "base.stl", "--place", "bar=100,100,90"});
  const auto gcode = boxes.gcode();
  CHECK_THAT(gcode, Contains("EXCLUDE_OBJECT_DEFINE NAME=bar CENTER=100,100 ") && Contains("[95,80]") &&
                        Contains("[105,120]"));
  const auto at = gcode.find("EXCLUDE_OBJECT_DEFINE NAME=base CENTER=");
  REQUIRE(at != std::string::npos);
  double x = 0, y = 0;
  REQUIRE(std::sscanf(gcode.c_str() + at, "EXCLUDE_OBJECT_DEFINE NAME=base CENTER=%lf,%lf", &x, &y) == 2);
  CHECK((std::abs(x - 100) >= 15 + 6 || std::abs(y - 100) >= 30 + 6));  // half of both, and --spacing
  boxes.check_verified();

  const auto outside = boxes.slice({"base.stl", "--place", "base=195,100"});
  CHECK(outside.status == 5);
  CHECK_THAT(outside.err, Contains("base.stl") && Contains("outside the print surface"));
  CHECK(boxes.slice({"base.stl", "--place", "base=195"}).status == 2);
  CHECK_THAT(boxes.slice({"base.stl", "--place", "top=5,5"}).err, Contains("no object and no part is called 'top'"));
  CHECK_THAT(boxes.slice({"base.stl", "--place", "base=50,50", "--copies", "base=2"}).err,
             Contains("'base' is to stand in 1 place, 2 times"));
}

TEST_CASE("weft slice: --copies NAME=N copies one model, N all others") {
  const Boxes boxes;
  boxes.sliced({"base.stl", "lid.stl", "--copies", "lid=3"});
  CHECK(count_of(boxes.gcode(), "EXCLUDE_OBJECT_DEFINE NAME=lid_") == 3);
  CHECK(count_of(boxes.gcode(), "EXCLUDE_OBJECT_DEFINE NAME=base ") == 1);
  boxes.check_verified();
  boxes.sliced({"base.stl", "lid.stl", "--copies", "2", "--copies", "lid=1"});
  CHECK(count_of(boxes.gcode(), "EXCLUDE_OBJECT_DEFINE NAME=base_") == 2);
  CHECK(count_of(boxes.gcode(), "EXCLUDE_OBJECT_DEFINE NAME=lid ") == 1);
  boxes.sliced({"base.stl", "base.stl", "lid.stl"});  // no two of one name
  CHECK(count_of(boxes.gcode(), "EXCLUDE_OBJECT_DEFINE NAME=base_1 ") == 1);
  CHECK(count_of(boxes.gcode(), "EXCLUDE_OBJECT_DEFINE NAME=base_2 ") == 1);
  CHECK(count_of(boxes.gcode(), "EXCLUDE_OBJECT_DEFINE NAME=lid ") == 1);
  CHECK_THAT(boxes.slice({"base.stl", "--copies", "base=0"}).err, Contains("0 is outside 1 … 10000"));
  CHECK_THAT(boxes.slice({"base.stl", "--copies", "two"}).err, Contains("'two' is not N, and not NAME=N"));
}

TEST_CASE("weft slice: a modifier changes settings where it is, a negative volume leaves a hole") {
  const Boxes boxes;
  const double plain = boxes.sliced({"base.stl"})["filament"]["mm3"];
  const double half =
      boxes.sliced({"base.stl", "--modifier", "box:0,0,0,10,20,4", "infill_sparse_density=100"})["filament"]["mm3"];
  boxes.check_verified();
  const double full = boxes.sliced({"base.stl", "-s", "infill_sparse_density=100"})["filament"]["mm3"];
  CHECK(half > plain + 0.4 * (full - plain));
  CHECK(half < plain + 0.6 * (full - plain));
  const double cut = boxes.sliced(
      {"base.stl", "-s", "infill_sparse_density=100", "--negative", "box:5,5,0,15,15,4"})["filament"]["mm3"];
  CHECK(cut == Approx(full - 10 * 10 * 4).epsilon(0.03));  // walls round the hole are no more than what fills
  boxes.check_verified();
  CHECK_THAT(boxes.slice({"base.stl", "--modifier", "lid.stl"}).err, Contains("'lid.stl' is to modify nothing"));
  CHECK_THAT(boxes.slice({"base.stl", "--modifier", "lid.stl", "layer_height=0.1"}).err,
             Contains("modifier 'lid': layer_height holds for a whole layer"));
  CHECK_THAT(boxes.slice({"--negative", "lid.stl", "base.stl"}).err, Contains("stands before any model"));
}

TEST_CASE("weft batch: a line says of its models what the command line says of objects") {
  const Boxes boxes;
  boxes.scratch.write(
      "jobs.jsonl",
      R"({"id": "plate", "profile": "p.ini", "models": [{"parts": [{"file": "base.stl"}, {"file": "lid.stl", "set": {"infill_sparse_density": 80}}], "place": [60, 60]}, {"file": "lid.stl", "copies": 2, "set": {"wall_line_count": 4}, "modifiers": [{"file": "box:0,0,0,5,5,4", "set": {"infill_sparse_density": 90}}]}]})"
      "\n");
  const auto run = weft({"batch", "jobs.jsonl", "-o", "out", "-q"}, boxes.scratch.path());
  INFO(run.err);
  REQUIRE(run.status == 0);
  const auto gcode = boxes.scratch.read("out/plate.gcode");
  CHECK_THAT(gcode, Contains("part 'lid': infill_sparse_density = 80") &&
                        Contains("object 'lid': wall_line_count = 4") &&
                        Contains("modifier 'box:0,0,0,5,5,4': infill_sparse_density = 90") &&
                        Contains("NAME=base CENTER=60,60"));
  CHECK(count_of(gcode, "EXCLUDE_OBJECT_DEFINE NAME=lid_") == 2);
  for (const auto& [line, problem] : std::vector<std::pair<std::string, std::string>>{
           {R"({"models": [{"fil": "a.stl"}]})", "models: unknown name 'fil'"},
           {R"({"models": [{"set": {}}]})", "names neither"},
           {R"({"models": [{"file": "base.stl", "modifiers": ["lid.stl"]}]})", "a modifier has no \"set\""},
           {R"({"models": [{"file": "base.stl", "place": [1]}]})", "place: is not [x, y, degrees]"}}) {
    boxes.scratch.write("bad.jsonl", line + "\n");
    const auto bad = weft({"batch", "bad.jsonl", "-p", "p.ini", "-o", "out", "-q"}, boxes.scratch.path());
    CHECK(bad.status == 2);
    CHECK_THAT(bad.err, Contains(problem));
  }
}

TEST_CASE("weft slice: objects that lie in each other are refused, by name, place and depth") {
  const Boxes boxes;
  const auto run = boxes.slice({"base.stl", "lid.stl", "--place", "base=60,60", "--place", "lid=75,60"});
  CHECK(run.status == 5);
  CHECK_THAT(run.err, Contains("plate: 'base' and 'lid' overlap at layer 0, z 0.200, (") && Contains("mm deep"));
  CHECK_FALSE(boxes.scratch.has("out.gcode"));
  const auto report = json::parse(boxes.scratch.read("report.json"));
  CHECK(report["warnings"].dump().find("paths_conflict") != std::string::npos);
  CHECK(
      boxes.slice({"base.stl", "lid.stl", "--place", "base=60,60", "--place", "lid=80,60", "-s", "skirt_line_count=0"})
          .status == 0);
  CHECK(boxes.slice({"base.stl", "lid.stl", "--place", "base=60,60", "--place", "lid=75,60", "--audit", "annotate"})
            .status == 0);
}

TEST_CASE("weft slice: one object at a time, over all that stands, and refused where the head has no way") {
  const Boxes boxes;
  const std::vector<std::string> one_by_one{"base.stl", "lid.stl",
                                            "-s",       "print_sequence=one_at_a_time",
                                            "-s",       "machine_head_profile=0: -10x-10, 10x-10, 10x10, -10x10"};
  auto words = one_by_one;
  words.insert(words.end(),
               {"--place", "base=50,50", "--place", "lid=120,50", "-s", "between_objects_gcode=; next one"});
  boxes.sliced(words);
  const auto gcode = boxes.gcode();
  const auto next = gcode.find("\n; next one\n");
  REQUIRE(next != std::string::npos);
  CHECK(next == gcode.rfind("\n; next one\n"));
  CHECK_THAT(gcode.substr(next, 600), Contains("Z6"));  // 4 mm stand, and 2 mm over them
  const auto first_base = gcode.find("EXCLUDE_OBJECT_START NAME=base"),
             last_base = gcode.rfind("EXCLUDE_OBJECT_START NAME=base"),
             first_lid = gcode.find("EXCLUDE_OBJECT_START NAME=lid"),
             last_lid = gcode.rfind("EXCLUDE_OBJECT_START NAME=lid");
  CHECK((last_base < first_lid || last_lid < first_base));
  words = one_by_one;
  words.insert(words.end(), {"--place", "base=50,50", "--place", "lid=75,50", "-s", "skirt_line_count=0"});
  const auto run = boxes.slice(words);
  CHECK(run.status == 5);
  CHECK_THAT(run.err,
             Contains("print_sequence: the head hits 'base' while 'lid' is printed, and 'lid' while 'base' is"));
  const std::string head = "machine_head_profile=0: -10x-10, 10x-10, 10x10, -10x10";
  words = {"base.stl", "--copies", "3", "-s", "print_sequence=one_at_a_time", "-s", head, "-s", "skirt_line_count=0"};
  boxes.sliced(words);  // as near as the head may pass: the audit lets it
  words.insert(words.end(), {"-s", "gantry_height=3"});
  CHECK_THAT(boxes.slice(words).err, Contains("the gantry hits") && Contains("as --arrange does"));
  words.insert(words.end(), {"--arrange"});  // one behind the other
  boxes.sliced(words);
  boxes.check_verified();
  CHECK(boxes.slice({"base.stl", "lid.stl", "-s", "print_sequence=one_at_a_time"}).status == 3);
  CHECK(boxes.slice({"base.stl", "-s", "machine_head_profile=0: 0x0, 1x1"}).status == 3);
}

TEST_CASE("weft slice: --arrange puts models close together, --fill as many as there is room for") {
  const Boxes boxes;
  boxes.sliced({"base.stl", "lid.stl", "--copies", "3", "--arrange", "--spacing", "2", "-s", "skirt_line_count=0"});
  CHECK(count_of(boxes.gcode(), "EXCLUDE_OBJECT_DEFINE NAME=") == 6);
  boxes.check_verified();
  boxes.scratch.write("big.stl", box_stl(60, 60, 1));
  boxes.sliced({"big.stl", "--fill", "--spacing", "4", "-s", "skirt_line_count=0"});
  CHECK(count_of(boxes.gcode(), "EXCLUDE_OBJECT_DEFINE NAME=big_") == 9);
  const auto run =
      boxes.slice({"big.stl", "--copies", "10", "--arrange", "--spacing", "4", "-s", "skirt_line_count=0"});
  CHECK(run.status == 5);
  CHECK_THAT(run.err, Contains("big.stl: there is room for 9 of 10 copies of it"));
}

TEST_CASE("weft slice: copies of a part that xy_offset widens stand apart as they are printed") {
  const Boxes boxes;
  for (const std::vector<std::string>& how :
       {std::vector<std::string>{"--copies", "4"}, {"--copies", "4", "--arrange"}, {"--fill"}}) {
    std::vector<std::string> words{"base.stl", "--spacing", "2", "-s", "xy_offset=5", "-s", "skirt_line_count=0"};
    words.insert(words.end(), how.begin(), how.end());
    boxes.sliced(words);  // walls would meet, or leave the bed
    CHECK(count_of(boxes.gcode(), "EXCLUDE_OBJECT_DEFINE") >= 4);
    boxes.check_verified();
  }
}

TEST_CASE("weft slice: --fill leaves room for the skirt, and prints more without one") {
  const Boxes boxes;
  const std::string object = "EXCLUDE_OBJECT_DEFINE";
  boxes.sliced({"base.stl", "--fill", "-s", "skirt_gap=20"});
  const auto with_skirt = count_of(boxes.gcode(), object);
  boxes.sliced({"base.stl", "--fill", "-s", "skirt_line_count=0"});
  const auto without = count_of(boxes.gcode(), object);
  CHECK(with_skirt >= 36);  // six rows of six have room between the skirt
  CHECK(without > with_skirt);
}

TEST_CASE("objects: a skirt goes around one whose first layer is thicker, too") {
  const Boxes boxes;
  const auto report =
      boxes.sliced({"base.stl", "lid.stl", "--for", "lid", "layer_height=0.3", "-s", "skirt_line_count=1"});
  CHECK(report["features"]["skirt"]["mm"].get<double>() > 2 * 46 + 2 * 20);  // mm: both stand beside each other
}

TEST_CASE("weft slice: --place said twice prints two copies, each turned as it is told") {
  const Boxes boxes;
  boxes.scratch.write("bar.stl", box_stl(40, 10, 2));
  const auto report = boxes.sliced({"bar.stl", "--place", "bar=50,50", "--place", "bar=50,120,90"});
  REQUIRE(report["objects"].size() == 2);
  CHECK(report["objects"][0]["size"] == json{40.0, 10.0});
  CHECK(report["objects"][1]["size"] == json{10.0, 40.0});
  CHECK(report["objects"][1]["at"] == json{50.0, 120.0});
  boxes.check_verified();
}

TEST_CASE("weft slice: --plates prints all, a file a plate, and says what is where") {
  const Boxes boxes;
  boxes.scratch.write("big.stl", box_stl(60, 60, 1));
  const auto run = boxes.slice({"big.stl", "base.stl", "--copies", "big=11", "--copies", "base=4", "--plates",
                                "--spacing", "4", "-s", "skirt_line_count=0"});
  INFO(run.err);
  REQUIRE(run.status == 0);
  CHECK_FALSE(boxes.scratch.has("out.gcode"));
  std::size_t big = 0, base = 0;
  for (int plate = 1; plate <= 2; ++plate) {
    const auto name = "out_plate_" + std::to_string(plate) + ".gcode";
    const auto gcode = boxes.scratch.read(name);
    big += count_of(gcode, "EXCLUDE_OBJECT_DEFINE NAME=big");
    base += count_of(gcode, "EXCLUDE_OBJECT_DEFINE NAME=base");
    const auto report = json::parse(boxes.scratch.read("report_plate_" + std::to_string(plate) + ".json"));
    CHECK(report["plate"] == plate);
    REQUIRE(report["plates"].size() == 2);
    CHECK(report["plates"][0][0] == json{{"file", "big.stl"}, {"copies", 9}});
    const auto verified = weft({"verify", name, "-q"}, boxes.scratch.path());
    INFO(verified.err);
    CHECK(verified.status == 0);
  }
  CHECK(big == 11);
  CHECK(base == 4);
  CHECK_FALSE(boxes.scratch.has("out_plate_3.gcode"));
  boxes.sliced({"big.stl", "--plates"});  // one is enough
  CHECK(boxes.scratch.has("out.gcode"));
  boxes.scratch.write("huge.stl", box_stl(210, 20, 1));
  const auto never = boxes.slice({"huge.stl", "--plates", "--turn", "0"});
  CHECK(never.status == 5);
  CHECK_THAT(never.err, Contains("huge.stl: there is no room for it; it does not fit on an empty bed"));
  CHECK(boxes.slice({"big.stl", "--plates", "--fill"}).status == 2);
  CHECK(
      weft({"slice", "big.stl", "--copies", "11", "--plates", "-p", "p.ini", "-o", "-"}, boxes.scratch.path()).status ==
      2);
}

TEST_CASE("weft slice: what has room only when it is turned is turned, unless it is to be kept") {
  const Boxes boxes;
  boxes.scratch.write("bar.stl", box_stl(190, 15, 1));
  boxes.scratch.write("narrow.ini",
                      "machine_width = 60\nmachine_depth = 200\nhome_position = 0x0\n"
                      "machine_start_gcode = G28\nskirt_line_count = 0\n");
  const auto slice = [&](const char* degrees) {
    return weft({"slice", "bar.stl", "--arrange", "--copies", "2", "--turn", degrees, "-p", "narrow.ini", "-o",
                 "out.gcode", "-q"},
                boxes.scratch.path());
  };
  CHECK(slice("90").status == 0);
  boxes.check_verified();
  CHECK(slice("0").status == 5);
}

TEST_CASE("weft batch: a queue of parts becomes a job a plate") {
  const Boxes boxes;
  boxes.scratch.write("big.stl", box_stl(60, 60, 1));
  boxes.scratch.write("jobs.jsonl",
                      R"({"id": "night", "profile": "p.ini", "set": {"skirt_line_count": 0}, "spacing": 4, "fill": )"
                      R"([{"file": "big.stl", "copies": 11}, {"file": "lid.stl", "copies": 2, )"
                      R"("set": {"infill_sparse_density": 70}}]})"
                      "\n");
  const auto run = weft({"batch", "jobs.jsonl", "-o", "out", "-q"}, boxes.scratch.path());
  INFO(run.err);
  REQUIRE(run.status == 0);
  const auto first = boxes.scratch.read("out/night_plate_1.gcode"),
             second = boxes.scratch.read("out/night_plate_2.gcode");
  CHECK(count_of(first, "EXCLUDE_OBJECT_DEFINE NAME=big") + count_of(second, "EXCLUDE_OBJECT_DEFINE NAME=big") == 11);
  CHECK(count_of(first, "EXCLUDE_OBJECT_DEFINE NAME=lid") + count_of(second, "EXCLUDE_OBJECT_DEFINE NAME=lid") == 2);
  const auto report = boxes.scratch.read("out/report.jsonl");
  CHECK_THAT(report, Contains("\"night_plate_1\"") && Contains("\"night_plate_2\""));
  const auto again = weft({"batch", "jobs.jsonl", "-o", "out"}, boxes.scratch.path());
  CHECK_THAT(again.err, Contains("2 unchanged"));
}

TEST_CASE("weft slice: objects have brims and seams of their own") {
  const Boxes boxes;
  const std::vector<std::string> two{"base.stl", "lid.stl", "--spacing", "20", "-s", "skirt_line_count=0"};
  auto words = two;
  words.insert(words.end(), {"--for", "lid", "brim_width=5"});
  const double one = boxes.sliced(words)["features"]["brim"]["mm3"];
  words = two;
  words.insert(words.end(), {"-s", "brim_width=5"});
  const double both = boxes.sliced(words)["features"]["brim"]["mm3"];
  CHECK(one == Approx(both / 2).epsilon(0.01));
  words.insert(words.end(), {"--for", "lid", "brim_width=0"});
  CHECK(boxes.sliced(words)["features"]["brim"]["mm3"].get<double>() == Approx(both / 2).epsilon(0.01));
  words = two;
  words.insert(words.end(), {"-s", "brim_width=5", "-s", "brim_ears=on"});
  const double ears = boxes.sliced(words)["features"]["brim"]["mm3"];
  CHECK(ears > 0.1 * both);
  CHECK(ears < 0.7 * both);
  boxes.sliced(two);
  const auto plain = boxes.gcode();
  words = two;
  words.insert(words.end(), {"--for", "lid", "z_seam_type=random"});
  boxes.sliced(words);
  CHECK(boxes.gcode() != plain);
}

TEST_CASE("weft slice: parts of two filaments are woven into each other where they touch") {
  const Boxes boxes;
  boxes.scratch.write("two.ini", boxes.scratch.read("p.ini") +
                                     "tool_nozzles = 0,1\nextruders_enabled_count = 2\nskirt_line_count = 0\n"
                                     "prime_tower_enable = false\n");
  boxes.scratch.write("left.stl", box_stl(20, 20, 12));
  const auto run = [&](const std::string& on) {
    return weft({"slice", "left.stl", "--modifier", "box:10,0,0,21,21,12", "extruder_nr=1", "-p", "two.ini", "-s",
                 "interlocking_enable=" + on, "-o", on + ".gcode", "-q"},
                boxes.scratch.path());
  };
  REQUIRE(run("false").status == 0);
  REQUIRE(run("true").status == 0);
  CHECK(5 * boxes.scratch.read("true.gcode").size() > 6 * boxes.scratch.read("false.gcode").size());
}

TEST_CASE("weft slice: the audit knows the head, and refuses end G-code that leads it into the print") {
  const Boxes boxes;
  // Lower beads may be laid beside higher ones of their layer.
  boxes.sliced({"base.stl", "--rotate-x", "12", "-s", "z_contouring=true", "-s", "support_enable=true", "-s",
                "machine_head_profile=0: -2x-2, 2x-2, 2x2, -2x2"});
  const std::vector<std::string> words{
      "base.stl", "-s", "machine_head_profile=0: -10x-10, 10x-10, 10x10, -10x10; 12: -30x-25, 45x-25, 45x60, -30x60"};
  CHECK(boxes.slice(words).status == 0);
  auto low = words;
  low.insert(low.end(), {"-s", "machine_end_gcode=G1 Z1 F600\\nG1 X100 Y100 F3000"});
  const auto run = boxes.slice(low);
  CHECK(run.status == 5);
  CHECK_THAT(run.err, Contains("into what is printed") && Contains("machine_end_gcode"));
}

TEST_CASE("weft slice: skirt and brim go around what is printed, moved by offsets or not") {
  const Boxes boxes;
  boxes.scratch.write("wide.stl", box_stl(22, 22, 4));
  const auto brim = [&](std::vector<std::string> words) {
    words.insert(words.end(), {"-s", "brim_width=4", "-s", "skirt_line_count=0"});
    return boxes.sliced(words)["features"]["brim"]["mm3"].get<double>();
  };
  CHECK(brim({"base.stl", "-s", "xy_offset=1"}) == Approx(brim({"wide.stl"})).epsilon(0.005));
  CHECK(brim({"wide.stl", "-s", "xy_offset=-1"}) == Approx(brim({"base.stl"})).epsilon(0.005));
  CHECK(brim({"wide.stl", "-s", "xy_offset_layer_0=-1"}) == Approx(brim({"base.stl"})).epsilon(0.005));
  CHECK(boxes.slice({"base.stl", "-s", "xy_offset=6"}).status == 0);  // farther than the skirt's gap
  // One of two parts alone.
  CHECK(boxes.slice({"base.stl", "lid.stl", "--spacing", "20", "--for", "lid", "xy_offset=6"}).status == 0);
  boxes.check_verified();
}
