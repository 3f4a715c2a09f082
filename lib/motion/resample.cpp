#include "motion/resample.h"

#include "core/tolerances.h"

#include <algorithm>
#include <cmath>

namespace weft::motion {
namespace {

constexpr double volume_share = 0.005;
constexpr double volume_most =
    2;  // mm²·µm at height 1 mm, a square of 45 µm: or on a long segment a share would be a gap

/// A junction in the numbers that errors are computed with, µm: it is looked at again and again.
struct Spot {
  double x, y, band_um;
};
Spot spot_of(const Junction& j) {
  return {static_cast<double>(j.at.x), static_cast<double>(j.at.y), j.width * static_cast<double>(j.flow)};
}

struct Span {
  std::size_t first, last;
};

class Thinner {
 public:
  explicit Thinner(const std::vector<Junction>& path)
      : path_(path), keep_(path.size(), 0), spots_(path.size()), volume_(path.size(), 0.0) {
    std::transform(path.begin(), path.end(), spots_.begin(), spot_of);
    for (std::size_t i = 1; i < path.size(); ++i)
      volume_[i] = volume_[i - 1] + distance(path[i - 1].at, path[i].at) * mean_area_mm2(path[i - 1], path[i], 1.0);
  }

  std::vector<Junction> thinned() {
    keep_.front() = keep_.back() = 1;
    std::vector<Span> open{{0, path_.size() - 1}};
    while (!open.empty()) {
      const Span span = open.back();
      open.pop_back();
      if (span.last - span.first < 2) continue;
      const std::size_t worst = worst_in(span);
      if (worst == 0) continue;
      keep_[worst] = 1;
      open.push_back({span.first, worst});
      open.push_back({worst, span.last});
    }
    std::vector<Junction> out;
    out.reserve(static_cast<std::size_t>(std::count(keep_.begin(), keep_.end(), 1)));
    for (std::size_t i = 0; i < path_.size(); ++i)
      if (keep_[i]) out.push_back(path_[i]);
    return out;
  }

 private:
  /// The junction that lies furthest off the segment from the first to the last, by place or by band, in units of the
  /// tolerances; 0 when the segment can stand for all of them.
  std::size_t worst_in(const Span& span) const {
    const Spot a = spots_[span.first], b = spots_[span.last];
    const double x = b.x - a.x, y = b.y - a.y, wider = b.band_um - a.band_um, length2 = x * x + y * y;
    constexpr double per_place = 1.0 / (static_cast<double>(tolerances::path) * tolerances::path),
                     per_band = 4.0 / (static_cast<double>(tolerances::band_step) * tolerances::band_step);
    const double per_length2 = length2 > 0 ? 1 / length2 : 0;
    double most = 1;  // of the squares: no root is drawn
    std::size_t worst = 0;
    for (std::size_t i = span.first + 1; i < span.last; ++i) {
      const double px = spots_[i].x - a.x, py = spots_[i].y - a.y;
      const double t = std::clamp((px * x + py * y) * per_length2, 0.0, 1.0);
      const double dx = px - t * x, dy = py - t * y, dq = a.band_um + t * wider - spots_[i].band_um;
      const double error = std::max((dx * dx + dy * dy) * per_place, dq * dq * per_band);
      if (error > most) most = error, worst = i;
    }
    if (worst != 0) return worst;
    const double was = volume_[span.last] - volume_[span.first];
    const double is = std::sqrt(length2) * mean_area_mm2(path_[span.first], path_[span.last], 1.0);
    return std::abs(is - was) > std::min(volume_share * was, volume_most) ? (span.first + span.last) / 2 : 0;
  }

  const std::vector<Junction>& path_;
  std::vector<char> keep_;
  std::vector<Spot> spots_;
  std::vector<double> volume_;  // from the first junction, at height 1
};

}  // namespace

void thin_out(std::vector<Junction>& path) {
  if (path.size() > 2) path = Thinner(path).thinned();
}

void cut_where_width_changes(std::vector<Junction>& path) {
  const auto pieces_of = [](const Junction& a, const Junction& b) {
    const double change_um = std::abs(a.width * static_cast<double>(a.flow) - b.width * static_cast<double>(b.flow));
    if (change_um <= tolerances::band_step) return 1;
    return std::max(1, static_cast<int>(std::min(std::ceil(change_um / tolerances::band_step),
                                                 distance(a.at, b.at) / tolerances::shortest_piece)));
  };
  std::size_t count = path.empty() ? 0 : 1;
  for (std::size_t i = 1; i < path.size(); ++i) count += static_cast<std::size_t>(pieces_of(path[i - 1], path[i]));
  if (count == path.size()) return;
  std::vector<Junction> out;
  out.reserve(count);
  out.push_back(path.front());
  for (std::size_t i = 1; i < path.size(); ++i) {
    const auto &a = path[i - 1], &b = path[i];
    const int pieces = pieces_of(a, b);
    for (int k = 1; k < pieces; ++k) {
      const double t = static_cast<double>(k) / pieces;
      out.push_back({lerp(a.at, b.at, t), rounded(a.width + t * (b.width - a.width)),
                     static_cast<float>(a.flow + t * static_cast<double>(b.flow - a.flow))});
    }
    out.push_back(b);
  }
  path = std::move(out);
}

}  // namespace weft::motion
