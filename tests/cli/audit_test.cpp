// SPDX-License-Identifier: GPL-3.0-or-later
// The scenarios of the boundary audit as users meet them, in both verdicts.
#include "cli/program.h"

#include <algorithm>
#include <filesystem>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
using nlohmann::json;

namespace {

const std::string printer =
    "machine_width = 200\nmachine_depth = 200\nmachine_height = 200\nhome_position = 0x0\n"
    "machine_start_gcode = G28\\nG90\nmachine_end_gcode = M84\nlayer_height = 0.2\nwall_line_count = 1\n"
    "top_layers = 1\nbottom_layers = 1\nretraction_amount = 1\n";

/// Slices in both verdicts; what is refused when it must be, and annotated on as many lines as the report counts.
struct Sliced {
  Run rejected, annotated;
  json report;
  std::string gcode;
  bool file_after_rejection = false;
};
Sliced slice(const Scratch& scratch, const std::string& model, std::vector<std::string> options) {
  scratch.write("printer.ini", printer);
  std::vector<std::string> words{"slice", model, "-p", "printer.ini", "-o", "out.gcode", "--report", "r.json"};
  words.insert(words.end(), options.begin(), options.end());
  Sliced out;
  out.rejected = weft(words, scratch.path());
  out.report = json::parse(scratch.read("r.json"));
  out.file_after_rejection = scratch.has("out.gcode");
  words.insert(words.end(), {"--audit", "annotate"});
  out.annotated = weft(words, scratch.path());
  if (scratch.has("out.gcode")) out.gcode = scratch.read("out.gcode");
  return out;
}

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

void check_found(const Sliced& s, const std::string& feature) {
  INFO(s.rejected.err << s.annotated.err);
  CHECK(s.rejected.status == 5);
  CHECK_FALSE(s.file_after_rejection);
  CHECK(s.report["status"] == "rejected");
  CHECK(s.report["audit"]["verdict"] == "rejected");
  const auto& violations = s.report["audit"]["violations"];
  CHECK(std::any_of(violations.begin(), violations.end(),
                    [&](const json& v) { return v["feature"] == feature && v["move"] == "extrude"; }));
  for (const auto* side : {"-x", "+x", "-y", "+y"})
    CHECK(std::any_of(violations.begin(), violations.end(), [&](const json& v) { return v["side"] == side; }));
  CHECK(s.annotated.status == 0);
  CHECK(count(s.gcode, "\n; WEFT-AUDIT outside ") == s.report["audit"]["violation_count"].get<std::size_t>());
  CHECK_THAT(s.gcode, Contains("\n; weft_audit = annotated: ") && Contains(" moves outside, worst "));
}

void check_passes(const Sliced& s) {
  INFO(s.rejected.err);
  CHECK(s.rejected.status == 0);
  CHECK(s.report["audit"]["verdict"] == "pass");
  CHECK(s.report["audit"]["violation_count"] == 0);
  CHECK_THAT(s.gcode, Contains("\n; weft_audit = pass, ") && Contains(" moves checked\n"));
}

/// A box sliced with start G-code that leaves the machine on `line`: refused, and annotated there. The motions up and
/// back from outside are found as well, so `moves` of them stand outside.
void check_start_code_found(const std::vector<std::string>& settings, const std::string& start,
                            const std::string& annotation, const std::string& line, std::size_t moves) {
  CAPTURE(start);
  Scratch scratch;
  scratch.write("part.stl", box_stl(10, 10, 0.4F));
  std::vector<std::string> options{"-s", "machine_start_gcode=G28\\nG90\\nM83\\n" + start};
  for (const auto& setting : settings) options.insert(options.end(), {"-s", setting});
  const auto s = slice(scratch, "part.stl", options);
  INFO(s.rejected.err << s.annotated.err);
  CHECK(s.rejected.status == 5);
  CHECK_FALSE(s.file_after_rejection);
  CHECK(s.report["audit"]["verdict"] == "rejected");
  CHECK(s.report["audit"]["violation_count"] == moves);
  CHECK(s.report["audit"]["violations"][0]["text"] == line);
  CHECK(s.report["audit"]["violations"][0]["feature"] == "custom");
  CHECK(s.annotated.status == 0);
  CHECK(count(s.gcode, "\n; WEFT-AUDIT ") == moves);
  CHECK(count(s.gcode, "\n; WEFT-AUDIT " + annotation + "\n" + line + "\n") == 1);
  CHECK(count(s.gcode, "\n; weft_audit = annotated: ") == 1);
}

/// Audits text against the printer with more settings.
Run audit(const Scratch& scratch, const std::string& gcode, const std::vector<std::string>& more = {}) {
  scratch.write("printer.ini", printer);
  scratch.write("part.gcode", gcode);
  std::vector<std::string> words{"audit", "part.gcode", "-p", "printer.ini"};
  for (const auto& setting : more) words.insert(words.end(), {"-s", setting});
  return weft(words, scratch.path());
}

const std::string start = "G28\nG90\nM83\n;LAYER_CHANGE\n;TYPE:External perimeter\n;WIDTH:0.4\n;HEIGHT:0.2\nG1 Z0.2\n";

}  // namespace

