// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/density.h"

#include "areas.h"
#include "geometry/spatial_index.h"
#include "infill/concentric.h"
#include "infill/prepared.h"
#include "infill/sparse.h"
#include "settings_error.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>

#include <catch2/catch.hpp>
#include <unistd.h>

using namespace weft;
using namespace weft::test;
using namespace weft::literals;
using infill::Density;

namespace {

/// A block of 60 × 40 × 20 mm, hollow but for its sparse infill.
struct Block {
  Regions outline{rectangle(0, 0, 60'000, 40'000)};
  std::vector<infill::ShellLayer> layers;
  std::vector<infill::LayerAreas> areas;
  explicit Block(Um high = 20'000) {
    for (Um z = 200; z <= high; z += 200) {
      layers.push_back({z, 200, &outline, &outline});
      infill::PartAreas part;
      part.sparse = outline;
      areas.push_back({part});
    }
  }
  infill::ShellObject object() const { return {layers, infill::box_of(layers), 400_um}; }
};

struct File {
  std::filesystem::path path;
  File(const std::string& name, const std::string& text)
      : path(std::filesystem::temp_directory_path() / (std::to_string(::getpid()) + name)) {
    std::ofstream(path, std::ios::binary) << text;
  }
  ~File() { std::filesystem::remove(path); }
};

Density density_of(const InfillSettings& infill, const Block& block, Point on_bed = {}) {
  return Density(infill, block.object(), block.areas, on_bed);
}

/// Plastic over area of what lies left of a place and right of it.
std::pair<double, double> halves(const Beads& beads, Um x) {
  double left = 0, right = 0;
  for (const Bead& bead : beads)
    for (std::size_t i = 0; i + (bead.closed ? 0U : 1U) < bead.path.size(); ++i) {
      const Junction &a = bead.path[i], &b = bead.path[(i + 1) % bead.path.size()];
      constexpr int pieces = 64;
      for (int k = 0; k < pieces; ++k) {
        const double t = (k + 0.5) / pieces,
                     mm2 = std::lerp(a.width, b.width, t) * distance(a.at, b.at) / pieces * 1e-6;
        (std::lerp(a.at.x, b.at.x, t) < x ? left : right) += mm2;
      }
    }
  return {left, right};
}

}  // namespace

