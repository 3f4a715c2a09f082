// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/stripes.h"

#include "settings/tools.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace weft::pipeline {
namespace {

/// Shorter ends of a cut bead stay with what they were cut off.
constexpr double least_piece_mm = 0.5;

}  // namespace

Junction between(const Junction& a, const Junction& b, double share) {
  const auto mix = [&](double x, double y) { return x + (y - x) * share; };
  return {{rounded(mix(a.at.x, b.at.x)), rounded(mix(a.at.y, b.at.y))},
          rounded(mix(a.width, b.width)),
          static_cast<float>(mix(static_cast<double>(a.flow), static_cast<double>(b.flow)))};
}

Stripes::Stripes(const ValuesAt& stops, double period_mm, double least_mm, double from, double to) {
  double owed = 0;  // mm of the second tool
  for (double begin = std::floor(from / period_mm) * period_mm; begin < to; begin += period_mm) {
    owed += period_mm * share_at(stops, begin + period_mm / 2);
    double width = std::clamp(owed, 0.0, period_mm);
    if (width < least_mm) width = 0;
    if (period_mm - width < least_mm) width = period_mm;
    owed -= width;
    if (width == 0) continue;
    const double first = begin + period_mm - width;  // it ends where the next period begins
    if (!borders_.empty() && first - borders_.back() < 1e-6)
      borders_.back() = begin + period_mm;
    else
      borders_.push_back(first), borders_.push_back(begin + period_mm);
  }
}

bool Stripes::second(double mm) const {
  const auto behind = std::upper_bound(borders_.begin(), borders_.end(), mm) - borders_.begin();
  return behind % 2 != 0;
}

Beads Stripes::cut(Bead bead, const std::function<double(Point)>& place) const {
  auto path = std::move(bead.path);
  if (bead.closed) path.push_back(path.front());
  Bead piece = bead;
  piece.closed = false;
  piece.path = {path.front()};
  Beads out;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Junction a = path[i - 1], b = path[i];
    const double from = place(a.at), to = place(b.at);
    auto first = std::upper_bound(borders_.begin(), borders_.end(), std::min(from, to));
    const auto last = std::lower_bound(borders_.begin(), borders_.end(), std::max(from, to));
    std::vector<double> shares;
    for (; first < last; ++first) shares.push_back((*first - from) / (to - from));
    std::sort(shares.begin(), shares.end());
    for (const double share : shares) {
      const Junction here = between(a, b, share);
      piece.path.push_back(here);
      if (length_mm(piece) < least_piece_mm) continue;
      out.push_back(piece);
      piece.path = {here};
    }
    piece.path.push_back(b);
  }
  if (out.empty()) {
    bead.path = std::move(path);
    if (bead.closed) bead.path.pop_back();
    return {std::move(bead)};
  }
  if (length_mm(piece) < least_piece_mm)
    out.back().path.insert(out.back().path.end(), piece.path.begin() + 1, piece.path.end());
  else
    out.push_back(std::move(piece));
  return out;
}

}  // namespace weft::pipeline
