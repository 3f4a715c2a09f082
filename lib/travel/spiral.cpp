// SPDX-License-Identifier: GPL-3.0-or-later
#include "travel/spiral.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace weft::travel {
namespace {

/// A turn's way is cut until it lies so near to where it is meant.
constexpr double close_um = 5;
constexpr double shortest_um = 200;
/// Plastic that grows or falls does so in steps along pieces of this length.
constexpr double ramp_um = 1000;

struct Nearest {
  std::size_t piece = 0;  ///< from junction `piece` to the next
  double t = 0, distance2 = std::numeric_limits<double>::infinity();
  double x = 0, y = 0;
};

/// The place of a closed path (its first junction repeated) that is nearest to (x, y), which is in fractional microns.
Nearest nearest(const std::vector<Junction>& path, double x, double y) {
  Nearest out;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const Point a = path[i].at, b = path[i + 1].at;
    const double ux = static_cast<double>(b.x) - a.x, uy = static_cast<double>(b.y) - a.y, l2 = ux * ux + uy * uy;
    const double t = l2 > 0 ? std::clamp(((x - a.x) * ux + (y - a.y) * uy) / l2, 0.0, 1.0) : 0;
    const double px = a.x + t * ux, py = a.y + t * uy;
    const double d2 = (px - x) * (px - x) + (py - y) * (py - y);
    if (d2 < out.distance2) out = {i, t, d2, px, py};
  }
  return out;
}

Junction between(const Junction& a, const Junction& b, double t) {
  return {lerp(a.at, b.at, t), rounded(a.width + t * (static_cast<double>(b.width) - a.width)),
          static_cast<float>(a.flow + t * static_cast<double>(b.flow - a.flow))};
}

/// Counter-clockwise, from the place nearest to `start` round to it again.
std::vector<Junction> from_nearest(std::vector<Junction> loop, Point start) {
  std::int64_t area = 0;
  for (std::size_t i = 0, j = loop.size() - 1; i < loop.size(); j = i++)
    area += std::int64_t{loop[j].at.x} * loop[i].at.y - std::int64_t{loop[j].at.y} * loop[i].at.x;
  if (area < 0) std::reverse(loop.begin(), loop.end());
  loop.push_back(loop.front());
  const auto at = nearest(loop, start.x, start.y);
  const Junction begin = between(loop[at.piece], loop[at.piece + 1], at.t);
  std::vector<Junction> out{begin};
  const auto add = [&](const Junction& j) {
    if (j.at != out.back().at) out.push_back(j);
  };
  for (std::size_t i = at.piece + 1; i + 1 < loop.size(); ++i) add(loop[i]);
  for (std::size_t i = 0; i <= at.piece; ++i) add(loop[i]);
  add(begin);
  return out;
}

/// A turn in the making: where share s of the way lies.
class Way {
 public:
  Way(const std::vector<Junction>& path, const std::vector<Junction>& below, const SpiralStyle& style)
      : path_(path),
        below_(below),
        smooth_(style.smooth && !below.empty()),
        apart_widths_(style.apart_widths),
        along_(path.size(), 0.0) {
    for (std::size_t i = 1; i < path.size(); ++i) along_[i] = along_[i - 1] + distance(path[i - 1].at, path[i].at);
  }

  double length() const { return along_.back(); }

  /// On the piece after junction i, at t of it.
  Junction place(std::size_t i, double t, double& share) const {
    Junction j = i + 1 < path_.size() ? between(path_[i], path_[i + 1], t) : path_[i];
    share = (along_[i] + (i + 1 < path_.size() ? t * (along_[i + 1] - along_[i]) : 0)) / length();
    if (!smooth_) return j;
    const double x = exact(i, t, &Point::x), y = exact(i, t, &Point::y);
    const auto near = nearest(below_, x, y);
    const double most = apart_widths_ * std::max(j.width, below_[near.piece].width);
    if (near.distance2 > most * most) return j;
    j.at = {rounded(near.x + share * (x - near.x)), rounded(near.y + share * (y - near.y))};
    return j;
  }

