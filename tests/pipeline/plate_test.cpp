// SPDX-License-Identifier: GPL-3.0-or-later
// Plates as a program that embeds weft makes them: objects with settings of their own.
#include "core/error.h"
#include "cuboid.h"
#include "pipeline/pipeline.h"
#include "plain_job.h"

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::literals;
using Catch::Matchers::Contains;

namespace {

/// A box of that size, its corner there.
Mesh box(Point3 at, Point3 size) {
  Mesh mesh;
  for (const Um z : {at.z, at.z + size.z})
    for (const Point p : {Point{0, 0}, Point{size.x, 0}, Point{size.x, size.y}, Point{0, size.y}})
      mesh.vertices.push_back({at.x + p.x, at.y + p.y, z});
  for (const auto& f : cuboid_faces)
    mesh.triangles.push_back(
        {static_cast<std::uint32_t>(f[0]), static_cast<std::uint32_t>(f[1]), static_cast<std::uint32_t>(f[2])});
  return mesh;
}

Object object(std::string name, Point3 at, Point3 size) {
  Object out{.name = std::move(name), .volumes = {}};
  out.overlay = {.what = "object '" + out.name + "'", .scope = Scope::object};
  out.volumes.push_back({.name = out.name, .mesh = box(at, size)});
  out.hull = {{at.x, at.y}, {at.x + size.x, at.y}, {at.x + size.x, at.y + size.y}, {at.x, at.y + size.y}};
  return out;
}

Job plain_job() {
  Job job = test::plain_job();
  auto& s = job.settings;
  s.gcode.gcode_label_objects = ObjectLabels::firmware;
  s.machine.firmware = Firmware::klipper;
  s.adhesion.skirt_line_count = 0;
  s.cooling.cool_min_layer_time = 0;
  return job;
}

struct Outcome {
  std::string text;
  Report report;
};
Outcome printed(const Job& job, Plate plate, const Sequence& sequence = {}, StageCache* cache = nullptr) {
  Outcome out;
  const auto passed = run(job, std::move(plate), sequence, {}, out.report, cache);
  REQUIRE(passed.has_value());
  out.text = passed->gcode();
  return out;
}

/// The z of each layer in the order of the file, and what objects lie in it.
struct Layer {
  double z = 0;
  std::set<std::string> objects;
};
std::vector<Layer> layers_of(const std::string& text) {
  std::vector<Layer> out;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    if (line.rfind(";Z:", 0) == 0) out.push_back({std::stod(line.substr(3)), {}});
    constexpr std::string_view starts = "EXCLUDE_OBJECT_START NAME=";
    if (line.rfind(starts, 0) == 0) out.back().objects.insert(line.substr(starts.size()));
  }
  return out;
}

/// Extruded length of lines of a feature between layers of z in (from, to], mm, by object.
std::map<std::string, double> length_of(const std::string& text, const std::string& feature, double from, double to) {
  std::map<std::string, double> out;
  std::string name, type;
  double z = 0, x = 0, y = 0;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    if (line.rfind(";Z:", 0) == 0) z = std::stod(line.substr(3));
    if (line.rfind(";TYPE:", 0) == 0) type = line.substr(6);
    if (line.rfind("EXCLUDE_OBJECT_START NAME=", 0) == 0) name = line.substr(26);
    if (line.rfind("G0", 0) != 0 && line.rfind("G1", 0) != 0) continue;
    const auto word = [&](char letter, double otherwise) {
      const auto found = line.find(std::string(" ") + letter);
      return found == std::string::npos ? otherwise : std::stod(line.substr(found + 2));
    };
    const double nx = word('X', x), ny = word('Y', y);
    if (word('E', 0) > 0 && type == feature && z > from && z <= to) out[name] += std::hypot(nx - x, ny - y);
    x = nx, y = ny;
  }
  return out;
}

}  // namespace

