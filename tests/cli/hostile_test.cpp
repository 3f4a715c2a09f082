// SPDX-License-Identifier: GPL-3.0-or-later
// What scripts and other people's files throw at the program: each is an error of one line with the status of the
// contract, at once.
#include "cli/program.h"
#include "sanitized.h"
#include "source.h"

#include <algorithm>
#include <filesystem>
#include <sstream>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <unistd.h>

using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

struct Desk {
  Scratch scratch;
  Desk() { scratch.write("part.stl", box_stl(10, 10, 2)); }
  /// That status and message, on one line.
  void fails(const std::string& script, int status, const std::string& message) const {
    CAPTURE(script);
    const auto run = shell("timeout 20 " + script, scratch.path());
    CHECK(run.status == status);
    CHECK_THAT(run.err, Contains(message));
    CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 1);
  }
};

}  // namespace

TEST_CASE("hostile: pipes, devices and folders are refused as inputs by their names, at once") {
  const Desk desk;
  REQUIRE(shell("mkfifo pipe.stl pipe.ini pipe.gcode; mkdir folder.stl folder.ini", desk.scratch.path()).status == 0);
  desk.fails("$WEFT slice pipe.stl -o a.gcode", 6, "pipe.stl: is a pipe, not a file");
  desk.fails("$WEFT slice /dev/zero -o a.gcode", 6, "/dev/zero: is a device, not a file");
  desk.fails("$WEFT slice folder.stl -o a.gcode", 6, "folder.stl: is a directory");
  desk.fails("$WEFT slice part.stl -p pipe.ini -o a.gcode", 6, "pipe.ini: is a pipe, not a file");
  desk.fails("$WEFT slice part.stl -p /dev/zero -o a.gcode", 6, "/dev/zero: is a device");
  desk.fails("$WEFT slice part.stl -p folder.ini -o a.gcode", 6, "folder.ini: is a folder");
  desk.fails("$WEFT verify pipe.gcode part.stl", 6, "pipe.gcode: is a pipe");
  desk.fails("$WEFT preview pipe.gcode -o a.png", 6, "pipe.gcode: is a pipe");
  desk.fails("$WEFT audit pipe.gcode -p " + (tests::source / "profiles/printers/marlin-220.ini").string(), 6,
             "pipe.gcode: is a pipe");
  desk.fails("$WEFT inspect pipe.stl", 6, "pipe.stl: is a pipe");
  desk.fails("$WEFT batch pipe.gcode -o out", 6, "pipe.gcode: is a pipe");
  CHECK(!desk.scratch.has("a.gcode"));
}

TEST_CASE("hostile: what is larger than any profile or list is refused before it is read") {
  const Desk desk;
  REQUIRE(shell("truncate -s 3G p.ini l.jsonl", desk.scratch.path()).status == 0);  // of which nothing is there
  desk.fails("$WEFT slice part.stl -p p.ini -o a.gcode", 6, "p.ini: of 3072 MB is no profile");
  desk.fails("$WEFT batch l.jsonl -o out", 6, "l.jsonl: of 3072 MB is no list of jobs");
}

TEST_CASE("hostile: profiles that lead in circles or nowhere are told by file and line") {
  const Desk desk;
  REQUIRE(shell("ln -s loop.ini loop.ini", desk.scratch.path()).status == 0);
  desk.scratch.write("a.ini", "inherits = loop.ini\n");
  desk.scratch.write("b.ini", "inherits = " + std::string(300, 'x') + ".ini\n");
  desk.fails("$WEFT slice part.stl -p a.ini -o a.gcode", 3, "a.ini:1: ");
  desk.fails("$WEFT slice part.stl -p b.ini -o a.gcode", 3, "b.ini:1: ");
  desk.fails("$WEFT slice part.stl -p loop.ini -o a.gcode", 6, "loop.ini: cannot be read");
}

TEST_CASE("hostile: a folder with links that lead to themselves is a folder of the models in it") {
  const Desk desk;
  REQUIRE(shell("mkdir d; cp part.stl d; ln -s x.stl d/x.stl; ln -s . d/y.stl", desk.scratch.path()).status == 0);
  CHECK(shell("$WEFT batch d -o out -q", desk.scratch.path()).status == 0);
  CHECK(desk.scratch.has("out/part.gcode"));
}

