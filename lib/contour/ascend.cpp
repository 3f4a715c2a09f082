// SPDX-License-Identifier: GPL-3.0-or-later
#include "contour/ascend.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace weft::contour {
namespace {

/// What rises by less across a nozzle is level.
constexpr double level = 0.01;

/// Mean height of the surface over a bead, and whether it slopes anywhere there.
struct Lie {
  double z_um = 0;
  bool slopes = false;
};
Lie lie_of(const Surface& surface, AtHeight at, const Bead& bead) {
  Lie out;
  int found = 0;
  const double low = at.z - at.height, high = at.z + at.height / 2.0;
  for (std::size_t i = 0; i + 1 < bead.path.size(); ++i)
    for (const double t : {0.0, 0.5, 1.0})
      if (const auto here = surface.between(lerp(bead.path[i].at, bead.path[i + 1].at, t), low, high)) {
        out.z_um += here->z_um, ++found;
        out.slopes = out.slopes || here->slope > level;
      }
  out.z_um = found > 0 ? out.z_um / found : at.z;
  return out;
}

/// Is the piece from junction i on a line, and no turn from one to the next?
bool is_line(const Bead& bead, std::size_t i) {
  constexpr double turns_up_to = 2;  // widths
  return distance(bead.path[i].at, bead.path[i + 1].at) > turns_up_to * bead.path[i].width;
}

/// The lines of a bead, each with the turn behind it.
Beads parted(const Bead& bead) {
  Beads out;
  Bead line = bead;
  line.path = {bead.path.front()};
  bool has_line = false;
  for (std::size_t i = 0; i + 1 < bead.path.size(); ++i) {
    if (is_line(bead, i)) {
      if (has_line && i > 0 && !is_line(bead, i - 1)) {  // a turn lies between
        out.push_back(line);
        line.path = {bead.path[i]};
      }
      has_line = true;
    }
    line.path.push_back(bead.path[i + 1]);
  }
  out.push_back(std::move(line));
  return out;
}

}  // namespace

void ascend(const Surface& surface, AtHeight at, Beads& beads) {
  for (std::size_t begin = 0; begin < beads.size();) {
    std::size_t end = begin + 1;
    const Bead& first = beads[begin];
    while (end < beads.size() && beads[end].role == first.role && beads[end].sequence == first.sequence &&
           beads[end].part == first.part)
      ++end;
    if (first.role != Role::top_skin || first.sequence == 0) {
      begin = end;
      continue;
    }
    std::vector<std::pair<double, Bead>> lines;
    bool slopes = false;
    for (std::size_t i = begin; i < end; ++i)
      for (Bead& line : parted(beads[i])) {
        const Lie lie = lie_of(surface, at, line);
        slopes = slopes || lie.slopes;
        lines.emplace_back(lie.z_um, std::move(line));
      }
    if (slopes) {
      std::stable_sort(lines.begin(), lines.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
      Beads sorted;
      for (auto& [z, line] : lines) sorted.push_back(std::move(line));
      const auto to = beads.erase(beads.begin() + static_cast<std::ptrdiff_t>(begin),
                                  beads.begin() + static_cast<std::ptrdiff_t>(end));
      beads.insert(to, std::make_move_iterator(sorted.begin()), std::make_move_iterator(sorted.end()));
      end = begin + lines.size();
    }
    begin = end;
  }
}

}  // namespace weft::contour
