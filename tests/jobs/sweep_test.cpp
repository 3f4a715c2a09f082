// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/sweep.h"

#include <map>
#include <set>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::jobs;
using Values = std::vector<std::string>;
using Catch::Matchers::Contains;

TEST_CASE("sweep: values are a list, or a range whose steps are counted") {
  CHECK(parse_axis("layer_height=0.1,0.2, 0.3").values == Values{"0.1", "0.2", "0.3"});
  CHECK(parse_axis("infill-sparse-density=10:50:10").values == Values{"10", "20", "30", "40", "50"});
  CHECK(parse_axis("layer_height=0.1:0.3:0.1").values == Values{"0.1", "0.2", "0.3"});
  CHECK(parse_axis("layer_height=0.10:0.27:0.05").values == Values{"0.1", "0.15", "0.2", "0.25"});
  CHECK(parse_axis("infill_pattern=grid,gyroid").key == "infill_pattern");
  CHECK(parse_axis("infill_sparse_density=10:50").continuous());
}

TEST_CASE("sweep: a tool's own setting is varied, where it may be a tool's own") {
  CHECK(parse_axis("tool.1.material-flow=90,100").key == "tool.1.material_flow");
  CHECK(parse_axis("tool.2.material_flow=90:100").continuous());
  CHECK_THROWS_WITH(parse_axis("tool.1.layer_height=0.1,0.2"), Contains("layer_height is no tool's own"));
  CHECK_THROWS_WITH(parse_axis("tool.1.machine_width=100,200"), Contains("machine_width is no tool's own"));
  CHECK_THROWS_WITH(parse_axis("tool.1.materialflow=1,2"), Contains("did you mean 'material_flow'?"));
}

TEST_CASE("sweep: what is no list of values is refused with a hint") {
  for (const auto* wrong :
       {"layer_height", "=1,2", "layer_height=", "layer_height=0.1,,0.2", "layer_height=0.1,0.1",
        "layer_height=0.3:0.1:0.1", "layer_height=0.1:0.3:0", "layer_height=a:b:c", "layer_height=0.1:0.3:0.0000001"})
    CHECK_THROWS_AS(parse_axis(wrong), Error);
  CHECK_THROWS_WITH(parse_axis("layer_hight=1"), Contains("did you mean 'layer_height'?"));
}

TEST_CASE("sweep: a grid has every combination, a zip the values in step") {
  const std::vector<Axis> axes{parse_axis("layer_height=0.1,0.2"), parse_axis("wall_line_count=1,2,3")};
  const auto grid = combinations(axes, {});
  REQUIRE(grid.size() == 6);
  CHECK(grid[0] == Values{"0.1", "1"});
  CHECK(grid[1] == Values{"0.1", "2"});
  CHECK(grid[5] == Values{"0.2", "3"});
  CHECK_THROWS_AS(combinations(axes, {Combine::zip}), Error);
  const auto zip = combinations({axes[0], parse_axis("wall_line_count=4,5")}, {Combine::zip});
  CHECK(zip == std::vector<Values>{{"0.1", "4"}, {"0.2", "5"}});
  CHECK_THROWS_AS(combinations({parse_axis("layer_height=0.1:0.3")}, {}), Error);
}

TEST_CASE("sweep: a Latin hypercube meets each stratum of each axis once, and is told by its seed") {
  const std::vector<Axis> axes{parse_axis("infill_sparse_density=0:100"), parse_axis("layer_height=0.1:0.3"),
                               parse_axis("infill_pattern=grid,gyroid,lines,triangles")};
  for (const std::uint64_t seed : {1u, 2u, 99u}) {
    const auto rows = combinations(axes, {Combine::sample, 20, seed});
    REQUIRE(rows.size() == 20);
    std::set<int> densities, heights;
    std::map<std::string, int> patterns;
    for (const auto& row : rows) {
      densities.insert(static_cast<int>(std::stod(row[0]) / 5));
      heights.insert(static_cast<int>((std::stod(row[1]) - 0.1) / 0.01 + 1e-6));
      ++patterns[row[2]];
    }
    CHECK(densities.size() == 20);
    CHECK(heights.size() >= 19);  // rounded to a micron, one may fall on a border
    for (const auto& [name, count] : patterns) CHECK(count == 5);
    CHECK(rows == combinations(axes, {Combine::sample, 20, seed}));
    CHECK(rows != combinations(axes, {Combine::sample, 20, seed + 1}));
  }
}

