// SPDX-License-Identifier: GPL-3.0-or-later
#include "preview/figures.h"

#include "preview/coverage.h"
#include "preview/timing.h"

#include <algorithm>
#include <cmath>

namespace weft::preview {
namespace {

constexpr std::size_t most_steps = 100;  // of a histogram

double length_mm(const Stroke& stroke, Um z_from) {
  const double dx = to_mm(stroke.to.x - stroke.from.x), dy = to_mm(stroke.to.y - stroke.from.y);
  const double dz = to_mm(stroke.z - z_from);
  return std::sqrt(dx * dx + dy * dy + dz * dz);
}

void count_bead(Figures& out, LayerFigures& layer, const Stroke& stroke, double mm, bool custom) {
  const double seconds = static_cast<double>(stroke.seconds);
  const double speed = static_cast<double>(stroke.speed_mm_s), flow = static_cast<double>(stroke.flow_mm3_s);
  const double mm3 = speed > 0 ? flow / speed * mm : 0;
  auto& share = out.features[stroke.feature];
  share.mm += mm, share.mm3 += mm3, share.seconds += seconds;
  layer.mm3 += mm3;
  ++out.beads;
  if (custom) return;
  out.flow.add(flow, seconds);
  out.speed.add(speed, mm);
  out.width.add(to_mm(stroke.width), mm);
}

}  // namespace

void Histogram::add(double at, double much) {
  const auto i = static_cast<std::size_t>(std::clamp(at / step + 1e-6, 0.0, most_steps - 1.0));
  if (i >= amount.size()) amount.resize(i + 1);
  amount[i] += much;
}

Figures figures_of(const Toolpaths& paths) {
  Figures out;
  out.features.resize(paths.features.size());
  out.mm2 = paths.filament_mm2;
  Um z = 0;
  bool travelling = false;
  for (const auto& layer : paths.layers) {
    auto& figures = out.layers.emplace_back();
    figures = {to_mm(layer.z), to_mm(layer.height), seconds_of(layer), 0, layer.strokes.size()};
    for (const auto& stroke : layer.strokes) {
      const double mm = length_mm(stroke, z);
      z = stroke.z;
      if (stroke.extrudes()) {
        count_bead(out, figures, stroke, mm, is_custom(paths, stroke));
      } else {
        out.travel.mm += mm, out.travel.seconds += static_cast<double>(stroke.seconds);
        out.travels += !travelling;
      }
      travelling = !stroke.extrudes();
    }
    for (const auto& event : layer.events) {
      out.retractions += event.kind == Event::Kind::retract;
      out.tool_changes += event.kind == Event::Kind::tool_change;
      out.pauses += event.kind == Event::Kind::pause;
    }
    out.seconds += figures.seconds;
    out.mm3 += figures.mm3;
    out.moves += figures.moves;
  }
  return out;
}

}  // namespace weft::preview
