// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/clip_lines.h"

#include "core/stop.h"

namespace weft::geometry {
namespace {

/// Follows one line through the outlines. The winding number is carried along; it is counted afresh, from outside along
/// the very line of the segment, where a vertex lies on an outline: so the number is always that of one straight line,
/// shifted by less than any length, which crosses every outline properly.
class Walk {
 public:
  Walk(const SegmentIndex& outlines, Keep keep, std::vector<Piece>& out)
      : outlines_(outlines), keep_(keep), out_(out) {}

  void along(const Polyline& line, std::size_t source) {
    source_ = source;
    bool known = false;
    for (std::size_t i = 1; i < line.size(); ++i) {
      if (line[i - 1] == line[i]) continue;
      if (!known) winding_ = winding_before(line[i - 1], line[i]);
      if (kept())
        put(line[i - 1]);
      else
        ended_ = true;
      outlines_.crossings(line[i - 1], line[i], crossings_);
      for (const auto& crossing : crossings_) {
        const bool before = kept();
        winding_ += crossing.enters ? 1 : -1;
        if (kept() == before) continue;
        put(lerp(line[i - 1], line[i], crossing.along));
        ended_ = before;
      }
      if (kept()) put(line[i]);
      known = !outlines_.touches(line[i]);
    }
    finish();
  }

 private:
  bool kept() const { return (winding_ != 0) == (keep_ == Keep::inside); }

  int winding_before(Point a, Point b) {
    if (!outlines_.box().contains(a)) return 0;
    const Point step = b - a;
    Point far = a;
    while (outlines_.box().contains(far)) far = far - step;
    outlines_.crossings(far, a, crossings_);
    int sum = 0;
    for (const auto& crossing : crossings_) sum += crossing.enters ? 1 : -1;
    return sum;
  }

  /// A piece that has ended goes on when the line comes back in where it left: it only touched an outline.
  void put(Point p) {
    if (ended_ && !piece_.empty() && piece_.back() != p) finish();
    ended_ = false;
    if (piece_.empty() || piece_.back() != p) piece_.push_back(p);
  }

  void finish() {
    if (piece_.size() >= 2) out_.push_back({piece_, source_});
    piece_.clear();
    ended_ = false;
  }

  const SegmentIndex& outlines_;
  Keep keep_;
  std::vector<Piece>& out_;
  std::size_t source_ = 0;
  int winding_ = 0;
  bool ended_ = false;
  Polyline piece_;
  std::vector<SegmentIndex::Crossing> crossings_;
};
}  // namespace

std::vector<Piece> clip_lines(std::span<const Polyline> lines, const SegmentIndex& outlines, Keep keep) {
  std::vector<Piece> out;
  Walk walk(outlines, keep, out);
  StopNowAndThen stop(16);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    stop.step();
    walk.along(lines[i], i);
  }
  return out;
}

std::vector<Piece> clip_lines(std::span<const Polyline> lines, const Regions& regions, Keep keep) {
  return clip_lines(lines, SegmentIndex(regions), keep);
}

}  // namespace weft::geometry
