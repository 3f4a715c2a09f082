// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/fixtures.h"
#include "mesh/three_mf_paint.h"
#include "mesh/zip_fixture.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::mesh;
using namespace fixtures;
using Catch::Contains;

namespace {

/// Vertices and triangles of a tetrahedron with that edge, moved along x; the first triangle has that attribute.
struct Tetrahedron {
  int x = 0, edge = 10, first_vertex = 0;
  std::string vertices() const {
    const auto at = [&](int dx, int y, int z) {
      return "<vertex x=\"" + std::to_string(x + dx) + "\" y=\"" + std::to_string(y) + "\" z=\"" + std::to_string(z) +
             "\"/>";
    };
    return at(0, 0, 0) + at(edge, 0, 0) + at(0, edge, 0) + at(0, 0, edge);
  }
  std::string triangles(const std::string& attribute = "") const {
    const auto triangle = [&](int a, int b, int c, const std::string& more) {
      return "<triangle v1=\"" + std::to_string(first_vertex + a) + "\" v2=\"" + std::to_string(first_vertex + b) +
             "\" v3=\"" + std::to_string(first_vertex + c) + "\" " + more + "/>";
    };
    return triangle(0, 2, 1, attribute) + triangle(0, 1, 3, "") + triangle(0, 3, 2, "") + triangle(1, 2, 3, "");
  }
  std::string mesh(const std::string& attribute = "") const {
    return "<mesh><vertices>" + vertices() + "</vertices><triangles>" + triangles(attribute) + "</triangles></mesh>";
  }
};

std::string model(const std::string& resources, const std::string& item = "1") {
  return R"(<?xml version="1.0" encoding="UTF-8"?>
<model xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02" xmlns:slic3rpe="http://schemas.slic3r.org/3mf/2017/06"><resources>)" +
         resources + "</resources><build><item objectid=\"" + item + "\"/></build></model>";
}

const Tetrahedron part, mark{20, 4, 4};

void check_marked(const Loaded& loaded, MarkKind kind) {
  REQUIRE(loaded.objects.size() == 1);
  CHECK(box_of(loaded.objects[0].mesh).max.x == 10'000);  // the volume is no part of it
  REQUIRE(loaded.objects[0].marks.size() == 1);
  CHECK(loaded.objects[0].marks[0].kind == kind);
  CHECK_FALSE(loaded.objects[0].marks[0].painted);
  CHECK(box_of(loaded.objects[0].marks[0].mesh) == Box3{{20'000, 0, 0}, {24'000, 4'000, 4'000}});
}

}  // namespace

TEST_CASE("mesh: a volume of PrusaSlicer's that is no part is a mark, of its kind", "[mesh][3mf]") {
  const std::string both = "<object id=\"1\"><mesh><vertices>" + part.vertices() + mark.vertices() +
                           "</vertices><triangles>" + part.triangles() + mark.triangles() +
                           "</triangles></mesh></object>";
  for (const auto& row : mark_names) {
    if (row.prusaslicer.empty()) continue;
    INFO(row.prusaslicer);
    const std::string config =
        "<config><object id=\"1\"><volume firstid=\"0\" lastid=\"3\"><metadata type=\"volume\" key=\"volume_type\" "
        "value=\"ModelPart\"/></volume><volume firstid=\"4\" lastid=\"7\"><metadata type=\"volume\" "
        "key=\"volume_type\" value=\"" +
        std::string(row.prusaslicer) + "\"/></volume></object></config>";
    check_marked(read(three_mf(model(both), {{"Metadata/Slic3r_PE_model.config", config}})), row.kind);
  }
}

TEST_CASE("mesh: a part of OrcaSlicer's and BambuStudio's that is none is a mark, of its kind", "[mesh][3mf]") {
  const Tetrahedron alone{20, 4, 0};
  const std::string resources = "<object id=\"1\">" + part.mesh() + "</object><object id=\"2\">" + alone.mesh() +
                                "</object><object id=\"3\"><components><component objectid=\"1\"/><component "
                                "objectid=\"2\"/></components></object>";
  for (const auto& row : mark_names) {
    if (row.orca.empty()) continue;
    INFO(row.orca);
    const std::string config =
        "<config><object id=\"3\"><part id=\"1\" subtype=\"normal_part\"/><part id=\"2\" subtype=\"" +
        std::string(row.orca) + "\"/></object></config>";
    check_marked(read(three_mf(model(resources, "3"), {{"Metadata/model_settings.config", config}})), row.kind);
  }
}

TEST_CASE("mesh: a volume of a kind that nobody knows is a part, and told", "[mesh][3mf]") {
  const auto read_with = [](const std::string& kind) {
    return read(three_mf(model("<object id=\"1\">" + part.mesh() + "</object>"),
                         {{"Metadata/Slic3r_PE_model.config",
                           "<config><object id=\"1\"><volume firstid=\"0\" lastid=\"3\"><metadata type=\"volume\" "
                           "key=\"volume_type\" value=\"" +
                               kind + "\"/></volume></object></config>"}}));
  };
  CHECK(read_with("ModelPart").notices.empty());
  const auto unknown = read_with("Frobnicator");
  CHECK(unknown.objects.size() == 1);
  REQUIRE(unknown.notices.size() == 1);
  CHECK_THAT(unknown.notices[0].message, Contains("'Frobnicator'"));
}

TEST_CASE("mesh: painted facets are marks, in both dialects, and damaged paint is told with its triangle",
          "[mesh][3mf]") {
  for (const std::string name : {"slic3rpe:custom_supports", "paint_supports"}) {
    INFO(name);
    const auto painted = [&](const std::string& text) {
      return three_mf(model("<object id=\"1\">" + part.mesh(name + "=\"" + text + "\"") + "</object>"));
    };
    for (const auto& [text, kind] :
         {std::pair{"4", MarkKind::support_enforcer}, std::pair{"8", MarkKind::support_blocker}}) {
      const auto loaded = read(painted(text));
      REQUIRE(loaded.objects[0].marks.size() == 1);
      CHECK(loaded.objects[0].marks[0].kind == kind);
      CHECK(loaded.objects[0].marks[0].painted);
      CHECK(loaded.objects[0].marks[0].mesh.triangles.size() == 1);
    }
    CHECK_THAT(refusal(painted("3")), Contains("object 1, triangle 1") && Contains("'3'"));
    CHECK_THAT(refusal(painted("4G")), Contains("object 1, triangle 1"));
  }
}

TEST_CASE("mesh: of a split triangle each child has its own paint", "[mesh][3mf]") {
  const std::array<Eigen::Vector3d, 3> corners{Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(4, 0, 0),
                                               Eigen::Vector3d(0, 4, 0)};
  const auto area = [](const PaintedFacet& f) {
    return 0.5 * (f.corners[1] - f.corners[0]).cross(f.corners[2] - f.corners[0]).norm();
  };
  for (const auto& [text, children] : {std::pair{"441", 2}, std::pair{"4442", 3}, std::pair{"44443", 4}}) {
    const auto all = painted_facets(text, corners);
    INFO(text);
    REQUIRE(all);
    CHECK(all->size() == static_cast<std::size_t>(children));
    double sum = 0;
    for (const auto& facet : *all) sum += area(facet);
    CHECK(sum == Approx(8));
  }
  // read from the last digit: split in two, then the child that is listed last, which is the one at corner c
  const auto one = painted_facets("041", corners);
  REQUIRE(one);
  REQUIRE(one->size() == 1);
  CHECK(area(one->front()) == Approx(4));
  CHECK(one->front().corners[1] == Eigen::Vector3d(0, 4, 0));
  CHECK_FALSE(painted_facets("41", corners));
  CHECK_FALSE(painted_facets("4441", corners));
}
