// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/figures.h"

#include "model/flow.h"
#include "model/moves.h"
#include "motion/kinematics.h"
#include "motion/speeds.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft::motion {
namespace {

constexpr Um thin_square = 5000;

std::uint64_t cell_at(double x, double y, Um size) {
  const auto index = [&](double v) {
    return static_cast<std::uint32_t>(static_cast<std::int32_t>(std::floor(v / size)));
  };
  return std::uint64_t{index(y)} << 32 | index(x);
}

/// Which cells were printed on when.
class Cells {
 public:
  /// @param x, y where the move begins, µm
  void add(double x, double y, const Move& move, double from_s, double seconds) {
    const double length = 1000 * move.length_mm;
    const int looks = std::max(1, static_cast<int>(std::ceil(2 * length / CellTime::size)));
    for (int k = 0; k <= looks; ++k) {
      const double t = static_cast<double>(k) / looks;
      const auto time = static_cast<float>(from_s + t * seconds);
      const auto cell = cell_at(x + t * length * move.ux, y + t * length * move.uy, CellTime::size);
      const auto [known, is_new] = times_.try_emplace(cell, CellTime{cell, time, time});
      if (!is_new) known->second.last_s = std::max(known->second.last_s, time);
    }
  }
  std::vector<CellTime> take() const {
    std::vector<CellTime> out;
    out.reserve(times_.size());
    for (const auto& [cell, time] : times_) out.push_back(time);
    return out;
  }

 private:
  std::map<std::uint64_t, CellTime> times_;
};

/// Walls below 0.8 nozzle diameters or half their flow.
void look_at_walls(const AllRules& all, const LayerPlan& layer, LayerFigures& out) {
  std::map<std::uint64_t, ThinPlace> places;
  for (const Step& step : layer.steps) {
    const auto* bead = std::get_if<Extrude>(&step);
    if (bead == nullptr || !is_wall(bead->role) || !bead->below.empty()) continue;
    const Um narrow = of_scope(all, bead->scope).machine.nozzle_diameter * 8 / 10;
    for (std::size_t i = 1; i < bead->path.size(); ++i) {
      const Junction &a = bead->path[i - 1], &b = bead->path[i];
      if (flow::line_width((a.width + b.width) / 2, bead->height) >= narrow && a.flow + b.flow >= 1.F) continue;
      const double mm = distance(a.at, b.at) / 1000;
      out.thin_mm += mm;
      places.try_emplace(cell_at(a.at.x, a.at.y, thin_square), ThinPlace{a.at, 0}).first->second.mm += mm;
    }
  }
  for (const auto& [cell, place] : places) out.thin.push_back(place);
}

/// How often F changes from one printed move to the next.
void look_at_speeds(const LayerPlan& layer, LayerFigures& out) {
  double before = 0;
  for (const Step& step : layer.steps) {
    const auto* bead = std::get_if<Extrude>(&step);
    if (bead == nullptr) continue;
    for (std::size_t i = 1; i < bead->path.size(); ++i) {
      const double v =
          bead->segment_speed_mm_s.empty() ? bead->speed_mm_s : static_cast<double>(bead->segment_speed_mm_s[i - 1]);
      out.printed_mm += distance(bead->path[i - 1].at, bead->path[i].at) / 1000;
      if (before != 0 && v != before) ++out.speed_changes;
      before = v;
    }
  }
}

/// Where the first move of a layer begins.
Point first_place(const LayerPlan& layer, std::optional<Point3> start) {
  if (start) return flat(*start);
  for (const Step& step : layer.steps) {
    if (const auto* travel = std::get_if<Travel>(&step); travel != nullptr && !travel->path.empty())
      return flat(travel->path.front());
    if (const auto* bead = std::get_if<Extrude>(&step); bead != nullptr && !bead->path.empty())
      return bead->path.front().at;
  }
  return {};
}

/// The mean of the fan over the layer's time.
double mean_fan(const LayerPlan& layer, const std::vector<double>& step_s) {
  double share = 0, sum = 0, all = 0;
  for (std::size_t i = 0; i < layer.steps.size(); ++i) {
    if (const auto* fan = std::get_if<SetFan>(&layer.steps[i])) share = fan->share;
    sum += share * step_s[i], all += step_s[i];
  }
  return all > 0 ? sum / all : share;
}

}  // namespace

LayerFigures figures_of(const AllRules& all, const LayerPlan& layer, std::optional<Point3> start) {
  LayerFigures out;
  const Rules& rules = of_scope(all, layer.scope);
  const auto moves = moves_of(all, layer, start, rules.machine);
  std::vector<double> seconds, steady;
  seconds_of(rules.machine, moves, {}, seconds, &steady);
  const double diameter_mm = to_mm(rules.material.filament_diameter);
  const double filament_mm2 = std::numbers::pi / 4 * diameter_mm * diameter_mm;
  const double limit = 0.99 * rules.material.material_max_volumetric_speed;
  std::vector<double> step_s(layer.steps.size());
  Cells cells;
  const Point begin = first_place(layer, start);
  double now = 0, x = begin.x, y = begin.y;
  for (std::size_t i = 0; i < moves.size(); ++i) {
    const Move& move = moves[i];
    step_s[move.step] += seconds[i];
    if (move.length_mm > 0) out.moving_s += seconds[i], out.accelerating_s += seconds[i] - steady[i];
    if (move.prints && move.e_per_mm > 0 && seconds[i] > 0) {
      const double mm3_s = move.e_per_mm * move.length_mm * filament_mm2 / seconds[i];
      const auto bin = static_cast<std::size_t>(mm3_s);
      if (out.flow_s.size() <= bin) out.flow_s.resize(bin + 1);
      out.flow_s[bin] += seconds[i];
      if (mm3_s >= limit) out.at_limit_s += seconds[i];
      const auto* bead = std::get_if<Extrude>(&layer.steps[move.step]);
      if (bead != nullptr && bead->role == Role::outer_wall)
        out.outer_wall_mm[static_cast<int>(std::lround(100 * std::log(move.length_mm / seconds[i])))] += move.length_mm;
      cells.add(x, y, move, now, seconds[i]);
    }
    now += seconds[i];
    x += 1000 * move.length_mm * move.ux, y += 1000 * move.length_mm * move.uy;
  }
  out.cells = cells.take();
  out.fan = mean_fan(layer, step_s);
  look_at_walls(all, layer, out);
  look_at_speeds(layer, out);
  return out;
}

}  // namespace weft::motion
