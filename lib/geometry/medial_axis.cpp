// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/medial_axis.h"

#include "core/stop.h"
#include "geometry/medial_axis_outline.h"
#include "geometry/segment_graph.h"

#include <array>
#include <cmath>
#include <limits>

namespace weft::geometry {
namespace {

using Site = MedialAxis::Site;

double length_of(double x, double y) {  // std::hypot guards against overflow that microns cannot reach
  return std::sqrt(x * x + y * y);
}

bool same(Place p, Place q) {
  return p.x == q.x && p.y == q.y;
}

/// True for an edge and one of its own ends: what separates them is a perpendicular, no part of the medial axis.
bool edge_and_its_end(const Site& s, const Site& t) {
  if (s.corner == t.corner) return false;
  const Site &edge = s.corner ? t : s, &end = s.corner ? s : t;
  return same(edge.a, end.a) || same(edge.b, end.a);
}

enum class Where : std::uint8_t { unknown, inside, outside, outline };

/// One Voronoi vertex.
struct Vortex {
  Place at;
  double clearance = 0;
  Where where = Where::unknown;
  std::array<std::uint32_t, 3> site{};       ///< counter-clockwise; `none` at infinity
  std::array<std::uint32_t, 3> neighbour{};  ///< across the edge between site[i + 1] and site[i + 2]
  std::array<std::uint8_t, 3> index_in_neighbour{};
  std::array<std::uint32_t, 3> half_edge{};  ///< leaving across that edge, or `none`
};
constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

/// What distances to a site are reckoned with, once for all vertices around it.
struct Edge {
  double ux = 0, uy = 0, length = 0;  ///< of an edge; a corner has none
  double nx = 0, ny = 0;              ///< its normal, to the left, of length 1

  explicit Edge(const Site& s) {
    if (s.corner) return;
    ux = s.b.x - s.a.x, uy = s.b.y - s.a.y, length = length_of(ux, uy);
    nx = -uy / length, ny = ux / length;
  }
};

struct Diagram {
  std::vector<Site> sites;
  std::vector<Edge> edges;  ///< of the sites
  std::vector<Vortex> vertices;

