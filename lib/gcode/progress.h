// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "gcode/dialect.h"
#include "model/statistics.h"

#include <string>
#include <vector>

namespace weft::gcode {

/// What is said when so much of a layer's time is over.
struct TimedLine {
  double share = 0;
  std::string text;
};

/// What displays are told of how far a print is, in the firmware's usual mode and in its silent one.
class ProgressText {
 public:
  /// @param layers how many there are: what statistics do not know of takes no time
  ProgressText(const Dialect& dialect, const Statistics& statistics, std::size_t layers);

  /// When so much of a layer's time is over, 0 … 1.
  std::string at(std::size_t layer, double share = 0) const;
  std::string done() const;
  /// What is to be told before a layer; nothing where it is what was told before the one below.
  std::string before(std::size_t layer) const;
  /// Displays shall not stand still during a layer that takes minutes: what is told within it.
  std::vector<TimedLine> within(std::size_t layer) const;

  double begin_s(std::size_t layer) const { return usual_[layer]; }

 private:
  const Dialect& dialect_;
  std::vector<double> usual_, silent_;  ///< when each layer begins, and one more for the end; the second may be empty
};

}  // namespace weft::gcode
