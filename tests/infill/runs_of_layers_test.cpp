// SPDX-License-Identifier: GPL-3.0-or-later
#include "areas.h"
#include "geometry/boolean.h"
#include "geometry/offset.h"
#include "infill/shells.h"

#include <random>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::test;

namespace {

bool same(const infill::LayerAreas& a, const infill::LayerAreas& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const infill::PartAreas& x, const infill::PartAreas& y) {
    return x.part == y.part && x.top == y.top && x.solid == y.solid && x.sparse == y.sparse && x.belted == y.belted &&
           std::equal(x.bridges.begin(), x.bridges.end(), y.bridges.begin(), y.bridges.end(),
                      [](const auto& p, const auto& q) { return p.regions == q.regions; });
  });
}

}  // namespace

TEST_CASE("shells: what a layer is does not depend on the layers that are looked at with it", "[infill][law]") {
  // Parts that stand closer together than the words of a mask are long, each of blocks that begin and end at random
  // heights: one after another stands out over the others, so that no run of layers has the box of all of them.
  std::mt19937 random(5);
  const auto below = [&](int end) { return static_cast<Um>(random() % static_cast<unsigned>(end)); };
  for (int i = 0; i < 6; ++i) {
    constexpr std::size_t count = 40;
    std::vector<Regions> outlines(count);
    for (int block = 0; block < 40; ++block) {
      // Corners in the middles of cells, so that edges go through other cells' middles.
      const auto coarse = [&](int end) { return below(end) / 50 * 50; };
      const Point at{below(6) * 5000 - coarse(900), below(4) * 6000 - coarse(900)};
      const Region box{{at,
                        {at.x + 2500 + coarse(4000), at.y + coarse(1500)},
                        {at.x + 2500 + coarse(4000), at.y + 2500 + coarse(4000)},
                        {at.x - coarse(1500), at.y + 2500 + coarse(4000)}},
                       {}};
      const std::size_t from = block < 6 ? 0 : random() % count;
      const std::size_t to = std::min(count, from + 3 + random() % 25);
      for (std::size_t z = from; z < to; ++z) outlines[z] = geometry::unite(outlines[z], {box});
    }
    // Far to the left, and in a few layers only: the windows of runs begin in different words of the grid.
    for (std::size_t z = 30; z < count; ++z)
      outlines[z].push_back(rectangle(-9000 - 1300 * i, 3000, -6500 - 1300 * i, 5500));
    std::vector<Regions> insides;
    for (const Regions& r : outlines) insides.push_back(geometry::offset(r, {.by = -450}));
    std::vector<infill::ShellLayer> layers;
    for (std::size_t z = 0; z < count; ++z)
      layers.push_back({static_cast<Um>(200 * (z + 1)), 200, &outlines[z], &insides[z]});
    Box box = infill::box_of(layers);
    if (i % 2 == 1) box.add(Point{box.min.x + 156'000, box.min.y + 155'000});  // cells of a length that does not round
    const infill::ShellObject object{layers, box, 400};
    const auto at_once = infill::find_areas({}, {}, object, 0, count);
    for (const std::size_t run : {1u, 3u, 8u})
      for (std::size_t first = 0; first < count; first += run) {
        const std::size_t many = std::min(run, count - first);
        const auto some = infill::find_areas({}, {}, object, first, many);
        CAPTURE(i, run, first);
        for (std::size_t k = 0; k < many; ++k) CHECK(same(some[k], at_once[first + k]));
      }
  }
}