TEST_CASE("plate: objects of other layer heights are merged by z, each printed as it is alone") {
  const auto job = plain_job();
  auto fine = object("fine", {20_mm, 20_mm, 0}, {10_mm, 10_mm, 6_mm}),
       coarse = object("coarse", {60_mm, 20_mm, 0}, {10_mm, 10_mm, 6_mm});
  coarse.overlay.add("layer_height", "0.3", "lid.3mf");
  const auto both = printed(job, {{fine, coarse}});
  const auto layers = layers_of(both.text);
  for (std::size_t i = 1; i < layers.size(); ++i) CHECK(layers[i].z > layers[i - 1].z);
  CHECK(layers.size() == 40);  // 30 and 20, of which 10 meet
  std::size_t fine_layers = 0, coarse_layers = 0;
  for (const auto& layer : layers)
    fine_layers += layer.objects.count("fine"), coarse_layers += layer.objects.count("coarse");
  CHECK(fine_layers == 30);
  CHECK(coarse_layers == 20);
  CHECK(layers[0].objects == std::set<std::string>{"fine"});            // 0.2
  CHECK(layers[1].objects == std::set<std::string>{"coarse"});          // 0.3
  CHECK(layers[3].objects == std::set<std::string>{"fine", "coarse"});  // 0.6
  double volume = 0;
  for (const auto& alone : {fine, coarse}) {
    const auto one = printed(job, {{alone}});
    volume += one.report.filament_mm3;
    CHECK(length_of(one.text, "External perimeter", 0, 10)[alone.name] ==
          Approx(length_of(both.text, "External perimeter", 0, 10)[alone.name]).margin(0.01));
  }
  CHECK(both.report.filament_mm3 == Approx(volume).epsilon(1e-6));
  CHECK(both.report.height_mm == 6);
}

TEST_CASE("plate: one object at a time is finished before the next begins on the bed") {
  auto job = plain_job();
  job.settings.gcode.between_objects_gcode = "; next";
  const Plate plate{
      {object("a", {20_mm, 20_mm, 0}, {10_mm, 10_mm, 2_mm}), object("b", {90_mm, 20_mm, 0}, {10_mm, 10_mm, 2_mm})}};
  const auto out = printed(job, plate, {{.objects = {1}, .rise = 0}, {.objects = {0}, .rise = 1}});
  const auto layers = layers_of(out.text);
  REQUIRE(layers.size() == 20);
  for (std::size_t i = 0; i < 20; ++i) {
    CHECK(layers[i].z == Approx(0.2 * static_cast<double>(i % 10 + 1)));
    CHECK(layers[i].objects == std::set<std::string>{i < 10 ? "b" : "a"});
  }
  CHECK(std::count(out.text.begin(), out.text.end(), '\n') > 0);
  const auto between = out.text.find("\n; next\n");
  CHECK(between != std::string::npos);
  CHECK(between == out.text.rfind("\n; next\n"));
  // The first layer of either is printed at the speed of first layers, and the fan is off.
  CHECK(out.report.height_mm == 2);
  std::size_t fans_off = 0;
  for (auto at = out.text.find("\nM107"); at != std::string::npos; at = out.text.find("\nM107", at + 1)) ++fans_off;
  CHECK(fans_off >= 2);
}

TEST_CASE("plate: an object has its own walls, infill and speeds, and the others keep theirs") {
  const auto job = plain_job();
  auto usual = object("usual", {20_mm, 20_mm, 0}, {20_mm, 20_mm, 3_mm}),
       own = object("own", {60_mm, 20_mm, 0}, {20_mm, 20_mm, 3_mm});
  const auto before = printed(job, {{usual, own}});
  own.overlay.add("wall_line_count", "5", "jobs.jsonl:1");
  own.overlay.add("infill_sparse_density", "60", "jobs.jsonl:1");
  own.overlay.add("speed_infill", "33", "jobs.jsonl:1");
  const auto after = printed(job, {{usual, own}});
  for (const auto* feature : {"Perimeter", "Internal infill"}) {
    auto was = length_of(before.text, feature, 0, 3), is = length_of(after.text, feature, 0, 3);
    CHECK(is["usual"] == Approx(was["usual"]).margin(0.1));
    CHECK(is["own"] > 1.5 * was["own"]);
  }
  CHECK_THAT(before.text, !Contains(" F1980"));
  CHECK_THAT(after.text, Contains(" F1980"));
  CHECK_THAT(after.text, Contains("; weft_overlay = object 'own': wall_line_count = 5 (jobs.jsonl:1)"));
  CHECK(before.report.settings_sha256 != after.report.settings_sha256);
}

TEST_CASE("plate: a height range holds for its layers alone") {
  const auto job = plain_job();
  auto one = object("one", {20_mm, 20_mm, 0}, {20_mm, 20_mm, 6_mm});
  const auto before = printed(job, {{one}});
  HeightRange range{2_mm, 4_mm, {.what = "height range 2 … 4", .scope = Scope::layer}};
  range.overlay.add("wall_line_count", "6", "one.3mf");
  range.overlay.add("layer_height", "0.1", "one.3mf");
  one.ranges.push_back(range);
  const auto after = printed(job, {{one}});
  CHECK(layers_of(before.text).size() == 30);
  CHECK(layers_of(after.text).size() == 40);
  CHECK(length_of(after.text, "Perimeter", 0, 2.01)["one"] ==
        Approx(length_of(before.text, "Perimeter", 0, 2.01)["one"]));
  CHECK(length_of(after.text, "Perimeter", 2.01, 4.01)["one"] >
        3 * length_of(before.text, "Perimeter", 2.01, 4.01)["one"]);
  CHECK(length_of(after.text, "Perimeter", 4.01, 9)["one"] ==
        Approx(length_of(before.text, "Perimeter", 4.01, 9)["one"]));
}

