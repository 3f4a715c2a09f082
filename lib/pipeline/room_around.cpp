// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/room_around.h"

#include "model/flow.h"
#include "settings/head_profile.h"

#include <algorithm>
#include <cmath>

namespace weft::pipeline {

Um brim_of(const Settings& settings) {
  const auto& a = settings.adhesion;
  const bool brim = a.adhesion_type == AdhesionType::brim || a.adhesion_type == AdhesionType::as_set;
  return brim ? a.brim_width : 0;
}

Um skirt_of(const Settings& settings) {
  const auto& a = settings.adhesion;
  const bool skirt = a.adhesion_type == AdhesionType::skirt || a.adhesion_type == AdhesionType::as_set;
  if (!skirt || a.skirt_line_count == 0 || a.adhesion_outside == AdhesionOutside::clip) return 0;
  const Um nozzle = settings.machine.nozzle_diameter;
  const Um height = settings.layers.initial_layer_height.value_or(settings.layers.layer_height);
  const Um line = length_or(a.skirt_brim_line_width, nozzle, flow::automatic_width(nozzle, height));
  return a.skirt_gap + a.skirt_line_count * line;
}

Um head_of(const Settings& settings) {
  Um out = 0;
  if (settings.plate.print_sequence == PrintSequence::one_at_a_time)
    for (const auto& slab : parse_head_profile(settings.plate.machine_head_profile))
      for (const Point p : slab.outline) out = std::max({out, std::abs(p.x), std::abs(p.y)});
  return out;
}

}  // namespace weft::pipeline
