// SPDX-License-Identifier: GPL-3.0-or-later
#include "travel/blocks.h"

#include "core/stop.h"

#include <algorithm>
#include <cmath>

namespace weft::travel {
namespace {

/// Beads are sampled this densely to see which touch, µm.
constexpr double sample_um = 600;

struct Sample {
  Point at;
  Um width;
  std::uint32_t wall;
  std::uint16_t inset;
};

std::vector<Sample> samples_of(const Beads& beads, const std::vector<std::uint32_t>& walls) {
  std::vector<Sample> samples;
  for (std::uint32_t w = 0; w < walls.size(); ++w) {
    const Bead& bead = beads[walls[w]];
    const std::size_t n = bead.path.size(), segments = bead.closed ? n : n - 1;
    double since = sample_um;
    for (std::size_t i = 0; i < segments; ++i) {
      const Point a = bead.path[i].at, b = bead.path[(i + 1) % n].at;
      const double step = distance(a, b);
      for (double s = sample_um - since; s < step; s += sample_um) {
        samples.push_back({lerp(a, b, std::max(0.0, s) / step), bead.path[i].width, w, bead.inset});
        since = -s;
      }
      since = since < 0 ? since + step : since + step;
    }
  }
  return samples;
}

/// A single wall of each inset: they lie in each other.
bool one_contour(const Beads& beads, const std::vector<std::uint32_t>& walls) {
  for (std::size_t i = 0; i < walls.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (beads[walls[i]].inset == beads[walls[k]].inset) return false;
  return true;
}

}  // namespace

std::vector<Block> blocks_of(const LayerInput& input) {
  std::vector<Block> blocks;
  if (!input.adhesion.empty()) {
    Block block;
    for (std::uint32_t i = 0; i < input.adhesion.size(); ++i) block.fills.push_back(i);
    blocks.push_back(std::move(block));
  }
  for (std::uint32_t o = 0; o < input.objects.size(); ++o) {
    const Beads& beads = input.objects[o].beads;
    std::vector<std::uint32_t> block_of_part;
    constexpr std::uint32_t none = 0xFFFFFFFF;
    for (std::uint32_t i = 0; i < beads.size(); ++i) {
      if (beads[i].path.size() < 2) continue;
      if (beads[i].part >= block_of_part.size()) block_of_part.resize(beads[i].part + 1, none);
      auto& slot = block_of_part[beads[i].part];
      if (slot == none) {
        slot = static_cast<std::uint32_t>(blocks.size());
        blocks.push_back({});
        blocks.back().object = o;
      }
      auto& block = blocks[slot];
      // An open wall lies between others and binds no order: it is fitted in among the fills.
      (is_wall(beads[i].role) && beads[i].closed ? block.walls : block.fills).push_back(i);
    }
  }
  return blocks;
}

std::vector<Touch> touching_walls(const Beads& beads, const std::vector<std::uint32_t>& walls) {
  std::vector<Touch> touches;
  if (one_contour(beads, walls)) {
    for (std::uint32_t w = 1; w < walls.size(); ++w) touches.push_back({w - 1, w});
    return touches;
  }
  const auto samples = samples_of(beads, walls);
  if (samples.empty()) return touches;
  Box box;
  Um widest = 1;
  for (const auto& s : samples) box.add(s.at), widest = std::max(widest, s.width);
  // Neighbouring centrelines are a width apart; half a sample's distance is lost along the bead.
  const double near = 1.3 * widest, near2 = near * near + sample_um * sample_um / 4;
  const double area = (box.size().x + 1.0) * (box.size().y + 1.0);
  const auto cell =
      static_cast<Um>(std::max(std::sqrt(near2), std::sqrt(area / static_cast<double>(4 * samples.size())))) + 1;
  const int columns = box.size().x / cell + 1, rows = box.size().y / cell + 1;
  const auto column = [&](Point p) { return (p.x - box.min.x) / cell; };
  const auto row = [&](Point p) { return (p.y - box.min.y) / cell; };
  const auto index = [&](int c, int r) {
    return static_cast<std::size_t>(r) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(c);
  };
  std::vector<std::uint32_t> first(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows) + 1, 0);
  for (const auto& s : samples) ++first[index(column(s.at), row(s.at)) + 1];
  for (std::size_t c = 1; c < first.size(); ++c) first[c] += first[c - 1];
  std::vector<Sample> sorted(samples.size());  // by cell: the three of a row beside each other are one run
  auto fill = first;
  for (const auto& s : samples) sorted[fill[index(column(s.at), row(s.at))]++] = s;
  // Each pair of samples is looked at from the one whose cell comes first: the rest of its row, and the row above.
  std::vector<std::uint64_t> pairs;
  std::vector<std::uint32_t> touched_by(walls.size(),
                                        0xFFFFFFFF);  // the last wall that was found to: samples are in order of walls
  StopNowAndThen stop(64);
  for (const auto& s : samples) {
    stop.step();
    const int c = column(s.at), r = row(s.at), last_row = std::min(rows - 1, r + 1),
              last = std::min(columns - 1, c + 1);
    for (int y = r; y <= last_row; ++y) {
      const std::uint32_t end = first[index(last, y) + 1];
      for (std::uint32_t k = first[index(y == r ? c : std::max(0, c - 1), y)]; k < end; ++k) {
        const auto& other = sorted[k];
        if (other.inset == s.inset || touched_by[other.wall] == s.wall) continue;
        if (static_cast<double>(distance2(s.at, other.at)) > near2) continue;
        touched_by[other.wall] = s.wall;
        pairs.push_back(std::uint64_t{std::min(s.wall, other.wall)} << 32 | std::max(s.wall, other.wall));
      }
    }
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());  // each of the two may have found the other
  for (const auto pair : pairs)
    touches.push_back({static_cast<std::uint32_t>(pair >> 32), static_cast<std::uint32_t>(pair)});
  return touches;
}

}  // namespace weft::travel
