// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/swap_filament.h"

#include "settings/tools.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft::pipeline {
namespace {

/// Each number of filament_ramming_parameters holds for so long.
constexpr double ramming_step_s = 0.25;
/// Drawn out at once, before the melt can follow.
constexpr double at_once_mm = 15;
/// From the tube to where filament waits.
constexpr double parking_mm_s = 2000.0 / 60;
/// Loading stops so often to go on along the tower: what comes out then is no blob.
constexpr double load_piece_mm = 5;

/// Moves of filament, between which the nozzle goes to and fro along a line, a step each.
class Feeding {
 public:
  Feeding(const Along& along, Um z) : z_(z) {
    if (!along) return;
    const auto [a, b] = *along;
    for (int i = 0; i <= pieces; ++i)
      spots_.push_back(
          {a.x + rounded((b.x - a.x) * i / double{pieces}), a.y + rounded((b.y - a.y) * i / double{pieces})});
  }

  void feed(double mm, double mm_s) {
    if (mm != 0) out_.emplace_back(Feed{mm, std::abs(mm) / mm_s, false, {}, 0});
  }
  void wait(double s) {
    if (s > 0) out_.emplace_back(Feed{0, s, false, {}, 0});
  }
  void step() {
    if (spots_.empty()) return;
    if (at_ + way_ < 0 || at_ + way_ >= static_cast<int>(spots_.size())) way_ = -way_;
    at_ += way_;
    const Point to = spots_[static_cast<std::size_t>(at_)];
    out_.emplace_back(Travel{.path = {{to.x, to.y, z_}}});
  }
  std::vector<Step> take() && { return std::move(out_); }

 private:
  static constexpr int pieces = 10;
  Um z_;
  std::vector<Point> spots_;
  int at_ = -1, way_ = 1;
  std::vector<Step> out_;
};

}  // namespace

std::vector<Rammed> ramming_of(const ToolSettings& tool) {
  std::vector<Rammed> out;
  for (const double mm3_s : ramming_flows(tool.filament_ramming_parameters)) out.push_back({mm3_s, ramming_step_s});
  return out;
}

double volume_of(const std::vector<Rammed>& rammed) {
  double sum = 0;
  for (const auto& [mm3_s, seconds] : rammed) sum += mm3_s * seconds;
  return sum;
}

std::vector<Step> lay_rammed(const Settings& tool, const Bead& line, Um height, bool shared) {
  const auto& t = tool.tools;
  const double flow = t.filament_multitool_ramming_flow;
  const auto rammed = shared ? ramming_of(t) : std::vector<Rammed>{{flow, t.filament_multitool_ramming_volume / flow}};
  std::vector<Step> out;
  const double d = to_mm(tool.material.filament_diameter), area_mm2 = std::numbers::pi / 4 * d * d;
  const Um width = line.path.front().width;
  const double bead_mm2 = to_mm(width) * to_mm(height);
  std::size_t next = 1;
  bool back = false;
  Point at = line.path.front().at;
  for (const auto& [mm3_s, seconds] : rammed) {
    double left_um = 1000 * mm3_s * seconds / bead_mm2;
    while (left_um >= 1) {
      const Point to = line.path[next].at;
      const double um = distance(at, to);
      const double share = um > left_um ? left_um / um : 1;
      const Point stop{at.x + rounded((to.x - at.x) * share), at.y + rounded((to.y - at.y) * share)};
      const double mm3 = std::min(um, left_um) / 1000 * bead_mm2;
      if (stop != at) out.emplace_back(Feed{mm3 / area_mm2, mm3 / mm3_s, true, stop, width});
      at = stop;
      if (share < 1) break;
      left_um -= um;
      if (next + 1 == line.path.size()) back = true;
      if (next == 0) back = false;
      next = back ? next - 1 : next + 1;
    }
  }
  return out;
}

std::vector<Step> unload(const Settings& tool, const Along& along, Um z) {
  const auto& t = tool.tools;
  Feeding out(along, z);
  const double tube = to_mm(t.cooling_tube_length), middle = to_mm(t.cooling_tube_retraction);
  const double rest = std::max(0.0, middle + tube / 2 - at_once_mm);
  out.feed(-at_once_mm, t.filament_unloading_speed_start);
  out.feed(-0.7 * rest, t.filament_unloading_speed);
  out.feed(-0.2 * rest, 0.5 * t.filament_unloading_speed);
  out.feed(-0.1 * rest, 0.3 * t.filament_unloading_speed);
  const double stamp = to_mm(t.filament_stamping_distance) + tube / 2;  // from where cooling moves begin and end
  const int moves = t.filament_cooling_moves;
  for (int i = 0; i < 2 * moves; ++i) {
    const double share = moves > 0 ? i / (2.0 * moves - 1) : 0;
    const double speed =
        t.filament_cooling_initial_speed + share * (t.filament_cooling_final_speed - t.filament_cooling_initial_speed);
    if (i % 2 == 0 && i > 0 && t.filament_stamping_distance > 0) {
      out.step();
      out.feed(stamp, t.filament_stamping_loading_speed);
      out.step();
      out.feed(-stamp, t.filament_unloading_speed);
    }
    out.step();
    out.feed(i % 2 == 0 ? tube : -tube, speed);
  }
  out.feed(at_once_mm + rest - to_mm(t.parking_pos_retraction), parking_mm_s);
  out.wait(t.filament_toolchange_delay);
  return std::move(out).take();
}

std::vector<Step> load(const Settings& tool, const Along& along, Um z) {
  const auto& t = tool.tools;
  Feeding out(along, z);
  const double mm = to_mm(t.parking_pos_retraction + t.extra_loading_move);
  struct Part {
    double share, mm_s;
  };
  for (const auto& [share, mm_s] : {Part{0.2, t.filament_loading_speed_start}, Part{0.7, t.filament_loading_speed},
                                    Part{0.1, 0.1 * t.filament_loading_speed}}) {
    const int pieces = !along ? 1 : std::max(1, static_cast<int>(std::abs(share * mm) / load_piece_mm));
    for (int i = 0; i < pieces; ++i) out.step(), out.feed(share * mm / pieces, mm_s);
  }
  return std::move(out).take();
}

}  // namespace weft::pipeline