TEST_CASE(
    "plate: volumes of one object are areas of its layers, alike they are one, and where they overlap the later has "
    "it") {
  const auto job = plain_job();
  auto whole = object("one", {20_mm, 20_mm, 0}, {20_mm, 10_mm, 2_mm});
  auto parts = object("one", {20_mm, 20_mm, 0}, {12_mm, 10_mm, 2_mm});
  parts.hull = whole.hull;
  parts.volumes.push_back({.name = "right", .mesh = box({30_mm, 20_mm, 0}, {10_mm, 10_mm, 2_mm})});
  const auto as_whole = printed(job, {{whole}}), as_parts = printed(job, {{parts}});
  CHECK(as_parts.report.filament_mm3 == Approx(as_whole.report.filament_mm3).epsilon(1e-6));

  auto& right = parts.volumes.back().overlay;
  right = {.what = "volume 'right'", .scope = Scope::region};
  right.add("infill_sparse_density", "100", "one.3mf");
  right.add("wall_line_count", "1", "one.3mf");
  const auto apart = printed(job, {{parts}});
  // Either is outlined: 10 × 10 twice instead of 20 × 10 once, and the later one's walls are single.
  const auto outer = length_of(apart.text, "External perimeter", 0, 0.21)["one"];
  CHECK(outer > length_of(as_whole.text, "External perimeter", 0, 0.21)["one"] + 15);
  CHECK(length_of(apart.text, "Perimeter", 0, 0.21)["one"] < length_of(as_whole.text, "Perimeter", 0, 0.21)["one"]);
  CHECK(apart.report.filament_mm3 > as_whole.report.filament_mm3);
}

TEST_CASE("plate: a stage is made again only where it is handed other settings") {
  const auto job = plain_job();
  const auto plate = [](const char* density, const char* speed) {
    auto one = object("one", {20_mm, 20_mm, 0}, {20_mm, 20_mm, 2_mm});
    one.overlay.add("infill_sparse_density", density, "x");
    one.overlay.add("speed_infill", speed, "x");
    return Plate{{one}};
  };
  StageCache cache({});
  const auto made = [&](const char* stage) {
    for (const auto& count : cache.counts())
      if (count.stage == stage) return count.made;
    return std::size_t{0};
  };
  const auto first = printed(job, plate("20", "50"), {}, &cache);
  printed(job, plate("40", "50"), {}, &cache);
  CHECK(made("slice") == 1);
  CHECK(made("walls") == 1);
  CHECK(made("infill") == 2);
  const auto faster = printed(job, plate("20", "70"), {}, &cache);
  CHECK(made("infill") == 2);
  CHECK(faster.text != first.text);
  CHECK(printed(job, plate("20", "50"), {}, &cache).text == first.text);
  CHECK(printed(job, plate("20", "50")).text == first.text);
}

TEST_CASE("plate: what cannot be printed is refused by name") {
  const auto job = plain_job();
  const auto message = [&](Plate plate) {
    Report report;
    try {
      run(job, std::move(plate), {}, {}, report);
    } catch (const Error& e) {
      return std::string(e.what());
    }
    return std::string("nothing was thrown");
  };
  auto one = object("one", {20_mm, 20_mm, 0}, {20_mm, 20_mm, 2_mm});
  auto cut = one;
  cut.volumes.front().kind = VolumeKind::negative;
  CHECK_THAT(message({{cut}}), Contains("object 'one': it has no part that is printed"));
  auto marked = one;
  marked.volumes.push_back(
      {.name = "here", .mesh = box({25_mm, 25_mm, 0}, {5_mm, 5_mm, 2_mm}), .kind = VolumeKind::support_enforcer});
  CHECK_THAT(message({{marked}}), Contains("object 'one': a support enforcer ('here') is a mark, not a volume"));
  CHECK_THAT(message({}), Contains("the plate holds no objects"));
  auto nowhere = one;
  nowhere.copies.clear();
  CHECK_THAT(message({{nowhere}}), Contains("object 'one': no copy of it stands on the plate"));
  auto thick = one;
  thick.overlay.add("layer_height", "0.6", "x");
  CHECK_THAT(message({{thick}}), Contains("object 'one': layer_height 0.6 mm is more than nozzle_diameter 0.4 mm"));
}