TEST_CASE("audit T1: the skirt of a part as large as the bed is found on all four sides") {
  Scratch scratch;
  scratch.write("part.stl", box_stl(195, 195, 0.4F));
  check_found(slice(scratch, "part.stl", {"-s", "skirt_gap=10"}), "skirt");
  check_passes(slice(scratch, "part.stl", {"-s", "skirt_gap=10", "-s", "adhesion_outside=clip"}));
}

TEST_CASE("audit T3: a spiral lift at the edge of the bed gives way to one that stays inside") {
  Scratch scratch;
  scratch.write("part.stl", box_stl(20, 40, 2));
  const auto s = slice(scratch, "part.stl",
                       {"--copies", "2", "--center", "177,22", "-s", "skirt_line_count=0", "-s", "retraction_hop=1",
                        "-s", "retraction_hop_type=spiral", "-s", "z_seam_type=user", "-s", "z_seam_x=200", "-s",
                        "z_seam_y=100", "-s", "travel_slope=1.2"});
  check_passes(s);
  const auto& warnings = s.report["warnings"];
  CHECK(std::any_of(warnings.begin(), warnings.end(), [](const json& w) { return w["code"] == "lift_gave_way"; }));
}

TEST_CASE("audit T4: a travel over the notch of a concave bed, or through a no-go area, is found") {
  Scratch scratch;
  const std::string travels = start + "G1 X20 Y20\nG1 X20 Y180\nG1 X180 Y180\n";
  CHECK(audit(scratch, travels).status == 0);
  const auto notch = audit(scratch, travels,
                           {"bed_shape=polygon", "bed_polygon=0x0,200x0,200x200,150x200,150x100,50x100,50x200,0x200"});
  CHECK(notch.status == 5);
  CHECK_THAT(notch.err, Contains("1 move outside") && Contains("travel, line 11"));
  const auto area = audit(scratch, travels, {"bed_exclude_areas=90x170,110x170,110x190,90x190"});
  CHECK(area.status == 5);
  CHECK_THAT(area.err, Contains("10.000 mm inside no-go area 1"));
  CHECK(audit(scratch, travels, {"bed_exclude_areas=90x170,110x170,110x190,90x190", "exclude_height=0.2"}).status == 0);
  // the planner's own travels go round the area between two parts
  scratch.write("tower.stl", box_stl(10, 10, 1));
  check_passes(slice(scratch, "tower.stl",
                     {"--copies", "2", "--spacing", "40", "-s", "skirt_line_count=0", "-s",
                      "bed_exclude_areas=97x60,103x60,103x140,97x140"}));
  check_start_code_found({"bed_shape=polygon", "bed_polygon=0x0,200x0,200x200,150x200,150x130,50x130,50x200,0x200"},
                         "G1 X20 Y180\\nG1 X180 Y180\\nG1 X180 Y20", "outside -x 50.000 mm, custom, travel",
                         "G1 X180 Y180", 1);
  check_start_code_found({"bed_exclude_areas=90x170,110x170,110x190,90x190"},
                         "G1 X20 Y180\\nG1 X180 Y180\\nG1 X180 Y20", "inside no-go area 1 10.000 mm, custom, travel",
                         "G1 X180 Y180", 1);
}

