// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/figures.h"

#include "core/stop.h"
#include "core/table.h"
#include "infill/mask.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <unordered_set>
#include <vector>

namespace weft::infill {
namespace {

enum class Way { upright, sheets };
/// factor × density ^ exponent.
struct Law {
  double factor = 1, exponent = 1;
};
struct Cellular {
  InfillPattern pattern;
  Way way;
  Law plane, z;
};
constexpr Law straight{1, 1}, two_ways{0.5, 1}, triangles_law{1.0 / 3, 1}, bending{1.5, 3}, foam{1, 2}, none{0, 1};

constexpr std::array cellular_rows{
    Cellular{InfillPattern::lines, Way::upright, two_ways, straight},
    Cellular{InfillPattern::grid, Way::upright, two_ways, straight},
    Cellular{InfillPattern::triangles, Way::upright, triangles_law, straight},
    Cellular{InfillPattern::gyroid, Way::sheets, foam, foam},
    Cellular{InfillPattern::concentric, Way::upright, bending, straight},
    Cellular{InfillPattern::zigzag, Way::upright, two_ways, straight},
    Cellular{InfillPattern::aligned, Way::upright, bending, straight},
    Cellular{InfillPattern::slanted, Way::upright, two_ways, straight},
    Cellular{InfillPattern::crosszag, Way::upright, bending, straight},
    Cellular{InfillPattern::trihexagon, Way::upright, triangles_law, straight},
    Cellular{InfillPattern::cubic, Way::sheets, triangles_law, triangles_law},
    Cellular{InfillPattern::tetrahedral, Way::sheets, triangles_law, triangles_law},
    Cellular{InfillPattern::quarter_cubic, Way::sheets, triangles_law, triangles_law},
    Cellular{InfillPattern::cubicsubdiv, Way::sheets, triangles_law, triangles_law},
    Cellular{InfillPattern::support_cubic, Way::sheets, triangles_law, triangles_law},
    Cellular{InfillPattern::honeycomb, Way::upright, bending, straight},
    Cellular{InfillPattern::octagon, Way::upright, bending, straight},
    Cellular{InfillPattern::honeycomb_3d, Way::sheets, foam, foam},
    Cellular{InfillPattern::crosshatch, Way::upright, foam, straight},
    Cellular{InfillPattern::lateral_lattice, Way::sheets, none, two_ways},
    Cellular{InfillPattern::lateral_honeycomb, Way::sheets, none, bending},
    Cellular{InfillPattern::diamond, Way::sheets, foam, foam},
    Cellular{InfillPattern::fischer_koch, Way::sheets, foam, foam},
    Cellular{InfillPattern::schwarz_p, Way::sheets, foam, foam},
    Cellular{InfillPattern::hilbert, Way::upright, bending, straight},
    Cellular{InfillPattern::peano, Way::upright, bending, straight},
    Cellular{InfillPattern::archimedean, Way::upright, bending, straight},
    Cellular{InfillPattern::octagram, Way::upright, bending, straight},
    Cellular{InfillPattern::fermat, Way::upright, bending, straight},
    Cellular{InfillPattern::voronoi, Way::upright, bending, straight},
    Cellular{InfillPattern::voronoi_3d, Way::sheets, foam, foam},
    Cellular{InfillPattern::cross, Way::upright, bending, straight},
    Cellular{InfillPattern::cross_3d, Way::sheets, bending, foam},
    Cellular{InfillPattern::lightning, Way::upright, none, none},
    Cellular{InfillPattern::lockedzag, Way::upright, two_ways, straight},
    Cellular{InfillPattern::medial, Way::upright, bending, straight},
    Cellular{InfillPattern::streamlines, Way::upright, two_ways, straight},
};
static_assert(in_order(cellular_rows, &Cellular::pattern), "row i of cellular_rows is pattern i");
static_assert(cellular_rows.size() == choices_of(InfillPattern{}).size(), "a pattern has no row");

template <class See>
void see_segments(const Beads& beads, const See& see) {
  for (const Bead& bead : beads) {
    if (bead.role != Role::infill) continue;
    for (std::size_t i = 1; i < bead.path.size(); ++i) see(bead.path[i - 1], bead.path[i]);
    if (bead.closed && bead.path.size() > 2) see(bead.path.back(), bead.path.front());
  }
}

/// What a layer's sparse infill holds, and of that one layer's share where several are printed at once.
struct Laid {
  double mm = 0, mm3 = 0, in_room_mm3 = 0;
};

/// A layer of its own.
struct LayerFigures {
  double room_mm3 = 0;
  Laid laid;
  std::array<double, 3> cosines{}, sines{};  ///< Σ ℓ e^{inα}, µm, of n = 2, 4, 6
  double looked_mm = 0, over_air_mm = 0;
};

Laid laid_in(const LookedAtLayer& layer) {
  Laid out;
  for (const Bead& bead : *layer.beads) {
    if (bead.role != Role::infill || bead.path.empty()) continue;
    const double mm3 = volume_mm3(bead, layer.height);
    out.mm += length_mm(bead), out.mm3 += mm3;
    out.in_room_mm3 += mm3 / std::max(1.0, std::round(static_cast<double>(bead.path.front().flow)));
  }
  return out;
}

/// Deviation of values, and their mean.
std::pair<double, double> spread_of(const std::vector<double>& values) {
  if (values.empty()) return {0, 0};
  double sum = 0, squares = 0;
  for (const double v : values) sum += v, squares += v * v;
  const double count = static_cast<double>(values.size()), mean = sum / count;
  return {std::sqrt(std::max(0.0, squares / count - mean * mean)), mean};
}

double room_of(const LookedAtLayer& layer) {
  double mm2 = 0;
  for (const Region& region : *layer.sparse) mm2 += area_mm2(region);
  return mm2 * to_mm(layer.height);
}

/// Length of a layer's infill that lies neither on the infill below nor on its walls and solid areas.
void look_below(const LookedAtLayer& layer, const LookedAtLayer& below, LayerFigures& out) {
  constexpr Um cell = 100;
  const Box box = box_of(*layer.sparse);
  if (box.empty()) return;
  const Grid grid = Grid::over(box, cell, 10 * cell, 4e6);
  Mask held(grid, *below.outline);
  held -= Mask(grid, *below.sparse);
  const auto along = [&](const Junction& a, const Junction& b, const auto& see) {
    const double way = distance(a.at, b.at);
    const int steps = std::max(1, static_cast<int>(std::ceil(way / grid.cell)));
    for (int k = 0; k < steps; ++k) {
      const double t = (k + 0.5) / steps;
      see(Point{rounded(std::lerp(a.at.x, b.at.x, t)), rounded(std::lerp(a.at.y, b.at.y, t))}, way / steps);
    }
  };
  see_segments(*below.beads, [&](const Junction& a, const Junction& b) {
    const double half = a.width / 2.0 / grid.cell;
    const int around = static_cast<int>(half);
    std::vector<int> reach;  // of the disc's rows, from its middle up
    for (int j = 0, i = around; j <= around; ++j) {
      while (i * i + j * j > half * half) --i;
      reach.push_back(i);
    }
    along(a, b, [&](Point p, double) {
      const int column = grid.column_of(p.x), row = grid.row_of(p.y);
      for (int r = std::max(0, row - around); r <= std::min(grid.rows - 1, row + around); ++r) {
        const int i = reach[static_cast<std::size_t>(std::abs(r - row))];
        const CellRun run{r, std::max(0, column - i), std::min(grid.columns, column + i + 1)};
        if (run.from < run.to) held.set(run);
      }
    });
  });
  see_segments(*layer.beads, [&](const Junction& a, const Junction& b) {
    along(a, b, [&](Point p, double um) {
      out.looked_mm += um / 1000;
      if (!held.at(p)) out.over_air_mm += um / 1000;
    });
  });
}

LayerFigures figures_of(const LookedAtLayer& layer, const LookedAtLayer* below) {
  stop_if_asked();
  LayerFigures out{room_of(layer), laid_in(layer)};
  see_segments(*layer.beads, [&](const Junction& a, const Junction& b) {
    const double dx = b.at.x - a.at.x, dy = b.at.y - a.at.y, way = std::hypot(dx, dy);
    if (way <= 0) return;
    // e^{2iα}, and its powers
    const double c = (dx * dx - dy * dy) / (way * way), s = 2 * dx * dy / (way * way);
    const std::array<double, 3> cs{c, c * c - s * s, c * (c * c - 3 * s * s)},
        ss{s, 2 * s * c, s * (3 * c * c - s * s)};
    for (std::size_t n = 0; n < 3; ++n) out.cosines[n] += way * cs[n], out.sines[n] += way * ss[n];
  });
  if (below != nullptr) look_below(layer, *below, out);
  return out;
}

/// The greatest square of a distance over the way between, of places along each path.
double locality_of(const Beads& beads, double spacing) {
  double most = 0;
  for (const Bead& bead : beads) {
    if (bead.role != Role::infill) continue;
    constexpr double most_places = 1200;
    const double step = std::max(spacing, 1000 * length_mm(bead) / most_places);
    std::vector<Point> places;
    double left = 0;
    for (std::size_t i = 1; i < bead.path.size(); ++i) {
      const Point a = bead.path[i - 1].at, b = bead.path[i].at;
      const double way = distance(a, b);
      for (; left <= way && way > 0; left += step)
        places.push_back({rounded(std::lerp(a.x, b.x, left / way)), rounded(std::lerp(a.y, b.y, left / way))});
      left -= way;
    }
    stop_if_asked();
    for (std::size_t i = 0; i < places.size(); ++i)
      for (std::size_t j = i + 1; j < places.size(); ++j) {
        const double d = distance(places[i], places[j]);
        most = std::max(most, d * d / (static_cast<double>(j - i) * step * spacing));
      }
  }
  return most;
}

/// The slope by least squares of the logarithms of boxes that lines run through, and of one over their size.
double box_dimension_of(const Beads& beads, const Box& box, double spacing) {
  const double largest = std::max(box.size().x, box.size().y) / 4.0;
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (double size = 2 * spacing; size <= largest; size *= std::numbers::sqrt2) {
    std::unordered_set<std::uint64_t> boxes;  // counted alone
    const auto cell = [&](double v) { return static_cast<std::uint32_t>(static_cast<int>(std::floor(v / size))); };
    see_segments(beads, [&](const Junction& a, const Junction& b) {
      const int steps = std::max(1, static_cast<int>(std::ceil(distance(a.at, b.at) / (size / 4))));
      for (int k = 0; k <= steps; ++k) {
        const double t = static_cast<double>(k) / steps;
        const double x = std::lerp(a.at.x, b.at.x, t) - box.min.x, y = std::lerp(a.at.y, b.at.y, t) - box.min.y;
        boxes.insert(std::uint64_t{cell(x)} << 32U | cell(y));
      }
    });
    if (boxes.empty()) return 0;
    const double u = -std::log(size), v = std::log(static_cast<double>(boxes.size()));
    n += 1, sx += u, sy += v, sxx += u * u, sxy += u * v;
  }
  return n < 3 ? 0 : (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

}  // namespace

Bounds bounds_of(InfillPattern pattern, double density) {
  const Cellular& row = weft::row_of(cellular_rows, pattern);
  const double f = std::clamp(density, 0.0, 1.0);
  const auto bears = [&](Law law) { return std::min(1.0, law.factor * std::pow(f, law.exponent)); };
  const double sheets = 2 * f / (3 - f);
  return {bears(row.plane), bears(row.z), row.way == Way::upright ? f / (2 - f) : sheets,
          row.way == Way::upright ? f : sheets};
}

Figures figures_of(const InfillSettings& infill, std::span<const LookedAtLayer> layers, const ForEach& for_each) {
  constexpr std::size_t every = 5;
  constexpr double much = 0.2;  // of the largest layer's room
  std::vector<LayerFigures> all(layers.size());
  for_each(layers.size(),
           [&](std::size_t i) { all[i] = figures_of(layers[i], i > 0 && i % every == 0 ? &layers[i - 1] : nullptr); });
  Figures out;
  std::array<double, 3> cosines{}, sines{};
  double largest = 0;
  for (const LayerFigures& layer : all) {
    const auto& [room, laid, cs, ss, looked, over_air] = layer;
    out.room_mm3 += room, out.mm += laid.mm, out.mm3 += laid.mm3, out.in_room_mm3 += laid.in_room_mm3;
    out.looked_mm += looked, out.over_air_mm += over_air;
    for (std::size_t n = 0; n < 3; ++n) cosines[n] += cs[n], sines[n] += ss[n];
    largest = std::max(largest, room);
  }
  for (std::size_t n = 0; n < 3; ++n)
    if (out.mm > 0) out.fabric[n] = std::hypot(cosines[n], sines[n]) / (1000 * out.mm);
  std::vector<double> densities, lengths;
  for (const auto& layer : all)
    if (layer.room_mm3 > much * largest && layer.laid.mm3 > 0)
      densities.push_back(layer.laid.in_room_mm3 / layer.room_mm3), lengths.push_back(layer.laid.mm / layer.room_mm3);
  out.density_spread = spread_of(densities).first;
  if (const auto [deviation, mean] = spread_of(lengths); mean > 0) out.length_spread = deviation / mean;
  out.bounds = bounds_of(infill.infill_pattern, out.density());
  if (largest <= 0 || out.density() <= 0) return out;
  const auto middle = static_cast<std::size_t>(
      std::max_element(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.room_mm3 < b.room_mm3; }) -
      all.begin());
  const Laid& laid = all[middle].laid;
  if (laid.mm <= 0 || laid.mm3 <= 0) return out;
  const double spacing =
      1000 * all[middle].room_mm3 / (laid.mm * to_mm(layers[middle].height));  // b/ρ of what was laid
  if (!(spacing > 0)) return out;
  out.locality = locality_of(*layers[middle].beads, spacing);
  out.box_dimension = box_dimension_of(*layers[middle].beads, box_of(*layers[middle].sparse), spacing);
  return out;
}

}  // namespace weft::infill
