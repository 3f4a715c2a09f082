// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces that a file paints or colours for other tools, as they are printed.
#include "core/error.h"
#include "cuboid.h"
#include "mesh/zip_fixture.h"
#include "plain_job.h"
#include "settings/overlay.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

#include <catch2/catch.hpp>
#include <unistd.h>

using namespace weft;
using namespace weft::literals;
using Catch::Matchers::Contains;

namespace {

namespace fs = std::filesystem;

struct Folder {
  fs::path path;
  Folder() {
    std::string name = (fs::temp_directory_path() / "weft-painted-XXXXXX").string();
    path = ::mkdtemp(name.data());
  }
  ~Folder() { fs::remove_all(path); }
  std::string write(const std::string& name, const std::string& bytes) const {
    std::ofstream(path / name, std::ios::binary) << bytes;
    return (path / name).string();
  }
};

/// A block of 20 × 20 × 4 mm. @param attributes of triangle `f` of which all corners lie on the side `on`
struct Block {
  std::function<std::string(int axis, bool high)> attributes;
  std::string resources{};  ///< before the object
  std::string of_object{};
  std::string text() const {
    std::ostringstream out;
    out << resources << "<object id=\"9\" type=\"model\" " << of_object << "><mesh><vertices>";
    std::vector<std::array<int, 3>> corners;
    for (const int z : {0, 4})
      for (const auto& [x, y] : {std::pair(0, 0), {20, 0}, {20, 20}, {0, 20}}) corners.push_back({x, y, z});
    for (const auto& c : corners) out << "<vertex x=\"" << c[0] << "\" y=\"" << c[1] << "\" z=\"" << c[2] << "\"/>";
    out << "</vertices><triangles>";
    for (const auto& f : cuboid_faces) {
      out << "<triangle v1=\"" << f[0] << "\" v2=\"" << f[1] << "\" v3=\"" << f[2] << "\" ";
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto at = [&](std::size_t i) { return corners[static_cast<std::size_t>(f[i])][axis]; };
        if (at(0) == at(1) && at(1) == at(2)) out << attributes(static_cast<int>(axis), at(0) > 0);
      }
      out << "/>";
    }
    out << "</triangles></mesh></object>";
    return out.str();
  }
};

std::string project(const Block& block, const std::vector<std::pair<std::string, std::string>>& more = {}) {
  return fixtures::three_mf(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?><model unit=\"millimeter\" "
      "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\" "
      "xmlns:m=\"http://schemas.microsoft.com/3dmanufacturing/material/2015/02\" "
      "xmlns:slic3rpe=\"http://schemas.slic3r.org/3mf/2017/06\"><resources>" +
          block.text() + "</resources><build><item objectid=\"9\"/></build></model>",
      more);
}

struct Outcome {
  std::string text;
  Report report;
  double mm3(std::size_t tool) const { return tool < report.tools.size() ? report.tools[tool].filament_mm3 : 0; }
  std::string warnings() const {
    std::string out;
    for (const auto& warning : report.warnings) out += warning.message + "\n";
    return out;
  }
};

/// With three tools, solid.
Outcome printed(const std::string& file, const std::vector<std::pair<std::string, std::string>>& more = {}) {
  Job job = test::plain_job({file});
  job.settings.tools.extruders_enabled_count = 3;
  job.settings.infill.infill_sparse_density = 100;
  job.settings.adhesion.adhesion_type = AdhesionType::none;
  for (const auto& [key, text] : more) {
    Overlay own{.what = "test", .scope = Scope::layer};
    const auto* entry = find_setting(key);
    REQUIRE(entry != nullptr);
    entry->lay(job.settings, read_value(*entry, text, "test"));
  }
  Outcome out;
  const auto passed = run(job, {}, out.report);
  REQUIRE(passed.has_value());
  out.text = passed->gcode();
  return out;
}

constexpr double block_mm3 = 20 * 20 * 4;

}  // namespace

TEST_CASE("painted: a side is printed with its tool as deep as paint goes, in both dialects") {
  const Folder folder;
  for (const std::string name : {"slic3rpe:mmu_segmentation", "paint_color"}) {
    const Block block{[&](int axis, bool high) { return axis == 0 && high ? name + "=\"8\"" : std::string(); }};
    const auto file = folder.write("p.3mf", project(block));
    const auto out = printed(file, {{"paint_depth", "2"}});
    // A band of 2 mm less a triangle of 2 × 2 mm at both ends, which are nearer to the sides beside it.
    CHECK(out.mm3(1) == Approx((20 * 2 - 4) * 4).epsilon(0.08));
    CHECK(out.mm3(0) + out.mm3(1) == Approx(block_mm3).epsilon(0.03));
    CHECK(out.mm3(2) == 0);
  }
}