TEST_CASE("audit T5: a brim wider than what is left of the bed is found") {
  Scratch scratch;
  scratch.write("part.stl", box_stl(190, 190, 0.4F));
  check_found(slice(scratch, "part.stl", {"-s", "skirt_line_count=0", "-s", "brim_width=15"}), "brim");
}

TEST_CASE("audit T7: an arc that bulges past the edge is found although its ends are inside") {
  Scratch scratch;
  const auto run = audit(scratch, start + "G1 X199 Y100\nG3 X199 Y110 I-4 J5 E1\n");
  CHECK(run.status == 5);
  CHECK_THAT(run.err, Contains("beyond +x of the print surface (outer_wall, arc, line 10)"));
  CHECK(audit(scratch, start + "G1 X199 Y100\nG2 X199 Y110 I4 J5 E1\n").status == 0);
  check_start_code_found({}, "G1 X199 Y100\\nG3 X199 Y110 I-4 J5", "outside +x 1.403 mm, custom, arc",
                         "G3 X199 Y110 I-4 J5", 1);
}

TEST_CASE("audit T8: an ordinary print has no finding, and neither has its file") {
  Scratch scratch;
  scratch.write("part.stl", box_stl(20, 20, 3));
  check_passes(slice(scratch, "part.stl", {}));
  const auto run = weft({"audit", "out.gcode", "-p", "printer.ini"}, scratch.path());
  CHECK(run.status == 0);
  CHECK(run.out.empty());
  CHECK_THAT(run.err, StartsWith("weft: out.gcode: pass, ") && Contains(" moves checked"));
}

TEST_CASE("audit T9: a purge line at Y-3 passes with the reach of the printer, and is custom G-code without") {
  Scratch scratch;
  scratch.write("part.stl", box_stl(10, 10, 1));
  const std::string purge =
      "machine_start_gcode=G28\\nG90\\nM83\\nG1 Z0.2 F720\\nG1 Y-3 F1000\\nG1 X60 E9\\nG1 X100 E12.5";
  check_passes(slice(scratch, "part.stl", {"-s", purge, "-s", "machine_reach=0x-5, 200x200"}));
  const auto refused = slice(scratch, "part.stl", {"-s", purge});
  CHECK(refused.rejected.status == 5);
  CHECK_THAT(refused.rejected.err, Contains("3.000 mm beyond -y of the reach (custom, ") && Contains("machine_reach"));
  CHECK_THAT(refused.gcode, Contains("; WEFT-AUDIT outside -y 3.000 mm, custom, travel\nG1 Y-3 F1000\n"));
}

TEST_CASE("audit T10: relative moves, shifted origins and inches are judged in machine coordinates") {
  Scratch scratch;
  for (const auto* moves : {"G91\nG1 X60\nG1 X140.1\n", "G1 X100 Y5\nG92 X0\nG1 X100.1\n", "G20\nG1 X7.88\n"}) {
    CAPTURE(moves);
    CHECK_THAT(audit(scratch, start + moves).err, Contains("1 move outside") && Contains("beyond +x"));
  }
  const std::string machine = "G1 X100 Y5\nG92 X500\nG53 G1 X200.1\n";
  CHECK_THAT(audit(scratch, start + machine, {"firmware=smoothie"}).err, Contains("1 move outside"));
  const auto unknown = audit(scratch, start + machine);  // not every Marlin knows G53
  CHECK(unknown.status == 5);
  CHECK_THAT(unknown.err, Contains("not audited (G53 on line "));
  for (const auto* moves : {"G91\nG1 X60\nG1 X140\n", "G1 X100 Y5\nG92 X0\nG1 X100\n", "G20\nG1 X7.87\n"}) {
    CAPTURE(moves);
    CHECK(audit(scratch, start + moves).status == 0);
  }
  check_start_code_found({}, "G1 X60 Y5\\nG91\\nG1 X140.1\\nG90", "outside +x 0.100 mm, custom, travel", "G1 X140.1",
                         3);
  check_start_code_found({}, "G1 X100 Y5\\nG92 X0\\nG1 X100.1\\nG92 X200.1", "outside +x 0.100 mm, custom, travel",
                         "G1 X100.1", 3);
  check_start_code_found({}, "G20\\nG1 X7.88\\nG21", "outside +x 0.152 mm, custom, travel", "G1 X7.88", 3);
}