 private:
  double exact(std::size_t i, double t, Um Point::*axis) const {
    const double a = path_[i].at.*axis;
    return i + 1 < path_.size() ? a + t * (static_cast<double>(path_[i + 1].at.*axis) - a) : a;
  }

  const std::vector<Junction>& path_;
  const std::vector<Junction>& below_;
  bool smooth_;
  double apart_widths_;
  std::vector<double> along_;
};

/// Cuts pieces until each lies where the way does, and is no longer than `longest`.
class Cutter {
 public:
  Cutter(const Way& way, const std::vector<Junction>& path, double longest_um, Extrude& out, Um height)
      : way_(way), path_(path), longest_um_(longest_um), out_(out), height_(height) {}

  void run() {
    double share = 0;
    Junction from = way_.place(0, 0, share);
    add(from, 0);
    for (std::size_t i = 0; i + 1 < path_.size(); ++i) {
      const Junction to = i + 2 < path_.size() ? way_.place(i + 1, 0, share) : way_.place(i, 1, share);
      piece(i, 0, from, 1, to, share);
      from = to;
    }
  }

 private:
  void piece(std::size_t i, double t0, const Junction& from, double t1, const Junction& to, double share) {
    const double length = distance(from.at, to.at);
    // Where turns pass over into each other no more the way jumps, however finely it is cut.
    const double own = (t1 - t0) * distance(path_[i].at, path_[i + 1].at);
    if (length > shortest_um && own > shortest_um) {
      double middle_share = 0;
      const double t = (t0 + t1) / 2;
      const Junction middle = way_.place(i, t, middle_share);
      const Point straight = lerp(from.at, to.at, 0.5);
      if (length > longest_um_ || distance(straight, middle.at) > close_um) {
        piece(i, t0, from, t, middle, middle_share);
        return piece(i, t, middle, t1, to, share);
      }
    }
    add(to, share);
  }
  void add(const Junction& j, double share) {
    if (!out_.path.empty() && out_.path.back().at == j.at) {
      out_.below.back() = rounded(height_ * (1 - share));
      return;
    }
    out_.path.push_back(j);
    out_.below.push_back(rounded(height_ * (1 - share)));
  }

  const Way& way_;
  const std::vector<Junction>& path_;
  double longest_um_;
  Extrude& out_;
  Um height_;
};

/// Plastic from share `from` at the beginning of the way to `to` at its end.
void ramp(double from, double to, Extrude& bead) {
  double length = 0, along = 0;
  for (std::size_t i = 1; i < bead.path.size(); ++i) length += distance(bead.path[i - 1].at, bead.path[i].at);
  for (std::size_t i = 0; i < bead.path.size(); ++i) {
    if (i > 0) along += distance(bead.path[i - 1].at, bead.path[i].at);
    bead.path[i].flow *= static_cast<float>(from + (to - from) * along / length);
  }
}

}  // namespace

std::vector<Extrude> Spiral::turn(const std::vector<Junction>& loop, Um height, TurnPlace place,
                                  std::optional<Point> start) {
  const auto path = from_nearest(loop, start ? *start : below_.back().at);
  const auto laid = [&](double longest_um, const std::vector<Junction>& below) {
    Extrude out{.path = {}, .role = Role::outer_wall, .height = height};
    const Way way(path, below, style_);
    Cutter(way, path, longest_um, out, height).run();
    return out;
  };
  const double whole = std::numeric_limits<double>::infinity();
  std::vector<Extrude> out{laid(place.first ? ramp_um : whole, below_)};
  auto& turn = out.front();
  if (!below_.empty() && turn.path.front().at != below_.back().at) {  // it begins where the last one ended
    turn.path.insert(turn.path.begin(), turn.path.front());
    turn.path.front().at = below_.back().at;
    turn.below.insert(turn.below.begin(), height);
  }
  if (place.first) ramp(style_.start_flow, 1, turn);
  if (place.last) {
    out.push_back(laid(ramp_um, {}));
    std::fill(out.back().below.begin(), out.back().below.end(), 0);
    ramp(1, style_.finish_flow, out.back());
  }
  below_ = path;
  return out;
}

}  // namespace weft::travel