  /// To the line of the site's edge, times its length: left of it positive. Pre: it is an edge.
  double aside(std::uint32_t site, Place p) const {
    const Place a = sites[site].a;
    const Edge& e = edges[site];
    return e.ux * (p.y - a.y) - e.uy * (p.x - a.x);
  }
  /// Distance from p to the line of a site's edge, or to its corner: inside a cell of the diagram the nearest point of
  /// the edge is never one of its ends.
  double distance_to(std::uint32_t site, Place p) const {
    return sites[site].corner ? distance(sites[site].a, p) : std::abs(aside(site, p)) / edges[site].length;
  }
};

/// Distances that differ by less are equal, µm: what is left of the outline's shaking after the first step of
/// refinement.
constexpr double exact_um = 1e-4;

/// Gauss-Newton on the three distances, from where CGAL's construction left the vertex of the shaken outline.
void refine(const Diagram& diagram, Vortex& v) {
  for (int round = 0; round < 8; ++round) {
    // Unknowns x, y, r: distance(site, p) = r; signs of edge distances are those at the start.
    double m[3][4];
    double worst = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Site& s = diagram.sites[v.site[i]];
      double gx, gy, distance_um;
      if (s.corner) {
        distance_um = distance(s.a, v.at);
        const double d = std::max(1e-9, distance_um);
        gx = (v.at.x - s.a.x) / d, gy = (v.at.y - s.a.y) / d;
      } else {
        const Edge& e = diagram.edges[v.site[i]];
        const double aside = diagram.aside(v.site[i], v.at), side = aside < 0 ? -1 : 1;
        gx = e.nx * side, gy = e.ny * side;
        distance_um = std::abs(aside) / e.length;
      }
      const double error = v.clearance - distance_um;
      worst = std::max(worst, std::abs(error));
      m[i][0] = gx, m[i][1] = gy, m[i][2] = -1, m[i][3] = error;
    }
    if (worst < exact_um) return;
    auto det = [&](int a, int b, int c) {
      return m[0][a] * (m[1][b] * m[2][c] - m[1][c] * m[2][b]) - m[0][b] * (m[1][a] * m[2][c] - m[1][c] * m[2][a]) +
             m[0][c] * (m[1][a] * m[2][b] - m[1][b] * m[2][a]);
    };
    const double d = det(0, 1, 2);
    if (std::abs(d) < 1e-9) return;
    const double dx = det(3, 1, 2) / d, dy = det(0, 3, 2) / d, dr = det(0, 1, 3) / d;
    if (length_of(dx, dy) > 1000) return;
    v.at.x += dx, v.at.y += dy, v.clearance += dr;
  }
}

void locate(Diagram& diagram, Vortex& v) {
  const Site* edge = nullptr;
  for (std::size_t i = 0; i < 3; ++i) {
    const Site &s = diagram.sites[v.site[i]], &t = diagram.sites[v.site[(i + 1) % 3]],
               &u = diagram.sites[v.site[(i + 2) % 3]];
    if (s.corner && edge_and_its_end(t, s) && edge_and_its_end(u, s)) {  // both edges and their common end
      v.at = s.a;
      v.clearance = 0;
      v.where = Where::outline;
      return;
    }
    if (!s.corner) edge = &s;
  }
  v.clearance = (diagram.distance_to(v.site[0], v.at) + diagram.distance_to(v.site[1], v.at) +
                 diagram.distance_to(v.site[2], v.at)) /
                3;
  refine(diagram, v);
  if (edge == nullptr) return;
  const double side = (edge->b.x - edge->a.x) * (v.at.y - edge->a.y) - (edge->b.y - edge->a.y) * (v.at.x - edge->a.x);
  v.where = side > 0 ? Where::inside : Where::outside;
}

/// Vertices between corners only: what their neighbours across the medial axis are.
void spread_sides(Diagram& diagram) {
  std::vector<std::uint32_t> open;
  auto passable = [&](const Vortex& v, std::size_t i) {
    const std::uint32_t s = v.site[(i + 1) % 3], t = v.site[(i + 2) % 3];
    return s != none && t != none && v.neighbour[i] != none && !edge_and_its_end(diagram.sites[s], diagram.sites[t]);
  };
  for (std::uint32_t k = 0; k < diagram.vertices.size(); ++k)
    if (diagram.vertices[k].where == Where::inside || diagram.vertices[k].where == Where::outside) open.push_back(k);
  while (!open.empty()) {
    const Vortex v = diagram.vertices[open.back()];
    open.pop_back();
    for (std::size_t i = 0; i < 3; ++i) {
      if (!passable(v, i)) continue;
      Vortex& other = diagram.vertices[v.neighbour[i]];
      if (other.where != Where::unknown) continue;
      other.where = v.where;
      open.push_back(v.neighbour[i]);
    }
  }
}

/// Where the point was before it was shaken.
Place unshaken(double x, double y) {
  constexpr double steps = static_cast<double>(detail::grid_steps);
  return {std::round(x * steps) / steps, std::round(y * steps) / steps};
}

Diagram diagram_of(const detail::Outline& outline) {
  constexpr double step = 1.0 / static_cast<double>(detail::shaken_steps);
  std::vector<detail::SegmentGraph::Point> points;
  points.reserve(outline.points.size());
  for (const auto p : outline.points)
    points.emplace_back(static_cast<double>(p.x) * step, static_cast<double>(p.y) * step);
  detail::SegmentGraph graph;
  graph.build(points, outline.segments);

  Diagram out;
  if (graph.dimension() < 2) return out;
  graph.infinite_vertex()->number = none;
  for (auto v = graph.finite_vertices_begin(); v != graph.finite_vertices_end(); ++v) {
    v->number = static_cast<std::uint32_t>(out.sites.size());
    const auto site = v->site();
    const auto a = site.is_point() ? site.point() : site.source(), b = site.is_point() ? a : site.target();
    out.sites.push_back({unshaken(a.x(), a.y()), unshaken(b.x(), b.y()), site.is_point()});
    out.edges.emplace_back(out.sites.back());
  }
  std::uint32_t count = 0;
  for (auto f = graph.all_faces_begin(); f != graph.all_faces_end(); ++f) f->number = count++;
  out.vertices.resize(count);
  StopNowAndThen stop(64);
  for (auto f = graph.all_faces_begin(); f != graph.all_faces_end(); ++f) {
    stop.step();
    Vortex& v = out.vertices[f->number];
    v.half_edge.fill(none);
    for (int i = 0; i < 3; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const auto neighbour = f->neighbor(i);
      v.site[k] = f->vertex(i)->number;
      v.neighbour[k] = neighbour->number;
      v.index_in_neighbour[k] = static_cast<std::uint8_t>(graph.tds().mirror_index(f, i));
    }
    if (graph.is_infinite(f)) {
      v.where = Where::outside;
      continue;
    }
    const auto centre = graph.centre(f);
    v.at = {centre.x(), centre.y()};
    locate(out, v);
  }
  spread_sides(out);
  return out;
}

/// Numbers the half-edges inside the region, twins together.
void number_half_edges(Diagram& diagram, MedialAxis& axis) {
  for (std::uint32_t k = 0; k < diagram.vertices.size(); ++k) {
    Vortex& v = diagram.vertices[k];
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t n = v.neighbour[i], right = v.site[(i + 1) % 3], left = v.site[(i + 2) % 3];
      if (v.half_edge[i] != none || right == none || left == none) continue;
      Vortex& w = diagram.vertices[n];
      if (v.where != Where::inside && w.where != Where::inside) continue;
      if (v.where == Where::outside || w.where == Where::outside) continue;
      if (edge_and_its_end(diagram.sites[right], diagram.sites[left])) continue;
      const auto h = static_cast<std::uint32_t>(axis.half_edges.size());
      v.half_edge[i] = h;
      w.half_edge[v.index_in_neighbour[i]] = h + 1;
      axis.half_edges.push_back({k, none, right});
      axis.half_edges.push_back({n, none, left});
    }
  }
}

