// SPDX-License-Identifier: GPL-3.0-or-later
#include "walls/pockets.h"

#include "geometry/boolean.h"
#include "geometry/offset.h"

#include <algorithm>
#include <utility>

namespace weft::walls {
namespace {

constexpr double sliver_um = 2;  // what is thinner is none

/// Rounding to microns would decide what is a pocket and what is not, differently for the mirror image of a part.
class FineLattice {
 public:
  FineLattice(const Region& region, Point origin) : origin_(origin) {
    constexpr Um finest = 1024;
    Box box = box_of(region.outer);
    box.add(origin);
    const Um size = std::max(box.size().x, box.size().y);
    while (scale_ < finest && size < max_coord / 4 / scale_) scale_ *= 2;
  }
  double scale() const { return scale_; }
  Point at(double x, double y) const { return {rounded(x * scale_), rounded(y * scale_)}; }
  Region of(const Region& region) const {
    Region out{of(region.outer), {}};
    for (const Ring& hole : region.holes) out.holes.push_back(of(hole));
    return out;
  }
  std::vector<Place> places(const Ring& ring) const {
    std::vector<Place> out;
    out.reserve(ring.size());
    for (const Point p : ring) out.push_back({p.x / scale(), p.y / scale()});
    return out;
  }

 private:
  Ring of(const Ring& ring) const {
    Ring out;
    out.reserve(ring.size());
    for (const Point p : ring) out.push_back({(p.x - origin_.x) * scale_, (p.y - origin_.y) * scale_});
    return out;
  }

  Point origin_;
  Um scale_ = 1;
};

void add_bands(const std::vector<Line::Vertex>& path, const FineLattice& lattice, std::vector<Ring>& out) {
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Line::Vertex &a = path[i - 1], &b = path[i];
    const Place way = unit(a.at, b.at);
    const auto corner = [&](const Line::Vertex& v, double side) {
      const double off = side * v.width / 2;
      return lattice.at(v.at.x - off * way.y, v.at.y + off * way.x);
    };
    out.push_back({corner(a, -1), corner(b, -1), corner(b, 1), corner(a, 1)});
  }
}

}  // namespace

std::vector<Pocket> pockets_of(const Region& region, Point origin, const std::vector<Line>& lines) {
  const FineLattice lattice(region, origin);
  std::vector<Ring> bands;
  for (const Line& line : lines) add_bands(line.path, lattice, bands);
  const Regions left = geometry::opening(geometry::subtract({lattice.of(region)}, geometry::regions_from_rings(bands)),
                                         rounded(sliver_um / 2 * lattice.scale()), geometry::Corner::miter);
  std::vector<Pocket> out;
  for (const Region& pocket : left)
    if (pocket.holes.empty())
      out.push_back({lattice.places(pocket.outer),
                     static_cast<double>(double_area(pocket.outer)) / 2 / (lattice.scale() * lattice.scale())});
  std::stable_sort(out.begin(), out.end(), [](const Pocket& a, const Pocket& b) { return a.area > b.area; });
  return out;
}

}  // namespace weft::walls