TEST_CASE("audit: a fleet of printers is told apart, for people, programs and CI servers") {
  Scratch scratch;
  scratch.write("large.ini", printer);
  scratch.write("small.ini", "inherits = large.ini\nmachine_width = 120\n");
  scratch.write("part.gcode", start + "G1 X150 Y100\n");
  scratch.write("other.gcode", start + "G1 X50 Y100\n");
  const std::vector<std::string> words{"audit",     "part.gcode", "other.gcode", "--against",
                                       "large.ini", "small.ini",  "--report",    "-"};
  const auto run = weft(words, scratch.path());
  CHECK(run.status == 5);
  CHECK_THAT(run.err, Contains("part.gcode on large.ini: pass") && Contains("part.gcode on small.ini: 1 move outside"));
  const auto report = json::parse(run.out);
  CHECK(report["status"] == "rejected");
  REQUIRE(report["audits"].size() == 4);
  const auto& bad = report["audits"][2];
  CHECK(bad["file"] == "part.gcode");
  CHECK(bad["printer"] == "small.ini");
  CHECK(bad["violation_count"] == 1);
  CHECK(bad["violations"][0]["outside_mm"] == 30.0);
  CHECK(bad["violations"][0]["side"] == "+x");
  CHECK(bad["violations"][0]["line"] == 9);
  CHECK(bad["totals"][0]["count"] == 1);
  auto junit = words;
  junit.insert(junit.end(), {"--format", "junit"});
  const auto xml = weft(junit, scratch.path());
  CHECK(xml.status == 5);
  CHECK_THAT(xml.out, StartsWith("<?xml ") && Contains("tests=\"4\" failures=\"1\" errors=\"0\"") &&
                          Contains("<failure type=\"boundary\""));
}

TEST_CASE("audit: files that cannot be read are status 6, and do not keep others from being audited") {
  Scratch scratch;
  scratch.write("good.gcode", start);
  scratch.write("packed.gcode", "GCDE and then bytes");
  const auto missing = weft({"audit", "none.gcode", "good.gcode", "-s", "home_position=0x0"}, scratch.path());
  CHECK(missing.status == 6);
  CHECK_THAT(missing.err, Contains("none.gcode: cannot be read") && Contains("good.gcode: pass"));
  CHECK_THAT(weft({"audit", "packed.gcode", "-s", "home_position=0x0"}, scratch.path()).err, Contains("binary G-code"));
  CHECK(weft({"audit"}, scratch.path()).status == 2);
  CHECK(weft({"audit", "good.gcode", "--format", "yaml"}, scratch.path()).status == 2);
}

TEST_CASE("audit: a job whose frame is moved is refused with the line, the reason and the number of moves") {
  for (const auto* moved : {"M206 X500", "G10 L2 P1 X500", "G68 R45", "G55", "SET_GCODE_OFFSET X=nan", "M428"}) {
    CAPTURE(moved);
    Scratch scratch;
    scratch.write("part.stl", box_stl(10, 10, 0.4F));
    const auto s = slice(scratch, "part.stl", {"-s", std::string("machine_start_gcode=G28\\nG90\\n") + moved});
    CHECK(s.rejected.status == 5);
    CHECK_FALSE(s.file_after_rejection);
    CHECK_THAT(s.rejected.err, Contains("not audited (") || Contains("damaged line"));
    CHECK(s.annotated.status == 0);
    CHECK_THAT(s.annotated.err, Contains("warning") && Contains(" not audited"));
  }
  Scratch scratch;
  scratch.write("part.stl", box_stl(10, 10, 0.4F));
  const auto s = slice(scratch, "part.stl", {"-s", "machine_start_gcode=PRINT_START\\nG28\\nG29"});
  CHECK(s.rejected.status == 0);
  CHECK_THAT(s.gcode, Contains(" moves checked; opaque: PRINT_START, G29\n"));
  CHECK_THAT(s.rejected.err, Contains("audit: pass, ") && Contains(" moves checked; opaque: PRINT_START, G29\n"));
  CHECK(s.report["audit"]["opaque"] == json{"PRINT_START", "G29"});
}

