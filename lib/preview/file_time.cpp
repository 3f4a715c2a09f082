// SPDX-License-Identifier: GPL-3.0-or-later
#include "preview/file_time.h"

#include "audit/reader.h"
#include "core/number.h"
#include "core/stop.h"
#include "motion/arcs.h"
#include "motion/kinematics.h"
#include "preview/in_force.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft::preview {
namespace {

/// Moves are timed in stretches that begin and end at rest, of so many moves about.
constexpr std::size_t stretch = 100'000;

/// The seconds that a line `G4 P500` or `G4 S2` waits; 0: it is another.
double dwell_s(std::string_view line) {
  if (!line.starts_with("G4") || line.size() < 4 || line[2] != ' ') return 0;
  double seconds = 0;
  for (const auto& [word, unit] : {std::pair{'P', 0.001}, {'S', 1.0}})
    if (const auto at = line.find(word); at != std::string_view::npos) {
      const auto text = line.substr(at + 1);
      seconds += unit * as_number<double>(text.substr(0, text.find_first_of(" \t\r;"))).value_or(0);
    }
  return std::isfinite(seconds) ? std::clamp(seconds, 0.0, 1e6) : 0;
}

class Clock {
 public:
  explicit Clock(const Settings& settings)
      : settings_(settings),
        filament_mm2_(std::numbers::pi / 4 * to_mm(settings.material.filament_diameter) *
                      to_mm(settings.material.filament_diameter)) {}

  void line(const char* begin, const char* end) {
    stop_.step();
    reader_.line(begin, end);
    in_force_.line({begin, end});
    alone();
    if (const double s = dwell_s({begin, end}); s > 0) rest(s);
    for (const audit::Motion& motion : reader_.motions()) add(motion);
  }

  FileTime finish() {
    flush();
    return out_;
  }

 private:
  /// What the extruder does alone: both moves beside it rest.
  void alone() {
    const double mm = std::abs(reader_.pushed_alone() - pushed_) + std::abs(reader_.drawn_alone() - drawn_);
    pushed_ = reader_.pushed_alone(), drawn_ = reader_.drawn_alone();
    if (mm > 0 && reader_.speed_mm_s() > 0) rest(motion::extruder_seconds(mm, reader_.speed_mm_s(), settings_.machine));
  }
  void rest(double seconds) {
    motion::Move move;
    move.pause_s = seconds;
    moves_.push_back(move);
    if (moves_.size() >= stretch) flush();
  }

  void add(const audit::Motion& m) {
    constexpr double reach_mm = max_coord / 1000.0 - 1;
    if (!m.from_known || !m.x_known || !m.y_known || !m.judgeable || !(reader_.speed_mm_s() > 0)) return;
    const audit::Vec from = m.path.from, to = m.path.to;
    if (std::max({std::abs(from.x), std::abs(from.y), std::abs(to.x), std::abs(to.y), std::abs(m.z_to)}) > reach_mm)
      return;
    int pieces = 1;
    if (m.path.arc) {
      const double length_um = 1000 * audit::length_mm(m.path);
      const double chord_um =
          motion::chord_um(settings_.machine.firmware, settings_.gcode.arc_segment_length, 1000 * m.path.radius_mm);
      pieces = static_cast<int>(std::clamp(length_um / chord_um, 1.0, 1e6));
    }
    const double e_mm = m.e_mm / (m.volumetric ? filament_mm2_ : 1);
    audit::Vec last = from;
    for (int i = 1; i <= pieces; ++i) {
      const double t = static_cast<double>(i) / pieces;
      const audit::Vec next = i == pieces ? to : audit::at(m.path, t);
      const motion::Way way{next.x - last.x, next.y - last.y, (m.z_to - m.z_from) / pieces};
      if (auto move = motion::move_along(settings_.machine, way,
                                         {reader_.speed_mm_s(), acceleration(m.extrudes), e_mm / pieces}))
        moves_.push_back(*move), ++out_.moves;
      last = next;
    }
  }
  double acceleration(bool extrudes) const {
    const auto told = in_force_.acceleration_mm_s2(extrudes);
    return told > 0 ? told : settings_.speeds.acceleration_print;
  }

  void flush() {
    motion::seconds_of(settings_.machine, moves_, {}, seconds_);
    for (const double s : seconds_) out_.seconds += s;
    moves_.clear();
  }

  const Settings& settings_;
  double filament_mm2_;
  StopNowAndThen stop_{1000};
  audit::Reader reader_{{}};
  InForce in_force_;
  double pushed_ = 0, drawn_ = 0;
  std::vector<motion::Move> moves_;
  std::vector<double> seconds_;
  FileTime out_;
};

}  // namespace

FileTime time_of(std::string_view gcode, const Settings& settings) {
  Clock clock(settings);
  std::size_t at = 0;
  for (std::size_t end; (end = gcode.find('\n', at)) != std::string_view::npos; at = end + 1)
    clock.line(gcode.data() + at, gcode.data() + end);
  if (at < gcode.size()) {
    const std::string last = std::string(gcode.substr(at)) + '\n';
    clock.line(last.data(), last.data() + last.size() - 1);
  }
  return clock.finish();
}

}  // namespace weft::preview
