// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/fill_support.h"

#include "core/stop.h"
#include "geometry/spatial_index.h"
#include "geometry/touching.h"
#include "model/flow.h"
#include "pipeline/layer_plastic.h"
#include "pipeline/rungs_below.h"
#include "pipeline/support_beads.h"
#include "pipeline/support_columns.h"
#include "support/column_steps.h"
#include "support/lengths.h"
#include "tasks/parallel.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <span>
#include <utility>

namespace weft::pipeline {
namespace {

void append(Regions& to, const Regions& more) {
  to.insert(to.end(), more.begin(), more.end());
}

/// Fills layers that know what they lie on.
class Layers {
 public:
  Layers(const Settings& settings, const std::vector<support::SupportLayer>& layers, Point origin)
      : settings_(settings),
        layers_(layers),
        origin_(origin),
        line_(support::line_width(settings.support, settings.machine.nozzle_diameter)),
        span_(support::roof_span(settings.machine.nozzle_diameter)),
        between_feet_(support::between_feet(settings.machine.nozzle_diameter)),
        shares_(shares_of_columns(settings)),
        near_(settings, layers, shares_, origin),
        reach_(shares_.shares.size() < 2
                   ? span_
                   : std::max(span_, support::line_distance(settings.support.support_pattern, shares_.band,
                                                            shares_.shares.back()))) {
    for (const auto& layer : layers) tallest_ = std::max(tallest_, layer.height);
    if (settings.support.support_wall_count.value_or(0) == 0)
      columns_.emplace(settings, layers, near_, origin);
    else
      walled_ = tasks::parallel_map(layers.size(),
                                    [&](std::size_t k) { return fill_walled_columns(to_fill(k), near_.on(k)); });
    under_roof_ = tasks::parallel_map(layers.size(), [&](std::size_t k) { return fill_under_roof(to_fill(k)); });
    outlines_ = tasks::parallel_map(layers.size(), [&](std::size_t k) {
      Regions all = layers[k].columns;
      append(all, layers[k].branches), append(all, layers[k].roof);
      append(all, layers[k].under_roof), append(all, layers[k].bottom);
      append(all, layers[k].joists.area);
      return geometry::joined(all);
    });
  }

  std::vector<PrintedLayer> filled() && {
    auto filled = tasks::parallel_map(layers_.size(), [&](std::size_t k) {
      return fill_support_layer(to_fill(k), columns_of(k), {.below = beneath_roof(k), .above = upon_feet(k)});
    });
    const auto hollow = tasks::parallel_map(layers_.size(), [&](std::size_t k) { return hang_of_columns(k); });
    std::vector<std::vector<Point>> hang_above(layers_.size());
    for (std::size_t k = 0; k < layers_.size(); ++k)
      for (const std::vector<Point>* at : {&std::as_const(filled[k].hang_at), &hollow[k]})
        if (!at->empty())
          for (const std::size_t j : below(k)) hang_above[j].insert(hang_above[j].end(), at->begin(), at->end());
    const std::vector<Beads> rungs = rungs_for(hang_above, filled);
    return tasks::parallel_map(layers_.size(), [&](std::size_t k) {
      std::copy(rungs[k].begin(), rungs[k].end(), std::back_inserter(filled[k].beads));
      return printed(k, std::move(filled[k].beads));
    });
  }

