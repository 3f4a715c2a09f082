// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "settings/groups/support.h"
#include "support/support.h"

#include <utility>
#include <vector>

namespace weft::support {

/// The width that a bead of support fills with nothing rounded, in layers as high as most are, µm.
Um usual_band(const SupportSettings& settings, Um nozzle);

/// What the beads of an area of columns of that height take, mm³, as far below what it carries as each step: a loop
/// where it is narrow, else lines. What joins these at every other end makes up for the half bead by which they end
/// before the edge.
/// @param shares  of columns, from the top down
std::vector<double> column_mm3(const SupportSettings& settings, Um nozzle, const std::vector<double>& shares,
                               const Region& area, Um height);

/// What of columns is no further than steps are below what they carry.
class NearMm2 {
 public:
  /// @param carried  upwards: at which height, and what
  NearMm2(const SupportSettings& settings, Um nozzle, const std::vector<double>& shares,
          const std::vector<std::pair<Um, const Regions*>>& carried);
  /// By step, at that height.
  std::vector<double> at(Um z) const;

 private:
  struct Carried {
    Um z;
    double mm2, round_mm;
  };
  struct Step {
    Um depth;
    double beside_mm;  ///< that cells reach beyond what is carried
  };
  std::vector<Carried> carried_;
  std::vector<Step> steps_;
};

/// What areas of columns take that are near by so much.
/// @param by_step  what they would, as far below what they carry as each step
double taken_mm3(const std::vector<double>& by_step, const std::vector<double>& near_mm2, double mm2);

/// What the beads of a plan take, mm³, reckoned from its areas. Cost: an offset a column.
double plastic_mm3(const SupportSettings& settings, Um nozzle, const Plan& plan);

}  // namespace weft::support
