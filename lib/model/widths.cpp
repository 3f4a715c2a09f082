// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/widths.h"

#include "core/stop.h"

#include <algorithm>
#include <cmath>
#include <numeric>

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

/// Widths along a path: each for so long.
struct Widths {
  std::vector<double> lengths, values;
};

/// Cuts heights of a row that are held for less (sign 1), or fills dips (-1). A row that is a circle begins anywhere.
void cut(Widths& row, bool circle, double least, double sign) {
  const std::size_t n = row.values.size();
  std::vector<double>& value = row.values;
  // A circle is cut open at its deepest place: no height lies across that.
  std::size_t first = 0;
  for (std::size_t i = 0; circle && i < n; ++i)
    if (sign * value[i] < sign * value[first]) first = i;
  const auto place = [&](std::size_t k) { return first + k < n ? first + k : first + k - n; };
  std::vector<double> way(n + 1, 0.0);
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t k = 0; k < n; ++k) way[k + 1] = way[k] + row.lengths[place(k)];
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const double p = sign * value[place(a)], q = sign * value[place(b)];
    return p != q ? p > q : a < b;
  });
  // Stretches grow from the highest places down. One is told at its ends by where its other end is.
  constexpr std::size_t none = ~std::size_t{0};
  std::vector<std::size_t> other(n, none);
  const auto holds = [&](std::size_t from, std::size_t to) {
    const bool end = !circle && (from == 0 || to + 1 == n);
    return way[to + 1] - way[from] >= (end ? least / 2 : least);
  };
  for (const std::size_t k : order) {
    const bool before = k > 0 && other[k - 1] != none, behind = k + 1 < n && other[k + 1] != none;
    const std::size_t from = before ? other[k - 1] : k, to = behind ? other[k + 1] : k;
    const double level = value[place(k)];
    const auto lower = [&](std::size_t a, std::size_t b) {
      if (holds(a, b)) return;  // all of it is decided
      for (std::size_t i = a; i <= b; ++i) value[place(i)] = level;
    };
    if (holds(from, to)) {
      if (before) lower(from, k - 1);
      if (behind) lower(k + 1, to);
    }
    other[from] = to, other[to] = from;
  }
}

}  // namespace

void steady_widths(VertexPath& path, bool closed, double least) {
  if (path.size() < 2 || least <= 0 || is_even(path)) return;
  path = finer(path, closed);
  const std::size_t n = path.size();
  Widths row{std::vector<double>(n, 0.0), std::vector<double>(n)};
  double whole = 0, area = 0;
  for (std::size_t i = 0; i + (closed ? 0 : 1) < n; ++i) {
    const std::size_t next = i + 1 < n ? i + 1 : 0;
    const double half = length_of(path[i], path[next]) / 2;
    row.lengths[i] += half, row.lengths[next] += half;
    whole += 2 * half, area += half * (path[i].band + path[next].band);
  }
  for (std::size_t i = 0; i < n; ++i) row.values[i] = path[i].band;
  if (whole < least) {
    if (whole > 0)
      for (PathVertex& v : path) v.band = area / whole;
    return;
  }
  stop_if_asked();
  Widths low = row, high = std::move(row);
  for (const double sign : {1.0, -1.0}) cut(low, closed, least, sign), cut(high, closed, least, -sign);
  for (std::size_t i = 0; i < n; ++i) path[i].band = (low.values[i] + high.values[i]) / 2;
}

}  // namespace weft
