// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/plan_moves.h"

#include "audit/audit.h"
#include "pipeline/at_heights.h"
#include "pipeline/change_tool.h"
#include "pipeline/codec.h"
#include "pipeline/ironing.h"
#include "pipeline/lagging_tower.h"
#include "pipeline/rules_of_scopes.h"
#include "tasks/parallel.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace weft::pipeline {
namespace {

/// Where the start G-code leaves the nozzle, where the first travel must know it: round no-go areas and notches.
std::optional<Point> start_of(const Settings& settings) {
  const auto& m = settings.machine;
  const bool open = m.bed_exclude_areas.empty() && m.bed_shape != BedShape::polygon && m.machine_reach.size() <= 2;
  return open ? std::nullopt : audit::place_after(m, settings.gcode.machine_start_gcode);
}

/// Of all objects of a layer.
Regions over_air_of(travel::LayerInput& input) {
  Regions out;
  for (auto& object : input.objects) std::move(object.over_air.begin(), object.over_air.end(), std::back_inserter(out));
  return out;
}

/// Where each pass begins, as far as it is known: after another tool was loaded the nozzle may be anywhere,
/// and the way to the next object is one over all that stands (go_over).
std::vector<std::optional<Point>> starts_of(const MovesOf& of, const std::vector<travel::Prepared>& prepared,
                                            const std::vector<travel::Ordered>& ordered) {
  std::vector<std::optional<Point>> from(ordered.size());
  if (!from.empty()) from[0] = start_of(of.scopes[0]);
  for (std::size_t p = 1; p < ordered.size(); ++p) {
    from[p] = ordered[p - 1].end ? ordered[p - 1].end : from[p - 1];
    if (of.passes.passes[p].changes || prepared[p].input.time.comes_down) from[p].reset();
  }
  return from;
}

/// The passes of a layer one after the other, with the changes of the tool between them.
LayerPlan joined(const MovesOf& of, std::size_t layer, std::vector<LayerPlan> passes) {
  LayerPlan out = std::move(passes.front());
  for (std::size_t k = 0; k < passes.size(); ++k) {
    LayerPlan& own = k == 0 ? out : passes[k];
    const auto from = k > 0 ? place_behind(out) : std::nullopt;
    if (auto steps = change_before(of.passes, of.passes.begin[layer] + k, of.tools, out, from); !steps.empty())
      put_before(own, std::move(steps));
    if (k > 0)
      out.steps.insert(out.steps.end(), std::make_move_iterator(own.steps.begin()),
                       std::make_move_iterator(own.steps.end()));
  }
  pause_before(out, of.pauses[layer]);
  return out;
}

/// A layer on its way, in three steps: the first and the last of several layers at a time, the second in order.
class Mover {
 public:
  Mover(const MovesOf& of, std::vector<travel::Prepared> prepared, std::vector<travel::Ordered> ordered, MovesFor what)
      : of_(of),
        settings_(of.scopes[0]),
        what_(what),
        prepared_(std::move(prepared)),
        ordered_(std::move(ordered)),
        from_(starts_of(of, prepared_, ordered_)),
        rules_(rules_of(of.scopes)),
        strands_(strands_of(of.scopes)),
        contours_(contours_of(of.scopes)),
        departures_(prepared_.size()),
        figured_(what.with_figures ? layers() : 0),
        turns_(of.vases.empty() ? 0 : of.vases.back().end),
        spiral_(spiral_style(settings_.layers)),
        primes_(primes_after_ironing(of.scopes)) {
    if (of.tools.several())
      for (const auto& tool : of.tools.tools()) of_tools_.push_back(motion::rules_of(tool));
  }

  std::size_t layers() const { return of_.passes.begin.size() - 1; }

  /// Its ways, and what of it hangs or follows a surface.
  LayerPlan routed(std::size_t layer) {
    std::vector<LayerPlan> plans;
    for (std::size_t pass = of_.passes.begin[layer]; pass < of_.passes.begin[layer + 1]; ++pass)
      plans.push_back(routed_pass(layer, pass));
    return joined(of_, layer, std::move(plans));
  }