 private:
  SupportToFill to_fill(std::size_t k) const { return {settings_, layers_[k], origin_}; }
  Beads columns_of(std::size_t k) const {
    Beads out = columns_ ? columns_->of(k) : walled_[k];
    out.insert(out.end(), under_roof_[k].begin(), under_roof_[k].end());
    return out;
  }
  /// The layers that one lies on, also where it must sag by half its height for that.
  std::vector<std::size_t> below(std::size_t k) const {
    const Um bottom = layers_[k].z - layers_[k].height, low = bottom - layers_[k].height / 2;
    std::vector<std::size_t> out;
    for (std::size_t j = k; j-- > 0 && layers_[j].z >= low;)
      if (layers_[j].z <= bottom) out.push_back(j);
    return out;
  }
  /// What a layer lies on that has a roof, but where that is the same as below.
  LayerPlastic beneath_roof(std::size_t k) const {
    const support::SupportLayer& layer = layers_[k];
    if (layer.roof.empty() && layer.bottom.empty()) return {};
    for (const std::size_t j : below(k))
      if (layers_[j].roof == layer.roof && layers_[j].bottom == layer.bottom) return {};
    return beneath(k);
  }
  LayerPlastic beneath(std::size_t k) const { return plastic_of(below(k)); }
  /// What lies on a layer that has feet.
  LayerPlastic upon_feet(std::size_t k) const {
    if (layers_[k].feet.empty()) return {};
    std::vector<std::size_t> above;
    for (std::size_t j = k + 1; j < layers_.size() && layers_[j].z <= layers_[k].z + tallest_ * 3 / 2; ++j)
      if (const auto on = below(j); std::find(on.begin(), on.end(), k) != on.end()) above.push_back(j);
    return plastic_of(above);
  }
  /// What is laid in layers, but for rungs.
  LayerPlastic plastic_of(const std::vector<std::size_t>& layers) const {
    Regions areas;
    Beads beads;
    for (const std::size_t j : layers) {
      const support::SupportLayer& layer = layers_[j];
      for (const Regions* some : {&layer.roof, &layer.bottom, &layer.branches, &layer.joists.area})
        append(areas, *some);
      Beads more = columns_of(j);
      std::move(more.begin(), more.end(), std::back_inserter(beads));
      for (const auto* lines : {&layer.joists.lines, &layer.joists.after})
        for (const Polyline& line : *lines) {
          Bead& bead = beads.emplace_back();
          for (Point p : line) bead.path.push_back({p, 0, 1.F});
        }
    }
    return {areas, beads, line_};
  }
  /// Where columns hang that are not the same as below, and what roofs lie on.
  std::vector<Point> hang_of_columns(std::size_t k) const {
    const auto under = below(k);
    if (under.empty()) return {};
    auto [beads, lines] = columns_ ? columns_->unlike(k, under.front()) : SupportColumns::Unlike{};
    beads.insert(beads.end(), under_roof_[k].begin(), under_roof_[k].end());
    if (beads.empty() && lines.empty()) return {};
    const LayerPlastic on = beneath(k);
    auto out = on.hanging(beads, span_).at;
    // Lines get longer and shorter from level to level: their ends hold on to the rest, a whole new one does not.
    const auto of_lines = on.hanging(lines, span_, 2 * span_).at;
    out.insert(out.end(), of_lines.begin(), of_lines.end());
    // Where a step begins all of them are new: what crosses from one of fewer lines to the next lies, no loose end
    // does.
    const Regions begun = near_.begun(k, under.front());
    if (begun.empty()) return out;
    const geometry::SegmentIndex there(begun);
    for (const Point p : on.hanging(lines, between_feet_).at)
      if (there.region_at(p)) out.push_back(p);
    return out;
  }
  /// Of a layer: all that rungs may lie in, and of that what those that were laid were told.
  struct Rungs {
    Regions all;
    std::vector<std::size_t> told;
    std::optional<RungsBelow> laid;
  };
  /// @param hang    of each layer places where beads above it hang
  /// @param filled  what each has laid: rungs end on that
  std::vector<Beads> rungs_for(const std::vector<std::vector<Point>>& hang,
                               const std::vector<SupportBeads>& filled) const {
    // Side by side as far as it is known what hangs; what hangs at ends of brackets is known from above.
    auto rungs = tasks::parallel_map(layers_.size(), [&](std::size_t k) {
      return hang[k].empty() ? Rungs{} : rungs_on(k, filled[k].beads, hang[k], between_beads(k));
    });
    std::vector<std::vector<Point>> ends(layers_.size());  // of brackets that hang
    for (std::size_t k = layers_.size(); k-- > 0;) {
      if (hang[k].empty() && ends[k].empty()) continue;
      stop_if_asked();
      if (!rungs[k].laid) rungs[k].all = between_beads(k);
      std::vector<Point> asked = hang[k];
      asked.insert(asked.end(), ends[k].begin(), ends[k].end());
      if (!rungs[k].laid || near_to(asked, rungs[k].all) != rungs[k].told)
        rungs[k] = rungs_on(k, filled[k].beads, asked, std::move(rungs[k].all));
      const auto more = rungs[k].laid->brackets(hang[k], ends[k]);
      for (const std::size_t j : below(k)) ends[j].insert(ends[j].end(), more.begin(), more.end());
    }
    std::vector<Beads> out(layers_.size());
    for (std::size_t k = 0; k < layers_.size(); ++k) {
      if (!rungs[k].laid) continue;
      stop_if_asked();
      Beads under;
      for (const std::size_t j : below(k)) under.insert(under.end(), out[j].begin(), out[j].end());
      out[k] = std::move(*rungs[k].laid).rungs(hang[k], under);
      if (const auto tool = settings_.support.support_infill_extruder_nr)
        for (Bead& rung : out[k]) rung.tool = static_cast<ToolId>(*tool);
    }
    return out;
  }
  /// Indices of the regions that rungs may lie in which hold places: none is further from them than brackets reach.
  std::vector<std::size_t> near_to(const std::vector<Point>& asked, const Regions& all) const {
    std::vector<std::size_t> out;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Box reached = box_of(all[i].outer).grown(reach_);
      if (std::any_of(asked.begin(), asked.end(), [&](Point p) { return reached.contains(p); })) out.push_back(i);
    }
    return out;
  }
  /// A bead holds itself one height out at 45°, and no further than it lies on the one below by a third of its width.
  /// Where lines are further apart brackets are longer, and the lowest of each lies on its root by half of itself.
  /// @param asked  places where something hangs
  Rungs rungs_on(std::size_t k, const Beads& beads, const std::vector<Point>& asked, Regions all) const {
    const Um height = layers_[k].height, step = std::min(height, line_ * 2 / 3);
    Rungs out{std::move(all), {}, std::nullopt};
    out.told = near_to(asked, out.all);
    Regions between;
    for (const std::size_t i : out.told) between.push_back(out.all[i]);
    out.laid.emplace(beads, between, beneath(k),
                     RungStyle{.span = span_,
                               .out = reach_,
                               .line = line_,
                               .band = flow::band(line_, height),
                               .step = step,
                               .stub = shares_.shares.size() < 2 ? step + line_ : line_});
    return out;
  }
  /// What rungs may lie in.
  Regions between_beads(std::size_t k) const {
    const support::SupportLayer& layer = layers_[k];
    if (layer.branches.empty() && layer.joists.area.empty()) return outlines_[k];
    Regions area = layer.columns;
    append(area, layer.roof), append(area, layer.under_roof), append(area, layer.bottom);
    return geometry::joined(area);
  }
  PrintedLayer printed(std::size_t k, Beads beads) {
    PrintedLayer out;
    out.z = layers_[k].z, out.height = layers_[k].height, out.beads = std::move(beads);
    out.outline = std::move(outlines_[k]);
    if (out.outline.size() > 1) {
      const geometry::SegmentIndex index(out.outline);
      for (auto& bead : out.beads)
        bead.part = static_cast<std::uint32_t>(index.region_at(bead.path.front().at).value_or(0));
    }
    return out;
  }

  const Settings& settings_;
  const std::vector<support::SupportLayer>& layers_;
  Point origin_;
  Um line_, span_;
  Um between_feet_;
  Um tallest_ = 0;  ///< of the layers' heights
  ColumnShares shares_;
  NearBelow near_;
  Um reach_;                               ///< from a column's lines to where they end above
  std::optional<SupportColumns> columns_;  ///< without walls
  std::vector<Beads> walled_;              ///< columns with walls, by layer
  std::vector<Beads> under_roof_;          ///< by layer
  std::vector<Regions> outlines_;          ///< of all that each layer covers
};

}  // namespace

std::vector<PrintedLayer> fill_support(const Settings& settings, const std::vector<support::SupportLayer>& layers,
                                       Point origin) {
  return Layers(settings, layers, origin).filled();
}

}  // namespace weft::pipeline
