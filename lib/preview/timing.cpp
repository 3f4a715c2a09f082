// SPDX-License-Identifier: GPL-3.0-or-later
#include "preview/timing.h"

#include "motion/kinematics.h"
#include "tasks/tasks.h"

#include <algorithm>
#include <cmath>

namespace weft::preview {
namespace {

/// What the axes let through of a speed along (ux, uy, uz).
double bounded_speed(const MachineSettings& machine, double speed, double ux, double uy, double uz) {
  const auto bound = [&speed](double part, double most) {
    if (part != 0) speed = std::min(speed, most / std::abs(part));
  };
  bound(ux, machine.machine_max_speed_x), bound(uy, machine.machine_max_speed_y),
      bound(uz, machine.machine_max_speed_z);
  return speed;
}

motion::Move move_of(const MachineSettings& machine, const Stroke& stroke, Um z_from) {
  motion::Move move;
  const double dx = to_mm(stroke.to.x - stroke.from.x), dy = to_mm(stroke.to.y - stroke.from.y),
               dz = to_mm(stroke.z - z_from);
  const double length = std::sqrt(dx * dx + dy * dy + dz * dz);
  if (length == 0 || !(stroke.speed_mm_s > 0)) return move;
  move.length_mm = length;
  move.ux = dx / length, move.uy = dy / length, move.uz = dz / length;
  move.speed_mm_s = bounded_speed(machine, static_cast<double>(stroke.speed_mm_s), move.ux, move.uy, move.uz);
  const double least = std::min(machine.machine_max_acceleration_x, machine.machine_max_acceleration_y);
  const double asked = stroke.acceleration_mm_s2 > 0 ? stroke.acceleration_mm_s2 : least;
  move.acceleration_mm_s2 = move.ux == 0 && move.uy == 0 ? std::min(asked, machine.machine_max_acceleration_z) : asked;
  return move;
}

void set_seconds(PathLayer& layer, Um z, const MachineSettings& machine) {
  std::vector<motion::Move> moves;
  std::vector<std::size_t> strokes;  // of each move
  moves.reserve(layer.strokes.size());
  std::size_t event = 0;
  for (std::size_t i = 0; i < layer.strokes.size(); ++i) {
    for (; event < layer.events.size() && layer.events[event].stroke <= i; ++event) {
      motion::Move rest;  // the nozzle stands still
      rest.pause_s = static_cast<double>(layer.events[event].seconds);
      moves.push_back(rest), strokes.push_back(layer.strokes.size());
    }
    auto& stroke = layer.strokes[i];
    const auto move = move_of(machine, stroke, z);
    z = stroke.z;
    stroke.seconds = 0;
    if (move.length_mm > 0) moves.push_back(move), strokes.push_back(i);
  }
  std::vector<double> seconds;
  motion::seconds_of(machine, moves, {}, seconds);
  for (std::size_t i = 0; i < moves.size(); ++i)
    if (strokes[i] < layer.strokes.size()) layer.strokes[strokes[i]].seconds = static_cast<float>(seconds[i]);
}

}  // namespace

void set_seconds(Toolpaths& paths, const MachineSettings& machine) {
  std::vector<Um> z(paths.layers.size(), 0);  // where each begins
  for (std::size_t i = 1; i < z.size(); ++i)
    z[i] = paths.layers[i - 1].strokes.empty() ? z[i - 1] : paths.layers[i - 1].strokes.back().z;
  tasks::for_each_index(paths.layers.size(), [&](std::size_t i) { set_seconds(paths.layers[i], z[i], machine); });
}

double seconds_of(const PathLayer& layer) {
  double sum = 0;
  for (const auto& stroke : layer.strokes) sum += static_cast<double>(stroke.seconds);
  for (const auto& event : layer.events) sum += static_cast<double>(event.seconds);
  return sum;
}

}  // namespace weft::preview
