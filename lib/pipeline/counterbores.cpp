// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/counterbores.h"

#include "core/stop.h"
#include "geometry/boolean.h"
#include "pipeline/area_pieces.h"
#include "slice/counterbore.h"
#include "tasks/parallel.h"

#include <cstddef>
#include <utility>

#include <fmt/format.h>

namespace weft::pipeline {
namespace {

/// Parts that touch have no hole between them.
std::vector<Regions> outlines(const std::vector<slice::Cut>& layers, const std::vector<Areas>& areas) {
  return tasks::parallel_map(layers.size(), [&](std::size_t i) {
    const auto& regions = layers[i].layer.regions;
    return areas[i].size() > 1 ? geometry::unite(regions) : regions;
  });
}

void change(slice::Cut& layer, Areas& areas, const Regions& open, const Regions& closed) {
  AreaPieces pieces(std::move(layer.layer.regions), areas);
  std::size_t largest = 0;
  for (std::size_t a = 0; a < pieces.size(); ++a) {
    pieces[a] = geometry::subtract(pieces[a], open);
    if (area_mm2(pieces[a]) > area_mm2(pieces[largest])) largest = a;
  }
  if (!closed.empty()) pieces[largest] = geometry::unite(pieces[largest], closed);
  std::move(pieces).put_back(layer.layer.regions, areas);
}

}  // namespace

void bridge_counterbores(CounterboreHoleBridging how, Um line, const Object& object, std::vector<slice::Cut>& layers,
                         std::vector<Areas>& areas, Notices& notices) {
  const auto own = outlines(layers, areas);
  const Regions nothing;
  const auto at = [&](std::size_t i) { return i < own.size() ? &own[i] : &nothing; };
  const auto ceilings = tasks::parallel_map(own.size(), [&](std::size_t i) {
    stop_if_asked();
    if (i == 0) return slice::CounterboreCeiling{};
    return slice::counterbore_ceiling({&own[i - 1], &own[i], at(i + 1), at(i + 2)}, how, line);
  });
  int closed = 0;
  Point first;
  for (std::size_t i = 1; i < layers.size(); ++i) {
    auto open = ceilings[i].open;
    open.insert(open.end(), ceilings[i - 1].open_next.begin(), ceilings[i - 1].open_next.end());
    const auto& shut = ceilings[i].closed;
    if (open.empty() && shut.empty()) continue;
    change(layers[i], areas[i], open, shut);
    if (shut.empty()) continue;
    if (closed == 0) first = box_of(shut.front().outer).centre() + object.copies.front();
    closed += ceilings[i].holes;
  }
  if (closed > 0)
    notices.push_back({"counterbore_holes_closed",
                       fmt::format("{}: {} over a wider one, at {:.2f}, {:.2f}, to be drilled out: one layer closes it",
                                   object.name, closed == 1 ? "a hole" : fmt::format("{} holes, the first", closed),
                                   to_mm(first.x), to_mm(first.y))});
}

}  // namespace weft::pipeline
