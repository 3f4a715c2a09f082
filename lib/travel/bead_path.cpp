// SPDX-License-Identifier: GPL-3.0-or-later
#include "travel/bead_path.h"

#include <algorithm>

namespace weft::travel {
namespace {

Junction between(const Junction& a, const Junction& b, Point at) {
  const double whole = distance(a.at, b.at), t = whole > 0 ? std::min(1.0, distance(a.at, at) / whole) : 0.0;
  return {at, rounded(a.width + t * (static_cast<double>(b.width) - a.width)),
          a.flow + static_cast<float>(t) * (b.flow - a.flow)};
}

}  // namespace

std::vector<Junction> path_of(const Bead& bead, const Turn& turn) {
  const std::size_t n = bead.path.size();
  if (!bead.closed) {
    if (turn.reversed) return {bead.path.rbegin(), bead.path.rend()};
    return bead.path;
  }
  std::vector<Junction> path;
  path.reserve(n + 2);
  const std::size_t i = turn.start.segment, next = (i + 1) % n;
  const bool at_junction = turn.start.at == bead.path[i].at;
  path.push_back(at_junction ? bead.path[i] : between(bead.path[i], bead.path[next], turn.start.at));
  for (std::size_t k = next; k != i; k = (k + 1) % n) path.push_back(bead.path[k]);
  if (!at_junction) path.push_back(bead.path[i]);
  path.push_back(path.front());
  return path;
}

Polyline first_of(const std::vector<Junction>& path, double length_um) {
  Polyline line;
  for (std::size_t i = 1; i < path.size() && length_um > 0; ++i) {
    const double step = distance(path[i - 1].at, path[i].at);
    line.push_back(step <= length_um ? path[i].at : lerp(path[i - 1].at, path[i].at, length_um / step));
    length_um -= step;
  }
  return line;
}

Polyline cut_end(std::vector<Junction>& path, double length_um) {
  Polyline tail;
  while (path.size() > 1 && length_um >= 1) {
    const Junction last = path.back(), before = path[path.size() - 2];
    const double step = distance(before.at, last.at);
    tail.insert(tail.begin(), last.at);
    if (step > length_um) {
      path.back() = between(before, last, lerp(last.at, before.at, length_um / step));
      break;
    }
    length_um -= step;
    path.pop_back();
  }
  return tail;
}

double length_um(const std::vector<Junction>& path) {
  double sum = 0;
  for (std::size_t i = 1; i < path.size(); ++i) sum += distance(path[i - 1].at, path[i].at);
  return sum;
}

}  // namespace weft::travel
