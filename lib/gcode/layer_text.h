// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "gcode/comments.h"
#include "gcode/progress.h"
#include "gcode/writer.h"

#include <string>
#include <string_view>
#include <vector>

namespace weft::gcode {

/// What the text of one layer is made of.
struct LayerJob {
  const Settings& settings;
  const std::vector<Settings>& tools;  ///< of each; empty: there is one
  const Dialect& dialect;
  Comments comments;
  const LayerPlan& plan;
  std::size_t index;  ///< of the layer, from 0
  const MachineState& entry;
  const std::vector<std::string>& names;
  std::string_view preamble;      ///< after ;LAYER_CHANGE, before the first move
  std::string_view before_layer;  ///< custom G-code
  std::string_view after_layer;
  const std::vector<std::string>& tool_changes;  ///< custom G-code of each
  const std::vector<std::string>& loaded;        ///< likewise, after the tool was chosen
  const std::vector<std::string>& pauses;        ///< likewise
  bool first_is_chosen = false;                  ///< start G-code has chosen the first tool
  double end_s = 0;                              ///< time of the print when the layer is done
  std::vector<TimedLine> timed{};                ///< between its steps, in order
};

std::string layer_text(const LayerJob& job);

/// Speed as F says it: mm/min, rounded down so that no limit is exceeded.
std::int64_t feed_of(double speed_mm_s);

}  // namespace weft::gcode
