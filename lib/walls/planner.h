// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "walls/laying.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

namespace weft::walls {

/// Private to laying: decides the beads of one part, step by step on the edges of its skeleton. Lengths are µm; an edge
/// has its two halves 2e and 2e + 1, and one that is split keeps its first part.
class Planner {
 public:
  /// All three must outlive the planner; nodes are added to the skeleton.
  Planner(Skeleton& skeleton, const Widths& widths, const LayingOptions& options)
      : s_(skeleton), w_(widths), o_(options) {}

  /// Call once.
  Laying run();

 private:
  static constexpr std::uint32_t none = ~0U;

  /// How a core edge's bounds approach those of a neighbouring count.
  struct Blend {
    Count other;
    double at_start = 0, at_end = 0;  ///< share of the other
  };
  /// A small place where arms meet.
  struct Summit {
    std::vector<std::uint32_t> nodes, edges;
    std::vector<std::vector<std::uint32_t>> arms;  ///< halves of each steep way down, from the place on
  };
  /// A climb in which walls keep to the outline: half the thickness they fill, by the clearance.
  struct Passage {
    double low, high;              ///< clearance
    double walls_low, walls_high;  ///< what walls fill there
  };
  /// The bead that turned back last on a way down: its tip is round.
  struct Turn {
    double reach = 0;  ///< half its width
    double past = 0;   ///< way along the axis since
  };
  /// Where a mouth ends in a part that has nothing but walls.
  struct Throat {
    int pairs;             ///< of that part
    std::uint32_t bounds;  ///< where those of the part begin in Laying::bounds
  };
  /// What is decided of an edge. The parts of one that is split begin alike.
  struct Edge {
    bool core = true;      ///< beads follow the thickness; else they run into a corner or a mouth
    bool steep = false;    ///< no middles but a single one
    bool mouth = false;    ///< where a thin part opens into a thick one
    bool reached = false;  ///< from the core down
    Count count{};         ///< of the core
    Blend blend{};
    std::uint32_t passage = none, throat = none;  ///< index of it
    Span span{};
  };
  /// Core edges of one count that touch are a region, known by the first of them.
  struct CountRegions {
    std::vector<std::uint32_t> root;        ///< by edge; of() leads to the region
    std::vector<double> length, low, high;  ///< by region: its way, its least and most thickness
    std::vector<double> ends;               ///< … and how many it has, twice
    std::uint32_t of(std::uint32_t edge);
  };
  /// Where a region meets another.
  struct Border {
    std::uint32_t region, other;
  };
  struct Descent {
    std::uint32_t half;
    Span span;
    Turn turn;
  };
  /// On its way into a corner the innermost wall of a span gets narrower between these clearances: its inner bound
  /// falls from where it is to the second of them.
  struct Narrowing {
    double from, to;
    double inner_bound(double own, double clearance) const {
      return to + (own - to) * std::clamp((clearance - to) / (from - to), 0.0, 1.0);
    }
  };

  double slope(std::uint32_t e) const {
    const double length = s_.length(e);
    const double rise = std::abs(s_.start(2 * e).clearance - s_.end(2 * e).clearance);
    return length > same_um ? rise / length : 0;
  }

  template <class F>
  void for_each_leaving(std::uint32_t half, F f) const {  // all halves that leave the node `half` leaves
    std::uint32_t h = half;
    do {
      f(h);
      h = s_.halves[Skeleton::twin(h)].next;
    } while (h != half);
  }

  // what runs into corners and what does not
  /// Which edges fall or climb so steeply that they run into a corner; cuts them where room for a single bead ends.
  void find_steep();
  void find_core();
  /// Where the axis climbs steeply from a thin part into a thick one, the walls of the thick part turn back as they do
  /// in a corner, and the beads of the thin part end.
  void cut_mouths(std::vector<int>& degree);
  /// Of the arm that a half leads down into: how many where that is level, for as long as a change of count is to last
  /// or to its end. 0 where there is no such arm.
  int beads_of_arm(std::uint32_t h) const;
  /// Whether at the end of a half another such arm begins, of at least so many beads.
  bool leads_to_arm(std::uint32_t h, int beads) const;
  /// A tip is led on to only straight ahead: at the end of a rib the axis also bends into the sharper of two corners.
  void cut_bent_tips(std::vector<int>& degree);
  Place direction(std::uint32_t h) const;

  // how many beads
  Count count_of(std::uint32_t e);
  /// The thickness from which a steep stretch gets a middle, too: that many beads, an even number, would be too wide.
  double crowded(int beads);
  std::uint32_t split(std::uint32_t e, double t);
  void cut_at_thresholds();
  /// The band of the widest bead when that many share a thickness.
  double widest(Count count, double thickness);
  /// Short regions take the count of a longer one beside them, where that fits there.
  void filter();
  /// The next core edge around the end of a half.
  std::uint32_t next_core(std::uint32_t h) const;
  CountRegions regions_of_counts() const;
  /// Either way round, the shortest regions first; counts their ends.
  std::vector<Border> borders_of(CountRegions& regions) const;
  bool gives_way(const CountRegions& regions, const Border& border);
  /// How wide a bead may grow for a short way, rather than be joined by another.
  double wide_bead() const { return std::min(w_.most, 1.7 * std::min(w_.inner, w_.outer)); }

