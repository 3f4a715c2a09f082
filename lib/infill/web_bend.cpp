// SPDX-License-Identifier: GPL-3.0-or-later
// Lines of two directions that turn into each other where they would cross: the same walls, and nothing that the nozzle
// strikes. All lines run into one half of the plane, and each goes on along the other from where they meet: so no path
// ever comes back to itself.
#include "core/stop.h"
#include "infill/web.h"

#include <algorithm>
#include <array>
#include <numbers>

namespace weft::infill {
namespace {

constexpr double crowded = 1.5;    // bands: where two meetings of a line are nearer, as where three meet, lines cross
constexpr double one_place = 0.3;  // bands: three lines that meet so near each other meet in a place
constexpr double in_front = 1;     // bands that a meeting is before a line's end, at least

}  // namespace

/// The part of a line between two distances from its beginning.
std::vector<Place> Web::stretch(std::uint32_t line, double from, double to) const {
  const std::vector<Place>& places = lines_[line].places;
  std::vector<Place> out;
  double way = 0;
  for (std::size_t i = 1; i < places.size(); ++i) {
    const Place a = places[i - 1], d = places[i] - a;
    const double l = norm(d);
    const auto at = [&](double s) { return a + (l > 0 ? std::clamp((s - way) / l, 0.0, 1.0) : 0.0) * d; };
    if (way + l >= from && out.empty()) out.push_back(at(from));
    if (!out.empty() && way + l < to) out.push_back(places[i]);
    if (!out.empty() && way + l >= to) {
      out.push_back(at(to));
      break;
    }
    way += l;
  }
  while (out.size() < 2) out.push_back(places.back());  // what is left is less than rounding
  return out;
}

/// Where lines of different families meet, by line, from its beginning on.
std::vector<std::vector<Web::Meeting>> Web::meetings() const {
  std::vector<std::vector<Meeting>> out(lines_.size());
  const double half = in_front * style_.band;
  StopNowAndThen stop(16);
  for (std::uint32_t a = 0; a < lines_.size(); ++a) {
    stop.step();
    for (std::uint32_t b = a + 1; b < lines_.size(); ++b) {
      if (family_[a] == family_[b]) continue;
      const Place p = lines_[a].places.front(), q = lines_[b].places.front();
      const Place d = lines_[a].places.back() - p, e = lines_[b].places.back() - q;
      const double cross = d.x * e.y - d.y * e.x, ld = norm(d), le = norm(e);
      if (std::abs(cross) < 0.1 * ld * le) continue;
      const double s = ((q.x - p.x) * e.y - (q.y - p.y) * e.x) / cross * ld,
                   t = ((q.x - p.x) * d.y - (q.y - p.y) * d.x) / cross * le;
      if (s < half || s > ld - half || t < half || t > le - half) continue;
      const double cosine = (d.x * e.x + d.y * e.y) / (ld * le);
      const double cut = style_.band / 2.0 / std::sqrt((1 - cosine) / 2);  // corners lie a band apart
      out[a].push_back({b, s, cut}), out[b].push_back({a, t, cut});
    }
  }
  for (auto& all : out)
    std::sort(all.begin(), all.end(), [](const Meeting& m, const Meeting& n) { return m.at < n.at; });
  return out;
}

/// Of a line's meetings, the one with another line; their number where they do not meet.
std::size_t Web::meeting_with(const std::vector<Meeting>& meetings, std::uint32_t other) {
  return static_cast<std::size_t>(
      std::find_if(meetings.begin(), meetings.end(), [&](const Meeting& m) { return m.other == other; }) -
      meetings.begin());
}

/// Where three lines meet in a place the outer two turn, far enough apart that the middle one runs between them.
void Web::part_threes(std::vector<std::vector<Meeting>>& all) const {
  const double together = one_place * style_.band;
  const auto direction = [&](std::uint32_t line) {  // all run into one half of the plane
    const Place d = lines_[line].places.back() - lines_[line].places.front();
    const double angle = std::atan2(d.y, d.x);
    return angle < -1e-9 ? angle + 2 * std::numbers::pi : angle;
  };
  for (std::uint32_t line = 0; line < all.size(); ++line)
    for (std::size_t k = 1; k < all[line].size(); ++k) {
      const Meeting &m = all[line][k - 1], &n = all[line][k];
      if (n.at - m.at > together || family_[m.other] == family_[n.other]) continue;
      std::array<std::uint32_t, 3> three{line, m.other, n.other};
      std::sort(three.begin(), three.end(),
                [&](std::uint32_t a, std::uint32_t b) { return direction(a) < direction(b); });
      const auto [first, middle, last] = three;
      if (line != middle) continue;  // seen from there once
      const std::size_t at_first = meeting_with(all[first], last), at_last = meeting_with(all[last], first);
      const std::size_t to_first = meeting_with(all[first], middle), to_last = meeting_with(all[last], middle);
      if (at_first == all[first].size() || to_first == all[first].size() || to_last == all[last].size()) continue;
      if (std::abs(all[first][at_first].at - all[first][to_first].at) > together) continue;
      all[first][at_first].cut *= 2, all[last][at_last].cut *= 2;
      const auto drop = [&](std::uint32_t from, std::size_t which) {
        all[from].erase(all[from].begin() + static_cast<std::ptrdiff_t>(which));
      };
      drop(first, to_first), drop(last, to_last), drop(line, k), drop(line, k - 1);
      k = 0;
    }
}

void Web::bend_crossings() {
  auto all = meetings();
  part_threes(all);
  // where meetings are crowded, none of both lines turns
  std::vector<std::vector<bool>> out(all.size());
  for (std::size_t line = 0; line < all.size(); ++line) out[line].assign(all[line].size(), false);
  const auto twin = [&](std::uint32_t line, std::size_t k) { return meeting_with(all[all[line][k].other], line); };
  for (std::uint32_t line = 0; line < all.size(); ++line)
    for (std::size_t k = 1; k < all[line].size(); ++k)
      if (all[line][k].at - all[line][k - 1].at < crowded * style_.band)
        for (const std::size_t each : {k - 1, k})
          out[line][each] = true, out[all[line][each].other][twin(line, each)] = true;
  for (std::size_t line = 0; line < all.size(); ++line)
    for (std::size_t k = all[line].size(); k-- > 0;)
      if (out[line][k]) all[line].erase(all[line].begin() + static_cast<std::ptrdiff_t>(k));
  std::vector<Line> lines;
  std::vector<End> ends;
  for (std::uint32_t start = 0; start < lines_.size(); ++start) {
    std::vector<Place> path;
    std::uint32_t line = start;
    double from = 0;
    for (std::size_t next = 0;;) {
      const bool turns = next < all[line].size();
      const double to = turns ? all[line][next].at - all[line][next].cut : length(line);
      const std::vector<Place> part = stretch(line, from, std::max(from, to));
      path.insert(path.end(), part.begin(), part.end());
      if (!turns) break;
      const std::size_t other = twin(line, next);
      const std::uint32_t onto = all[line][next].other;
      from = all[onto][other].at + all[onto][other].cut;
      line = onto, next = other + 1;
    }
    const double way = infill::length_of(path);
    lines.push_back({std::move(path), way});
    ends.push_back(ends_[2 * start]), ends.push_back(ends_[2 * line + 1]);
  }
  lines_ = std::move(lines), ends_ = std::move(ends);
}

}  // namespace weft::infill
