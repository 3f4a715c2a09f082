// SPDX-License-Identifier: GPL-3.0-or-later
#include "walls/keep_inside.h"

#include "walls/room.h"

#include <algorithm>
#include <cmath>

namespace weft::walls {
namespace {

using Vertex = Line::Vertex;
using Path = std::vector<Vertex>;

constexpr double noticed_um = 8;  // a band may reach over the outline by so much
constexpr double outside_um = 4;  // … and is made to by no more: the lattice and the part's volume want their share
constexpr double least_piece_um = 20;  // no shorter pieces are cut
constexpr double least_piece = 0.06;  // … nor than so much of the width: on the lattice their directions would jitter
constexpr double long_piece = 8;      // times the least: longer ones are cut whatever that brings
constexpr double worth_um = 4;        // … others if it makes them so much wider, together
constexpr double tolerated = 0.004;   // of the part's area may be missing: else its volume comes first
constexpr double most_outside_um = 200;  // … at the cost of so much at most
constexpr double tip_um = 100;           // an end so narrow meets nothing
constexpr double trim_step_um = 5;       // an end gives way in such steps
constexpr double most_trim = 0.1;        // … up to so much of its width
constexpr int most_rounds = 3;           // so often what is missing is spread

double half_width(const Vertex& a, const Vertex& b) {
  return (a.width + b.width) / 4;
}

bool single(const Line& line) {
  return !line.closed && line.inset == 0;
}

/// What lies between other walls with both its ends is none: it is as wide as they leave room for.
bool is_arm(const Line& line) {
  const auto ends = [](bool meets, const Vertex& v) { return !meets || v.width < tip_um; };
  return single(line) && (ends(line.first_meets, line.path.front()) || ends(line.last_meets, line.path.back()));
}

/// The lines of one part.
class Keeper {
 public:
  Keeper(const Region& region, const FinishOptions& options, std::vector<Line>& lines)
      : region_(region), o_(options), lines_(lines), room_(region, options.origin) {}

  /// `thin`: all lines are single beads.
  void run(bool thin) {
    bool any = false;
    for (Line& line : lines_) {
      if (!(thin || is_arm(line)) || fits(line.path)) continue;
      any = true;
      if (!thin) trim_ends(line);
      keep(line.path);
    }
    if (!any || !thin) return;  // beside walls it is not known what else is bare
    const double whole = 1e6 * area_mm2(region_);
    missing_ = whole;
    for (const Line& line : lines_) missing_ -= area_of(line.path);
    spread();
    for (; missing_ > tolerated * whole && outside_ < most_outside_um; outside_ *= 2) spread();
  }

 private:
  bool fits(const Path& path) {
    for (std::size_t i = 1; i < path.size(); ++i) {
      const double half = half_width(path[i - 1], path[i]);
      if (room_.beside(path[i - 1].at, path[i].at, half, i == 1, i + 1 == path.size()) + noticed_um < half)
        return false;
    }
    return true;
  }

  void trim_ends(Line& line) {
    if (!line.last_meets) trim_end(line.path);
    std::reverse(line.path.begin(), line.path.end());
    if (!line.first_meets) trim_end(line.path);
    std::reverse(line.path.begin(), line.path.end());
  }

  /// An end that is not quite square to the outline stays as wide and gives way a little.
  void trim_end(Path& path) {
    for (double by = trim_step_um; by <= most_trim * path.back().width; by += trim_step_um) {
      Path trimmed = path;
      cut_end(trimmed, by);
      if (trimmed.size() < 2) return;
      const Vertex &a = trimmed[trimmed.size() - 2], &b = trimmed.back();
      const double half = half_width(a, b);
      if (room_.beside(a.at, b.at, half, false, true) + noticed_um < half) continue;
      path = std::move(trimmed);
      return;
    }
  }

  void keep(Path& path) {
    path = cut(path);
    bound(path, bounds_of(path));
  }