TEST_CASE("audit: annotating says so on standard error, in the report and its status") {
  Scratch scratch;
  scratch.write("printer.ini", printer);
  scratch.write("part.stl", box_stl(10, 10, 0.4F));
  const auto run = weft({"slice", "part.stl", "-p", "printer.ini", "-o", "out.gcode", "--report", "r.json", "--center",
                         "300,100", "--audit", "annotate"},
                        scratch.path());
  CHECK(run.status == 0);
  CHECK_THAT(run.err, Contains("warning") && Contains(" moves outside, worst ") && Contains("beyond +x of"));
  const auto report = json::parse(scratch.read("r.json"));
  CHECK(report["status"] == "annotated");
  CHECK(report["audit"]["verdict"] == "annotated");
  CHECK_THAT(report["audit"]["summary"].get<std::string>(), Contains(" moves outside"));
}

TEST_CASE("audit: a file without a move is refused") {
  Scratch scratch;
  for (const auto* text : {"", "; generated by nobody\n", "M104 S200\n"}) {
    const auto run = audit(scratch, text);
    CHECK(run.status == 5);
    CHECK_THAT(run.err, Contains("nothing to audit: did the upload break off?"));
  }
}

TEST_CASE("audit: what is opaque is named without -v, and commands to the host are no damage") {
  Scratch scratch;
  const auto run = audit(scratch, start + "PRINT_START\n@pause\nT1\nM0\nG1 X10 Y10\n");
  CHECK(run.status == 0);
  CHECK_THAT(run.err, Contains("opaque: PRINT_START, @pause, T1, M0"));
}

TEST_CASE("audit: a finding in custom G-code quotes the line and the setting it came from, in the message, too") {
  Scratch scratch;
  scratch.write("part.stl", box_stl(10, 10, 0.4F));
  const auto s = slice(scratch, "part.stl", {"-s", "machine_end_gcode=G91\\nG1 Z1\\nG90\\nG1 X0 Y{machine_depth + 7}"});
  CHECK(s.rejected.status == 5);
  CHECK_THAT(s.rejected.err, Contains("from machine_end_gcode: G1 X0 Y207"));
  CHECK(s.report["audit"]["violations"][0]["setting"] == "machine_end_gcode");
}

TEST_CASE("audit: --commands lists what moves the frame and what becomes of it") {
  Scratch scratch;
  const auto run = weft({"audit", "--commands"}, scratch.path());
  CHECK(run.status == 0);
  for (const auto* command : {"G5 ", "G10 ", "G54 ", "G68 ", "G92.1", "M206 ", "M428 ", "M218 ", "SET_GCODE_OFFSET"})
    CHECK_THAT(run.out, Contains(std::string("\n") + command));
}

TEST_CASE("audit: the first travel is led round a no-go area") {
  Scratch scratch;
  scratch.write("part.stl", box_stl(10, 10, 0.4F));
  const auto s = slice(scratch, "part.stl", {"-s", "bed_exclude_areas=40x30, 70x30, 70x70, 40x70"});
  check_passes(s);
  // From a place that is not known it cannot be judged, and what to say is said.
  const auto unknown =
      slice(scratch, "part.stl", {"-s", "bed_exclude_areas=40x30, 70x30, 70x70, 40x70", "-s", "home_position=auto"});
  CHECK(unknown.rejected.status == 5);
  CHECK_THAT(unknown.rejected.err, Contains("1 move not audited (G28 on line ") && Contains("home_position"));
}