  struct Begun {
    LayerPlan plan;
    std::optional<Point3> start;
    ToolId loaded = any_tool;
  };
  /// What hangs on the layer before.
  Begun begun(std::size_t layer, LayerPlan plan) {
    const auto& passes = of_.passes;
    if (const Vase* vase = vase_at(of_.vases, layer)) {
      if (layer == vase->begin) spiral_ = travel::Spiral(spiral_style(settings_.layers));
      wind(*vase, layer, turns_[layer], spiral_, plan);
    }
    if (primes_) prime_after_ironing(of_.scopes, plan, owed_mm3_);
    const ToolId loaded = layer > 0 ? passes.passes[passes.begin[layer] - 1].tool : any_tool;
    if (plan.time.comes_down && at_) go_over(settings_.machine, of_.standing[layer], *at_, plan);
    if (plan.time.comes_down && passes.pad) leave_over(settings_.machine, of_.standing[layer], plan);
    Begun out{std::move(plan), at_, loaded};
    at_ = motion::start_after(out.plan, at_);
    return out;
  }

  /// Speeds and times.
  PackedLayer planned(std::size_t layer, Begun begun) const {
    const motion::AllRules all(rules_, of_tools_, begun.loaded);
    auto planned = motion::plan_layer(all, std::move(begun.plan), begun.start);
    const auto& plan = planned.plan;
    PackedLayer out{{plan.z, plan.height, plan.time, plan.scope}, {}, {}, planned.statistics};
    if (what_.with_figures) {
      out.figures = figured_[layer];
      out.figures->motion = motion::figures_of(all, plan, begun.start);
    }
    if (what_.use == PlanFor::figures) return out;
    if (!of_tools_.empty()) out.times = times_of(plan, std::move(planned.step_s));
    out.packed = encode(plan);
    out.digest = gcode::digest_of(settings_, plan);
    return out;
  }

  const std::vector<travel::Routed>& departures() const { return departures_; }

 private:
  LayerPlan routed_pass(std::size_t index, std::size_t pass) {
    auto layer = std::move(prepared_[pass]);
    travel::prepare_ways(settings_.travel, layer);
    const auto& retraction = of_.scopes[of_.tools.several() ? layer.input.scope : 0].retraction;
    auto routed = travel::route(settings_.travel, retraction, layer, ordered_[pass], from_[pass]);
    lower_tower(of_.passes.lag_of(index), routed.plan);
    if (vase_at(of_.vases, index) != nullptr) turns_[index] = wall_of(layer.input);
    auto over_air = over_air_of(layer.input);
    const Regions asked = what_.with_figures ? over_air : Regions{};
    overhangs::mark(strands_, std::move(over_air), routed.plan);
    if (what_.with_figures) {
      auto& figures = figured_[index];
      figures.unsupported_mm2 += area_mm2(asked);
      figures.longest_span_mm = std::max(figures.longest_span_mm, overhangs::longest_span_mm(asked, routed.plan));
    }
    if (!of_.standing_on.empty()) contour::follow(contours_, of_.standing_on, routed.plan);
    departures_[pass].departures = routed.departures;
    return std::move(routed.plan);
  }

  const MovesOf& of_;
  const Settings& settings_;
  MovesFor what_;
  std::vector<travel::Prepared> prepared_;
  std::vector<travel::Ordered> ordered_;
  std::vector<std::optional<Point>> from_;
  std::vector<motion::Rules> rules_, of_tools_;
  std::vector<overhangs::Strand> strands_;
  std::vector<contour::Rules> contours_;
  std::vector<travel::Routed> departures_;  // without their plans, which go on
  std::vector<FiguredLayer> figured_;
  std::vector<Bead> turns_;  // walls that become turns, by layer
  travel::Spiral spiral_;
  bool primes_;
  double owed_mm3_ = 0;  // after ironing
  std::optional<Point3> at_;
};

}  // namespace

void unpack_steps(std::string_view packed, LayerPlan& bare) {
  LayerPlan whole;
  decode(packed, whole);
  bare.steps = std::move(whole.steps);
}

std::vector<PackedLayer> plan_moves(const MovesOf& of, std::vector<travel::Prepared> prepared,
                                    std::vector<travel::Ordered> ordered, Notices& notices, MovesFor what) {
  Mover mover(of, std::move(prepared), std::move(ordered), what);
  auto packed = tasks::parallel_linked(
      mover.layers(), [&](std::size_t i) { return mover.routed(i); },
      [&](std::size_t i, LayerPlan plan) { return mover.begun(i, std::move(plan)); },
      [&](std::size_t i, Mover::Begun begun) { return mover.planned(i, std::move(begun)); });
  for (auto& notice : travel::notices_of(mover.departures())) notices.push_back(std::move(notice));
  return packed;
}

}  // namespace weft::pipeline
