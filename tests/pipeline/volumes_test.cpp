// SPDX-License-Identifier: GPL-3.0-or-later
// Parts, negative volumes and modifiers of an object: which settings hold where.
#include "cuboid.h"
#include "pipeline/object_scopes.h"
#include "slice/slice.h"

#include <optional>
#include <random>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::literals;
using namespace weft::pipeline;

namespace {

Volume cuboid(VolumeKind kind, Box3 box, const std::string& density) {
  Volume out{.name = "v", .mesh = {}, .kind = kind};
  for (const Um z : {box.min.z, box.max.z})
    for (const Point p : {Point{box.min.x, box.min.y}, Point{box.max.x, box.min.y}, Point{box.max.x, box.max.y},
                          Point{box.min.x, box.max.y}})
      out.mesh.vertices.push_back({p.x, p.y, z});
  for (const auto& f : cuboid_faces)
    out.mesh.triangles.push_back(
        {static_cast<std::uint32_t>(f[0]), static_cast<std::uint32_t>(f[1]), static_cast<std::uint32_t>(f[2])});
  if (!density.empty()) out.overlay.add("infill_sparse_density", density, "test");
  return out;
}

/// Even microns, so that odd ones are never on an edge.
Object random_object(std::mt19937& random, bool with_said) {
  const auto number = [&](int least, int most) {
    return least + static_cast<int>(random() % static_cast<unsigned>(most - least + 1));
  };
  const auto box = [&](bool on_bed) {
    const Um x = number(0, 40) * 500, y = number(0, 40) * 500, z = on_bed ? 0 : number(0, 8) * 100;
    return Box3{{x, y, z}, {x + number(4, 40) * 500, y + number(4, 40) * 500, z + number(4, 20) * 100}};
  };
  const std::array<std::string, 4> densities{"", "10", "20", "30"};
  const auto density = [&] { return densities[random() % densities.size()]; };
  Object out{.name = "random", .volumes = {cuboid(VolumeKind::model, box(true), density())}};
  for (int i = number(0, 2); i > 0; --i) {
    if (random() % 2 == 0) out.volumes.push_back(cuboid(VolumeKind::negative, box(false), ""));
    out.volumes.push_back(cuboid(VolumeKind::model, box(true), density()));
  }
  if (random() % 2 == 0) out.volumes.push_back(cuboid(VolumeKind::negative, box(false), ""));
  for (int i = number(0, 3); i > 0; --i)
    out.volumes.push_back(cuboid(VolumeKind::modifier, box(false), densities[1 + random() % 3]));
  if (with_said)
    for (auto& volume : out.volumes)
      if (volume.kind != VolumeKind::negative && random() % 4 == 0)
        volume.said.add("wall_line_count", std::to_string(number(2, 4)), "test");
  return out;
}

bool holds(const Box3& box, Point p, Um twice_z) {
  return p.x > box.min.x && p.x < box.max.x && p.y > box.min.y && p.y < box.max.y && twice_z > 2 * box.min.z &&
         twice_z < 2 * box.max.z;
}

/// By its volumes, one after the other: the scope at a place, nothing outside.
std::optional<ScopeId> expected(const Object& object, const ScopesFrom& scopes, Point p, Um twice_z) {
  Mix mix;
  bool inside = false;
  for (std::size_t v = 0; v < object.volumes.size(); ++v) {
    const auto& volume = object.volumes[v];
    if (!holds(box_of(volume.mesh), p, twice_z)) continue;
    if (volume.kind == VolumeKind::model) mix = {v}, inside = true;
    if (volume.kind == VolumeKind::negative) inside = false;
    if (volume.kind == VolumeKind::modifier) mix.modifiers.push_back(v);
  }
  if (!inside) return std::nullopt;
  const auto mixes = mixes_of(object);
  const auto found = std::find(mixes.begin(), mixes.end(), mix);
  REQUIRE(found != mixes.end());
  return scopes.of_mix[static_cast<std::size_t>(found - mixes.begin())];
}

bool lies_in(const Region& region, Point p) {
  if (side_of(region.outer, p) != Side::inside) return false;
  return std::all_of(region.holes.begin(), region.holes.end(),
                     [&](const Ring& hole) { return side_of(hole, p) == Side::outside; });
}

std::optional<ScopeId> found(const slice::Cut& cut, const Areas& areas, Point p) {
  std::size_t region = 0;
  std::optional<ScopeId> out;
  for (const auto& area : areas)
    for (std::uint32_t i = 0; i < area.regions; ++i, ++region)
      if (lies_in(cut.layer.regions[region], p)) {
        CHECK_FALSE(out.has_value());  // areas are apart
        out = area.scope;
        int inner_ones = 0;
        for (const auto& inner : area.inner)
          for (const auto& each : inner.regions)
            if (lies_in(each, p)) out = inner.scope, ++inner_ones;
        CHECK(inner_ones <= 1);
      }
  CHECK(region == cut.layer.regions.size());
  return out;
}

}  // namespace

