// SPDX-License-Identifier: GPL-3.0-or-later
#include "preview/model_pack.h"

#include "core/stop.h"
#include "preview/pack.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

namespace weft::preview {
namespace {

struct Coarse {
  std::vector<Point3> corners;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Corners within a cube of that side become the first of them.
Coarse coarse(std::span<const Standing> meshes, Um cube) {
  Coarse out;
  std::unordered_map<std::uint64_t, std::uint32_t> first;
  const auto cell = [cube](Um v) {
    return static_cast<std::uint64_t>((std::int64_t{v} + max_coord) / cube) & 0x1FFFFF;
  };
  StopNowAndThen stop(4096);
  std::vector<std::uint32_t> index;
  for (const auto& [mesh, at] : meshes) {
    index.clear();
    for (const Point3 p : mesh->vertices) {
      stop.step();
      const Point3 q{p.x + at.x, p.y + at.y, p.z};
      const auto [place, is_new] = first.try_emplace(cell(q.x) << 42 | cell(q.y) << 21 | cell(q.z),
                                                     static_cast<std::uint32_t>(out.corners.size()));
      if (is_new) out.corners.push_back(q);
      index.push_back(place->second);
    }
    for (const Triangle& t : mesh->triangles) {
      const std::array<std::uint32_t, 3> corners{index[t[0]], index[t[1]], index[t[2]]};
      if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0])
        out.triangles.push_back(corners);
    }
  }
  return out;
}

}  // namespace

std::string packed_model(std::span<const Standing> meshes, std::size_t most) {
  constexpr Um finest = 100;  // µm: below, no eye tells them apart through the beads
  Coarse model;
  for (Um cube = finest;; cube *= 2) {
    model = coarse(meshes, cube);
    if (model.triangles.size() <= most || cube > max_coord / 4) break;
  }
  if (model.triangles.empty()) return {};
  Numbers out;
  out.add(model.corners.size()), out.add(model.triangles.size());
  std::array<std::int64_t, 3> at{};
  for (const Point3 p : model.corners) {
    const std::array<Um, 3> to{p.x, p.y, p.z};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int64_t grains = std::lround(static_cast<double>(to[i]) / page_grain);
      out.step(grains - at[i]);
      at[i] = grains;
    }
  }
  std::int64_t last = 0;
  for (const auto& triangle : model.triangles)
    for (const std::uint32_t corner : triangle) {
      out.step(corner - last);
      last = corner;
    }
  return deflated(out.bytes());
}

}  // namespace weft::preview
