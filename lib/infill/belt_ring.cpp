// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/belt_ring.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace weft::infill {
namespace {

constexpr double looked_at = widest_strip + 2;  // bands: how deep
constexpr double step_um = 200;                 // along the wall: half a bead
constexpr double shortest_um = 2000;            // of a line, of a pause in it, and of what is no spike between belts
constexpr double about_um = 500;                // that is about as long
constexpr double doubt = 1.5;                   // cells: nearer to a limit a width by cells says nothing

/// Whether a layer has a place and what is around it.
bool surely_has(const Mask& cells, Point p) {
  const int column = cells.grid().column_of(p.x), row = cells.grid().row_of(p.y);
  return cells.at(column, row) && cells.at(column - 1, row - 1) && cells.at(column + 1, row - 1) &&
         cells.at(column - 1, row + 1) && cells.at(column + 1, row + 1);
}

}  // namespace

void LengthLimit::add(double um) {
  if (std::abs(um - shortest_um) < about_um) near_.push_back(um);
}

double LengthLimit::um() const {
  std::vector<double> all = near_;
  std::sort(all.begin(), all.end());
  all.push_back(shortest_um + about_um);
  double last = shortest_um - about_um, gap = 0, limit = 0;
  for (const double um : all) {
    if (um - last > gap) gap = um - last, limit = (um + last) / 2;
    last = um;
  }
  return limit;
}

BeltRing::BeltRing(Ring ring, double depth_um, const BeltGround& ground)
    : ring_(std::move(ring)),
      depth_(depth_um),
      cell_(ground.solid.grid().cell),
      most_(looked_at * ground.band),
      ground_(ground) {
  for (std::size_t i = 0; i < ring_.size(); ++i) {
    const Point a = ring_[i], b = ring_[(i + 1) % ring_.size()];
    const double length = distance(a, b);
    if (length == 0) continue;
    const int looks = static_cast<int>(std::ceil(length / step_um));
    Sample s;
    s.nx = -(b.y - a.y) / length, s.ny = (b.x - a.x) / length;  // the inside is to the left
    s.length = length / looks;
    for (int k = 0; k < looks; ++k) {
      s.at = lerp(a, b, (k + 0.5) / looks), s.along = perimeter_ + (k + 0.5) * s.length;
      samples_.push_back(s);
      look_across(samples_.back());
    }
    perimeter_ += length;
  }
}

/// What is in the cell that far from the wall. Grids have a margin: nothing is outside.
BeltRing::Cell BeltRing::look(const Sample& s, double um) const {
  const Grid& grid = ground_.solid.grid();
  // Divided, not multiplied: on the border of two cells it is the same one whichever window of the grid this is.
  const int column = static_cast<int>((s.at.x - grid.origin.x + (um - depth_) * s.nx) / cell_),
            row = static_cast<int>((s.at.y - grid.origin.y + (um - depth_) * s.ny) / cell_);
  return ground_.sparse.at(column, row) ? Cell::sparse : ground_.solid.at(column, row) ? Cell::solid : Cell::wall;
}

/// From the wall to the first cell that is sparse, or half way to the other side.
void BeltRing::look_across(Sample& s) const {
  s.free = look(s, depth_) != Cell::wall;
  if (!s.free) return;
  double way = cell_ / 2;
  Cell found = Cell::wall;
  for (; way < most_; way += cell_) {
    found = look(s, way);
    if (found == Cell::sparse || (found == Cell::wall && way >= depth_)) break;
  }
  s.all_solid = found != Cell::sparse;
  s.width = (way - cell_ / 2) / (s.all_solid ? 2 : 1);
}

/// The same by outlines.
void BeltRing::measure(Sample& s, Measuring& on) const {
  const double by_cells = s.width * (s.all_solid ? 2 : 1), enough = std::min(by_cells + 3 * cell_, most_);
  s.width = std::min(first_that_all_cover(s, enough, on), most_);
  if (s.width == most_) s.width = std::min(first_that_all_cover(s, most_, on), most_);
  if (!s.all_solid && look(s, 2 * s.width + cell_) != Cell::wall) return;
  ground_.layers.here->edges().crossings(s.at, place(s, most_), on.met);
  if (!on.met.empty()) s.width = std::min(s.width, (depth_ + on.met.front().along * (most_ - depth_)) / 2);
}