TEST_CASE("volumes: the last part has it, negative volumes cut those before, modifiers hold where they are") {
  std::mt19937 random(7);
  std::size_t places = 0, modified = 0, cut_away = 0;
  for (int run = 0; run < 150; ++run) {
    const auto object = random_object(random, run % 3 == 0);
    Settings plate;
    plate.layers.layer_height = 200;
    Scopes scopes(plate);
    ToolScopes tools(plate);
    const auto of_object = scopes_of(object, tools, scopes);
    Um top = 0;
    for (const auto& volume : object.volumes)
      if (volume.kind == VolumeKind::model) top = std::max(top, box_of(volume.mesh).max.z);
    std::vector<std::vector<slice::Cut>> cuts;
    const auto planes = slice::planes(plate.layers, top);
    for (const auto& volume : object.volumes) {
      const slice::Cutter cutter(volume.mesh, planes);
      cuts.emplace_back();
      for (std::size_t i = 0; i < cutter.size(); ++i) cuts.back().push_back(cutter.cut(i, plate.layers));
    }
    std::vector<const std::vector<slice::Cut>*> of_volume;
    for (const auto& each : cuts) of_volume.push_back(&each);
    std::vector<Areas> areas;
    const auto layers = united(object, of_object, of_volume, areas);
    REQUIRE(layers.size() == planes.size());
    for (std::size_t i = 0; i < layers.size(); ++i) {
      for (std::size_t a = 0; a < areas[i].size(); ++a)
        for (std::size_t b = 0; b < a; ++b) CHECK(areas[i][a].scope != areas[i][b].scope);
      const Um twice_z = 2 * planes[i].below + 1;
      for (int k = 0; k < 12; ++k, ++places) {
        const Point p{static_cast<Um>(random() % 15000) * 2 + 1, static_cast<Um>(random() % 15000) * 2 + 1};
        INFO("object " << run << ", layer " << i << ", at " << p.x << ", " << p.y);
        const auto& there = at(of_object, planes[i].z - planes[i].height);
        const auto wanted = expected(object, there, p, twice_z);
        CHECK(found(layers[i], areas[i], p) == wanted);
        cut_away += !wanted;
        modified +=
            wanted && std::find(there.of_mix.begin(), there.of_mix.begin() + 1, *wanted) == there.of_mix.begin() + 1;
      }
    }
  }
  CHECK(places > 5000);
  CHECK(modified > 100);
  CHECK(cut_away > 1000);
}

TEST_CASE("volumes: modifiers that overlap in too many ways are refused, not counted for ever") {
  Object object{.name = "knot", .volumes = {cuboid(VolumeKind::model, {{0, 0, 0}, {9000, 9000, 900}}, "")}};
  for (int i = 0; i < 20; ++i)
    object.volumes.push_back(cuboid(VolumeKind::modifier, {{0, 0, 0}, {9000, 9000, 900}}, "30"));
  CHECK_THROWS_WITH(mixes_of(object), Catch::Contains("object 'knot': its modifiers overlap in more than 4096 ways"));
}