/// The half-edge after the one that arrives at v across edge i: the next one leaving counter-clockwise.
void link(const Diagram& diagram, MedialAxis& axis) {
  for (const Vortex& v : diagram.vertices)
    for (std::size_t i = 0; i < 3; ++i) {
      if (v.half_edge[i] == none) continue;
      std::size_t j = (i + 1) % 3;
      while (v.half_edge[j] == none) j = (j + 1) % 3;
      axis.half_edges[MedialAxis::twin(v.half_edge[i])].next = v.half_edge[j];
    }
}

/// Drops the vertices no half-edge leaves from.
void number_nodes(const Diagram& diagram, MedialAxis& axis) {
  std::vector<std::uint32_t> number(diagram.vertices.size(), none);
  for (auto& half_edge : axis.half_edges) {
    std::uint32_t& n = number[half_edge.from];
    if (n == none) {
      n = static_cast<std::uint32_t>(axis.nodes.size());
      const Vortex& v = diagram.vertices[half_edge.from];
      axis.nodes.push_back({v.at, v.clearance});
    }
    half_edge.from = n;
  }
}

}  // namespace

MedialAxis medial_axis(const Region& region) {
  MedialAxis axis;
  const Box box = box_of(region.outer);
  if (box.empty()) return axis;
  axis.origin = box.min;
  const detail::Outline outline = detail::simple_outline(region, axis.origin);
  if (!outline.simple) return axis;
  Diagram diagram = diagram_of(outline);
  number_half_edges(diagram, axis);
  link(diagram, axis);
  number_nodes(diagram, axis);
  axis.sites = std::move(diagram.sites);
  axis.valid = !axis.half_edges.empty();
  return axis;
}

}  // namespace weft::geometry
