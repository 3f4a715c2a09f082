// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The outline is proven simple before CGAL sees it; its own checks cost a third of the time and cannot fail then.
#define CGAL_NDEBUG 1
#define CGAL_SDG_NO_FACE_MAP 1

#include "geometry/graph_site.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <CGAL/Mpzf.h>
#include <CGAL/Segment_Delaunay_graph_2.h>
#include <CGAL/Segment_Delaunay_graph_face_base_2.h>
#include <CGAL/Segment_Delaunay_graph_filtered_traits_2.h>
#include <CGAL/Segment_Delaunay_graph_storage_traits_2.h>
#include <CGAL/Segment_Delaunay_graph_vertex_base_2.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Spatial_sort_traits_adapter_2.h>
#include <CGAL/Triangulation_data_structure_2.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>
#include <CGAL/version.h>

/// Private to medial_axis: CGAL's segment Delaunay graph, grown by a way of our own.
///
/// A site is inserted by finding the Voronoi vertices whose circles it enters. CGAL computes each circle anew whenever
/// it is asked, in interval arithmetic; here a circle is computed once, in double, with a bound of its error, and what
/// that bound leaves open is asked of CGAL: the graph is the same (tests/geometry/segment_graph_test.cpp compares
/// them). The order of insertion, the search for the faces that a site enters and the filling of their hole follow
/// Segment_Delaunay_graph_2 of CGAL (Menelaos Karavelas; GPL-3.0-or-later), whose protected members they use.
namespace weft::geometry::detail {

static_assert(
    CGAL_VERSION_NR >= 1050500000 && CGAL_VERSION_NR < 1050600000,
    "members of CGAL that are not documented are used here, as CGAL 5.5 has them: with another version run the "
    "tests of the segment graph, then widen this");

/// A vertex or a face of CGAL's that carries data of ours.
template <class Base, class Data>
struct Carrier : Base, Data {
  using Base::Base;
  template <class Tds>
  struct Rebind_TDS {
    using Other = Carrier<typename Base::template Rebind_TDS<Tds>::Other, Data>;
  };
};

/// A vertex: the site it is, and its number.
struct VertexData {
  std::uint32_t number = 0;
  GraphSite graph_site;
};

/// A face: its circle, and its number.
struct FaceData {
  std::uint32_t number = 0;
  enum class Circle : std::uint8_t { unknown, bounded, doubtful, point } circle = Circle::unknown;
  double x = 0, y = 0;
  double least = 0, most = 0;  ///< of its radius
  double error = 0;            ///< of its centre
};

using GraphKernel = CGAL::Simple_cartesian<double>;
using GraphExact = CGAL::Simple_cartesian<CGAL::Mpzf>;
using GraphFilteredTraits =
    CGAL::Segment_Delaunay_graph_filtered_traits_without_intersections_2<GraphKernel, CGAL::Field_with_sqrt_tag,
                                                                         GraphExact>;

/// CGAL's predicates, but for two that are asked oftest. Every site is a point of the outline or an edge between two,
/// and edges are proven to meet in common ends only: then equality of sites is equality of their coordinates.
struct GraphTraits : GraphFilteredTraits {
  using Site = Site_2;
  struct Equal_2 {
    using result_type = bool;
    using argument_type = Site;
    bool operator()(const Site& p, const Site& q) const { return same(p.point(), q.point()); }
    static bool same(const Point_2& p, const Point_2& q) { return p.x() == q.x() && p.y() == q.y(); }
  };
  struct Arrangement_type_2 : CGAL::SegmentDelaunayGraph_2::Internal::Arrangement_enum {
    using result_type = Arrangement_type;
    using argument_type = Site;
    Arrangement_type operator()(const Site& p, const Site& q) const {
      if (p.is_point() && q.is_point()) return Equal_2()(p, q) ? IDENTICAL : DISJOINT;
      if (p.is_point()) return end_of(q, p.point());
      if (q.is_point()) return end_of(p, q.point());
      const auto p1 = p.source(), p2 = p.target(), q1 = q.source(), q2 = q.target();
      const bool s11 = Equal_2::same(p1, q1), s22 = Equal_2::same(p2, q2), s12 = Equal_2::same(p1, q2),
                 s21 = Equal_2::same(p2, q1);
      if ((s11 && s22) || (s12 && s21)) return IDENTICAL;
      return s11 ? TOUCH_11 : s12 ? TOUCH_12 : s21 ? TOUCH_21 : s22 ? TOUCH_22 : DISJOINT;
    }
    static Arrangement_type end_of(const Site& edge, const Point_2& p) {
      return Equal_2::same(p, edge.source()) ? TOUCH_1 : Equal_2::same(p, edge.target()) ? TOUCH_2 : DISJOINT;
    }
  };
  Equal_2 equal_2_object() const { return {}; }
  Arrangement_type_2 arrangement_type_2_object() const { return {}; }
};

using GraphStorage = CGAL::Segment_Delaunay_graph_storage_traits_2<GraphTraits>;
using GraphBase = CGAL::Segment_Delaunay_graph_2<
    GraphTraits, GraphStorage,
    CGAL::Triangulation_data_structure_2<Carrier<CGAL::Segment_Delaunay_graph_vertex_base_2<GraphStorage>, VertexData>,
                                         Carrier<CGAL::Segment_Delaunay_graph_face_base_2<GraphTraits>, FaceData>>>;

class SegmentGraph : public GraphBase {
 public:
  using Point = GraphTraits::Point_2;
  using Face = Face_handle;
  using Vertex = Vertex_handle;
  using Circle = FaceData::Circle;