TEST_CASE("density: by height, by distance, by gradual steps", "[infill]") {
  const Block block;
  InfillSettings s;
  s.infill_density_by_height = {{0, 40}, {10, 20}};
  CHECK(density_of(s, block).at({30'000, 20'000}, 5'000) == Approx(0.3));
  CHECK(density_of(s, block).at({30'000, 20'000}, 15'000) == Approx(0.2));
  s = {};
  s.infill_density_by_distance = {{0, 60}, {8, 20}};
  // 4 mm from the nearest face, half a cell of half a millimetre off at most
  CHECK(density_of(s, block).at({4'000, 20'000}, 10'000) == Approx(0.4).margin(0.02));
  CHECK(density_of(s, block).at({30'000, 20'000}, 10'000) == Approx(0.2).margin(0.005));
  s = {};
  s.gradual_infill_steps = 2, s.gradual_infill_step_height = 2'000, s.infill_density_min = 1;
  CHECK(density_of(s, block).at({30'000, 20'000}, 19'000) == Approx(0.2));
  CHECK(density_of(s, block).at({30'000, 20'000}, 17'000) == Approx(0.1));
  CHECK(density_of(s, block).at({30'000, 20'000}, 5'000) == Approx(0.05));
}

TEST_CASE("density: transfer curves are the inverses of what they are named after", "[infill][law]") {
  const Block block;
  const File csv("v.csv", "0,0,0,0.2\n60,0,0,0.8\n");
  InfillSettings s;
  s.infill_density_field = csv.path.string(), s.infill_density_min = 0, s.infill_density_max = 100;
  const auto at = [&](const char* curve, Um x) {
    value::parse(curve, Unit::none, s.infill_density_transfer);
    return density_of(s, block).at({x, 20'000}, 10'000);
  };
  for (const Um x : {0, 20'000, 60'000}) {
    const double v = 0.2 + 0.6 * x / 60'000;
    CHECK(at("linear", x) == Approx(v));
    CHECK(std::pow(at("simp:3", x), 3) == Approx(v));  // E/E₀ = ρᵖ
    const double rho = at("ramp:8", x);
    CHECK(rho / (1 + 8 * (1 - rho)) == Approx(v));  // E/E₀ = ρ/(1 + q(1 − ρ))
  }
  CHECK(at("heaviside:16:0.5", 0) < 0.02);
  CHECK(at("heaviside:16:0.5", 60'000) > 0.98);
  CHECK(at("heaviside:16:0.5", 30'000) == Approx(0.5));
  s.infill_density_min = 10, s.infill_density_max = 50;
  CHECK(1 / at("linear_spacing", 30'000) == Approx((1 / 0.1 + 1 / 0.5) / 2));
  CHECK(at("exponential_spacing", 30'000) == Approx(std::sqrt(0.1 * 0.5)));
}

TEST_CASE("density: a field that misses the object is refused with both places", "[infill]") {
  const Block block;
  const File csv("m.csv", "0,0,0,0.2\n10,0,0,0.8\n0,10,0,0.2\n10,10,0,0.2\n");
  InfillSettings s;
  s.infill_density_field = csv.path.string();
  CHECK(settings_error([&] {
          (void)density_of(s, block, {80'000, 80'000});
        }) == csv.path.string() +
                  ": 0…10, 0…10, 0…0 misses the object at 80…140, 80…120, 0…20; is it in metres or another frame?");
}

TEST_CASE("density: a wedge of densities is laid as it is asked for, by every way of making it", "[infill][law]") {
  const Block block;
  const File csv("w.csv", "0,0,0,0.1\n60,0,0,0.4\n");
  for (const DensityDither dither : {DensityDither::none, DensityDither::floyd_steinberg, DensityDither::blue_noise})
    for (const InfillPattern pattern : {InfillPattern::grid, InfillPattern::gyroid}) {
      InfillSettings s;
      s.infill_density_field = csv.path.string(), s.infill_density_dither = dither, s.infill_pattern = pattern;
      infill::Prepared prepared;
      prepared.density.emplace(s, block.object(), block.areas, Point{});
      double left = 0, right = 0;
      constexpr std::size_t layers = 6;  // cells of two densities are right on average
      for (std::size_t i = 0; i < layers; ++i) {
        Beads beads;
        const Um z = static_cast<Um>(2'000 + 200 * i);
        for (const Density::Part& part : prepared.density->parts(block.outline.front(), z, i)) {
          const std::size_t from = beads.size();
          infill::fill_sparse(part.region,
                              {.pattern = part.pattern,
                               .density = part.level,
                               .band = 420,
                               .angle_rad = degrees(45),
                               .overlap = {45},
                               .z = z,
                               .origin = {30'000, 20'000},
                               .reach = 30'000,
                               .even = !part.dithered},
                              beads);
          if (!part.dithered) prepared.density->follow(part.level, z, from, beads);
        }
        prepared.density->even(block.outline.front(), z, 420, dither != DensityDither::none, 0, beads);
        const auto [l, r] = halves(beads, 30'000);
        left += l / 1'200 / layers, right += r / 1'200 / layers;
      }
      CAPTURE(static_cast<int>(dither), static_cast<int>(pattern));
      CHECK(left == Approx(0.175).epsilon(0.08));
      CHECK(right == Approx(0.325).epsilon(0.08));
    }
}

TEST_CASE("density: rings are as far apart at each place as it asks for, and the plastic is what it asks for",
          "[infill]") {
  const Block block;
  const File csv("r.csv", "0,0,0,0.1\n60,0,0,0.4\n");
  InfillSettings s;
  s.infill_density_field = csv.path.string(), s.infill_pattern = InfillPattern::concentric;
  const Density density = density_of(s, block);
  REQUIRE(density.goes_on());
  Beads beads;
  infill::fill_concentric(block.outline.front(), {.density = 0.2, .band = 420, .z = 5'000}, density, beads);
  for (const Bead& bead : beads) CHECK(bead.closed);
  // along the middle from the left, rings are met 420 / 0.1 … apart, half of that from the edge
  std::vector<double> met;
  for (const Bead& bead : beads)
    for (std::size_t i = 0; i < bead.path.size(); ++i) {
      const Point a = bead.path[i].at, b = bead.path[(i + 1) % bead.path.size()].at;
      if ((a.y < 20'000) != (b.y < 20'000)) met.push_back(a.x + (20'000.0 - a.y) / (b.y - a.y) * (b.x - a.x));
    }
  std::sort(met.begin(), met.end());
  REQUIRE(met.size() > 8);
  // ∫ρ dx / band = k + ½ with ρ = 0.1 + 0.3 x / 60 mm
  const auto before = [](double x) { return (0.1 * x + 0.0025e-3 * x * x) / 420; };
  for (std::size_t k = 0; k < 3; ++k) CHECK(before(met[k]) == Approx(static_cast<double>(k) + 0.5).margin(0.06));
  density.even(block.outline.front(), 5'000, 420, false, 0, beads);
  CHECK(covered_mm2(beads) == Approx(0.25 * 60 * 40).epsilon(0.005));
}

TEST_CASE("density: what joins lines at a border of levels is taken from the lines around it", "[infill]") {
  const Block block;
  const File csv("b.csv", "0,0,0,0.2\n15,0,0,0.2\n30,0,0,0.4\n45,0,0,0.4\n60,0,0,0.4\n");
  InfillSettings s;
  s.infill_density_field = csv.path.string(), s.infill_pattern = InfillPattern::grid;
  const Density density = density_of(s, block);
  const Region& region = block.outline.front();
  // between two places across, as a share of what is asked for
  const auto laid = [&](bool alike) {
    double sum = 0;
    for (std::size_t i = 0; i < 4; ++i) {  // the lines of each layer lie elsewhere
      Beads beads;
      for (const Density::Part& part : density.parts(region, 5'000, i)) {
        const std::size_t from = beads.size();
        const Point origin{static_cast<Um>(30'000 + 700 * i), 20'000};
        infill::fill_sparse(part.region,
                            {.density = part.level, .band = 420, .angle_rad = degrees(45), .origin = origin}, beads);
        density.follow(part.level, 5'000, from, beads);
      }
      density.even(region, 5'000, 420, alike, 0, beads);
      sum += (halves(beads, 26'000).first - halves(beads, 18'000).first) / 4;
    }
    return sum / (40 * (8 * 0.2 + 0.2 / 15 * (11 * 11 - 3 * 3) / 2));
  };
  const double off_alike = std::abs(laid(true) - 1), off = std::abs(laid(false) - 1);
  CHECK(off_alike > 0.015);
  CHECK(off < off_alike / 2);
}

namespace {

/// How far a place is from the nearest line that does not end there.
double from_others(const Beads& beads, Point p) {
  std::vector<geometry::Segment> segments;
  for (const Bead& bead : beads)
    for (std::size_t i = 1; i < bead.path.size(); ++i)
      if (bead.path[i - 1].at != p && bead.path[i].at != p) segments.push_back({bead.path[i - 1].at, bead.path[i].at});
  const auto near = geometry::SegmentIndex(std::move(segments)).nearest(p);
  return near ? near->distance_um : 1e9;
}

}  // namespace

TEST_CASE("density: lines of a level run on through what is denser, and those between end beside lines they meet",
          "[infill]") {
  const Region region = rectangle(0, 0, 60'000, 40'000);
  const Region denser = rectangle(20'000, 0, 60'000, 40'000), densest = rectangle(37'300, 9'100, 51'100, 30'700);
  const std::vector<infill::DenseLevel> levels{{0.1, {region}}, {0.2, {denser}}, {0.4, {densest}}};
  const infill::SparseStyle style{
      .density = 0.2, .band = 420, .angle_rad = degrees(45), .overlap = {100}, .reach = 60'000};
  for (const auto pattern : {InfillPattern::grid, InfillPattern::triangles, InfillPattern::cubic}) {
    CAPTURE(static_cast<int>(pattern));
    auto own = style;
    own.pattern = pattern;
    Beads beads;
    REQUIRE(infill::fill_levels(region, own, levels, beads));
    CHECK(covered_mm2(beads) == Approx(0.1 * 2'400 + 0.1 * 1'600 + 0.2 * area_mm2(densest)).epsilon(0.02));
    std::size_t inside = 0;
    for (const Bead& bead : beads)
      for (const Point end : {bead.path.front().at, bead.path.back().at})
        if (end.x > 500 && end.x < 59'500 && end.y > 500 && end.y < 39'500) {
          ++inside;
          CHECK(from_others(beads, end) < 420);
        }
    CHECK(inside > 10);
    Beads coarse;
    own.density = 0.1, own.connect = false;
    infill::fill_sparse(region, own, coarse);
    for (const Bead& bead : coarse)  // where others end, these go on
      for (int k = 1; k < 20; ++k) {
        const Point a = bead.path.front().at, c = bead.path.back().at,
                    p{a.x + (c.x - a.x) * k / 20, a.y + (c.y - a.y) * k / 20};
        if (std::min({p.x, 60'000 - p.x, p.y, 40'000 - p.y}) > 2'000) CHECK(from_others(beads, p) < 3);
      }
  }
  for (const auto pattern : {InfillPattern::lines, InfillPattern::trihexagon, InfillPattern::gyroid}) {
    auto own = style;
    own.pattern = pattern;
    Beads beads;
    CHECK(!infill::fill_levels(region, own, levels, beads));
    CHECK(beads.empty());
  }
}

TEST_CASE("density: patterns go by it", "[infill]") {
  const Block block;
  const File csv("p.csv", "0,0,0,0.1\n60,0,0,0.4\n");
  InfillSettings s;
  s.infill_density_field = csv.path.string(), s.infill_pattern_by_density = "0:gyroid, 25:grid";
  const Density density = density_of(s, block);
  for (const Density::Part& part : density.parts(block.outline.front(), 10'000, 0)) {
    const Point middle = box_of(part.region.outer).centre();
    // 25 % lies at x = 30 mm
    CHECK(part.pattern == (middle.x < 30'000 ? InfillPattern::gyroid : InfillPattern::grid));
  }
}

TEST_CASE("density: no part is narrower than the lines in it are apart", "[infill]") {
  const Block block;
  // from 60 to 5 % within 3 mm, and from 40 to 10 over 20
  const File steep("s.csv",
                   "0,0,0,0.6\n28,0,0,0.6\n32,0,0,0.05\n36,0,0,0.05\n40,0,0,0.05\n44,0,0,0.05\n48,0,0,0.05\n"
                   "52,0,0,0.05\n56,0,0,0.05\n60,0,0,0.05\n4,0,0,0.6\n8,0,0,0.6\n12,0,0,0.6\n16,0,0,0.6\n"
                   "20,0,0,0.6\n24,0,0,0.6\n");
  InfillSettings s;
  s.infill_density_field = steep.path.string(), s.infill_density_min = 1;
  const auto parts = density_of(s, block).parts(block.outline.front(), 10'000, 50);
  REQUIRE(parts.size() == 3);  // of five levels
  double area = 0;
  for (const auto& part : parts) {
    area += area_mm2(part.region);
    const Box box = box_of(part.region.outer);
    CHECK(box.size().x >= 400 / part.level);
  }
  CHECK(area == Approx(60 * 40));
}

TEST_CASE("prepared: cubes are small where the surface is, however the pattern is turned", "[infill]") {
  const Block block(60'000);
  for (const double angle : {0.0, 45.0, 110.0}) {
    InfillSettings s;
    s.infill_pattern = InfillPattern::cubicsubdiv, s.infill_angle = angle, s.infill_sparse_density = 50;
    const Point middle{30'000, 20'000};
    const infill::Prepared prepared = infill::prepare(s, block.object(), block.areas, middle, {});
    REQUIRE(prepared.cubes);
    Beads beads;
    infill::SparseStyle style = infill::sparse_style(s, {.z = 30'000, .height = 200, .nozzle = 400, .origin = middle});
    style.prepared = &prepared;
    infill::fill_sparse(block.outline.front(), style, beads);
    double edge = 0, inner = 0;
    for (const Bead& bead : beads)
      for (std::size_t i = 1; i < bead.path.size(); ++i) {
        const Point a = bead.path[i - 1].at, b = bead.path[i].at;
        constexpr int pieces = 40;
        for (int k = 0; k < pieces; ++k) {
          const double t = (k + 0.5) / pieces, x = std::lerp(a.x, b.x, t), y = std::lerp(a.y, b.y, t);
          const bool in = std::abs(x - 30'000) < 20'000 && std::abs(y - 20'000) < 10'000;
          (in ? inner : edge) += distance(a, b) / pieces;
        }
      }
    // the inner part is a third of the area
    CHECK(edge / 1'600 > 1.1 * inner / 800);
  }
}
