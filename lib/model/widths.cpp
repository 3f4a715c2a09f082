// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/widths.h"

#include "core/stop.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace weft {
namespace {

/// A path with so many vertices that from each to the next its width changes little.
VertexPath finer(const VertexPath& path, bool closed) {
  constexpr double little = 10, shortest = 20;  // µm of width, and of way
  VertexPath out;
  out.reserve(2 * path.size());
  for (std::size_t i = 0; i < path.size(); ++i) {
    const PathVertex &a = path[i], &b = path[i + 1 < path.size() ? i + 1 : 0];
    out.push_back(a);
    if (i + 1 == path.size() && !closed) break;
    const double wider = std::abs(b.band - a.band);
    if (wider <= little) continue;
    const auto pieces = static_cast<int>(std::min(std::ceil(wider / little), length_of(a, b) / shortest));
    for (int k = 1; k < pieces; ++k) {
      const double t = static_cast<double>(k) / pieces;
      out.push_back(lerp(a, b, t));
    }
  }
  return out;
}

/// Cuts heights of widths along a path that are held for less than `least`, and fills dips.
class Cutter {
 public:
  /// `lengths`: for how long each width is held. A path that is a circle begins anywhere.
  Cutter(std::vector<double> lengths, bool circle, double least)
      : lengths_(std::move(lengths)),
        circle_(circle),
        least_(least),
        way_(lengths_.size() + 1),
        height_(lengths_.size()),
        open_(lengths_.size() + 1, {0, lowest}) {}

  /// Heights (sign 1) or dips (-1). Stretches that are as high grow from a place where the path rises to where it falls
  /// below that: one stack has all that are open, each of them higher than the one below.
  void cut(std::vector<double>& values, double sign) {
    const std::size_t n = values.size();
    // A circle is cut open at its deepest place: no height lies across that.
    std::size_t first = 0;
    for (std::size_t i = 1; circle_ && i < n; ++i)
      if (sign * values[i] < sign * values[first]) first = i;
    double way = 0;
    for (std::size_t k = 0, i = first; k < n; ++k, i = i + 1 < n ? i + 1 : 0)
      height_[k] = sign * values[i], way_[k + 1] = way += lengths_[i];
    std::size_t top = 0;  // of the stack; below all is one that never ends
    for (std::size_t k = 0; k <= n; ++k) {
      const double here = k < n ? height_[k] : lowest;
      std::size_t from = k;
      for (; open_[top].height > here; --top) from = open_[top].from, close(open_[top], k);
      if (open_[top].height < here) open_[++top] = {from, here};
    }
    short_.clear();
    for (std::size_t k = 0, i = first; k < n; ++k, i = i + 1 < n ? i + 1 : 0) values[i] = sign * height_[k];
  }

 private:
  static constexpr double lowest = -std::numeric_limits<double>::infinity();
  struct Rise {
    std::size_t from;
    double height;
  };
  struct Stretch {
    std::size_t from, to;
  };

  /// A stretch ends before `to`: if it is held long enough, those upon it that are not are as high as it is.
  void close(const Rise& rise, std::size_t to) {
    const bool end = !circle_ && (rise.from == 0 || to == height_.size());
    const bool held = way_[to] - way_[rise.from] >= (end ? least_ / 2 : least_);
    const auto place = [&](std::size_t k) { return height_.begin() + static_cast<std::ptrdiff_t>(k); };
    for (; !short_.empty() && short_.back().from >= rise.from; short_.pop_back())
      if (held) std::fill(place(short_.back().from), place(short_.back().to), rise.height);
    if (!held) short_.push_back({rise.from, to});
  }

  std::vector<double> lengths_;
  bool circle_;
  double least_;
  std::vector<double> way_, height_;
  std::vector<Rise> open_;
  std::vector<Stretch> short_;  // whole, side by side, and not held long enough
};

}  // namespace

void steady_widths(VertexPath& path, bool closed, double least) {
  if (path.size() < 2 || least <= 0 || is_even(path)) return;
  path = finer(path, closed);
  const std::size_t n = path.size();
  std::vector<double> lengths(n, 0.0), low(n);
  double whole = 0, area = 0;
  for (std::size_t i = 0; i + (closed ? 0 : 1) < n; ++i) {
    const std::size_t next = i + 1 < n ? i + 1 : 0;
    const double half = length_of(path[i], path[next]) / 2;
    lengths[i] += half, lengths[next] += half;
    whole += 2 * half, area += half * (path[i].band + path[next].band);
  }
  for (std::size_t i = 0; i < n; ++i) low[i] = path[i].band;
  if (whole < least) {
    if (whole > 0)
      for (PathVertex& v : path) v.band = area / whole;
    return;
  }
  stop_if_asked();
  std::vector<double> high = low;
  Cutter cutter(std::move(lengths), closed, least);
  for (const double sign : {1.0, -1.0}) cutter.cut(low, sign), cutter.cut(high, -sign);
  for (std::size_t i = 0; i < n; ++i) path[i].band = (low[i] + high[i]) / 2;
}

}  // namespace weft