TEST_CASE("painted: a top is printed with its tool through the shell, and no deeper") {
  const Folder folder;
  const Block block{[&](int axis, bool high) { return axis == 2 && high ? "paint_color=\"0C\"" : std::string(); }};
  const auto out = printed(folder.write("p.3mf", project(block)), {{"top_layers", "3"}, {"top_thickness", "0"}});
  CHECK(out.mm3(2) == Approx(20 * 20 * 0.6).epsilon(0.03));
  CHECK(out.mm3(1) == 0);
}

TEST_CASE("painted: what is for a tool that there is not is told once, and printed with the part's own") {
  const Folder folder;
  const Block block{[&](int axis, bool high) { return high ? "paint_color=\"2C\"" : axis == 0 ? "" : ""; }};
  const auto out = printed(folder.write("p.3mf", project(block)));
  CHECK_THAT(out.warnings(), Contains("what is painted for extruder 5 is left out: the printer has T0 … T2"));
  CHECK(out.mm3(0) == Approx(block_mm3).epsilon(0.03));
}

TEST_CASE("painted: paint is for all features, whatever tools they have otherwise") {
  const Folder folder;
  const Block block{[&](int axis, bool high) { return axis == 0 && high ? "paint_color=\"8\"" : std::string(); }};
  const auto out = printed(folder.write("p.3mf", project(block)), {{"wall_0_extruder_nr", "2"}, {"paint_depth", "2"}});
  CHECK(out.mm3(1) == Approx((20 * 2 - 4) * 4).epsilon(0.08));
  CHECK(out.mm3(2) > 10);
}

TEST_CASE("painted: colours of a file go to the tools whose filaments are nearest, and what is far off is told") {
  const Folder folder;
  const std::vector<std::pair<std::string, std::string>> colours{
      {"tool_settings", "1.filament_colour = #E02020; 2.filament_colour = #2020E0"},
      {"filament_colour", "#F0F0F0"},
      {"paint_depth", "2"}};
  const Block block{
      [&](int axis, bool high) { return axis == 0 && high ? "pid=\"2\" p1=\"1\"" : std::string(); },
      "<m:colorgroup id=\"2\"><m:color color=\"#FFFFFFFF\"/><m:color color=\"#2222DDFF\"/></m:colorgroup>"};
  const auto out = printed(folder.write("p.3mf", project(block)), colours);
  CHECK(out.mm3(2) == Approx((20 * 2 - 4) * 4).epsilon(0.08));
  CHECK_THAT(out.warnings(), !Contains("filament_colour"));
  // One colour for all of an object is its tool's.
  const Block whole{[](int, bool) { return std::string(); },
                    "<basematerials id=\"1\"><base name=\"red\" displaycolor=\"#FF0000\"/>"
                    "<base name=\"grass\" displaycolor=\"#00FF00\"/></basematerials>",
                    "pid=\"1\" pindex=\"0\""};
  const auto red = printed(folder.write("w.3mf", project(whole)), colours);
  CHECK(red.mm3(1) == Approx(block_mm3).epsilon(0.03));
  auto green = whole;
  green.of_object = "pid=\"1\" pindex=\"1\"";
  CHECK_THAT(printed(folder.write("g.3mf", project(green)), colours).warnings(), Contains("#00FF00 is printed with T"));
  auto content = colours;
  content.emplace_back("colour_match", "400");
  CHECK_THAT(printed(folder.write("g.3mf", project(green)), content).warnings(), !Contains("#00FF00"));
}

TEST_CASE("painted: a layer that nothing is painted on is as it was") {
  const Folder folder;
  const Block bare{[](int, bool) { return std::string(); }},
      top{[&](int axis, bool high) { return axis == 2 && high ? "paint_color=\"8\"" : std::string(); }};
  const auto layer_of = [](const std::string& text, int number) {
    auto at = text.find(";LAYER_CHANGE");
    for (int i = 0; i < number; ++i) at = text.find(";LAYER_CHANGE", at + 1);
    std::istringstream in(text.substr(at, text.find(";LAYER_CHANGE", at + 1) - at));
    std::string out;
    for (std::string line; std::getline(in, line);)
      if (!line.starts_with("M73")) out += line + "\n";
    return out;
  };
  const auto a = printed(folder.write("a.3mf", project(bare))), b = printed(folder.write("b.3mf", project(top)));
  CHECK(layer_of(a.text, 5) == layer_of(b.text, 5));
}