/// How far it is from the wall to where every cover is, if that is no further than `most`. A cover that surely is where
/// those are that were asked need not be asked.
double BeltRing::first_that_all_cover(const Sample& s, double most, Measuring& on) const {
  const std::vector<Cover>& covers = ground_.layers.covers;
  on.changes.clear();
  on.asked.assign(covers.size(), false);
  double first = 0;
  int lack = 0;  // that many lack what is before the first change
  const auto next = [&] {
    const Point at = place(s, first);
    std::size_t i = 0;
    while (i < covers.size() && (on.asked[i] || surely_has(*covers[i].cells, at))) ++i;
    return i;
  };
  for (std::size_t i = next(); i < covers.size(); i = next()) {
    on.asked[i] = true;
    lack += add_changes(s, covers[i], most, on);
    std::sort(on.changes.begin(), on.changes.end());
    int still = lack;
    std::size_t k = 0;
    while (k < on.changes.size() && (still > 0 || on.changes[k].first <= 0)) still += on.changes[k++].second;
    if (still > 0) return beyond;
    if (k > 0) first = std::max(0.0, on.changes[k - 1].first);
  }
  return first;
}

/// Where a cover begins and ends along the way inwards: as far before and beyond its area's edges as it is grown.
/// @returns whether it lacks what is before its first change
bool BeltRing::add_changes(const Sample& s, const Cover& cover, double most, Measuring& on) const {
  const double by = cover.grown, from = -cell_ - by, to = most + by;
  cover.area->edges().crossings(place(s, from), place(s, to), on.met);
  if (on.met.empty()) return !cover.area->cells().at(s.at);
  const std::size_t before = on.changes.size();
  for (const auto& c : on.met) {
    const double at = from + c.along * (to - from);
    if (!c.enters)
      on.changes.push_back({at + by, 1});
    else if (on.changes.size() > before && on.changes.back().first >= at - by)
      on.changes.pop_back();  // grown, they are one
    else
      on.changes.push_back({at - by, -1});
  }
  return on.met.front().enters;
}

/// Maximal runs of samples, once around; a ring that is all one begins with the first.
template <class Is>
std::vector<BeltRing::Run> BeltRing::runs(const Is& is) const {
  const std::size_t n = samples_.size();
  std::vector<Run> out;
  std::size_t first = 0;
  while (first < n && is(samples_[first])) ++first;
  if (first == n && n > 0) return {{0, n}};
  bool goes_on = false;
  for (std::size_t k = 0, i = first; k < n; ++k, i = i + 1 < n ? i + 1 : 0) {
    if (!std::exchange(goes_on, is(samples_[i])) && goes_on) out.push_back({i, 0});
    if (goes_on) ++out.back().count;
  }
  return out;
}

double BeltRing::begins_um(std::size_t i) const {
  const Sample& s = sample(i);
  return s.along - s.length / 2 + perimeter_ * static_cast<double>(i / samples_.size());
}

void BeltRing::add_solid_runs(LengthLimit& limit) const {
  for (const Run& run : runs([](const Sample& s) { return s.all_solid; })) limit.add(length_of(run));
}

void BeltRing::open_solid_runs(double longest_um) {
  for (const Run& run : runs([](const Sample& s) { return s.all_solid; })) {
    if (length_of(run) < longest_um && run.count < samples_.size()) continue;
    for (std::size_t k = 0; k < run.count; ++k) samples_[(run.first + k) % samples_.size()].free = false;
  }
}

LinesBefore::LinesBefore(const std::vector<BeltLine>& lines, double band) : band_(band) {
  std::vector<geometry::Segment> segments;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const auto& [path, closed] = lines[k];
    ends_.push_back({path.front(), path.back(), !closed});
    for (std::size_t i = closed ? 0 : 1; i < path.size(); ++i) {
      segments.push_back({path[i == 0 ? path.size() - 1 : i - 1], path[i]});
      of_.push_back(static_cast<std::uint32_t>(k));
    }
  }
  index_ = geometry::SegmentIndex(std::move(segments));
}