  /// The path with pieces that have not the room they need cut where that gains some.
  Path cut(const Path& path) {
    Path out{path.front()};
    for (std::size_t i = 1; i < path.size(); ++i) {
      const Vertex &a = path[i - 1], &b = path[i];
      const bool first = i == 1, last = i + 1 == path.size();
      const double half = half_width(a, b), room = room_.beside(a.at, b.at, half, first, last);
      if (room + outside_um < half) cut(a, b, room, first, last, out);
      out.push_back(b);
    }
    return out;
  }

  void cut(const Vertex& a, const Vertex& b, double room, bool first, bool last, Path& out) {
    const double length = distance(a.at, b.at), most = std::max(a.width, b.width) / 2;
    const double least = std::max(least_piece_um, least_piece * most * 2);
    if (length < 2 * least) return;
    const Vertex middle = lerp(a, b, 0.5);
    const double before = room_.beside(a.at, middle.at, most, first, false),
                 after = room_.beside(middle.at, b.at, most, false, last);
    if (length < long_piece * least && before + after - 2 * room < worth_um) return;
    cut(a, middle, before, first, false, out);
    out.push_back(middle);
    cut(middle, b, after, false, last, out);
  }

  /// How wide each piece may be, on average.
  std::vector<double> bounds_of(const Path& path) {
    std::vector<double> out;
    for (std::size_t i = 1; i < path.size(); ++i) {
      const double room = room_.beside(path[i - 1].at, path[i].at, o_.most_width / 2, i == 1, i + 1 == path.size());
      out.push_back(std::min(o_.most_width, 2 * (room + outside_)));
    }
    return out;
  }

  static void bound(Path& path, const std::vector<double>& most) {
    const std::size_t n = path.size();
    for (std::size_t j = 0; j < n; ++j) {
      const double before = most[j > 0 ? j - 1 : 0], after = most[j + 1 < n ? j : n - 2];
      path[j].width = std::min(path[j].width, (before + after) / 2);
    }
    std::vector<double> less(n, 0);
    for (std::size_t k = 0; k + 1 < n; ++k) {
      const double over = (path[k].width + path[k + 1].width) / 2 - most[k];
      for (const std::size_t j : {k, k + 1}) less[j] = std::max(less[j], over);
    }
    for (std::size_t j = 0; j < n; ++j) path[j].width = std::max(1.0, path[j].width - less[j]);
  }

  /// The path wider by a share of the room it has yet.
  Path widened(const Path& path, double share) {
    const auto most = bounds_of(path);
    Path out = path;
    for (std::size_t j = 0; j < path.size(); ++j) {
      double room = 1e18;
      for (std::size_t k = j > 0 ? j - 1 : 0; k <= std::min(j, most.size() - 1); ++k)
        room = std::min(room, most[k] - (path[k].width + path[k + 1].width) / 2);
      out[j].width += std::max(0.0, share * room);
    }
    return out;
  }

  /// The area that the lines have room for yet.
  double spare() {
    double sum = 0;
    for (const Line& line : lines_) sum += area_of(widened(line.path, 1)) - area_of(line.path);
    return sum;
  }

  void spread() {
    for (int round = 0; round < most_rounds && missing_ > 0; ++round) {
      const double room = spare();
      if (room < 1) return;
      const double share = std::min(1.0, missing_ / room);
      for (Line& line : lines_) {
        missing_ += area_of(line.path);
        line.path = widened(line.path, share);
        missing_ -= area_of(line.path);
      }
    }
  }

  const Region& region_;
  const FinishOptions& o_;
  std::vector<Line>& lines_;
  Room room_;
  double outside_ = outside_um;
  double missing_ = 0;
};

}  // namespace

void keep_inside(const Region& region, const FinishOptions& options, std::vector<Line>& lines) {
  const bool thin = std::all_of(lines.begin(), lines.end(), single);
  if (lines.empty() || (!thin && std::none_of(lines.begin(), lines.end(), is_arm))) return;
  Keeper(region, options, lines).run(thin);
}

}  // namespace weft::walls
