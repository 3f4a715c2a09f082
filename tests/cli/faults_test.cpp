// SPDX-License-Identifier: GPL-3.0-or-later
// What a farm's machines do to a job: full disks, readers that go away, limits, signals, files that change. The status
// says what happened, the message where, and nothing half-written is left.
#include "cli/program.h"
#include "sanitized.h"

#include <cstring>
#include <filesystem>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <sys/mount.h>

using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
using nlohmann::json;

namespace {

/// A box and a job that takes seconds: many layers of many copies.
void write_long_job(const Scratch& scratch) {
  scratch.write("box.stl", box_stl(6, 6, 100));
  scratch.write("long.ini", "layer_height = 0.05\ninitial_layer_height = 0.05\n");
}
const std::string long_job = "$WEFT slice box.stl -p long.ini --copies 200 --spacing 1 -o out.gcode --report r.json";

}  // namespace

TEST_CASE("faults: a full disk is status 6, says so, and keeps the old file") {
  Scratch scratch;
  scratch.write("box.stl", box_stl(10, 10, 2));
  const auto device = weft({"slice", "box.stl", "-o", "/dev/full"}, scratch.path());
  CHECK(device.status == 6);
  CHECK_THAT(device.err,
             Contains("weft: error: /dev/full: cannot be written (No space left on device); free some space"));

  const auto out = shell("$WEFT slice box.stl -o - > /dev/full", scratch.path());
  CHECK(out.status == 6);
  CHECK_THAT(out.err,
             Contains("weft: error: standard output: cannot be written (No space left on device); free some space"));

  const auto disk = scratch.path() / "disk";
  std::filesystem::create_directory(disk);
  if (::mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=16k") != 0) {
    WARN("SKIPPED: no right to mount a small disk");
    return;
  }
  scratch.write("disk/out.gcode", "the old one\n");
  const auto run = weft({"slice", "box.stl", "-o", "disk/out.gcode"}, scratch.path());
  CHECK(run.status == 6);
  CHECK_THAT(run.err, Contains("disk/out.gcode: cannot be written (No space left on device)"));
  CHECK((scratch.read("disk/out.gcode") == "the old one\n"));
  CHECK(std::distance(std::filesystem::directory_iterator(disk), {}) == 1);
  ::umount(disk.c_str());
}

TEST_CASE("faults: a file system that is read-only is status 6") {
  Scratch scratch;
  scratch.write("box.stl", box_stl(10, 10, 2));
  const auto disk = scratch.path() / "disk";
  std::filesystem::create_directory(disk);
  if (::mount("tmpfs", disk.c_str(), "tmpfs", MS_RDONLY, "size=16k") != 0) {
    WARN("SKIPPED: no right to mount a disk");
    return;
  }
  const auto run = weft({"slice", "box.stl", "-o", "disk/out.gcode"}, scratch.path());
  ::umount(disk.c_str());
  CHECK(run.status == 6);
  CHECK_THAT(run.err, Contains("weft: error: disk/out.gcode: cannot be written (Read-only file system)"));
}

TEST_CASE("faults: a folder that is gone, or that nothing may be written to, is status 6") {
  Scratch scratch;
  scratch.write("box.stl", box_stl(10, 10, 2));
  for (const auto* place : {"gone/out.gcode", "box.stl/out.gcode", "/proc/out.gcode"}) {
    const auto run = weft({"slice", "box.stl", "-o", place}, scratch.path());
    CHECK(run.status == 6);
    CHECK_THAT(run.err, StartsWith("weft: error: ") && Contains(place) && Contains("cannot be written"));
  }
  CHECK(weft({"slice", "box.stl", "-o", "out.gcode", "--report", "gone/r.json"}, scratch.path()).status == 6);
  CHECK(scratch.names() == std::vector<std::string>{"box.stl"});  // found before slicing
}

TEST_CASE("faults: a reader that goes away ends the job with status 6, not with a signal") {
  Scratch scratch;
  scratch.write("box.stl", box_stl(20, 20, 20));
  const auto run = shell("$WEFT slice box.stl -o - | head -c 100 > /dev/null; echo ${PIPESTATUS[0]}", scratch.path());
  CHECK(run.out == "6\n");
  CHECK_THAT(run.err, Contains("standard output: cannot be written (Broken pipe); was the pipe closed?"));
}

