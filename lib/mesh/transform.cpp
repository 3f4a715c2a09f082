// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/transform.h"

#include "core/error.h"
#include "mesh/mapped.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft::mesh {
namespace {

using Vector = std::array<double, 3>;

Vector applied(const Linear& m, const Vector& v) {
  Vector out{};
  for (std::size_t i = 0; i < 3; ++i) out[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
  return out;
}

double determinant(const Linear& m) {
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/// Millimetres from `about` to p.
Vector mm_from(Point3 about, Point3 p) {
  return {(double(p.x) - about.x) / 1000, (double(p.y) - about.y) / 1000, (double(p.z) - about.z) / 1000};
}

}  // namespace

Linear product(const Linear& a, const Linear& b) {
  Linear out{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) out[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j];
  return out;
}

Linear turned_about(int axis, double degrees) {
  const double quarters = degrees / 90, whole = std::round(quarters);
  double c = std::cos(degrees * std::numbers::pi / 180), s = std::sin(degrees * std::numbers::pi / 180);
  if (quarters == whole) {
    constexpr std::array<int, 4> sines{0, 1, 0, -1};
    const auto quarter = static_cast<std::size_t>(std::fmod(std::fmod(whole, 4) + 4, 4));
    s = sines[quarter], c = sines[(quarter + 1) % 4];
  }
  const auto a = static_cast<std::size_t>((axis + 1) % 3), b = static_cast<std::size_t>((axis + 2) % 3);
  Linear out = identity;
  out[a][a] = c, out[a][b] = -s, out[b][a] = s, out[b][b] = c;
  return out;
}

Linear stretched_along(const std::array<double, 3>& factors) {
  Linear out = identity;
  for (std::size_t i = 0; i < 3; ++i) out[i][i] = factors[i];
  return out;
}

Linear laid_on(const std::array<double, 3>& direction) {
  const double length = std::hypot(direction[0], direction[1], direction[2]);
  const Vector d{direction[0] / length, direction[1] / length, direction[2] / length};
  if (d[2] == -1) return identity;
  if (d[2] > 1 - 1e-12) return turned_about(0, 180);
  // About the axis d × down, which is level: Rodrigues' formula with cosine −d.z.
  const double sine = std::hypot(d[0], d[1]), cosine = -d[2];
  const Vector axis{-d[1] / sine, d[0] / sine, 0};
  const double left = 1 - cosine;
  Linear out{{{cosine + axis[0] * axis[0] * left, axis[0] * axis[1] * left, axis[1] * sine},
              {axis[0] * axis[1] * left, cosine + axis[1] * axis[1] * left, -axis[0] * sine},
              {-axis[1] * sine, axis[0] * sine, cosine}}};
  for (auto& row : out)  // a quarter turn is exact
    for (double& v : row)
      if (std::abs(v - std::round(v)) < 1e-12) v = std::round(v);
  return out;
}

std::array<std::array<double, 3>, 2> box_under(const Mesh& mesh, const Linear& map, Point3 about) {
  constexpr double far = 1e12;
  std::array<Vector, 2> out{Vector{far, far, far}, Vector{-far, -far, -far}};
  for (const Point3 p : mesh.vertices) {
    const Vector at = applied(map, mm_from(about, p));
    for (std::size_t i = 0; i < 3; ++i) out[0][i] = std::min(out[0][i], at[i]), out[1][i] = std::max(out[1][i], at[i]);
  }
  return out;
}

Mesh transformed(Mesh mesh, const Linear& map, Point3 about) {
  if (map == identity) return mesh;
  mesh = mapped(std::move(mesh), [&](Point3 p) {
    const Vector mm = applied(map, mm_from(about, p));
    if (!placeable(mm[0]) || !placeable(mm[1]) || !placeable(mm[2]))
      throw Error(Error::Kind::model, "scaled and turned it reaches beyond ±16 m", {}, "check --scale and --unit");
    return Point3{lattice(mm[0]) + about.x, lattice(mm[1]) + about.y, lattice(mm[2]) + about.z};
  });
  if (determinant(map) < 0)
    for (Triangle& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  return mesh;
}

}  // namespace weft::mesh