double LinesBefore::within(Point at) const {
  if (ends_.empty()) return std::numeric_limits<double>::infinity();
  const double farthest = 2 * band_;
  const auto nearest = index_.nearest(at, farthest);
  if (!nearest) return -farthest;
  const Ends& ends = ends_[of_[nearest->segment]];
  if (!ends.open) return std::numeric_limits<double>::infinity();
  const double from_end = std::min(distance(nearest->at, ends.first), distance(nearest->at, ends.last));
  if (from_end > 0) return from_end;
  return -std::sqrt(std::max(0.0, nearest->distance_um * nearest->distance_um - band_ * band_));
}

void BeltRing::find_lines(const LinesBefore& before) {
  const auto too_narrow = [&](const Sample& s) { return s.width + cell_ < depth_; };
  if (std::all_of(samples_.begin(), samples_.end(), too_narrow)) return;
  const double in_doubt = doubt * cell_;
  Measuring on;
  for (Sample& s : samples_) {
    if (!s.free) continue;
    if (std::abs(over(s)) < in_doubt) measure(s, on);  // what may have a line or may not, as far as cells can tell
    s.over = over(s);
    if (s.over < 0) continue;
    s.within = before.within(s.at), s.over = std::min(s.over, s.within);
    s.line = s.over >= 0;
  }
}

/// By how much the belt is wide enough there, and narrow enough.
double BeltRing::over(const Sample& s) const {
  return std::min(s.width - depth_, widest_strip * ground_.band - s.width);
}

/// How much later than that sample what it is begins: where the width passes the limit.
double BeltRing::later(std::size_t i) const {
  const Sample &a = sample(i + samples_.size() - 1), &b = sample(i);
  if (!a.free || !b.free || (a.over >= 0) == (b.over >= 0)) return 0;
  return a.over / (a.over - b.over) * (a.length + b.length) / 2 - a.length / 2;
}

double BeltRing::drawn_length(const Run& run) const {
  return length_of(run) - later(run.first) + later(run.first + run.count);
}

/// Runs that have a line, or none, and could be the other: a pause only where a line may go on.
std::vector<BeltRing::Run> BeltRing::turnable(bool line) const {
  std::vector<Run> out = runs([&](const Sample& s) { return s.line == line; });
  std::erase_if(out, [&](const Run& run) {
    bool may = run.count < samples_.size();
    for (std::size_t k = 0; k < run.count && may; ++k) {
      const Sample& s = sample(run.first + k);
      may = line || (s.free && s.within >= 0);
    }
    return !may;
  });
  return out;
}

void BeltRing::add_runs(bool line, LengthLimit& limit) const {
  for (const Run& run : turnable(line)) limit.add(drawn_length(run));
}

void BeltRing::turn_short(bool line, double least_um) {
  for (const Run& run : turnable(line))
    if (drawn_length(run) < least_um)
      for (std::size_t k = 0; k < run.count; ++k) samples_[(run.first + k) % samples_.size()].line = !line;
}

std::vector<BeltLine> BeltRing::lines() const {
  std::vector<BeltLine> out;
  for (const Run& run : runs([](const Sample& s) { return s.line; })) {
    if (run.count == samples_.size()) return {{ring_, true}};
    const std::size_t end = run.first + run.count;
    out.push_back({between(begins_um(run.first) + later(run.first), begins_um(end) + later(end)), false});
  }
  return out;
}

/// The ring from one place to another.
Polyline BeltRing::between(double from, double to) const {
  Polyline out;
  const std::size_t n = ring_.size();
  double at = 0;
  for (std::size_t i = 0; i < 2 * n && at < to; ++i) {
    const Point a = ring_[i % n], b = ring_[(i + 1) % n];
    const double length = distance(a, b);
    if (length > 0 && at + length > from) {
      if (out.empty()) out.push_back(lerp(a, b, std::max(0.0, (from - at) / length)));
      out.push_back(lerp(a, b, std::min(1.0, (to - at) / length)));
    }
    at += length;
  }
  return out;
}

}  // namespace weft::infill
