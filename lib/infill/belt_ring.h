// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "geometry/spatial_index.h"
#include "infill/belts.h"
#include "infill/strips.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

/// Private to belts.cpp.
namespace weft::infill {

constexpr int most_belt_lines = static_cast<int>(widest_strip);

/// What is asked about a belt's width.
struct BeltGround {
  const Mask& solid;
  const Mask& sparse;
  const LayersInReach& layers;
  double band = 0;  ///< of a line, µm
};

/// Where a length decides, many that are about as long are decided alike: the limit moves into the widest gap between
/// the lengths near it.
class LengthLimit {
 public:
  void add(double um);
  double um() const;  ///< with all that were added
 private:
  std::vector<double> near_;
};

/// The lines one nearer to the wall: a line lies beside one of them, else there would be a slit between it and the
/// wall.
class LinesBefore {
 public:
  /// @param lines none: the next ones lie beside the wall itself
  /// @param band  from a line to the next, µm
  LinesBefore(const std::vector<BeltLine>& lines, double band);
  /// How far that place of the next line is from where the line beside it ends, µm along it: negative beyond its end.
  double within(Point at) const;

 private:
  struct Ends {
    Point first, last;
    bool open = false;
  };
  geometry::SegmentIndex index_;
  std::vector<Ends> ends_;         // of each line
  std::vector<std::uint32_t> of_;  // which line a segment is of
  double band_;
};

/// A ring along the wall that a belt's line may run on, and how wide the belt is along it.
class BeltRing {
 public:
  /// Pre: what is inside of the wall lies to the left of the ring; `ground` outlives this.
  /// @param depth_um of the ring below the wall
  BeltRing(Ring ring, double depth_um, const BeltGround& ground);

  // To be done in this order, and each step with a limit by what all rings of that depth add to it.
  void add_solid_runs(LengthLimit& limit) const;
  void open_solid_runs(double longest_um);     ///< longer ones are no spike between belts: wider than any belt
  void find_lines(const LinesBefore& before);  ///< where the belt is as wide as asks for one
  void add_pauses(LengthLimit& limit) const { add_runs(false, limit); }
  void close_pauses(double shortest_um) { turn_short(false, shortest_um); }
  void add_lines(LengthLimit& limit) const { add_runs(true, limit); }
  void drop_lines(double shortest_um) { turn_short(true, shortest_um); }

  std::vector<BeltLine> lines() const;

 private:
  static constexpr double beyond = std::numeric_limits<double>::infinity();
  /// What a place on the ring stands for.
  struct Sample {
    Point at;
    double nx = 0, ny = 0;  // inwards, of length 1
    double along = 0;       // µm from the ring's first point, of its middle
    double length = 0;
    double width = 0;        // of the belt there, from the wall
    double over = 0;         // by how much it is within the limits between which there is a line
    double within = beyond;  // the ends of the line beside it, of those one nearer to the wall
    bool free = false;       // solid or sparse: a line may go on there
    bool line = false;       // there is one
    bool all_solid = false;  // from wall to wall
  };
  /// What measuring a place needs, made once for many.
  struct Measuring {
    std::vector<geometry::SegmentIndex::Crossing> met;
    std::vector<std::pair<double, int>> changes;  // from the wall, µm: so many layers more lack what is there
    std::vector<bool> asked;                      // of the others
  };
  struct Run {
    std::size_t first = 0, count = 0;  // samples, round the ring
  };

  const Sample& sample(std::size_t i) const { return samples_[i % samples_.size()]; }
  double begins_um(std::size_t i) const;
  double length_of(const Run& run) const { return begins_um(run.first + run.count) - begins_um(run.first); }
  template <class Is>
  std::vector<Run> runs(const Is& is) const;
  enum class Cell { wall, solid, sparse };
  Cell look(const Sample& s, double um) const;
  void look_across(Sample& s) const;
  void measure(Sample& s, Measuring& on) const;
  double first_that_all_cover(const Sample& s, double most, Measuring& on) const;
  bool add_changes(const Sample& s, const Cover& cover, double most, Measuring& on) const;
  /// That far from the wall.
  Point place(const Sample& s, double um) const {
    return {s.at.x + rounded((um - depth_) * s.nx), s.at.y + rounded((um - depth_) * s.ny)};
  }
  double over(const Sample& s) const;
  double later(std::size_t i) const;
  double drawn_length(const Run& run) const;
  std::vector<Run> turnable(bool line) const;
  void add_runs(bool line, LengthLimit& limit) const;
  void turn_short(bool line, double least_um);
  Polyline between(double from, double to) const;

  Ring ring_;
  double depth_, cell_, most_;
  const BeltGround& ground_;
  std::vector<Sample> samples_;
  double perimeter_ = 0;
};

}  // namespace weft::infill
