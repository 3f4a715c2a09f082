#include "walls/fit_ends.h"

#include <algorithm>
#include <cmath>

namespace weft::walls {
namespace {

using Vertex = Line::Vertex;

constexpr double step_um = 20;
constexpr double under_share = 0.9;  // of half a wall's width: closer to its middle an end lies under it
constexpr double most_widths = 2;    // no more than so many widths of the wall are cut; else it lies there on purpose

/// How deep p lies under a wall: half the wall's width there less the distance; at most 0 when beside it.
struct Depth {
  double depth = 0, width = 0;
};
Depth depth_under(const Line& wall, double widest, Place p) {
  Depth best;
  const auto& path = wall.path;
  for (std::size_t i = 0; i < path.size();) {
    const Vertex &a = path[i], &b = path[(i + 1) % path.size()];
    const double length = distance(a.at, b.at), from_a = distance(a.at, p);
    if (from_a - length < widest) {
      const double dx = b.at.x - a.at.x, dy = b.at.y - a.at.y, l2 = dx * dx + dy * dy;
      const double t = l2 > 0 ? std::clamp(((p.x - a.at.x) * dx + (p.y - a.at.y) * dy) / l2, 0.0, 1.0) : 0;
      const double width = a.width + t * (b.width - a.width);
      const double depth = under_share * width / 2 - distance(lerp(a.at, b.at, t), p);
      if (depth > best.depth) best = {depth, width};
      ++i;
      continue;
    }
    double room = from_a - widest;  // as far as this no segment comes near
    while (i < path.size() && room > 0) {
      room -= distance(path[i].at, path[(i + 1) % path.size()].at);
      if (room > 0) ++i;
    }
  }
  return best;
}

/// The length at the end of a path that lies under the wall.
double length_under(const std::vector<Vertex>& path, const Line& wall, double widest) {
  const Depth end = depth_under(wall, widest, path.back().at);
  if (end.depth <= 0) return 0;
  double done = 0;
  for (std::size_t i = path.size() - 1; i > 0; --i) {
    const double length = distance(path[i].at, path[i - 1].at);
    const int pieces = std::max(1, static_cast<int>(std::ceil(length / step_um)));
    for (int k = 1; k <= pieces; ++k) {
      const double at = done + length * k / pieces;
      if (at > most_widths * end.width) return 0;
      if (depth_under(wall, widest, lerp(path[i].at, path[i - 1].at, static_cast<double>(k) / pieces)).depth <= 0)
        return at;
    }
    done += length;
  }
  return 0;
}

}  // namespace

void fit_ends(std::vector<Line>& middles, const std::vector<Line>& pairs) {
  std::vector<double> widest(pairs.size(), 0);
  for (std::size_t i = 0; i < pairs.size(); ++i)
    for (const Vertex& v : pairs[i].path) widest[i] = std::max(widest[i], v.width);
  for (Line& line : middles) {
    if (line.closed || line.path.size() < 2) continue;
    for (int end = 0; end < 2; ++end) {
      double by = 0;
      for (std::size_t i = 0; i < pairs.size(); ++i)
        if (pairs[i].inset == line.inset) by = std::max(by, length_under(line.path, pairs[i], widest[i]));
      if (by > 0) cut_end(line.path, by);
      std::reverse(line.path.begin(), line.path.end());
    }
  }
}

}  // namespace weft::walls
