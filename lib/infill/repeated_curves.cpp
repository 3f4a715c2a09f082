// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/repeated_curves.h"

#include "core/stop.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <tuple>

namespace weft::infill {
namespace {

/// A place on the border of a period, as the same place on the opposite one has it.
struct Gate {
  std::tuple<bool, double> key;  ///< on a border along y? and where on it
  int across = 0, up = 0;        ///< periods that are stepped over there
};

std::optional<Gate> gate_at(const LevelGrid& grid, Turned p) {
  const bool left = p.x == grid.x(0), right = p.x == grid.x(grid.columns - 1), low = p.y == grid.y(0),
             high = p.y == grid.y(grid.rows - 1);
  if (left + right + low + high != 1) return std::nullopt;
  return Gate{{left || right, left || right ? p.y : p.x}, right ? 1 : (left ? -1 : 0), high ? 1 : (low ? -1 : 0)};
}

/// What a vector of whole numbers makes a parallelogram of area one with. Pre: they have no common divisor
std::pair<int, int> beside(int across, int up) {
  const int most = std::abs(across) + std::abs(up);
  for (int a = -most; a <= most; ++a)
    for (int b = -most; b <= most; ++b)
      if (across * b - up * a == 1) return {a, b};
  return {0, 0};
}

Span2 span_of(const std::vector<Turned>& points) {
  Span2 out{points.front(), points.front()};
  for (const Turned p : points) {
    out.min = {std::min(out.min.x, p.x), std::min(out.min.y, p.y)};
    out.max = {std::max(out.max.x, p.x), std::max(out.max.y, p.y)};
  }
  return out;
}

/// Whole numbers from the first to the last; none where the last is less.
struct Steps {
  long first, last;
};
/// Those k for which [low, high] + k·by meets the span; all where `by` is nothing and it does.
Steps meeting(double low, double high, double by, double from, double to) {
  constexpr long all = 1L << 40;
  if (by == 0) return high < from || low > to ? Steps{0, -1} : Steps{-all, all};
  const double a = (from - high) / by, b = (to - low) / by;
  return {static_cast<long>(std::ceil(std::min(a, b))), static_cast<long>(std::floor(std::max(a, b)))};
}

void append_moved(const std::vector<Turned>& points, double x, double y, std::vector<Turned>& to) {
  for (const Turned p : points) to.push_back({p.x + x, p.y + y});
}

void repeat_closed(const RepeatedCurve& curve, const Span2& own, double period, const Span2& area,
                   std::vector<Curve>& out) {
  const Steps rows = meeting(own.min.y, own.max.y, period, area.min.y, area.max.y),
              columns = meeting(own.min.x, own.max.x, period, area.min.x, area.max.x);
  for (long j = rows.first; j <= rows.last; ++j) {
    stop_if_asked();
    for (long i = columns.first; i <= columns.last; ++i) {
      Curve& one = out.emplace_back();
      one.closed = true;
      append_moved(curve.points, static_cast<double>(i) * period, static_cast<double>(j) * period, one.points);
    }
  }
}

/// A curve that begins anew at (across, up) stands beside itself at each multiple of what is beside that vector.
void repeat_open(const RepeatedCurve& curve, const Span2& own, double period, const Span2& area,
                 std::vector<Curve>& out) {
  const auto [a, b] = beside(curve.across, curve.up);
  const double tx = curve.across * period, ty = curve.up * period;
  double least = 1e300, most = -1e300;  // of those multiples
  for (const double x : {area.min.x - own.max.x, area.max.x - own.min.x})
    for (const double y : {area.min.y - own.max.y, area.max.y - own.min.y}) {
      const double m = (curve.across * y - curve.up * x) / period;
      least = std::min(least, m), most = std::max(most, m);
    }
  for (auto m = static_cast<long>(std::ceil(least)); m <= static_cast<long>(std::floor(most)); ++m) {
    stop_if_asked();
    const double x = static_cast<double>(m * a) * period, y = static_cast<double>(m * b) * period;
    const Steps by_x = meeting(own.min.x + x, own.max.x + x, tx, area.min.x, area.max.x),
                by_y = meeting(own.min.y + y, own.max.y + y, ty, area.min.y, area.max.y);
    const long first = std::max(by_x.first, by_y.first), last = std::min(by_x.last, by_y.last);
    if (first > last) continue;
    Curve& one = out.emplace_back();
    one.points.reserve(static_cast<std::size_t>(last - first + 1) * curve.points.size() + 1);
    for (long k = first; k <= last; ++k)
      append_moved(curve.points, x + static_cast<double>(k) * tx, y + static_cast<double>(k) * ty, one.points);
    const Turned end = curve.points.front();
    one.points.push_back(
        {end.x + x + static_cast<double>(last + 1) * tx, end.y + y + static_cast<double>(last + 1) * ty});
  }
}

}  // namespace

std::optional<std::vector<RepeatedCurve>> join_over_borders(const LevelGrid& period, std::vector<Curve> curves) {
  std::vector<RepeatedCurve> out;
  std::map<std::tuple<bool, double>, std::size_t> begins;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    if (curves[i].closed) continue;
    const auto gate = gate_at(period, curves[i].points.front());
    if (!gate || !begins.emplace(gate->key, i).second) return std::nullopt;
  }
  const double wide = period.step * static_cast<double>(period.columns - 1);
  std::vector<bool> done(curves.size(), false);
  for (std::size_t i = 0; i < curves.size(); ++i) {
    if (done[i]) continue;
    RepeatedCurve& whole = out.emplace_back();
    for (std::size_t k = i; !done[k];) {
      done[k] = true;
      std::vector<Turned>& points = curves[k].points;
      if (curves[k].closed) {
        whole.points = std::move(points);
        break;
      }
      const auto gate = gate_at(period, points.back());
      const auto next = gate ? begins.find(gate->key) : begins.end();
      if (next == begins.end()) return std::nullopt;
      points.pop_back();  // where the next begins
      append_moved(points, whole.across * wide, whole.up * wide, whole.points);
      whole.across += gate->across, whole.up += gate->up;
      k = next->second;
    }
  }
  std::erase_if(out, [](const RepeatedCurve& c) { return c.points.size() < 2; });
  return out;
}

std::vector<Curve> repeat(const std::vector<RepeatedCurve>& curves, double period_um, const Span2& area) {
  std::vector<Curve> out;
  for (const RepeatedCurve& curve : curves) {
    const Span2 own = span_of(curve.points);
    if (curve.across == 0 && curve.up == 0)
      repeat_closed(curve, own, period_um, area, out);
    else
      repeat_open(curve, own, period_um, area, out);
  }
  return out;
}

}  // namespace weft::infill