TEST_CASE("sweep: jobs are named by their settings") {
  const auto list =
      sweep_jobs({"a.stl"}, {parse_axis("infill_sparse_density=10%,20%"), parse_axis("infill_pattern=grid")}, {});
  REQUIRE(list.errors.empty());
  REQUIRE(list.jobs.size() == 2);
  CHECK(list.jobs[1].id == "infill_sparse_density=20%,infill_pattern=grid");
  CHECK(list.jobs[1].output == "infill_sparse_density=20%_infill_pattern=grid.gcode");
}

TEST_CASE("sweep: the best are those that no other beats") {
  std::vector<Trial> t(5);
  const auto set = [&](std::size_t i, double time, double grams, double strength) {
    t[i].ok = true, t[i].time_s = time, t[i].material_g = grams, t[i].strength = strength;
  };
  set(0, 100, 10, 50);
  set(1, 100, 10, 40);  // weaker
  set(2, 90, 12, 50);
  set(3, 120, 9, 30);
  t[4].time_s = 1;  // failed
  mark_best(t);
  CHECK(t[0].best);
  CHECK_FALSE(t[1].best);
  CHECK(t[2].best);
  CHECK(t[3].best);
  CHECK_FALSE(t[4].best);
}

TEST_CASE("sweep: the strength of a solid is 100 and grows with density") {
  Record record;
  Settings settings;
  const auto at = [&](double density, double walls, double infill) {
    settings.infill.infill_sparse_density = density;
    record.line = R"({"models": [{"volume_mm3": 1000}], "features": {"outer_wall": {"mm3": )" + std::to_string(walls) +
                  R"(}, "infill": {"mm3": )" + std::to_string(infill) + R"(}, "skirt": {"mm3": 500}}})";
    return strength_estimate(record, settings);
  };
  CHECK(at(100, 1000, 0) == Approx(100));
  CHECK(at(100, 400, 600) == Approx(100));
  CHECK(at(0, 400, 0) == Approx(40));
  CHECK(at(25, 400, 150) == Approx(40 + 60 * 0.125));
  settings.infill.infill_pattern = InfillPattern::triangles;
  CHECK(at(25, 400, 150) == Approx(40 + 60 * 0.25));
  // what the report says of the pattern holds: two directions in the plane and one up
  record.line.insert(1, R"("infill": {"stiffness_percent": {"plane": 9, "z": 30}}, )");
  CHECK(strength_estimate(record, settings) == Approx(40 + 60 * 0.16));
}

TEST_CASE("sweep: the page holds its data, whatever stands in it, and asks the network for nothing") {
  std::vector<Trial> trials(2);
  trials[0] = {"a=1",         "a.gcode", "", true, true, {"1"}, 10, 2, 30, 4, 1.5, "EUR", std::string("\x89PNG\0x", 6),
               "a.gcode.html"};
  trials[1].id = "</script><b>";
  trials[1].values = {"2"};
  const auto page = sweep_page("<part>.stl", {"a"}, trials);
  CHECK_THAT(page, Contains("\\u003c/script>\\u003cb>") && Contains("iVBORwB4") && Contains("a.gcode.html"));
  CHECK(page.find("http:") == page.find("http://www.w3.org/2000/svg"));
  CHECK(page.find("https:") == std::string::npos);  // the name of SVG, which is never fetched
  std::size_t ends = 0;
  for (std::size_t at = 0; (at = page.find("</script>", at)) != std::string::npos; ++at) ++ends;
  CHECK(ends == 2);  // facts, script
}
