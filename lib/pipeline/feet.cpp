// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/feet.h"

#include "geometry/along_path.h"
#include "geometry/spatial_index.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace weft::pipeline {
namespace {

/// A part of a bead by how far along it, µm.
struct Stretch {
  double from = 0, to = 0;
};

/// A bead with its length.
class Walk {
 public:
  explicit Walk(const Bead& bead) : bead_(bead), path_(bead.path) {
    if (bead.closed) path_.push_back(path_.front());
    at_.push_back(0);
    for (std::size_t i = 1; i < path_.size(); ++i) at_.push_back(at_.back() + distance(path_[i - 1].at, path_[i].at));
    constexpr double step = 100;
    const int count = std::max(1, static_cast<int>(length() / step));
    for (int i = 0; i < count; ++i) middles_.push_back(junction(length() * (i + 0.5) / count).at);
  }
  double length() const { return at_.back(); }

  /// The runs over an area.
  std::vector<Stretch> over(const geometry::SegmentIndex& area) const {
    return runs(geometry::lie_within(middles_, area));
  }
  /// The runs that what lies on the bead only leans on.
  std::vector<Stretch> leant_on(const LayerPlastic& above) const {
    return above.empty() ? std::vector<Stretch>{} : runs(above.leaning(middles_));
  }
  Bead piece(Stretch part) const {
    Bead out = bead_;
    out.closed = false;
    out.path = {junction(part.from)};
    for (std::size_t i = 0; i < path_.size(); ++i)
      if (at_[i] > part.from && at_[i] < part.to) out.path.push_back(path_[i]);
    out.path.push_back(junction(part.to));
    return out;
  }

 private:
  /// Its steps that follow each other, taken together.
  /// @param of_them  which of them
  std::vector<Stretch> runs(const std::vector<char>& of_them) const {
    const auto count = static_cast<double>(middles_.size());
    std::vector<Stretch> out;
    bool was = false;
    for (std::size_t i = 0; i < middles_.size(); ++i) {
      const auto at = static_cast<double>(i);
      const double from = length() * at / count, to = length() * (at + 1) / count;
      const bool is = of_them[i] != 0;
      if (is && was) out.back().to = to;
      if (is && !was) out.push_back({from, to});
      was = is;
    }
    return out;
  }
  Junction junction(double along) const {
    const auto next = std::upper_bound(at_.begin() + 1, at_.end() - 1, along) - at_.begin();
    const auto i = static_cast<std::size_t>(next);
    const double length = at_[i] - at_[i - 1];
    Junction out = path_[i];
    if (length > 0) out.at = lerp(path_[i - 1].at, path_[i].at, std::clamp((along - at_[i - 1]) / length, 0.0, 1.0));
    return out;
  }

  const Bead& bead_;
  std::vector<Junction> path_;
  std::vector<double> at_;
  Polyline middles_;  ///< of its steps, of 0.1 mm or nearly
};

/// What of runs lies beside stretches that are longer than that.
std::vector<Stretch> without_long(std::vector<Stretch> runs, const std::vector<Stretch>& stretches,
                                  double longer_than) {
  for (const Stretch out : stretches) {
    if (out.to - out.from <= longer_than) continue;
    std::vector<Stretch> left;
    for (const Stretch run : runs) {
      if (run.from < out.from) left.push_back({run.from, std::min(run.to, out.from)});
      if (run.to > out.to) left.push_back({std::max(run.from, out.to), run.to});
    }
    runs = std::move(left);
  }
  return runs;
}

/// What is left out of a run between its feet.
void leave_out(Stretch run, bool around, FeetStyle style, std::vector<Stretch>& gaps) {
  constexpr double least_feet = 3;
  const double foot = style.foot, length = run.to - run.from, feet_in_line = around ? 0 : foot;
  const double count = std::ceil((length - feet_in_line) / (foot + style.apart));
  const double pitch = (length - feet_in_line) / std::max(count, around ? least_feet : least_feet - 1);
  if (pitch < 2 * foot) return;
  for (double from = run.from + foot; from < run.to - foot / 2; from += pitch)
    gaps.push_back({from, from + pitch - foot});
}

}  // namespace

Beads on_feet(Beads beads, const Regions& on_part, const LayerPlastic& above, FeetStyle style) {
  if (on_part.empty()) return beads;
  const geometry::SegmentIndex area(on_part);
  std::vector<Box> boxes;
  for (const Region& region : on_part) boxes.push_back(box_of(region.outer));
  Beads out;
  for (Bead& bead : beads) {
    const Box box = box_of(bead);
    if (std::none_of(boxes.begin(), boxes.end(), [&](const Box& there) { return there.overlaps(box); })) {
      out.push_back(std::move(bead));
      continue;
    }
    const Walk walk(bead);
    std::vector<Stretch> gaps;
    for (const Stretch run : without_long(walk.over(area), walk.leant_on(above), style.apart))
      leave_out(run, bead.closed && run.to - run.from >= walk.length(), style, gaps);
    double from = 0;
    for (const Stretch gap : gaps) {
      out.push_back(walk.piece({from, gap.from}));
      from = gap.to;
    }
    if (gaps.empty())
      out.push_back(std::move(bead));
    else if (from < walk.length())
      out.push_back(walk.piece({from, walk.length()}));
  }
  return out;
}

}  // namespace weft::pipeline
