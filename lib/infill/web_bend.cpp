// SPDX-License-Identifier: GPL-3.0-or-later
// Lines of two directions that turn into each other where they would cross: the same walls, and nothing that the nozzle
// strikes. All lines run into one half of the plane, and each goes on along the other from where they meet: so no path
// ever comes back to itself.
#include "core/stop.h"
#include "infill/web.h"

#include <algorithm>

namespace weft::infill {
namespace {

constexpr double crowded = 1.5;  // bands: where two meetings of a line are nearer, as where three meet, lines cross
constexpr double in_front = 1;   // bands that a meeting is before a line's end, at least

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

void Web::bend_crossings() {
  auto all = meetings();
  // where meetings are crowded, none of both lines turns
  std::vector<std::vector<bool>> out(all.size());
  for (std::size_t line = 0; line < all.size(); ++line) out[line].assign(all[line].size(), false);
  const auto twin = [&](std::uint32_t line, std::size_t k) {
    const auto& others = all[all[line][k].other];
    return static_cast<std::size_t>(
        std::find_if(others.begin(), others.end(), [&](const Meeting& m) { return m.other == line; }) - others.begin());
  };
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
