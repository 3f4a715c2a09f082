// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/delaunay.h"

#include <cmath>
#include <random>

#include <catch2/catch.hpp>

using namespace weft;

namespace {

/// Twice the signed area, µm².
double doubled(Point a, Point b, Point c) {
  return double(b.x - a.x) * (c.y - a.y) - double(b.y - a.y) * (c.x - a.x);
}

/// Whether p lies inside of the circle through the corners of a triangle, which runs counter-clockwise.
bool in_circle(Point a, Point b, Point c, Point p) {
  const auto lifted = [&](Point q) { return double(q.x - p.x) * (q.x - p.x) + double(q.y - p.y) * (q.y - p.y); };
  const Point o = p;
  return lifted(a) * doubled(o, b, c) - lifted(b) * doubled(o, a, c) + lifted(c) * doubled(o, a, b) > 1;
}

}  // namespace

TEST_CASE("delaunay: triangles fill the hull, run counter-clockwise, and their circles are empty") {
  std::mt19937 random(4);  // any
  std::vector<Point> points;
  for (int i = 0; i < 60; ++i) points.push_back({static_cast<Um>(random() % 20000), static_cast<Um>(random() % 20000)});
  for (const Point corner : {Point{-1000, -1000}, Point{21000, -1000}, Point{21000, 21000}, Point{-1000, 21000}})
    points.push_back(corner);
  points.push_back(points.front());  // the same place again
  const auto triangles = geometry::delaunay(points);
  double area = 0;
  for (const auto& [i, j, k] : triangles) {
    CHECK(i < points.size() - 1);
    CHECK(doubled(points[i], points[j], points[k]) > 0);
    area += doubled(points[i], points[j], points[k]) / 2;
    for (const Point p : points) CHECK_FALSE(in_circle(points[i], points[j], points[k], p));
  }
  CHECK(area == 22000.0 * 22000.0);
  for (Point& p : points) p = p + Point{1237, -4711};
  CHECK(geometry::delaunay(points) == triangles);
}

TEST_CASE("delaunay: points in a line, or too few, have no triangles") {
  CHECK(geometry::delaunay({}).empty());
  CHECK(geometry::delaunay(std::vector<Point>{{0, 0}, {10, 0}}).empty());
  CHECK(geometry::delaunay(std::vector<Point>{{0, 0}, {10, 10}, {20, 20}, {5, 5}}).empty());
}