  /// Inserts the points and the segments between them. Pre: points are distinct; segments meet in common ends only and
  /// are distinct.
  void build(const std::vector<Point>& points, const std::vector<std::pair<std::uint32_t, std::uint32_t>>& segments);
  /// Of a face's circle. Pre: the face is finite
  Point centre(Face f);

 private:
  struct Query {
    GraphSite site;
    Storage_site_2 stored;
    Site_2 exact;
  };

  Vertex add_point(const Query& query, Vertex near);
  Vertex add_edge(const Query& query, Vertex end);
  Vertex nearest(const Query& query, Vertex from);
  Face entered_around(const Query& query, Vertex v);
  Vertex replace_entered(Face start, const Query& query);
  Vertex fill_hole(const Query& query);

  void measure(Face f);
  Circle bound_circle(Face f) const;
  bool bound_by_sites(Face f) const;
  bool bound_on_perpendicular(Face f, int end, int edge) const;
  bool bound(Face f, double least, double most, double residual, double turn) const;
  bool enters(Face f, const Query& query);
  CGAL::Sign side_of_circle(Face f, const GraphSite& t) const;
  CGAL::Sign side_of_hull(Face f, const GraphSite& t) const;
  bool enters_edge_between(Face f, int i, const Query& query) const;
  int takes_between_points(Face f, Face g, const GraphSite& p, const GraphSite& q, const GraphSite& t) const;
  int takes_between(Face f, Face g, const GraphSite& p, const GraphSite& q, const GraphSite& t) const;
  int side_along(Face f, double px, double py, double x, double y) const;

  Data_structure& structure() { return const_cast<Data_structure&>(tds()); }  // CGAL inherits it privately

  double scale_ = 1;          ///< of coordinates, µm
  bool knows_sites_ = false;  ///< vertices carry them

  // The boundary of the faces that are entered, counter-clockwise: a ring of edges linked through their faces' data.
  void link(const Edge& a, const Edge& b) {
    a.first->tds_data().set_next(static_cast<unsigned>(a.second), b);
    b.first->tds_data().set_previous(static_cast<unsigned>(b.second), a);
  }
  Edge after(const Edge& e) const { return e.first->tds_data().next(static_cast<unsigned>(e.second)); }
  Edge before(const Edge& e) const { return e.first->tds_data().previous(static_cast<unsigned>(e.second)); }
  bool in_boundary(const Edge& e) const { return e.first->tds_data().is_in_list(static_cast<unsigned>(e.second)); }
  void unlink(const Edge& e) {
    const Edge nowhere(Face(), -1);
    e.first->tds_data().set_next(static_cast<unsigned>(e.second), nowhere);
    e.first->tds_data().set_previous(static_cast<unsigned>(e.second), nowhere);
  }
  Edge front_;
  std::vector<Face> entered_, open_;
  std::vector<Edge> hole_, twice_;
};

}  // namespace weft::geometry::detail