TEST_CASE("faults: a signal in the middle is status 130 and leaves nothing") {
  Scratch scratch;
  write_long_job(scratch);
  const auto before = scratch.names();
  for (const auto* signal : {"TERM", "INT"}) {
    // sent when the job says that it slices: by then it listens, however slow the machine
    const auto run = shell(long_job +
                               " --log-format json --progress always 2> err & job=$!; until grep -q slicing err; do "
                               "sleep 0.02; done 2> /dev/null; kill -" +
                               signal + " $job; wait $job; status=$?; cat err >&2; rm err; exit $status",
                           scratch.path());
    INFO(run.err);
    CHECK(run.status == 130);
    CHECK_THAT(run.err, Contains("interrupted; nothing was written"));
    CHECK(json::parse(scratch.read("r.json"))["status"] == "failed");
    std::filesystem::remove(scratch.path() / "r.json");
    CHECK(scratch.names() == before);
  }
}

TEST_CASE("faults: --timeout and --max-memory end a job with status 130 and a report of what was done") {
  Scratch scratch;
  write_long_job(scratch);
  const auto late = shell(long_job + " --timeout 0.2", scratch.path());
  CHECK(late.status == 130);
  CHECK_THAT(late.err, Contains("weft: error: --timeout: stopped after 0.2 s; nothing was written"));
  const auto report = json::parse(scratch.read("r.json"));
  CHECK(report["status"] == "failed");
  CHECK(report["models"][0]["triangles"] == 12);
  const auto fat = shell(long_job + " --max-memory 30", scratch.path());
  CHECK(fat.status == 130);
  CHECK_THAT(fat.err, Contains("weft: error: --max-memory: stopped above 30 MB"));
  CHECK_FALSE(scratch.has("out.gcode"));
  const auto wrong = shell(long_job + " --timeout -1", scratch.path());
  CHECK(wrong.status == 2);
  CHECK_THAT(wrong.err, Contains("--timeout: -1 is outside 0 … 1e9; 0 is no limit"));
}

TEST_CASE("faults: a limit is kept within a layer, however much is in it") {
  Scratch scratch;
  scratch.write("bed.ini", "machine_width = 400\nmachine_depth = 400\n");
  scratch.write("islands.stl", boxes_stl(0.5F, 0.5F, 0.2F, 350, 1));
  const auto run =
      shell("$WEFT slice islands.stl -p bed.ini -o out.gcode --report r.json --timeout 0.1", scratch.path());
  CHECK(run.status == 130);
  CHECK_THAT(run.err, Contains("weft: error: --timeout: stopped after 0.1 s; nothing was written"));
  const auto report = json::parse(scratch.read("r.json"));
  CHECK(report["status"] == "failed");
  CHECK_THAT(report["error"].get<std::string>(), StartsWith("--timeout: "));
  CHECK(scratch.names() == std::vector<std::string>{"bed.ini", "islands.stl", "r.json"});
}

TEST_CASE("faults: thousands of islands on a layer are each printed") {
  Scratch scratch;
  scratch.write("bed.ini", "machine_width = 400\nmachine_depth = 400\nskirt_line_count = 0\n");
  scratch.write("one.stl", box_stl(0.8F, 0.8F, 0.4F));
  scratch.write("islands.stl", boxes_stl(0.8F, 0.8F, 0.4F, 70, 1.5F));
  const auto plastic = [&](const char* model) {
    const auto run = weft({"slice", model, "-p", "bed.ini", "-o", "out.gcode", "--report", "r.json"}, scratch.path());
    INFO(run.err);
    REQUIRE(run.status == 0);
    return json::parse(scratch.read("r.json"))["filament"]["mm3"].get<double>();
  };
  CHECK(plastic("islands.stl") == Approx(70 * 70 * plastic("one.stl")).epsilon(0.01));
}

TEST_CASE("faults: memory that the system refuses is told, never a crash") {
  if (sanitized) {
    WARN("SKIPPED: sanitizers reserve more address space than any limit leaves");
    return;
  }
  Scratch scratch;
  write_long_job(scratch);
  int refused = 0;
  for (const int kilobytes : {60'000, 120'000, 250'000, 400'000}) {
    const auto run = shell("ulimit -v " + std::to_string(kilobytes) + "; " + long_job + " -j 2", scratch.path());
    CAPTURE(kilobytes, run.err);
    CHECK((run.status == 130 || run.status == 0));
    if (run.status == 0) continue;
    ++refused;
    CHECK_THAT(run.err, Contains("memory"));
    CHECK_FALSE(scratch.has("out.gcode"));
  }
  CHECK(refused > 0);  // or nothing was tested
}

