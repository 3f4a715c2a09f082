// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/program.h"

#include <catch2/catch.hpp>

using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

/// What bash offers for a line of words, the last of which is begun.
std::string offered_by_bash(const std::string& words, const Scratch& scratch) {
  const auto run = shell(
      "PATH=$(dirname \"$WEFT\"):$PATH\n"
      "compopt() { :; }\n"
      "source <(\"$WEFT\" completions bash)\n"
      "COMP_WORDS=(" +
          words +
          "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n"
          "_weft; printf '%s\\n' \"${COMPREPLY[@]}\"\n",
      scratch.path());
  INFO(run.err);
  CHECK(run.err.empty());
  return "\n" + run.out;
}

/// Does a shell that is there read what it is told? Says so when it is not there.
void check_syntax(const std::string& name, const std::string& check) {
  if (shell("command -v " + name).status != 0) {
    WARN("SKIPPED: no " << name << "; apt-get install " << name);
    return;
  }
  const Scratch scratch;
  const auto run = shell("\"$WEFT\" completions " + name + " -o words && " + check, scratch.path());
  INFO(run.err);
  CHECK(run.status == 0);
  CHECK(run.err.empty());
}

}  // namespace

TEST_CASE("completions: bash offers verbs, the options of each, values, settings and profiles") {
  const Scratch scratch;
  scratch.write("part.stl", box_stl(10, 10, 2));
  scratch.write("mine/printers/the-window.ini", "machine_width = 200\n");
  CHECK_THAT(offered_by_bash("weft s", scratch),
             Contains("\nslice\n") && Contains("\nsweep\n") && !Contains("\nbatch\n"));
  CHECK_THAT(offered_by_bash("weft slice --sp", scratch), Contains("\n--spacing\n"));
  CHECK_THAT(offered_by_bash("weft batch --sh", scratch), Contains("\n--shard\n"));
  CHECK_THAT(offered_by_bash("weft inspect --sh", scratch), !Contains("\n--shard\n"));
  CHECK_THAT(offered_by_bash("weft slice --infill-pat", scratch), Contains("\n--infill-pattern\n"));
  CHECK_THAT(offered_by_bash("weft slice --infill-pattern gy", scratch), Contains("\ngyroid\n"));
  CHECK_THAT(offered_by_bash("weft slice --infill-pattern = gy", scratch), Contains("\ngyroid\n"));
  CHECK_THAT(offered_by_bash("weft slice -s infill_pat", scratch), Contains("\ninfill_pattern=\n"));
  CHECK_THAT(offered_by_bash("weft slice -s infill_pattern = gy", scratch), Contains("\ngyroid\n"));
  CHECK_THAT(offered_by_bash("weft slice --log-format j", scratch), Contains("\njson\n"));
  CHECK_THAT(offered_by_bash("weft slice pa", scratch), Contains("\npart.stl\n"));
  CHECK_THAT(offered_by_bash("weft settings layer_hei", scratch), Contains("\nlayer_height\n"));
  CHECK_THAT(offered_by_bash("weft settings sup", scratch), Contains("\nsupport\n"));
  ::setenv("WEFT_PROFILES", (scratch.path() / "mine").c_str(), 1);
  CHECK_THAT(offered_by_bash("weft slice -p printers/the", scratch), Contains("\nprinters/the-window\n"));
  ::unsetenv("WEFT_PROFILES");
}

TEST_CASE("completions: zsh and fish read theirs without complaint") {
  check_syntax(
      "zsh",
      "zsh -f -n words && zsh -f -c 'fpath=($PWD $fpath); cp words _weft; autoload -Uz compinit; compinit -u -D; "
      "[[ $_comps[weft] == _weft ]]'");
  check_syntax(
      "fish",
      "fish --no-config --no-execute words && fish --no-config -c 'source words; complete -C \"weft sli\"' | "
      "grep -q slice && fish --no-config -c 'source words; complete -C \"weft settings sup\"' | grep -qx support");
}

TEST_CASE("completions: another word than a shell's is wrong use") {
  CHECK(weft({"completions"}).status == 2);
  CHECK_THAT(weft({"completions", "csh"}).err, Contains("bash, zsh or fish?"));
  CHECK_THAT(weft({"completions", "zsh"}).out, StartsWith("#compdef weft\n"));
}

TEST_CASE("profiles by name: slice, lists of jobs and inherits find them in WEFT_PROFILES, and the list names them") {
  const Scratch scratch;
  scratch.write("a.stl", box_stl(10, 10, 2));
  scratch.write("shelf/printers/small.ini", "# The small one.\nmachine_width = 90\nmachine_depth = 90\n");
  scratch.write("lists/mine.ini", "inherits = printers/small\nlayer_height = 0.25\n");
  scratch.write("lists/jobs.jsonl", R"({"id": "a", "models": ["../a.stl"], "profiles": ["small", "mine.ini"]})"
                                    "\n");
  ::setenv("WEFT_PROFILES", "nowhere:shelf", 1);
  const auto listed = weft({"profile", "list"}, scratch.path());
  const auto sliced = weft({"slice", "a.stl", "-p", "small", "-o", "a.gcode"}, scratch.path());
  const auto batch = weft({"batch", "lists/jobs.jsonl", "-o", "out"}, scratch.path());
  const auto explained = weft({"profile", "show", "small", "--explain", "machine_width"}, scratch.path());
  const auto missing = weft({"slice", "a.stl", "-p", "smal", "-o", "b.gcode"}, scratch.path());
  ::unsetenv("WEFT_PROFILES");
  CHECK(listed.status == 0);
  CHECK_THAT(listed.out, Contains("# shelf\nprinters/small  The small one.\n"));
  INFO(sliced.err << batch.err);
  CHECK(sliced.status == 0);
  CHECK_THAT(scratch.read("a.gcode"), Contains("; machine_width = 90\n"));
  CHECK(batch.status == 0);
  CHECK_THAT(scratch.read("out/a.gcode"), Contains("; machine_width = 90\n") && Contains("; layer_height = 0.25\n"));
  CHECK_THAT(explained.out, Contains("shelf/printers/small.ini:2"));
  CHECK(missing.status == 6);
  CHECK_THAT(missing.err, Contains("did you mean 'small'?"));
}

TEST_CASE("version: the first line is the version alone, the libraries follow") {
  const auto run = weft({"--version"});
  CHECK(run.status == 0);
  CHECK_THAT(run.out, StartsWith("weft ") && Contains("\nwith Boost 1.") && Contains("CGAL ") && Contains("TBB "));
  CHECK(run.out.find(' ', 5) > run.out.find('\n'));
}
