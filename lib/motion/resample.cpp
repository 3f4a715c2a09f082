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
    // A junction that stands out from its neighbours stays in any case, and spans between those are short.
    std::vector<Span> open;
    std::size_t last = 0;
    for (std::size_t i = 1; i < path_.size(); ++i) {
      if (i + 1 < path_.size() && Chord(spots_[i - 1], spots_[i + 1]).error(spots_[i]) <= 1) continue;
      keep_[i] = 1;
      if (i > last + 1) open.push_back({last, i});
      last = i;
    }
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
  /// The squares of how far places or bands between two junctions may lie off, in units of the tolerances.
  class Chord {
   public:
    Chord(const Spot& a, const Spot& b) : a_(a), x_(b.x - a.x), y_(b.y - a.y), wider_(b.band_um - a.band_um) {
      const double length2 = x_ * x_ + y_ * y_;
      per_length2_ = length2 > 0 ? 1 / length2 : 0;
    }
    double error(const Spot& p) const {
      constexpr double per_place = 1.0 / (static_cast<double>(tolerances::path) * tolerances::path),
                       per_band = 4.0 / (static_cast<double>(tolerances::band_step) * tolerances::band_step);
      const double px = p.x - a_.x, py = p.y - a_.y;
      const double t = std::clamp((px * x_ + py * y_) * per_length2_, 0.0, 1.0);
      const double dx = px - t * x_, dy = py - t * y_, dq = a_.band_um + t * wider_ - p.band_um;
      return std::max((dx * dx + dy * dy) * per_place, dq * dq * per_band);
    }

   private:
    Spot a_;
    double x_, y_, wider_, per_length2_;
  };

  /// The junction that lies furthest off the segment from the first to the last, by place or by band, in units of the
  /// tolerances; 0 when the segment can stand for all of them.
  std::size_t worst_in(const Span& span) const {
    const Chord chord(spots_[span.first], spots_[span.last]);
    double most = 1;  // of the squares: no root is drawn
    std::size_t worst = 0;
    for (std::size_t i = span.first + 1; i < span.last; ++i)
      if (const double error = chord.error(spots_[i]); error > most) most = error, worst = i;
    if (worst != 0) return worst;
    const double was = volume_[span.last] - volume_[span.first];
    const double is =
        distance(path_[span.first].at, path_[span.last].at) * mean_area_mm2(path_[span.first], path_[span.last], 1.0);
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
    const double length = distance(a.at, b.at);
    const double most =
        std::max(length / tolerances::shortest_piece,
                 std::min(std::ceil(change_um / tolerances::band_leap), 2 * length / tolerances::shortest_piece));
    return std::max(1, static_cast<int>(std::min(std::ceil(change_um / tolerances::band_step), most)));
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
