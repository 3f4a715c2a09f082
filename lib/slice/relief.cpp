// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/stop.h"
#include "slice/heights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace weft::slice {
namespace {

constexpr double least_flat_mm2 = 5;
constexpr double speck_mm2 = 1;
/// Of an upright wall: what its rounded sides stand off, as a share of their height.
constexpr double of_upright = 0.184;
/// Faces are told apart by how much their normals rise, in so many classes.
constexpr std::size_t classes = 64;

/// One triangle as heights see it.
struct Facet {
  Um low, high;
  double mm2, rise;  ///< of its normal, 0 … 1
};

Facet facet_of(const Mesh& mesh, const Triangle& triangle) {
  const Point3 a = mesh.vertices[triangle[0]], b = mesh.vertices[triangle[1]], c = mesh.vertices[triangle[2]];
  const double ux = b.x - a.x, uy = b.y - a.y, uz = b.z - a.z, vx = c.x - a.x, vy = c.y - a.y, vz = c.z - a.z;
  const double nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
  const double twice = std::sqrt(nx * nx + ny * ny + nz * nz);
  const auto [low, high] = std::minmax({a.z, b.z, c.z});
  return {low, high, twice / 2e6, twice > 0 ? std::abs(nz) / twice : 0};
}

template <class F>
void for_each_facet(std::span<const Mesh* const> meshes, F f) {
  StopNowAndThen stop(4096);
  for (const Mesh* mesh : meshes)
    for (const Triangle& triangle : mesh->triangles) {
      stop.step();
      f(facet_of(*mesh, triangle));
    }
}

std::vector<Flat> flats_of(std::span<const Mesh* const> meshes) {
  std::map<Um, double> mm2;
  for_each_facet(meshes, [&](const Facet& facet) {
    if (facet.low == facet.high && facet.low > 0) mm2[facet.low] += facet.mm2;
  });
  std::vector<Flat> out;
  for (const auto& [z, area] : mm2)
    if (area > least_flat_mm2) out.push_back({z, area});
  return out;
}

/// Area by height and class.
class Areas {
 public:
  explicit Areas(Um top) : steps_(static_cast<std::size_t>(std::max(top, Um{0}) / Relief::step) + 1) {
    rows_.assign((steps_ + 1) * classes, 0);
  }
  void add(const Facet& facet) {
    const auto first = std::min(static_cast<std::size_t>(std::max(facet.low, Um{0}) / Relief::step), steps_ - 1);
    const auto last = std::min(static_cast<std::size_t>(std::max(facet.high - 1, Um{0}) / Relief::step), steps_ - 1);
    const auto kind = std::min(static_cast<std::size_t>(facet.rise * classes), classes - 1);
    const double each = facet.mm2 / static_cast<double>(last - first + 1);
    rows_[first * classes + kind] += static_cast<float>(each),
        rows_[(last + 1) * classes + kind] -= static_cast<float>(each);
  }
  /// Of each step the greatest rise of which there is more than a speck within so many steps around it.
  std::vector<double> rises(std::size_t around) {
    for (std::size_t i = classes; i < rows_.size(); ++i) rows_[i] += rows_[i - classes];
    std::vector<double> out(steps_);
    std::array<double, classes> window{};
    const auto count = [&](std::size_t step, double sign) {
      for (std::size_t k = 0; k < classes; ++k) window[k] += sign * static_cast<double>(rows_[step * classes + k]);
    };
    for (std::size_t i = 0; i < std::min(around, steps_); ++i) count(i, 1);
    for (std::size_t i = 0; i < steps_; ++i) {
      if (i + around < steps_) count(i + around, 1);
      if (i > around) count(i - around - 1, -1);
      double sum = 0;
      std::size_t k = classes;
      while (k > 0 && sum < speck_mm2) sum += window[--k];
      out[i] = sum < speck_mm2 ? 0 : static_cast<double>(k + 1) / classes;
    }
    return out;
  }

 private:
  std::size_t steps_;
  std::vector<float> rows_;
};

}  // namespace

Relief relief_of(std::span<const Mesh* const> meshes, Um top, Um error) {
  constexpr std::size_t around = 10;  // steps: about a layer
  Areas areas(top);
  for_each_facet(meshes, [&](const Facet& facet) {
    if (facet.low < facet.high && facet.high > 0) areas.add(facet);
  });
  Relief out{{}, flats_of(meshes)};
  for (const double rise : areas.rises(around)) out.most.push_back(static_cast<Um>(error / (of_upright + rise / 2)));
  return out;
}

void Surface::add(const Surface& other) {
  mm2 += other.mm2, cusp_um_mm2 += other.cusp_um_mm2;
  faces += other.faces, missed_um += other.missed_um;
}

Surface surface_of(std::span<const Mesh* const> meshes, std::span<const LayerHeight> layers) {
  Surface out;
  if (layers.empty()) return out;
  // The mean height between two heights, by the sum of h over z.
  std::vector<double> sums{0};
  for (const LayerHeight& layer : layers)
    sums.push_back(sums.back() + static_cast<double>(layer.height) * layer.height);
  const auto sum_to = [&](Um z) {
    const auto above =
        std::upper_bound(layers.begin(), layers.end(), z, [](Um at, const LayerHeight& layer) { return at < layer.z; });
    const auto i = static_cast<std::size_t>(above - layers.begin());
    if (above == layers.end()) return sums.back() + static_cast<double>(z - layers.back().z) * layers.back().height;
    return sums[i] + static_cast<double>(z - (above->z - above->height)) * above->height;
  };
  constexpr double upright = 1e-3;
  for_each_facet(meshes, [&](const Facet& facet) {
    if (facet.low == facet.high || facet.rise < upright || facet.high <= 0) return;
    const double height = (sum_to(facet.high) - sum_to(facet.low)) / (facet.high - facet.low);
    out.mm2 += facet.mm2, out.cusp_um_mm2 += facet.mm2 * height * facet.rise;
  });
  for (const Flat& flat : flats_of(meshes)) {
    const auto above = std::lower_bound(layers.begin(), layers.end(), flat.z,
                                        [](const LayerHeight& layer, Um z) { return layer.z < z; });
    Um off = above == layers.end() ? max_coord : above->z - flat.z;
    if (above != layers.begin()) off = std::min(off, flat.z - std::prev(above)->z);
    ++out.faces, out.missed_um += off;
  }
  return out;
}

}  // namespace weft::slice
