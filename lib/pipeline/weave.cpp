// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/weave.h"

#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/offset.h"
#include "pipeline/area_pieces.h"
#include "tasks/parallel.h"

#include <algorithm>
#include <utility>

namespace weft::pipeline {
namespace {

/// What of each layer is inside of the object: as far off its outlines, upwards and downwards as well, as beams keep.
std::vector<Regions> hidden(const slice::InterlockStyle& style, const std::vector<slice::Cut>& layers) {
  const auto shrunk = tasks::parallel_map(layers.size(), [&](std::size_t i) {
    return geometry::offset(geometry::unite(layers[i].layer.regions), {.by = -style.avoidance * style.beam_width});
  });
  const auto reach = static_cast<std::size_t>(style.avoidance * style.beam_layers);
  return tasks::parallel_map(layers.size(), [&](std::size_t i) {
    if (i < reach || i + reach >= layers.size()) return Regions{};
    Regions out = shrunk[i];
    for (std::size_t k = i - reach; k <= i + reach && !out.empty(); ++k)
      if (k != i) out = geometry::intersect(out, shrunk[k]);
    return out;
  });
}

/// The areas of a layer, taken out of it, and what each is printed with.
class Pieces {
 public:
  Pieces(const Weave& how, Regions regions, const Areas& areas) : of_area_(std::move(regions), areas) {
    for (const Area& area : areas) tool_.push_back(how.tool.at(area.scope));
  }

  std::vector<ToolId> tools() const {
    auto out = tool_;
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
  }
  Regions of(ToolId tool) const {
    Regions out;
    for (std::size_t a = 0; a < of_area_.size(); ++a)
      if (tool_[a] == tool) out.insert(out.end(), of_area_[a].begin(), of_area_[a].end());
    return out;
  }
  /// What a tool gives away, and what it gets, which its largest area does.
  void change(ToolId tool, const Regions& given, const Regions& got) {
    Regions* largest = nullptr;
    double most = -1;
    for (std::size_t a = 0; a < of_area_.size(); ++a) {
      if (tool_[a] != tool) continue;
      if (const double mm2 = area_mm2(of_area_[a]); mm2 > most) most = mm2, largest = &of_area_[a];
      of_area_[a] = geometry::subtract(of_area_[a], given);
    }
    if (largest != nullptr) *largest = geometry::unite(*largest, got);
  }
  void put_back(Regions& regions, Areas& areas) && { std::move(of_area_).put_back(regions, areas); }

 private:
  AreaPieces of_area_;
  std::vector<ToolId> tool_;
};

void weave_layer(const Weave& how, std::size_t number, const Regions& may, Regions& regions, Areas& areas) {
  if (may.empty() || areas.size() < 2) return;
  stop_if_asked();
  Pieces pieces(how, std::move(regions), areas);
  const auto tools = pieces.tools();
  for (std::size_t i = 0; i < tools.size(); ++i)
    for (std::size_t k = i + 1; k < tools.size(); ++k) {
      const auto a = pieces.of(tools[i]), b = pieces.of(tools[k]);
      const auto [to_a, to_b] = slice::interlocked(how.style, number, a, b, may);
      if (to_a.empty() && to_b.empty()) continue;
      pieces.change(tools[i], to_b, geometry::intersect(to_a, b));
      pieces.change(tools[k], to_a, geometry::intersect(to_b, a));
    }
  std::move(pieces).put_back(regions, areas);
}

}  // namespace

std::optional<Weave> weave_of(const ObjectScopes& scopes, const Scopes& all) {
  const auto& l = all[scopes.front().of_mix.front()].layers;
  if (!l.interlocking_enable) return std::nullopt;
  Weave out{{l.interlocking_beam_width, l.interlocking_orientation, l.interlocking_beam_layer_count,
             l.interlocking_depth, l.interlocking_boundary_avoidance},
            {}};
  for (const auto& from : scopes)
    for (const ScopeId id : from.of_mix) out.tool[id] = tool_of(all[id].tools, Role::inner_wall, 1);
  return out;
}

void weave(const Weave& how, std::vector<slice::Cut>& layers, std::vector<Areas>& areas) {
  const auto may = hidden(how.style, layers);
  tasks::for_each_index(layers.size(),
                        [&](std::size_t i) { weave_layer(how, i, may[i], layers[i].layer.regions, areas[i]); });
}

}  // namespace weft::pipeline