TEST_CASE("hostile: a result goes through a link, under any name that a system takes, and never above its limit") {
  const Desk desk;
  const std::string name = std::string(249, 'n') + ".gcode";  // 255 bytes
  CHECK(shell("$WEFT slice part.stl -o " + name, desk.scratch.path()).status == 0);
  CHECK(desk.scratch.has(name));
  REQUIRE(shell("mkdir there; ln -s there/real.gcode link.gcode", desk.scratch.path()).status == 0);
  CHECK(shell("$WEFT slice part.stl -o link.gcode", desk.scratch.path()).status == 0);
  CHECK(fs::is_symlink(desk.scratch.path() / "link.gcode"));
  CHECK((desk.scratch.read("there/real.gcode") == desk.scratch.read(name)));
  if (!sanitized) {
    const auto names = desk.scratch.names();
    desk.fails("bash -c 'ulimit -f 4; exec $WEFT slice part.stl -o big.gcode'", 6,
               "big.gcode: cannot be written (File too large); the system's limit for the size of a file is reached");
    CHECK(desk.scratch.names() == names);
  }
}

TEST_CASE("hostile: what cannot be written is told before the work") {
  const Desk desk;
  desk.fails("$WEFT slice part.stl -o a.gcode --report none/r.json", 6, "none/r.json: cannot be written");
  desk.fails("$WEFT slice part.stl -o none/a.gcode", 6, "none/a.gcode: cannot be written");
  desk.fails("$WEFT slice part.stl -o a.gcode --preview none/p.png", 6, "none/p.png: cannot be written");
  desk.fails("$WEFT slice part.stl -o a.gcode --report .", 6, ".: is a folder");
  CHECK(!desk.scratch.has("a.gcode"));
}

