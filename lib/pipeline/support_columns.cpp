// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/support_columns.h"

#include "geometry/simplify.h"
#include "model/flow.h"
#include "pipeline/support_beads.h"
#include "support/lengths.h"
#include "tasks/parallel.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <tuple>

namespace weft::pipeline {
namespace {

/// What tells columns from each other, roughly; and how beads are laid: levels a micron higher or lower have the same.
using Hint = std::tuple<Um, Um, bool, std::size_t, Point, Point>;
Hint hint_of(const Settings& settings, const support::SupportLayer& layer, const Region& column) {
  const Um at = settings.support.support_pattern == SupportPattern::gyroid ? layer.z : 0;
  const std::size_t n = column.outer.size();
  const Um line = support::line_width(settings.support, settings.machine.nozzle_diameter);
  return {flow::band(line, layer.height), at, layer.first, n, column.outer.front(), column.outer[n / 2]};
}

}  // namespace

SupportColumns::SupportColumns(const Settings& settings, const std::vector<support::SupportLayer>& layers,
                               const NearBelow& near, Point origin) {
  const auto areas = tasks::parallel_map(
      layers.size(), [&](std::size_t k) { return geometry::simplified(layers[k].columns, support::outline_bound); });
  find_like(settings, layers, near, areas);
  filled_ = tasks::parallel_map(firsts_.size(), [&](std::size_t i) {
    const auto [layer, region] = firsts_[i];
    const Region& column = areas[layer][region];
    return fill_column({settings, layers[layer], origin}, column, near.around(layer, column));
  });
}

Beads SupportColumns::of(std::size_t layer) const {
  Beads out;
  for (const std::size_t i : like_[layer]) out.insert(out.end(), filled_[i].begin(), filled_[i].end());
  return out;
}

SupportColumns::Unlike SupportColumns::unlike(std::size_t layer, std::size_t other) const {
  Unlike out;
  for (const std::size_t i : like_[layer])
    if (std::find(like_[other].begin(), like_[other].end(), i) == like_[other].end())
      for (const Bead& bead : filled_[i]) (bead.closed ? out.walls : out.lines).push_back(bead);
  return out;
}

void SupportColumns::find_like(const Settings& settings, const std::vector<support::SupportLayer>& layers,
                               const NearBelow& near, const std::vector<Regions>& areas) {
  std::map<Hint, std::vector<std::size_t>> known;  // firsts_
  like_.resize(layers.size());
  for (std::size_t k = 0; k < layers.size(); ++k)
    for (std::size_t r = 0; r < areas[k].size(); ++r) {
      auto& alike = known[hint_of(settings, layers[k], areas[k][r])];
      const auto same = std::find_if(alike.begin(), alike.end(), [&](std::size_t i) {
        const auto [layer, region] = firsts_[i];
        return areas[layer][region] == areas[k][r] &&
               (near.are_alike(layer, k) || near.around(layer, areas[k][r]) == near.around(k, areas[k][r]));
      });
      like_[k].push_back(same != alike.end() ? *same : firsts_.size());
      if (same != alike.end()) continue;
      alike.push_back(firsts_.size());
      firsts_.push_back({k, r});
    }
}

}  // namespace weft::pipeline
