// SPDX-License-Identifier: GPL-3.0-or-later
// The segment Delaunay graph that is grown by a way of our own, against the one that CGAL grows from the same sites.
#include "geometry/segment_graph.h"

#include "core/stop.h"
#include "corpus.h"
#include "geometry/boolean.h"
#include "geometry/medial_axis_outline.h"
#include "geometry/shapes.h"
#include "picture.h"

#include <array>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>

#include <catch2/catch.hpp>

using namespace weft;
using geometry::detail::GraphSite;
using geometry::detail::Outline;
using geometry::detail::SegmentGraph;

namespace {

/// CGAL as it comes: filtered predicates, exact where intervals do not decide.
using StockTraits =
    CGAL::Segment_Delaunay_graph_filtered_traits_without_intersections_2<CGAL::Simple_cartesian<double>>;
using Stock = CGAL::Segment_Delaunay_graph_2<StockTraits>;

/// A site by the numbers of its ends; equal for a point.
using SiteId = std::pair<std::uint32_t, std::uint32_t>;
/// A Voronoi vertex by its three sites, counter-clockwise, the least first.
using Triple = std::array<SiteId, 3>;

Triple canonical(Triple t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

std::vector<SegmentGraph::Point> points_of(const Outline& outline) {
  constexpr double step = 1.0 / static_cast<double>(geometry::detail::shaken_steps);
  std::vector<SegmentGraph::Point> points;
  for (const auto p : outline.points)
    points.emplace_back(static_cast<double>(p.x) * step, static_cast<double>(p.y) * step);
  return points;
}

SiteId ordered(std::uint32_t a, std::uint32_t b) {
  return {std::min(a, b), std::max(a, b)};
}

std::set<Triple> triples_of(SegmentGraph& graph) {
  std::set<Triple> out;
  for (auto f = graph.finite_faces_begin(); f != graph.finite_faces_end(); ++f) {
    Triple triple;
    for (int i = 0; i < 3; ++i) {
      const GraphSite& s = f->vertex(i)->graph_site;
      triple[static_cast<std::size_t>(i)] = ordered(s.a, s.b);
    }
    out.insert(canonical(triple));
  }
  return out;
}

std::set<Triple> stock_triples(const Outline& outline) {
  const auto points = points_of(outline);
  std::vector<Stock::Point_2> stock_points;
  std::map<std::pair<double, double>, std::uint32_t> number;
  for (const auto& p : points) {
    number[{p.x(), p.y()}] = static_cast<std::uint32_t>(stock_points.size());
    stock_points.emplace_back(p.x(), p.y());
  }
  Stock graph;
  graph.insert_segments(stock_points, outline.segments.begin(), outline.segments.end());
  const auto id = [&](const auto& p) { return number.at({p.x(), p.y()}); };
  std::set<Triple> out;
  for (auto f = graph.finite_faces_begin(); f != graph.finite_faces_end(); ++f) {
    Triple triple;
    for (int i = 0; i < 3; ++i) {
      const auto site = f->vertex(i)->site();
      triple[static_cast<std::size_t>(i)] =
          site.is_point() ? SiteId(id(site.point()), id(site.point())) : ordered(id(site.source()), id(site.target()));
    }
    out.insert(canonical(triple));
  }
  return out;
}

/// How many Voronoi vertices only one of the two has.
struct Difference {
  std::size_t vertices = 0, ours = 0, stock = 0;
};

Difference compare(const Region& region) {
  const Outline outline = geometry::detail::simple_outline(region, box_of(region.outer).min);
  if (!outline.simple || outline.points.size() < 4) return {};
  SegmentGraph graph;
  graph.build(points_of(outline), outline.segments);
  REQUIRE(graph.is_valid(false, 0));
  const std::set<Triple> ours = triples_of(graph), stock = stock_triples(outline);
  Difference d{ours.size(), 0, 0};
  for (const Triple& t : ours) d.ours += !stock.contains(t);
  for (const Triple& t : stock) d.stock += !ours.contains(t);
  return d;
}

void check_equal(const Regions& regions) {
  std::size_t compared = 0;
  for (const Region& region : regions) {
    tests::look_at({region});
    const Difference d = compare(region);
    CAPTURE(region.outer.size(), region.holes.size());
    compared += d.vertices;
    CHECK(d.ours == 0);
    CHECK(d.stock == 0);
  }
  CHECK(compared > 0);
}

/// The rings of a WKT polygon, µm.
std::vector<Ring> rings_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  std::vector<Ring> rings;
  for (std::size_t at = 0; (at = text.find_first_of("0123456789-", at)) != std::string::npos;) {
    const std::size_t end = text.find(')', at);
    std::istringstream numbers(text.substr(at, end - at));
    Ring ring;
    Um x = 0, y = 0;
    for (char comma = ','; numbers >> x >> y; numbers >> comma) ring.push_back({x, y});
    rings.push_back(std::move(ring));
    at = end == std::string::npos ? text.size() : end;
  }
  return rings;
}

}  // namespace

TEST_CASE("segment graph: stars, convex rings and what they cut out of each other have CGAL's own Voronoi vertices",
          "[geometry][segment_graph]") {
  for (std::uint32_t seed = 1; seed <= 8; ++seed) {
    shapes::Dice dice(seed);
    for (int i = 0; i < 25; ++i) {
      const Um size = dice.between(300, 30'000);
      const std::vector<Ring> rings{shapes::star(dice, {0, 0}, size, dice.between(3, 60)),
                                    shapes::convex(dice, {size / 3, 0}, size / 2, dice.between(3, 40)),
                                    shapes::star(dice, {0, size / 4}, size / 3, dice.between(3, 30))};
      CAPTURE(seed, i);
      check_equal(geometry::regions_from_rings(rings, geometry::WindingRule::even_odd));
    }
  }
}

TEST_CASE("segment graph: grids, circles and other shapes with many sites on one circle have CGAL's Voronoi vertices",
          "[geometry][segment_graph]") {
  std::vector<Ring> holes{test::rectangle(0, 0, 50'000, 50'000).outer};
  for (int i = 0; i < 8; ++i)
    for (int k = 0; k < 8; ++k) {
      Ring hole;
      for (int c = 0; c < 8; ++c)
        hole.push_back({rounded(6000.0 * i + 4000 + 1500 * std::cos(c * std::numbers::pi / 4)),
                        rounded(6000.0 * k + 4000 + 1500 * std::sin(c * std::numbers::pi / 4))});
      holes.push_back(std::move(hole));
    }
  check_equal(geometry::regions_from_rings(holes, geometry::WindingRule::even_odd));
}

TEST_CASE("segment graph: polygons that broke other slicers have CGAL's own Voronoi vertices",
          "[geometry][segment_graph]") {
  const auto folder = corpus("shapes");
  if (!folder) return;
  for (const auto& entry : std::filesystem::directory_iterator(*folder)) {
    if (entry.path().extension() != ".wkt") continue;
    CAPTURE(entry.path().filename().string());
    check_equal(geometry::regions_from_rings(rings_of(entry.path()), geometry::WindingRule::even_odd));
  }
}