TEST_CASE("hostile: a list of one endless word is refused at once, in few words") {
  const Desk desk;
  desk.scratch.write("deep.jsonl", std::string(100'000, '[') + "\n");
  const auto run = shell("timeout 20 $WEFT batch deep.jsonl -o out", desk.scratch.path());
  CHECK(run.status == 2);
  CHECK_THAT(run.err, Contains("deep.jsonl:1: column '[[[["));
  CHECK(run.err.size() < 1000);
}

TEST_CASE("hostile: a message is one line that does nothing to a terminal") {
  const Desk desk;
  desk.fails("$WEFT slice $'no\\e[31m\\nne\\r.stl' -o a.gcode", 6, "no\\x1b[31m\\x0ane\\x0d.stl");
  desk.fails("$WEFT slice $'no\\xc2\\x9bm.stl' -o a.gcode", 6, "no\\x9bm.stl");
}

TEST_CASE("hostile: with -q a batch still names the jobs that failed") {
  const Desk desk;
  desk.scratch.write("list.jsonl", R"({"id": "far", "models": ["part.stl"], "center": [900, 900]})"
                                   "\n");
  const auto run = shell("$WEFT batch list.jsonl -o out -q", desk.scratch.path());
  CHECK(run.status == 7);
  CHECK_THAT(run.err, Contains("weft: error: far (list.jsonl:1): "));
}

TEST_CASE("hostile: no result leaves the folder through a link") {
  const Desk desk;
  REQUIRE(shell("mkdir out away; ln -s ../away out/sub", desk.scratch.path()).status == 0);
  desk.scratch.write("list.jsonl", R"({"models": ["part.stl"], "output": "sub/a.gcode"})"
                                   "\n");
  desk.fails("$WEFT batch list.jsonl -o out", 2, "list.jsonl:1: output sub/a.gcode leads out of the folder");
  CHECK(!desk.scratch.has("away/a.gcode"));
  for (const std::string name : {"report.jsonl", "junit.xml", ".weft"}) {
    CAPTURE(name);
    REQUIRE(shell("rm -rf in; mkdir in; ln -s ../away in/" + name, desk.scratch.path()).status == 0);
    desk.fails("$WEFT batch part.stl -o in", 2, "leads out of the folder of the results");
  }
  REQUIRE(shell("rm -rf in; mkdir in; touch away/r; ln -s ../away/r in/summary.csv", desk.scratch.path()).status == 0);
  desk.fails("$WEFT batch part.stl -o in", 2, "-o: summary.csv leads out of the folder of the results");
  CHECK(desk.scratch.read("away/r").empty());
}

TEST_CASE("hostile: a cache entry that cannot be read is made again") {
  const Desk desk;
  REQUIRE(shell("$WEFT slice part.stl -o a.gcode --cache c", desk.scratch.path()).status == 0);
  REQUIRE(shell("for f in c/*/*.*; do rm $f; mkdir $f; done", desk.scratch.path()).status == 0);
  REQUIRE(shell("$WEFT slice part.stl -o b.gcode --cache c", desk.scratch.path()).status == 0);
  CHECK((desk.scratch.read("a.gcode") == desk.scratch.read("b.gcode")));
}

TEST_CASE("hostile: weft profile alone is wrong use, and a placement that no one could ask for is no file of weft's") {
  const Desk desk;
  desk.fails("$WEFT profile", 2, "check, diff, import, list or show?");
  REQUIRE(shell("$WEFT slice part.stl -o a.gcode --copies 2", desk.scratch.path()).status == 0);
  for (const std::string copies : {"-5", "0", "2000000000"}) {
    REQUIRE(shell("sed 's/copies=2/copies=" + copies + "/' a.gcode > b.gcode", desk.scratch.path()).status == 0);
    desk.fails("$WEFT verify b.gcode part.stl", 6, "b.gcode: weft_placement: copies is " + copies);
  }
}

TEST_CASE("hostile: every verb that reads can be limited in time and memory") {
  const Desk desk;
  REQUIRE(shell("$WEFT slice part.stl -o a.gcode", desk.scratch.path()).status == 0);
  for (const std::string verb :
       {"audit a.gcode", "verify a.gcode part.stl", "preview a.gcode -o a.png", "inspect part.stl"}) {
    CAPTURE(verb);
    CHECK(shell("$WEFT " + verb + " --timeout 60 --max-memory 8000", desk.scratch.path()).status == 0);
    CHECK(shell("$WEFT " + verb + " --timeout -1", desk.scratch.path()).status == 2);
  }
  std::string moves = "M83\n;LAYER:0\nG1 Z0.2\n";
  for (int i = 0; i < 3'000'000; ++i) moves += i % 2 == 0 ? "G1 X10 Y10 E1\n" : "G1 X90 Y90 E1\n";
  desk.scratch.write("long.gcode", moves);
  desk.fails("$WEFT preview long.gcode -o long.png --timeout 0.01", 130, "--timeout: stopped after 0.01 s");
  if (!sanitized)
    desk.fails("$WEFT preview long.gcode -o long.png --max-memory 60", 130, "--max-memory: stopped above 60 MB");
  CHECK(!desk.scratch.has("long.png"));
}

TEST_CASE("hostile: where no thread is to be had the work is done with fewer, and comes out the same") {
  if (sanitized) return;  // their runtimes need threads of their own
  const Desk desk;
  REQUIRE(shell("$WEFT slice part.stl -o - > a.gcode", desk.scratch.path()).status == 0);
  // Root is given threads beyond any limit.
  const std::string nobody = ::geteuid() == 0 ? "setpriv --reuid=65533 --clear-groups " : "";
  fs::permissions(desk.scratch.path(), fs::perms::all);
  for (const std::string words : {"slice part.stl -o -", "slice part.stl -j 7 -o -"})
    for (const std::string threads : {"1", "2"}) {
      const auto script = nobody + "bash -c 'ulimit -u " + threads + "; exec $WEFT " + words + "' > b.gcode";
      CAPTURE(script);
      const auto run = shell(script, desk.scratch.path());
      CHECK(run.status == 0);
      CHECK((desk.scratch.read("b.gcode") == desk.scratch.read("a.gcode")));
    }
  const auto batch =
      shell(nobody + "bash -c 'ulimit -u 1; exec $WEFT batch part.stl -j 3 -o out'", desk.scratch.path());
  CHECK(batch.status == 0);
  CHECK(desk.scratch.has("out/part.gcode"));
}

TEST_CASE("hostile: profiles may be bounded to a folder, links and inheritance included") {
  const Desk desk;
  REQUIRE(shell("mkdir -p root/own secrets", desk.scratch.path()).status == 0);
  desk.scratch.write("secrets/s.ini", "layer_height = 0.3\n");
  desk.scratch.write("root/base.ini", "layer_height = 0.3\n");
  desk.scratch.write("root/own/good.ini", "inherits = ../base.ini\n");
  desk.scratch.write("root/own/bad.ini", "inherits = ../../secrets/s.ini\n");
  REQUIRE(shell("ln -s ../../secrets/s.ini root/own/link.ini", desk.scratch.path()).status == 0);
  const auto profiles = (tests::source / "profiles").string();
  const std::string slice = "$WEFT slice part.stl --profile-root root -o a.gcode -p ";
  CHECK(shell(slice + "root/own/good.ini -q", desk.scratch.path()).status == 0);
  CHECK(shell("WEFT_PROFILES=" + profiles + " " + slice + "marlin-220 -q", desk.scratch.path()).status ==
        0);  // found by name: installed for all
  REQUIRE(shell("rm a.gcode", desk.scratch.path()).status == 0);
  for (const std::string outside : {"secrets/s.ini", "root/own/bad.ini", "root/own/link.ini", "root/../secrets/s.ini"})
    desk.fails(slice + outside, 6, "lies outside the folder that profiles and what they name may come from");
  desk.scratch.write("list.jsonl", R"({"models": ["part.stl"], "profiles": ["secrets/s.ini"]})"
                                   "\n");
  CHECK(shell("$WEFT batch list.jsonl --profile-root root -o out", desk.scratch.path()).status != 0);
  CHECK(!desk.scratch.has("out/part.gcode"));
  desk.fails(slice + "root/base.ini --profile-root none", 2, "--profile-root");
  CHECK(!desk.scratch.has("a.gcode"));
}

TEST_CASE("hostile: the content of a file that is no profile is not told") {
  const Desk desk;
  desk.scratch.write("passwd", "root:x:0:0:secret\n");
  desk.scratch.write("key.pem", "MIIEvQ/IBADANBgkqhkiG9w0BAQEFAASC+secret==\n");
  desk.scratch.write("sly.ini", "inherits = passwd\n");
  for (const std::string file : {"passwd", "key.pem", "sly.ini"}) {
    const auto run = shell("$WEFT profile check " + file, desk.scratch.path());
    CHECK(run.status == 3);
    CHECK_THAT(run.err, Contains(":1: ") && !Contains("secret"));
  }
}

TEST_CASE("hostile: names that are no UTF-8 stand byte for byte in reports, which stay valid") {
  const Desk desk;
  REQUIRE(shell("mkdir d; cp part.stl $'d/p\\xffq.stl'; cp part.stl $'d/p\\xfeq.stl'", desk.scratch.path()).status ==
          0);
  const auto slice = shell("$WEFT slice $'d/p\\xffq.stl' -o a.gcode --report r.json -q", desk.scratch.path());
  CHECK(slice.status == 0);
  CHECK(nlohmann::json::parse(desk.scratch.read("r.json"))["models"][0]["file"] == "d/p%FFq.stl");
  CHECK(shell("$WEFT batch d -o out -q", desk.scratch.path()).status == 0);
  std::istringstream lines(desk.scratch.read("out/report.jsonl"));
  std::string line, ids;
  while (std::getline(lines, line)) ids += nlohmann::json::parse(line)["id"].get<std::string>() + " ";
  CHECK(ids == "p%FEq p%FFq ");
  for (const std::string file : {"out/junit.xml", "out/summary.csv"}) {
    CAPTURE(file);
    CHECK_NOTHROW(nlohmann::json(desk.scratch.read(file)).dump());  // which throws for what is no UTF-8
    CHECK_THAT(desk.scratch.read(file), Contains("p%FFq") && Contains("p%FEq"));
  }
}
