// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "geometry/spatial_index.h"
#include "infill/beside.h"
#include "infill/fit_sides.h"
#include "infill/sparse.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace weft::infill {

/// A place in the layer, fractional microns from where patterns are anchored.
struct Place {
  double x = 0, y = 0;
  friend Place operator+(Place a, Place b) { return {a.x + b.x, a.y + b.y}; }
  friend Place operator-(Place a, Place b) { return {a.x - b.x, a.y - b.y}; }
  friend Place operator*(double s, Place a) { return {s * a.x, s * a.y}; }
};
/// hypot would guard against squares that microns do not reach.
inline double norm(Place a) {
  return std::sqrt(a.x * a.x + a.y * a.y);
}

inline constexpr double least_narrowing = 0.75;  // of the band, so that a layer has its density; most is 1 / least

double length_of(const std::vector<Place>& places);
/// Shortens a way at its end, or prolongs it when `by` is negative. Pre: by < its length.
void shorten(std::vector<Place>& places, double by);

/// Lines of a region and where they end, and how they are joined to paths beside the region's edge.
class Web {
 public:
  /// Both are to outlive it.
  Web(const Region& region, const SparseStyle& style);

  /// Lines y = phase + k·spacing in a frame turned by that angle. Beside an edge along them they bend aside.
  struct Lines {
    double angle_rad = 0, spacing = 1, phase = 0;
    const Regions* within = nullptr;  ///< what of the region they are wanted in; null: all of it
    bool more = false;                ///< of the last family
  };
  void add_lines(const Region& region, const Lines& of);

  /// Lines that end off the edge go on, or draw back, to the nearest line of another family that they meet, and end
  /// beside it; where there is none, they go on to the edge. @param farthest  that they may be moved by
  void end_at_lines(double farthest);

  /// Lines of different families turn into each other instead of crossing. Pre: no curves were added
  void bend_crossings();

  /// A curve; what of it is inside.
  struct Curve {
    Polyline line;
    bool closed = false;
  };
  void add_curves(const Region& region, const std::vector<Curve>& curves);

  /// Joins the lines and writes them.
  /// @param most  length of a joint along the edge
  /// @param wanted  length of lines that the region needs; 0: as much as there is of them without joints
  void emit(double most, Um band, double wanted, Beads& beads);

 private:
  /// A piece of the pattern; its ends are `2i` and `2i + 1`.
  struct Line {
    std::vector<Place> places;
    double length = 0;
  };
  /// An end of a line, on the region's edge unless `edge` is nobody.
  struct End {
    std::uint32_t edge = nobody;
    double along = 0;  ///< where on the edge, 0 … 1
    double sine = 1;   ///< of the angle between line and edge
  };
  static constexpr std::uint32_t nobody = std::numeric_limits<std::uint32_t>::max();
  static constexpr double shallowest = 0.2;  // sine of the angle between line and edge below which they are not joined

  /// Where a line meets another: how far from its beginning, and how far before and behind it turns.
  struct Meeting {
    std::uint32_t other = 0;
    double at = 0, cut = 0;
  };
  std::vector<std::vector<Meeting>> meetings() const;
  static std::size_t meeting_with(const std::vector<Meeting>& meetings, std::uint32_t other);
  void part_threes(std::vector<std::vector<Meeting>>& all) const;
  std::vector<Place> stretch(std::uint32_t line, double from, double to) const;
  void give_way(const std::vector<Sides>& sides, const Interval& i, double y, double angle_rad,
                std::vector<Place>& places) const;
  void add_piece(std::vector<Place> piece, End from, End to);
  static End end_on(const geometry::SegmentIndex& edges, const geometry::SegmentIndex::Crossing& met, Point a, Point b);
  Place place(std::uint32_t i) const { return {outline_.points()[i].x, outline_.points()[i].y}; }
  Place relative(Point p) const {
    return {static_cast<double>(p.x) - style_.origin.x, static_cast<double>(p.y) - style_.origin.y};
  }
  Point on_plane(Place p) const { return {style_.origin.x + rounded(p.x), style_.origin.y + rounded(p.y)}; }
  double laid_length() const;
  double length(std::uint32_t line) const { return lines_[line].length; }
  std::vector<Place> walked_from(std::uint32_t end) const;
  Place pulled(std::uint32_t end) const;
  std::uint32_t set_of(std::uint32_t line) {
    while (set_[line] != line) line = set_[line] = set_[set_[line]];
    return line;
  }
  bool on_edge(std::uint32_t end) const { return ends_[end].edge != nobody; }
  double free_pull(std::uint32_t end) const;
  void join(double longest);
  void order_ends();
  void join_the_rest(double longest);
  bool shift_joints(const std::vector<std::uint32_t>& ends, double longest);
  void find_sets();
  void merge_loops(double longest);
  bool merge_loop(std::uint32_t start, double longest, std::size_t& tries);
  bool merge_at(std::uint32_t x, std::uint32_t y, std::uint32_t gap, double longest);
  std::uint32_t gap_of_loop(std::uint32_t end) const;
  std::uint32_t other_end_of_path(std::uint32_t end) const;
  std::uint32_t beside(std::uint32_t end, bool after) const;
  std::vector<Place> way_of(std::uint32_t end) const;
  bool crosses_a_line(const std::vector<Place>& way, std::uint32_t a, std::uint32_t b);
  void join_far(double longest, double most_more);
  void anchor(double length);
  bool try_join(std::uint32_t a, std::uint32_t b, double longest);
  bool turn_above_others(std::uint32_t a, std::uint32_t b) const;
  void part(std::uint32_t a);
  std::optional<std::vector<Place>> arc_between(std::uint32_t a, std::uint32_t b, double inset, double longest);
  std::optional<std::vector<Place>> arc_beside(std::uint32_t a, std::uint32_t b, double inset, double longest);
  std::optional<Beside::Foot> foot_of(std::uint32_t end) const;
  double inside_of(Place p, std::uint32_t first, std::uint32_t last) const;
  std::vector<std::vector<Place>> joined_paths() const;
  void write(const std::vector<std::vector<Place>>& paths, Um width, Beads& beads) const;

  const Region& region_;
  const SparseStyle& style_;
  Outline outline_;
  std::vector<Place> normals_;
  std::vector<Line> lines_;
  std::vector<int> family_;  // of lines that were added as such
  std::vector<long> row_;    // the same: which of its family's lines it lies on
  int families_ = 0;
  std::vector<End> ends_;
  std::vector<std::vector<Place>> loops_;                   // curves that meet no edge
  std::vector<std::uint32_t> order_;                        // ends on the edge, around each ring
  std::vector<std::pair<std::size_t, std::size_t>> rings_;  // of `order_`
  std::vector<std::uint32_t> at_ring_, in_order_;           // by end on the edge: its ring, its place in `order_`
  std::vector<std::uint32_t> joint_, set_;
  Um band_ = 0;
  double most_ = 0;                       // length of a joint of dashes, whatever it takes
  double neighbours_ = 0;                 // length of joints between which no line can come near the edge
  std::optional<Beside> beside_;          // the edge, where joints run; made when it is wanted
  geometry::SegmentIndex all_lines_;      // the same
  std::vector<std::uint32_t> line_of_;    // beside its segments
  std::vector<double> pull_;              // how far each end is drawn back along its line
  std::vector<std::vector<Place>> arc_;   // by end, of the one that the joint was made from
  std::vector<std::vector<Place>> bent_;  // by end: along the edge, of one that is joined to none
};

}  // namespace weft::infill
