// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "travel/obstacles.h"
#include "travel/travel.h"

#include <cstdint>
#include <optional>

namespace weft::travel {

/// How the nozzle gets from one bead to the next.
struct Way {
  Polyline points;       ///< after the first
  bool retract = false;  ///< filament is to be drawn back
  bool crosses = false;  ///< it leaves the part, or enters one
  bool outside = false;  ///< it leaves the room: none that stays inside was found
};

/// Ways between the beads of one layer, combed where they can be. For one thread.
class Router {
 public:
  /// The arguments must outlive the router.
  Router(const TravelSettings& settings, const RetractionSettings& retraction, const Prepared& layer)
      : settings_(settings),
        retraction_(retraction),
        layer_(layer),
        outline_(layer.outline),
        obstacles_(settings, layer.input) {}

  /// @param to_outer_wall  whether one begins at q
  Way way(Point p, Point q, bool to_outer_wall = false) const;

 private:
  bool leaves_outline(Point p, const Polyline& way) const;
  bool leaves_room(Point p, const Polyline& way) const;
  struct Gate {
    Point at;
    std::uint32_t part;  ///< of the comb area
  };
  std::optional<Gate> gate(const Comb& comb, Point p) const;
  struct Inside {
    Polyline points;
    double from_um = 0, to_um = 0;  ///< what of it lies, at both ends, between the beads and the comb area
    bool on_outer_walls = false;
  };
  std::optional<Inside> combed(const Comb& comb, Point p, Point q) const;
  std::optional<Inside> off_outer_walls(Point p, Point q) const;
  double most_on_outer_walls_um() const;
  bool lies_on_outer_walls(Point p, const Inside& way, bool ends_alone) const;
  double on_outer_walls_um(Point p, Point q) const;
  bool apart(Point p, Point q) const;
  const Comb& half_a_bead_in() const;
  bool too_long(double combed_um, double straight_um) const;
  bool drains(double combed_um, bool to_outer_wall) const;
  Way direct(Point p, Point q) const;

  const TravelSettings& settings_;
  const RetractionSettings& retraction_;
  const Prepared& layer_;
  const Comb& outline_;
  Obstacles obstacles_;
  // Made when a way asks for them: in most layers none does.
  mutable std::optional<Comb> half_a_bead_in_, outer_walls_;
};

double length_from(Point p, const Polyline& way);

}  // namespace weft::travel
