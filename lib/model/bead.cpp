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

double length_mm(const Bead& bead) {
  double um = 0;
  for_each_segment(bead, [&](const Junction& a, const Junction& b) { um += distance(a.at, b.at); });
  return um / 1000.0;
}

double volume_mm3(const Bead& bead, Um height) {
  double um2 = 0;
  for_each_segment(bead, [&](const Junction& a, const Junction& b) {
    // The integral of the product of two linear functions over a segment.
    const double wa = a.width, wb = b.width, fa = static_cast<double>(a.flow), fb = static_cast<double>(b.flow);
    um2 += distance(a.at, b.at) * (2 * wa * fa + wa * fb + wb * fa + 2 * wb * fb) / 6.0;
  });
  return um2 / 1e6 * to_mm(height);
}

}  // namespace weft
