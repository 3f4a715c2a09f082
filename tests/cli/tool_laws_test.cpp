// SPDX-License-Identifier: GPL-3.0-or-later
// Laws that the G-code of several tools keeps, read from its text alone, and files that were spoiled on purpose.
#include "cli/program.h"

#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <random>
#include <set>
#include <sstream>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> out;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) out.push_back(line);
  return out;
}

std::optional<double> word(const std::string& line, char letter) {
  const auto at = line.find(std::string(" ") + letter);
  if (at == std::string::npos) return std::nullopt;
  return std::stod(line.substr(at + 2));
}

bool moves(const std::string& line) {
  return line.starts_with("G1") || line.starts_with("G0");
}

/// What must hold of a print whose object `a` is T0's and whose object `b` is T1's, with relative E.
class Laws {
 public:
  /// @param wanted_mm3 that is purged at each change
  explicit Laws(double wanted_mm3) : wanted_mm3_(wanted_mm3) {}

  std::set<std::string> faults(const std::vector<std::string>& lines) {
    for (const auto& line : lines) read(line);
    end_of_pass();
    for (const auto& [tool, mm] : drawn_)
      if (mm < -1e-4) faults_.insert("pushed forward further than drawn back");
    return faults_;
  }

 private:
  void read(const std::string& line) {
    if (line.size() == 2 && line[0] == 'T' && line[1] >= '0' && line[1] <= '9') return change(line[1] - '0');
    if (line.starts_with("; printing object ")) object_ = line.substr(18, 1);
    if (line.starts_with("; stop printing")) object_.clear();
    if (line.starts_with(";TYPE:")) type_ = line.substr(6);
    if (line.starts_with("M104 S") || line.starts_with("M109 S")) celsius_ = std::stod(line.substr(6));
    if (!moves(line)) return;
    const auto e = word(line, 'E');
    if (!e) return;
    const bool goes = word(line, 'X') || word(line, 'Y');
    if (!goes || *e < 0) {
      drawn_[tool_.value_or(-1)] -= *e;
      return;
    }
    extrude(*e);
  }

  void extrude(double mm) {
    if (!tool_) faults_.insert("extruded without a tool");
    if (celsius_ < 170) faults_.insert("extruded cold");
    if (std::abs(drawn_[tool_.value_or(-1)]) > 1e-4) faults_.insert("extruded while drawn back");
    if (type_ == "Wipe tower")
      purged_mm3_ += mm * std::numbers::pi / 4 * 1.75 * 1.75;
    else if (!object_.empty())
      print();
  }

  void print() {
    if (object_ != (tool_ == 0 ? "a" : "b")) faults_.insert("printed with the other tool");
    if (changed_ && purged_mm3_ < wanted_mm3_ - 0.02) faults_.insert("printed before enough was purged");  // mm³
    printed_ = true;
  }

  void change(int tool) {
    if (tool_ == tool) faults_.insert("a tool that is loaded already");
    if (tool_ && std::abs(drawn_[*tool_]) > 1e-4) faults_.insert("swapped while drawn back");
    end_of_pass();
    changed_ = tool_.has_value();
    tool_ = tool;
    purged_mm3_ = 0, printed_ = false;
  }

  void end_of_pass() {
    if (tool_ && !printed_) faults_.insert("a tool that prints nothing");
  }

  double wanted_mm3_;
  std::set<std::string> faults_;
  std::optional<int> tool_;
  bool changed_ = false, printed_ = false;
  std::string object_, type_;
  double purged_mm3_ = 0, celsius_ = 0;
  std::map<int, double> drawn_;
};

/// Two boxes through one nozzle.
std::vector<std::string> printed() {
  static const auto lines = [] {
    const Scratch scratch;
    scratch.write("a.stl", box_stl(10, 10, 3));
    scratch.write("b.stl", box_stl(10, 10, 3));
    const auto run = weft({"slice", "a.stl", "b.stl@T1", "-o", "out.gcode", "-q", "-s", "tool_nozzles=0,0", "-s",
                           "firmware=marlin2", "-s", "relative_extrusion=true", "-s", "gcode_label_objects=comments",
                           "-s", "adhesion_type=none", "-s", "switch_extruder_retraction_amount=4"},
                          scratch.path());
    REQUIRE(run.status == 0);
    return lines_of(scratch.read("out.gcode"));
  }();
  return lines;
}

std::string joined(const std::set<std::string>& faults) {
  std::string out;
  for (const auto& fault : faults) out += fault + "; ";
  return out;
}

}  // namespace

TEST_CASE("cli: each bead is laid by its tool, hot, primed, and after enough was purged") {
  CHECK(joined(Laws(140).faults(printed())).empty());
  CHECK_FALSE(Laws(160).faults(printed()).empty());  // no more is purged than is wanted and a line
}

TEST_CASE("cli: a spoiled line of tools is always found") {
  const auto whole = printed();
  std::vector<std::size_t> changes, primes, tower;
  std::string type;
  double longest = 0;
  std::optional<double> x, y;
  std::vector<std::pair<std::size_t, double>> lengths;
  std::size_t layers = 0;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    const auto& line = whole[i];
    if (line == ";LAYER_CHANGE") ++layers;
    if (line == "T0" || line == "T1") changes.push_back(i);
    if (line.starts_with(";TYPE:")) type = line.substr(6);
    if (!moves(line)) continue;
    const auto e = word(line, 'E');
    const auto to_x = word(line, 'X') ? word(line, 'X') : x, to_y = word(line, 'Y') ? word(line, 'Y') : y;
    if (e && *e > 0 && !word(line, 'X') && !word(line, 'Y')) primes.push_back(i);
    if (e && *e > 0 && type == "Wipe tower" && layers > 1 && x && y && to_x && to_y) {
      lengths.emplace_back(i, std::hypot(*to_x - *x, *to_y - *y));
      longest = std::max(longest, lengths.back().second);
    }
    x = to_x, y = to_y;
  }
  for (const auto& [i, mm] : lengths)
    if (mm > 0.9 * longest) tower.push_back(i);
  REQUIRE(changes.size() > 10);
  REQUIRE(primes.size() > 20);
  REQUIRE(tower.size() > 100);

  std::mt19937 random(24);
  const auto any_of = [&](const std::vector<std::size_t>& list) {
    return list[std::uniform_int_distribution<std::size_t>(0, list.size() - 1)(random)];
  };
  int found = 0;
  for (int i = 0; i < 1000; ++i) {
    auto lines = whole;
    const auto drop = [&](std::size_t at) { lines[at].clear(); };
    if (i % 4 == 0) drop(any_of(changes));
    if (i % 4 == 1) drop(any_of(primes));
    if (i % 4 == 2) drop(any_of(tower));
    if (i % 4 == 3) {  // the order: two changes that follow each other
      const auto first = std::uniform_int_distribution<std::size_t>(0, changes.size() - 2)(random);
      std::swap(lines[changes[first]], lines[changes[first + 1]]);
    }
    found += !Laws(140).faults(lines).empty();
  }
  CHECK(found == 1000);
}
