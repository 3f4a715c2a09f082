// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/bead.h"

namespace weft {
namespace {
template <class F>
void for_each_segment(const Bead& bead, F f) {
  const auto& path = bead.path;
  for (std::size_t i = 1; i < path.size(); ++i) f(path[i - 1], path[i]);
  if (bead.closed && path.size() > 1) f(path.back(), path.front());
}
}  // namespace

Box box_of(const Bead& bead) {
  Box box;
  for (const Junction& j : bead.path) box.add(j.at);
  return box;
}

double length_mm(const Bead& bead) {
  double um = 0;
  for_each_segment(bead, [&](const Junction& a, const Junction& b) { um += distance(a.at, b.at); });
  return um / 1000.0;
}

double volume_mm3(const Bead& bead, Um height) {
  double um_mm2 = 0;
  for_each_segment(bead, [&](const Junction& a, const Junction& b) {
    um_mm2 += distance(a.at, b.at) * mean_area_mm2(a, b, to_mm(height));
  });
  return um_mm2 / 1000.0;
}

}  // namespace weft
