// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/repeated_curves.h"

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

using namespace weft::infill;

namespace {

constexpr double period = 6'000, step = period / 24;
constexpr Span2 area{{-21'000, -13'000}, {17'000, 26'000}};

template <class Function>
std::vector<Curve> traced(const LevelGrid& grid, const Function& f) {
  std::vector<double> values;
  for (std::size_t j = 0; j < grid.rows; ++j)
    for (std::size_t i = 0; i < grid.columns; ++i)
      values.push_back(f(static_cast<double>(i % 24) * step, static_cast<double>(j % 24) * step));
  return zero_curves(grid, values);
}

/// Of what lies in the area.
double length_of(const std::vector<Curve>& curves) {
  double out = 0;
  for (const Curve& curve : curves)
    for (std::size_t i = 0; i + (curve.closed ? 0 : 1) < curve.points.size(); ++i) {
      const Turned a = curve.points[i], b = curve.points[(i + 1) % curve.points.size()];
      const double x = (a.x + b.x) / 2, y = (a.y + b.y) / 2;
      if (x > area.min.x && x < area.max.x && y > area.min.y && y < area.max.y) out += std::hypot(b.x - a.x, b.y - a.y);
    }
  return out;
}

/// On nodes of whole steps from the origin, as far as the area and farther.
LevelGrid whole_grid() {
  LevelGrid out(area, step);
  out.min = {-24'000, -18'000}, out.columns = 24 * 7 + 1, out.rows = 24 * 8 + 1;
  return out;
}

}  // namespace

TEST_CASE("repeated curves: traced once and repeated, they are what is traced all over", "[infill]") {
  LevelGrid one(area, step);
  one.min = {}, one.columns = one.rows = 25;
  const double unit = period / (2 * std::numbers::pi);
  for (int k = 0; k < 60; ++k) {
    const double z = 0.1 * k + 0.013;
    // loops; loops and waves of any direction; lines that are aslant
    const auto loops = [&](double x, double y) { return std::cos(x / unit) + std::cos(y / unit) + std::cos(z); };
    const auto waves = [&](double x, double y) {
      return std::cos(2 * x / unit) * std::sin(y / unit) * std::cos(z) +
             std::cos(2 * y / unit) * std::sin(z) * std::cos(x / unit) +
             std::cos(2 * z) * std::sin(x / unit) * std::cos(y / unit);
    };
    const auto slanted = [&](double x, double y) { return std::sin((2 * x - 3 * y) / unit + z); };
    const auto same = [&](const auto& f) {
      const auto joined = join_over_borders(one, traced(one, f));
      REQUIRE(joined);
      CAPTURE(z, joined->size());
      CHECK(length_of(repeat(*joined, period, area)) == Approx(length_of(traced(whole_grid(), f))).epsilon(1e-9));
    };
    same(loops), same(waves), same(slanted);
  }
}

TEST_CASE("repeated curves: what runs through a corner of the period is left to others", "[infill]") {
  LevelGrid one(area, step);
  one.min = {}, one.columns = one.rows = 25;
  Curve through_corner;
  through_corner.points = {{0, 0}, {period, period}};
  CHECK(!join_over_borders(one, {through_corner}));
}
