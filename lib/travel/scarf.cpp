// SPDX-License-Identifier: GPL-3.0-or-later
#include "travel/scarf.h"

#include <algorithm>
#include <cmath>

namespace weft::travel {
namespace {

Junction between(const Junction& a, const Junction& b, double t) {
  return {lerp(a.at, b.at, t), rounded(a.width + t * (static_cast<double>(b.width) - a.width)),
          a.flow + static_cast<float>(t) * (b.flow - a.flow)};
}

/// The path with junctions so close that the ramp may be printed at one rate of flow between them, and one at its end.
std::vector<Junction> split(const std::vector<Junction>& path, double seam_um, double piece_um, std::size_t& end) {
  std::vector<Junction> out{path.front()};
  double gone = 0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double step = distance(path[i - 1].at, path[i].at), inside = std::min(step, seam_um - gone);
    if (inside > 0) {
      const int pieces = std::max(1, static_cast<int>(std::ceil(inside / piece_um)));
      for (int k = 1; k <= pieces; ++k) {
        const double t = inside * k / pieces / step;
        out.push_back(t < 1 ? between(path[i - 1], path[i], t) : path[i]);
      }
      end = out.size() - 1;
    }
    if (inside < step) out.push_back(path[i]);
    gone += step;
  }
  return out;
}

}  // namespace

Scarf scarfed(const TravelSettings& settings, const std::vector<Junction>& path, Um height) {
  double whole = 0;
  for (std::size_t i = 1; i < path.size(); ++i) whole += distance(path[i - 1].at, path[i].at);
  const double seam_um = std::min<double>(settings.scarf_joint_seam_length, whole / 2);
  std::size_t end = 0;
  const auto fine = split(path, seam_um, settings.scarf_split_distance, end);
  Scarf out;
  const double from = settings.scarf_joint_seam_start_height_ratio / 100.0;
  double gone = 0;
  for (std::size_t i = 0; i <= end; ++i) {
    if (i > 0) gone += distance(fine[i - 1].at, fine[i].at);
    const double share = std::min(1.0, from + (1 - from) * gone / seam_um);
    Junction low = fine[i], high = fine[i];
    low.flow *= static_cast<float>(share);
    high.flow *= static_cast<float>(1 - share);
    out.ramp.push_back(low);
    out.below.push_back(rounded((1 - share) * height));
    out.cover.push_back(high);
  }
  out.body.assign(fine.begin() + static_cast<std::ptrdiff_t>(end), fine.end());
  return out;
}

}  // namespace weft::travel