  // small places where thick arms meet
  /// Where four or five arms of equal beads meet and their walls alone would become too wide, but there is no room for
  /// a wall that turns back: the walls go on as wide as they come, and a bead in the middle fills what they leave.
  void pass_junctions();
  /// Steep, and longer than what rounding makes of one place.
  bool is_climb(std::uint32_t e) const { return edges_[e].steep && s_.length(e) > one_place; }
  /// Whether steep ways lead up from a node, or down, but not both: it does not lie on a slope, nor in the flat.
  bool steep_around(std::uint32_t node) const;
  /// The place around a node that no steep way leads up from, if it is small, with the steep ways down from it.
  std::optional<Summit> summit_at(std::uint32_t node) const;
  /// Makes an arm end where it is level.
  void down_to_level(std::vector<std::uint32_t>& arm) const;
  /// Whether beyond each of them lies one stretch, all of the same even number of beads.
  bool alike(const std::vector<std::vector<std::uint32_t>>& arms, Count& count);
  /// Makes an edge core of so many beads, along which the walls fill what the passage says.
  void pass(std::uint32_t e, Count count, Passage passage);
  bool passes(std::uint32_t e) const { return edges_[e].passage != none; }
  /// Half the thickness that walls fill where the clearance is that; all of it but in a passage.
  double walled(std::uint32_t e, double clearance) const;

  // ramps between counts
  void ramps();
  /// The one core half that leads on from the end of h, or h itself when there is none or more.
  std::uint32_t onward(std::uint32_t h) const;
  double stretch(std::uint32_t h) const;
  void blend_along(std::uint32_t h, Count other, double reach);
  void set_core_bounds(std::uint32_t e);
  std::uint32_t bounds_at(Count mine, Count other, double share, double half);

  // corners
  /// Of each mouth that ends in one part, if that has no bead on its axis: there walls meet, and may give way. Pre: the
  /// bounds of the core are set.
  void find_throats();
  /// None where the mouth has none.
  const Throat* throat_at(std::uint32_t edge) const {
    return edges_[edge].throat != none ? &throats_[edges_[edge].throat] : nullptr;
  }
  /// Walls that go on where another has turned back fill the room beside its tip, and no more: at an edge of a mouth,
  /// and down into the part below it as far as they would meet the tip.
  void fill_beside(std::uint32_t h, const Turn& turn);
  void yield_below(std::uint32_t h, const Span& span, Turn turn);
  /// Splits an edge whose beads are known; returns the first part of the half.
  std::uint32_t split_core(std::uint32_t h, double t);
  /// The bounds of those walls where the axis has come so far, steep by `slope`; as in `span`, but no less than that.
  std::uint32_t bounds_beside(const Throat& throat, const Span& span, const Turn& turn, double slope, double clearance);
  bool climbs_mouth(std::uint32_t h) const {
    return edges_[h / 2].mouth && s_.end(h).clearance > s_.start(h).clearance;
  }
  void run_into_corners();
  /// Descends from a node with the most beads that its core has, into corners and mouths or into mouths only; does
  /// nothing where the node has no core.
  void leave_core(std::uint32_t n, bool only_mouths);
  void descend_from(std::uint32_t n, const Span& span, bool only_mouths);
  /// Beads end on the axis where the clearance falls to their distance.
  void descend(std::uint32_t h, Span span, Turn turn);
  /// What changes next on a way down, and whether a bead ends there; negative: nothing before `low`.
  struct Change {
    double clearance = -1;
    bool ends = false;
  };
  Change next_change(const Span& span, const std::optional<Narrowing>& narrowing, double from, double low) const;

  // sharp corners
  /// The clearance from which on a half leads straight down into a sharp corner; 0 if it does not.
  double sharp_from(std::uint32_t h) const;
  /// Where a wall turns back it is round: the tip of the corner stays bare, and so does what lies between its bend and
  /// the next wall's. There its ribs leave it less than its width anyway, so that it may get narrower and bend further
  /// out without leaving anything bare inside. None without a wall, without a sharp corner, or too near its tip.
  std::optional<Narrowing> narrowing_of(const Span& span, double sharp_from) const;
  /// The clearance at which the innermost wall turns back. Pre: there is one.
  double turn_at(const Span& span, const std::optional<Narrowing>& narrowing) const;
  /// The span on a half in a corner. Pre: nothing changes between its ends.
  Span in_corner(std::uint32_t h, const Span& span, const std::optional<Narrowing>& narrowing);
  /// The bounds of a span with that innermost bound.
  std::uint32_t bounds_up_to(const Span& span, double innermost);

  static constexpr double outer_spread =
      1.25;  // of its width: an outer wall alone on its side grows to this in a taper
  static constexpr std::size_t fewest_arms = 4, most_arms = 5;  // of three the walls fill it; of six much stays bare
  static constexpr double one_place =
      10;  // so near lie the nodes where more than three parts meet: corners are rounded
  static constexpr double longest_summit =
      2.5;  // of a bead's width: bars of two beads that cross at 45° meet in two places so far apart
  static constexpr double sharp_sine =
      0.766;  // of half a corner's angle of 100°: a blunter bend leaves next to nothing bare
  static constexpr double least_narrowing = 5;  // of clearance, µm: what is gained in less is lost on the lattice
  static constexpr double same_um = 1e-3;       // lengths that differ by less are equal
  static constexpr double stub_share = 0.25;    // of the clearance: flat ends of the axis shorter than this are corners
  static constexpr double dip_share = 0.02;     // of the clearance: … and never reach over a rise of more than this

  Skeleton& s_;
  const Widths& w_;
  const LayingOptions& o_;
  std::vector<std::uint32_t> any_, peaks_, tops_;  // a half that leaves each node; nodes with corners all around
  std::vector<Edge> edges_;
  std::vector<std::vector<std::uint32_t>> runs_;  // halves of each mouth, climbing
  std::vector<Passage> passages_;
  std::vector<Throat> throats_;
  std::vector<double> scratch_;
  std::vector<std::optional<double>> crowded_;  // as far as it was asked for
  std::vector<Descent> leave_;
  Laying out_;
};

}  // namespace weft::walls
