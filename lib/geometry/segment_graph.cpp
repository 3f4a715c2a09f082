// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/segment_graph.h"

#include "core/stop.h"
#include "geometry/circle_centre.h"

#include <limits>

namespace weft::geometry::detail {
namespace {

/// Rounding of a distance between places of a unit square, generously: a few operations of 2⁻⁵³ each.
constexpr double rounding = 1e-14;

double length_of(double x, double y) {
  return std::sqrt(x * x + y * y);
}

/// Twice the area of abc where its sign is certain, else 0.
double certain_turn(double ax, double ay, double bx, double by, double cx, double cy) {
  const double l = (bx - ax) * (cy - ay), r = (by - ay) * (cx - ax), turn = l - r;
  return std::abs(turn) > 1e-15 * (std::abs(l) + std::abs(r)) ? turn : 0.0;
}

/// Distance from a site, and its gradient.
struct Slope {
  double distance = 0, x = 0, y = 0;
};

/// False where there is no gradient, or the foot is not within the edge.
bool slope_at(const GraphSite& s, double px, double py, Slope& out) {
  double x = px - s.ax, y = py - s.ay;
  if (s.edge) {
    const double ux = s.bx - s.ax, uy = s.by - s.ay, along = x * ux + y * uy, length2 = ux * ux + uy * uy;
    if (!(along >= 0 && along <= length2)) return false;
    const double across = (ux * y - uy * x) / length2;
    x = -uy * across, y = ux * across;
  }
  out.distance = length_of(x, y);
  if (!(out.distance > 0)) return false;
  out.x = x / out.distance, out.y = y / out.distance;
  return true;
}

/// Whether the site is, or ends in, a point that is one of the face's sites.
template <class Face>
bool ends_in_a_point_of(const Face& f, const GraphSite& t) {
  for (int i = 0; i < 3; ++i)
    if (const GraphSite& s = f->vertex(i)->graph_site; !s.edge && t.ends_in(s.a)) return true;
  return false;
}

CGAL::Sign sign_of_turn(double turn) {
  return turn > 0 ? CGAL::POSITIVE : turn < 0 ? CGAL::NEGATIVE : CGAL::ZERO;
}

}  // namespace

void SegmentGraph::build(const std::vector<Point>& points,
                         const std::vector<std::pair<std::uint32_t, std::uint32_t>>& segments) {
  if (points.size() < 4) {
    insert_segments(points, segments.begin(), segments.end());
    return;
  }
  knows_sites_ = true;
  std::vector<Point_handle> handles;
  handles.reserve(points.size());
  double least_x = points[0].x(), most_x = least_x, least_y = points[0].y(), most_y = least_y;
  for (const Point& p : points) {
    handles.push_back(pc_.insert(pc_.end(), p));  // they come sorted, more or less
    least_x = std::min(least_x, p.x()), most_x = std::max(most_x, p.x());
    least_y = std::min(least_y, p.y()), most_y = std::max(most_y, p.y());
  }
  scale_ = std::max({std::abs(least_x), std::abs(most_x), std::abs(least_y), std::abs(most_y), 1.0});

  std::vector<std::size_t> order(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  using SortTraits = CGAL::Spatial_sort_traits_adapter_2<GraphTraits, CGAL::Pointer_property_map<Point>::const_type>;
  CGAL::spatial_sort(order.begin(), order.end(), SortTraits(CGAL::make_property_map(points)));

  std::vector<Vertex> vertices(points.size());
  Vertex near;
  StopNowAndThen stop(8);
  for (const std::size_t i : order) {
    stop.step();
    const auto number = static_cast<std::uint32_t>(i);
    const Point& p = points[i];
    const Query query{{p.x(), p.y(), p.x(), p.y(), number, number, false},
                      st_.construct_storage_site_2_object()(handles[i]),
                      Site_2::construct_site_2(p)};
    near = number_of_vertices() < 3 ? insert_no_register(query.stored, p, near) : add_point(query, near);
    near->graph_site = query.site;
    vertices[i] = near;
  }
  for (const auto& [a, b] : segments) {
    stop.step();
    const Point &p = points[a], &q = points[b];
    const Storage_site_2 stored = st_.construct_storage_site_2_object()(handles[a], handles[b]);
    const Query query{{p.x(), p.y(), q.x(), q.y(), a, b, true}, stored, stored.site()};
    add_edge(query, vertices[a])->graph_site = query.site;
  }
}

SegmentGraph::Vertex SegmentGraph::add_point(const Query& query, Vertex near) {
  const Vertex v = nearest(query, near);
  const Face start = entered_around(query, v);
  if (start == Face()) return insert_point2(query.stored, query.exact, v);  // it enters the inside of an edge alone
  return replace_entered(start, query);
}

SegmentGraph::Vertex SegmentGraph::add_edge(const Query& query, Vertex end) {
  return replace_entered(entered_around(query, end), query);
}

/// The point nearest to a point; there are no edges yet.
SegmentGraph::Vertex SegmentGraph::nearest(const Query& query, Vertex from) {
  const auto farther = [&](const GraphSite& s, const GraphSite& t) {  // s than t; 0 where that is not certain
    const double sx = s.ax - query.site.ax, sy = s.ay - query.site.ay, tx = t.ax - query.site.ax,
                 ty = t.ay - query.site.ay;
    const double s2 = sx * sx + sy * sy, t2 = tx * tx + ty * ty;
    return std::abs(s2 - t2) > rounding * (s2 + t2) ? s2 - t2 : 0.0;
  };
  for (Vertex v = from;;) {
    const Vertex here = v;
    auto circulator = incident_vertices(here);
    const auto begin = circulator;
    do {
      const Vertex other(circulator);
      if (is_infinite(other)) continue;
      const double difference = farther(here->graph_site, other->graph_site);
      if (difference > 0 ||
          (difference == 0 && side_of_bisector(here->site(), other->site(), query.exact) == CGAL::ON_NEGATIVE_SIDE)) {
        v = other;
        break;
      }
    } while (++circulator != begin);
    if (v == here) return v;
  }
}

SegmentGraph::Face SegmentGraph::entered_around(const Query& query, Vertex v) {
  auto circulator = incident_faces(v);
  const auto begin = circulator;
  do {
    if (enters(Face(circulator), query)) return Face(circulator);
  } while (++circulator != begin);
  return Face();
}

/// Finds all faces that the site enters, from one of them on, and puts it in their place.
SegmentGraph::Vertex SegmentGraph::replace_entered(Face start, const Query& query) {
  const Edge edges[3] = {sym_edge(start, 0), sym_edge(start, 1), sym_edge(start, 2)};
  link(edges[0], edges[1]), link(edges[1], edges[2]), link(edges[2], edges[0]);
  front_ = edges[0];
  open_.assign(1, start);
  StopNowAndThen stop(32);  // a long edge may enter most of the graph
  while (!open_.empty()) {
    stop.step();
    const Face f = open_.back();
    open_.pop_back();
    if (f->tds_data().is_in_conflict()) continue;
    f->tds_data().mark_in_conflict();
    entered_.push_back(f);
    for (int i = 0; i < 3; ++i) {
      const Face n = f->neighbor(i);
      if (n->tds_data().is_in_conflict() || !enters(n, query) || !enters_edge_between(f, i, query)) continue;
      const Edge e = sym_edge(f, i);
      const int j = structure().mirror_index(f, i);
      const Edge first = sym_edge(n, ccw(j)), second = sym_edge(n, cw(j));
      if (!in_boundary(first)) {
        const Edge b = before(e);
        link(b, first), link(first, e);
      }
      if (!in_boundary(second)) {
        const Edge a = after(e);
        link(e, second), link(second, a);
      }
      const Edge b = before(e), a = after(e);
      if (e == front_) front_ = a;
      unlink(e);
      link(b, a);
      open_.push_back(n);
    }
  }
  return fill_hole(query);
}

SegmentGraph::Vertex SegmentGraph::fill_hole(const Query& query) {
  const Vertex v = create_vertex(query.stored);
  // An edge whose both sides are on the boundary is split by a vertex for the time of the filling.
  twice_.clear();
  Edge e = front_;
  do {
    const Edge other = sym_edge(e);
    if (in_boundary(other) && std::find(twice_.begin(), twice_.end(), other) == twice_.end()) twice_.push_back(e);
    e = after(e);
  } while (e != front_);
  std::vector<Vertex> auxiliary;
  for (const Edge& one : twice_) {
    const Edge other = sym_edge(one);
    const Face g = one.first;
    auxiliary.push_back(insert_degree_2(one));
    auto circulator = incident_faces(auxiliary.back());
    const Face f1(circulator), f2(++circulator);
    const int i1 = f1->index(auxiliary.back()), i2 = f2->index(auxiliary.back());
    const bool first = f1->neighbor(i1) == g;
    const Edge for_one = first ? Edge(f2, i2) : Edge(f1, i1), for_other = first ? Edge(f1, i1) : Edge(f2, i2);
    for (const auto& [old, now] : {std::pair(one, for_one), std::pair(other, for_other)}) {
      const Edge b = before(old), a = after(old);
      if (old == front_) front_ = now;
      unlink(old);
      link(b == old ? now : b, now), link(now, a == old ? now : a);
    }
  }
  hole_.clear();
  e = front_;
  do {
    e.first->vertex(ccw(e.second))->set_face(e.first);
    e.first->vertex(cw(e.second))->set_face(e.first);
    hole_.push_back(e);
    e = after(e);
  } while (e != front_);
  for (const Edge& edge : hole_) unlink(edge);
  structure().star_hole(v, hole_.begin(), hole_.end());
  for (const Vertex& a : auxiliary) remove_degree_2(a);
  for (const Face& f : entered_) {
    f->tds_data().clear();
    structure().delete_face(f);
  }
  entered_.clear();
  return v;
}

SegmentGraph::Point SegmentGraph::centre(Face f) {
  if (knows_sites_) measure(f);
  const bool known = f->circle == Circle::bounded || f->circle == Circle::point;
  return known ? Point(f->x, f->y) : circumcenter(f);
}

/// By closed forms where what they give is proven, and of three points; else as CGAL constructs it, from intervals that
/// may be wide.
void SegmentGraph::measure(Face f) {
  if (f->circle != Circle::unknown) return;
  const GraphSite &a = f->vertex(0)->graph_site, &b = f->vertex(1)->graph_site, &c = f->vertex(2)->graph_site;
  if (const auto centre = circle_centre(a, b, c)) {
    f->x = centre->x, f->y = centre->y;
    f->circle = bound_circle(f);
    if (f->circle != Circle::doubtful || !(a.edge || b.edge || c.edge)) return;
  }
  const auto at = circumcenter(f);
  f->x = at.x(), f->y = at.y();
  f->circle = bound_circle(f);
}

SegmentGraph::Circle SegmentGraph::bound_circle(Face f) const {
  int ends = 0, end = 0, edge = 0;  // points that are ends of an edge of the same face
  for (int i = 0; i < 3; ++i) {
    const GraphSite& s = f->vertex(i)->graph_site;
    if (s.edge) continue;
    int edges = 0;
    for (const int k : {(i + 1) % 3, (i + 2) % 3})
      if (const GraphSite& t = f->vertex(k)->graph_site; t.edge && t.ends_in(s.a)) ++edges, end = i, edge = k;
    if (edges == 2) return Circle::point;
    ends += edges;
  }
  return (ends == 0 ? bound_by_sites(f) : ends == 1 && bound_on_perpendicular(f, end, edge)) ? Circle::bounded
                                                                                             : Circle::doubtful;
}

/// Newton-Kantorovich: where distances to three sites nearly agree and their gradients are far from one line, the place
/// where they agree is near. Gradients in counter-clockwise order, and feet within the edges, tell it from the other
/// places. Source: Ortega & Rheinboldt 1970, "Iterative solution of nonlinear equations in several variables", 12.6.
bool SegmentGraph::bound_by_sites(Face f) const {
  Slope s[3];
  for (int i = 0; i < 3; ++i)
    if (!slope_at(f->vertex(i)->graph_site, f->x, f->y, s[i])) return false;
  const double turn = (s[1].x - s[0].x) * (s[2].y - s[0].y) - (s[1].y - s[0].y) * (s[2].x - s[0].x);
  const double least = std::min({s[0].distance, s[1].distance, s[2].distance});
  const double most = std::max({s[0].distance, s[1].distance, s[2].distance});
  return bound(f, least, most, most - least, turn);
}

/// An edge and its own end have one foot: the circle's centre lies on the perpendicular there, and as far from the
/// third site.
bool SegmentGraph::bound_on_perpendicular(Face f, int end, int edge) const {
  const GraphSite &p = f->vertex(end)->graph_site, &e = f->vertex(edge)->graph_site;
  Slope at_end, at_third;
  if (!slope_at(p, f->x, f->y, at_end) || !slope_at(f->vertex(3 - end - edge)->graph_site, f->x, f->y, at_third))
    return false;
  const double sense = e.a == p.a ? 1.0 : -1.0, length = length_of(e.bx - e.ax, e.by - e.ay);
  const double ux = sense * (e.bx - e.ax) / length, uy = sense * (e.by - e.ay) / length;  // into the edge
  const double slip = std::abs((f->x - p.ax) * ux + (f->y - p.ay) * uy);
  const double twist = ux * (at_end.y - at_third.y) - uy * (at_end.x - at_third.x);
  const double least = std::min(at_end.distance, at_third.distance),
               most = std::max(at_end.distance, at_third.distance);
  return bound(f, least, most, std::max(most - least, slip), edge == (end + 1) % 3 ? twist : -twist);
}

/// @param turn  determinant of the equations' Jacobian, whose inverse is at most 6 / turn
bool SegmentGraph::bound(Face f, double least, double most, double residual, double turn) const {
  if (!(turn > 1e-5)) return false;
  const double error = 16 / turn * (residual + 100 * rounding * (scale_ + most));
  if (!(error < 0.01 * least * turn)) return false;
  f->error = error;
  f->least = least - error, f->most = most + error;
  return true;
}

/// Whether the site enters the face's circle.
bool SegmentGraph::enters(Face f, const Query& query) {
  CGAL::Sign side = CGAL::ZERO;
  if (is_infinite(f)) {
    side = side_of_hull(f, query.site);
  } else {
    measure(f);
    if (f->circle == Circle::bounded) side = side_of_circle(f, query.site);
    if (f->circle == Circle::point && !ends_in_a_point_of(f, query.site)) side = CGAL::POSITIVE;
  }
  if (side == CGAL::ZERO) side = incircle(f, query.exact);
  return side == CGAL::NEGATIVE;
}

/// Negative: inside; zero: not certain.
CGAL::Sign SegmentGraph::side_of_circle(Face f, const GraphSite& t) const {
  const double x = f->x - t.ax, y = f->y - t.ay;
  double distance2 = x * x + y * y;
  if (t.edge) {
    const double ux = t.bx - t.ax, uy = t.by - t.ay, along = x * ux + y * uy, length2 = ux * ux + uy * uy;
    for (int i = 0; i < 3; ++i) {  // it leaves a point of the circle: into it or away from it
      const GraphSite& s = f->vertex(i)->graph_site;
      if (s.edge || !t.ends_in(s.a)) continue;
      const double into = s.a == t.a ? along : length2 - along;
      const double doubt = (f->error + 100 * rounding * scale_) * std::sqrt(length2);
      return into > doubt ? CGAL::NEGATIVE : into < -doubt ? CGAL::POSITIVE : CGAL::ZERO;
    }
    if (along >= length2) {
      const double bx = f->x - t.bx, by = f->y - t.by;
      distance2 = bx * bx + by * by;
    } else if (along > 0) {
      const double across = ux * y - uy * x;
      distance2 = across * across / length2;
    }
  }
  return distance2 < f->least * f->least ? CGAL::NEGATIVE : distance2 > f->most * f->most ? CGAL::POSITIVE : CGAL::ZERO;
}

/// The same for an infinite face, whose circle is a half-plane.
CGAL::Sign SegmentGraph::side_of_hull(Face f, const GraphSite& t) const {
  const int infinite = f->index(infinite_vertex());
  const GraphSite &p = f->vertex(cw(infinite))->graph_site, &q = f->vertex(ccw(infinite))->graph_site;
  if (p.edge || q.edge) return CGAL::ZERO;
  if (!t.edge) return sign_of_turn(certain_turn(p.ax, p.ay, q.ax, q.ay, t.ax, t.ay));
  const bool from_p = t.ends_in(p.a), from_q = t.ends_in(q.a);
  if (from_p && from_q) return CGAL::NEGATIVE;
  const double a = certain_turn(p.ax, p.ay, q.ax, q.ay, t.ax, t.ay),
               b = certain_turn(p.ax, p.ay, q.ax, q.ay, t.bx, t.by);
  if (from_p || from_q) return sign_of_turn(from_p == (t.a == p.a) && from_q == (t.a == q.a) ? b : a);
  return a > 0 && b > 0 ? CGAL::POSITIVE : a < 0 || b < 0 ? CGAL::NEGATIVE : CGAL::ZERO;
}

/// Whether the site, which enters both circles beside edge i of the face, takes all of the Voronoi edge between them.
bool SegmentGraph::enters_edge_between(Face f, int i, const Query& query) const {
  const bool here = is_infinite(f), there = is_infinite(f->neighbor(i));
  if (!(here && there)) {
    const GraphSite &p = f->vertex(ccw(i))->graph_site, &q = f->vertex(cw(i))->graph_site, &t = query.site;
    if (here || there) {
      if (!t.edge) return true;
      return !p.edge && !q.edge && t.ends_in(p.a) && t.ends_in(q.a);
    }
    if (p.edge && q.edge) return true;
    if (p.edge != q.edge) {
      if (p.edge ? p.ends_in(q.a) : q.ends_in(p.a)) return false;
    } else if (!t.edge || t.ends_in(p.a) || t.ends_in(q.a)) {
      return true;
    }
    const Face g = f->neighbor(i);
    if (t.edge && f->circle == Circle::bounded && g->circle == Circle::bounded) {
      const int sign = p.edge == q.edge ? takes_between_points(f, g, p, q, t)
                       : p.edge         ? takes_between(g, f, q, p, t)
                                        : takes_between(f, g, p, q, t);
      if (sign != 0) return sign > 0;
    }
  }
  return edge_interior(f, i, query.exact, CGAL::NEGATIVE);
}

/// Sign of how far the circle's centre lies along (x, y), of unit length, from a point; 0 where that is not certain.
int SegmentGraph::side_along(Face f, double px, double py, double x, double y) const {
  const double along = (f->x - px) * x + (f->y - py) * y;
  return std::abs(along) > f->error + 100 * rounding * (scale_ + f->most) ? (along > 0 ? 1 : -1) : 0;
}

/// Between two points and an edge t that ends in neither, which enters the circles f and g: 1 where it takes all
/// between them, -1 where it does not, 0 where that is not certain. As in CGAL's Finite_edge_interior_conflict_C2,
/// which says why.
int SegmentGraph::takes_between_points(Face f, Face g, const GraphSite& p, const GraphSite& q,
                                       const GraphSite& t) const {
  const double length = length_of(t.bx - t.ax, t.by - t.ay), ux = (t.bx - t.ax) / length, uy = (t.by - t.ay) / length;
  const double dp = ux * (p.ay - t.ay) - uy * (p.ax - t.ax), dq = ux * (q.ay - t.ay) - uy * (q.ax - t.ax);
  const double doubt = 100 * rounding * scale_;
  if (std::abs(dp) < doubt || std::abs(dq) < doubt) return 0;
  if ((dp > 0) != (dq > 0)) return 1;
  if (std::abs(dp - dq) < doubt) return 0;
  const GraphSite& near = std::abs(dp) < std::abs(dq) ? p : q;
  return side_along(f, near.ax, near.ay, ux, uy) * side_along(g, near.ax, near.ay, ux, uy);
}

/// The same between a point p and an edge q that does not end in it. Pre: f is the circle of p, q and a third site in
/// that order, g that of q, p and a fourth.
int SegmentGraph::takes_between(Face f, Face g, const GraphSite& p, const GraphSite& q, const GraphSite& t) const {
  const double doubt = 100 * rounding * scale_;
  const double q_length = length_of(q.bx - q.ax, q.by - q.ay), qx = (q.bx - q.ax) / q_length,
               qy = (q.by - q.ay) / q_length;
  const double p_off = qx * (p.ay - q.ay) - qy * (p.ax - q.ax);
  const int f_along = side_along(f, p.ax, p.ay, qx, qy), g_along = side_along(g, p.ax, p.ay, qx, qy);
  if (t.ends_in(p.a)) {
    if (f_along * g_along == 0) return 0;
    if (f_along == g_along) return 1;  // on one arc of the parabola
    if (q.ends_in(t.a) || q.ends_in(t.b)) return 1;
    const bool to_b = t.a == p.a;
    const double other_off = qx * ((to_b ? t.by : t.ay) - q.ay) - qy * ((to_b ? t.bx : t.ax) - q.ax);
    if (std::abs(p_off) < doubt || std::abs(other_off) < doubt ||
        std::abs(std::abs(p_off) - std::abs(other_off)) < doubt)
      return 0;
    if ((p_off > 0) != (other_off > 0)) return 1;
    return std::abs(p_off) > std::abs(other_off) ? 1 : -1;
  }
  const double t_length = length_of(t.bx - t.ax, t.by - t.ay), tx = (t.bx - t.ax) / t_length,
               ty = (t.by - t.ay) / t_length;
  if (std::abs(tx * qy - ty * qx) < 1e-6) return 0;  // nearly parallel
  const double off = tx * (p.ay - t.ay) - ty * (p.ax - t.ax);
  if (std::abs(off) < doubt) return 0;
  // Along t, so that p lies to the left of it.
  const double ax = off > 0 ? -tx : tx, ay = off > 0 ? -ty : ty;
  const int f_side = side_along(f, p.ax, p.ay, ax, ay), g_side = side_along(g, p.ax, p.ay, ax, ay);
  if (f_side * g_side == 0) return 0;
  if (f_side != g_side) return f_side > 0 ? -1 : 1;
  if (f_along * g_along == 0) return 0;
  if (f_along == g_along) return 1;
  const double foot = (qy * p_off) * ax - (qx * p_off) * ay;  // from p to its foot on q, along t
  return std::abs(foot) < doubt ? 0 : (foot > 0) == (f_side > 0) ? 1 : -1;
}

}  // namespace weft::geometry::detail