TEST_CASE("faults: a model that is cut short or grows while it is read is refused") {
  Scratch scratch;
  scratch.write("box.stl", box_stl(10, 10, 2));
  // a writer that appends to a large file for as long as the reader reads
  const auto run = shell(
      "head -c 300000000 /dev/zero > big.stl; (while :; do echo more >> big.stl; done) & writer=$!; "
      "$WEFT slice big.stl -o out.gcode; status=$?; kill $writer; exit $status",
      scratch.path());
  CHECK((run.status == 6 || run.status == 4));
  CHECK_THAT(run.err, StartsWith("weft: error: big.stl: "));
  CHECK_FALSE(scratch.has("out.gcode"));
}

TEST_CASE("faults: sizes at both ends of what can be printed") {
  Scratch scratch;
  scratch.write("bed.ini", "machine_width = 3000\nmachine_depth = 3000\nmachine_height = 3000\n");
  scratch.write("huge.stl", box_stl(2000, 2000, 1));
  scratch.write("tiny.stl", box_stl(0.2F, 0.2F, 0.3F));
  scratch.write("tall.stl", box_stl(2, 2, 100));
  const auto done = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words{"slice", "-p", "bed.ini", "-o", "out.gcode", "--report", "r.json"};
    words.insert(words.end(), more.begin(), more.end());
    const auto run = weft(words, scratch.path());
    INFO(run.err);
    CHECK(run.status == 0);
    return run.status == 0 ? json::parse(scratch.read("r.json")) : json();
  };
  const auto huge = done({"huge.stl"});
  CHECK(huge["layers"] == 5);
  const auto tiny = done({"tiny.stl", "-s", "skirt_line_count=0"});
  CHECK(tiny["layers"] == 2);  // its top lies in the middle of the second
  CHECK(tiny["filament"]["mm3"].get<double>() > 0.006);
  CHECK(tiny["filament"]["mm3"].get<double>() < 0.016);  // two layers of 0.2 x 0.2 mm, their sides are round
  const auto tall = done({"tall.stl", "-s", "layer_height=0.02", "-s", "initial_layer_height=0.02"});
  CHECK(tall["layers"] == 5'000);
}

TEST_CASE("faults: a model far from the origin is put on the bed, or told where it is") {
  Scratch scratch;
  auto far = box_stl(20, 10, 5);
  const auto moved = [&](float x, float y, float z) {
    std::string out = far;
    for (std::size_t corner = 84; corner < out.size(); corner += 50)
      for (std::size_t i = 0; i < 9; ++i) {
        float v = 0;
        std::memcpy(&v, out.data() + corner + 12 + 4 * i, 4);
        v += i % 3 == 0 ? x : i % 3 == 1 ? y : z;
        std::memcpy(out.data() + corner + 12 + 4 * i, &v, 4);
      }
    return out;
  };
  scratch.write("near.stl", far);
  scratch.write("far.stl", moved(15'000, -15'000, 9'000));
  scratch.write("beyond.stl", moved(20'000, 0, 0));
  const auto body = [&](const char* model) {  // of the G-code, whose head and foot name the model
    const auto run = weft({"slice", model, "-o", "out.gcode"}, scratch.path());
    INFO(run.err);
    CHECK(run.status == 0);
    const auto text = scratch.read("out.gcode");
    const auto begin = text.find(";LAYER_CHANGE");
    return text.substr(begin, text.rfind(";LAYER_CHANGE") - begin);
  };
  CHECK((body("far.stl") == body("near.stl")));
  const auto kept = weft({"slice", "far.stl", "--keep-position", "--drop", "-o", "no.gcode"}, scratch.path());
  CHECK(kept.status == 5);
  CHECK_THAT(kept.err, Contains("far.stl: does not fit") && Contains("mm outside"));
  const auto above = weft({"slice", "far.stl", "--keep-position", "-o", "no.gcode"}, scratch.path());
  CHECK(above.status == 4);
  CHECK_THAT(above.err, Contains("stands 9000.000 mm above the bed"));
  const auto beyond = weft({"slice", "beyond.stl", "-o", "no.gcode"}, scratch.path());
  CHECK(beyond.status == 4);
  CHECK_THAT(beyond.err, Contains("beyond ±16 m"));
  CHECK_FALSE(scratch.has("no.gcode"));
}
