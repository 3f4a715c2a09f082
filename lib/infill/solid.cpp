// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/solid.h"

#include "core/stop.h"
#include "infill/fit_sides.h"
#include "infill/fitted_lines.h"
#include "infill/scan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>

namespace weft::infill {
namespace {

using namespace weft::literals;

constexpr std::uint32_t nobody = std::numeric_limits<std::uint32_t>::max();
constexpr double short_lines = 1.5;       // bands; shorter lines cannot turn
constexpr double widest_pair = 2.4;       // bands across; wider strips are filled line by line
constexpr double widest_strand = 1.35;    // bands, of a bead along a strip: one and a half nozzles, of lines of 1.125
constexpr double narrowest_strand = 0.6;  // bands, of one of two
constexpr double narrowest_side = 0.25;   // bands, of a line that an edge runs along
// Where edges run along lines. The flow of an extruder that lags follows a step as 1 − e^(−x/L); with L = 2 mm, 40 ms
// at 50 mm/s, it errs over 2L(1 − e^(−D/L)) when it is asked for a swing of length D, both flanks together, and over D
// when it is not: it is better not asked below 1.6 L, seven and a half bands of 0.42 mm.
constexpr FitWidths beside_edges{.least = 0.65, .most = widest_strand, .steady_from = 7.5, .shared_by = 6};
constexpr double longest_turn = 2.7;      // bands; shallower edges are run along (fit_sides.h), not turned along
constexpr double least_left = 0.3;        // bands of a line between its turns; else the turn is as wide as the place
constexpr double most_lean = 4;           // bands that a narrow strip may lean from line to line and still be one strip
constexpr double deepest_bump = 0.25;     // bands that the edge may stand into a turn
constexpr double least_given_back = 0.9;  // of the width: a small area rather gets a little too much
constexpr double shortest_bead = 1;       // bands, however narrow: less is a dab, and the nozzle stops for nothing

/// Lines of a region in chains: intervals that lie over each other with no fork between them.
struct Chains {
  std::vector<std::vector<std::uint32_t>> intervals;  // of each chain, upwards
  std::vector<std::vector<std::uint32_t>> above;      // chains that must wait for it
  std::vector<std::uint32_t> waits_for;               // how many
};

/// The intervals that lie over each other on neighbouring lines: (lower, upper). In strips that lean further than they
/// are wide none overlap; there `leads_to` says whether the strip carries on from one to the other.
template <class LeadsTo>
std::vector<std::pair<std::uint32_t, std::uint32_t>> neighbours(const std::vector<Interval>& all, double lean,
                                                                LeadsTo leads_to) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  const auto n = static_cast<std::uint32_t>(all.size());
  for (std::uint32_t a = 0, b = 0; a < n; ++a) {
    while (b < n && all[b].line <= all[a].line) ++b;
    // b stays at the first that may be near the next a
    while (b < n && all[b].line == all[a].line + 1 && all[b].to <= all[a].from - lean) ++b;
    for (std::uint32_t c = b; c < n && all[c].line == all[a].line + 1 && all[c].from < all[a].to + lean; ++c) {
      const bool over = all[c].from < all[a].to && all[c].to > all[a].from;
      if (over || leads_to(a, c)) pairs.emplace_back(a, c);
    }
  }
  return pairs;
}

Chains chains_of(std::size_t count, const std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs) {
  const auto n = static_cast<std::uint32_t>(count);
  std::vector<std::uint32_t> up(n, 0), down(n, 0), only_up(n, nobody);
  for (const auto& [a, c] : pairs) ++up[a], ++down[c], only_up[a] = c;
  Chains chains;
  std::vector<std::uint32_t> chain(n, nobody);
  for (std::uint32_t a = 0; a < n; ++a) {
    if (chain[a] == nobody) {
      chain[a] = static_cast<std::uint32_t>(chains.intervals.size());
      chains.intervals.push_back({a});
    }
    const std::uint32_t c = only_up[a];
    if (up[a] == 1 && down[c] == 1) {
      chain[c] = chain[a];
      chains.intervals[chain[a]].push_back(c);
    }
  }
  chains.above.resize(chains.intervals.size());
  chains.waits_for.resize(chains.intervals.size(), 0);
  for (const auto& [a, c] : pairs) {
    if (chain[a] == chain[c]) continue;
    chains.above[chain[a]].push_back(chain[c]);
    ++chains.waits_for[chain[c]];
  }
  return chains;
}

class Filler {
 public:
  Filler(const Region& region, const SolidStyle& style, Beads& beads)
      : style_(style), beads_(beads), frame_(style.angle_rad, style.origin), outline_(region, frame_) {}

  void run() {
    const std::size_t before = beads_.size();
    lay();
    if (!style_.fixed_strand) give_back(before);
  }

 private:
  void lay() {
    if (!(outline_.greatest_y() > outline_.least_y())) return;
    if (style_.loose != nullptr) outline_.loosen(*style_.loose, frame_);
    lines_ = fitted_lines(outline_, style_.band);
    width_ = style_.fixed_strand ? style_.band : std::max(1, rounded(lines_.spacing));
    all_ = outline_.cut(lines_);
    if (!style_.fixed_strand) sides_.emplace(outline_, lines_, all_, lines_.spacing, beside_edges);
    if (sides_) end_where_they_lie();
    left_.reserve(all_.size()), right_.reserve(all_.size());
    for (const Interval& i : all_)
      left_.push_back(i.from - over(i.from_edge)), right_.push_back(i.to + over(i.to_edge));
    if (sides_) keep_to_room();
    const auto pairs = neighbours(all_, most_lean * lines_.spacing, [&](std::uint32_t a, std::uint32_t c) {
      return way(a, c, true).has_value() && way(a, c, false).has_value();
    });
    Chains chains = chains_of(all_.size(), pairs);
    std::vector<std::uint32_t> ready;
    for (std::uint32_t c = 0; c < chains.intervals.size(); ++c)
      if (chains.waits_for[c] == 0) ready.push_back(c);
    while (!ready.empty()) {
      stop_if_asked();
      const std::size_t next = nearest(ready, chains);
      const std::uint32_t c = ready[next];
      ready.erase(ready.begin() + static_cast<std::ptrdiff_t>(next));
      emit(chains.intervals[c]);
      for (const std::uint32_t waiting : chains.above[c])
        if (--chains.waits_for[waiting] == 0) ready.push_back(waiting);
    }
    end_bead();
  }

  /// Ends of lines that moved aside follow the edges there.
  void end_where_they_lie() {
    const auto along = [&](std::uint32_t i, double x, std::uint32_t edge) {
      const Turned a = outline_.points()[edge], b = outline_.points()[outline_.next(edge)];
      return is_along(edge) || a.x == b.x ? 0 : sides_->aside(i, x) * (b.x - a.x) / (b.y - a.y);
    };
    for (std::uint32_t i = 0; i < all_.size(); ++i) {
      Interval& line = all_[i];
      if (!sides_->shares(i)) continue;
      const double from = line.from + along(i, line.from, line.from_edge),
                   to = line.to + along(i, line.to, line.to_edge);
      if (to - from > lines_.spacing) line.from = from, line.to = to;
    }
  }

  /// Lines end where there is room for none, and are none where there is none for them at all.
  void keep_to_room() {
    for (std::uint32_t i = 0; i < all_.size(); ++i) {
      if (sides_->is_plain(i)) continue;
      const auto room = sides_->with_room(i);
      if (!room) left_[i] = right_[i] = all_[i].from;
      if (room && room->first > all_[i].from) left_[i] = room->first;
      if (room && room->second < all_[i].to) right_[i] = room->second;
    }
  }
  bool is_nothing(std::uint32_t i) const { return left_[i] >= right_[i]; }
  bool ends_early(std::uint32_t i, bool right) const {
    return right ? right_[i] < all_[i].to : left_[i] > all_[i].from;
  }

  /// What the ends reach over the edge comes out of the lines' width: the wall there has its plastic already.
  void give_back(std::size_t before) {
    if (prolonged_ <= 0) return;
    double laid = 0;
    for (std::size_t i = before; i < beads_.size(); ++i) laid += 1000 * length_mm(beads_[i]);
    const double share = std::max(1 - prolonged_ / std::max(laid, 1.0), least_given_back);
    for (std::size_t i = before; i < beads_.size(); ++i)
      for (Junction& j : beads_[i].path) j.width = std::max(1, rounded(share * j.width));
  }

  struct Vertex {
    Turned at;
    Um width = 0;
  };

  double length(std::uint32_t i) const { return all_[i].to - all_[i].from; }
  double y(std::uint32_t i) const { return lines_.y(all_[i].line); }

  /// Whether a line lies beside the edge that it ends at, and its neighbour fits itself to that.
  bool is_along(std::uint32_t edge) const {
    return sides_ && SideFit::along(outline_.points()[edge], outline_.points()[outline_.next(edge)]);
  }
  /// Of the angle between a line and its edge: not far along edges that are nearly parallel to it.
  double sine_to(std::uint32_t edge) const {
    const Turned a = outline_.points()[edge], b = outline_.points()[outline_.next(edge)];
    return std::max(std::abs(b.y - a.y) / std::hypot(b.x - a.x, b.y - a.y), 0.4);
  }
  /// How far a line is prolonged beyond its edge.
  double over(std::uint32_t edge) const { return is_along(edge) ? 0 : style_.overlap.along(sine_to(edge)); }
  /// How much less far it reaches where it does not turn.
  double kept_within(std::uint32_t i, bool right) const {
    if (!style_.ends_within) return 0;
    const std::uint32_t edge = right ? all_[i].to_edge : all_[i].from_edge;
    // Beside an edge that runs along it it is half as wide where it ends.
    const double back = lines_.spacing / (is_along(edge) ? 4 : 2) / sine_to(edge);
    return std::min(back, (length(i) - least_left * lines_.spacing) / 2);
  }

  /// Which of the ready chains begins nearest to where the nozzle is.
  std::size_t nearest(const std::vector<std::uint32_t>& ready, const Chains& chains) const {
    if (!started_) return 0;
    constexpr std::size_t looked_at = 64;  // bounds the work in regions of thousands of chains
    std::size_t best = 0;
    double best_distance = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < std::min(ready.size(), looked_at); ++i) {
      const std::uint32_t first = chains.intervals[ready[i]].front();
      const double dy = y(first) - at_.y;
      const double d = std::min(std::hypot(left_[first] - at_.x, dy), std::hypot(right_[first] - at_.x, dy));
      if (d < best_distance) best_distance = d, best = i;
    }
    return best;
  }

  /// Strips of up to two lines' width are filled along, the rest line by line.
  void emit(const std::vector<std::uint32_t>& chain) {
    const std::span<const std::uint32_t> all(chain);
    std::size_t lines_from = 0;
    for (std::size_t i = 0; i < chain.size();) {
      const auto [count, strands] = strip_at(all, i);
      if (count == 0) {
        ++i;
        continue;
      }
      if (i > lines_from) emit_lines(all.subspan(lines_from, i - lines_from));
      emit_strip(all.subspan(i, count), strands);
      i += count, lines_from = i;
    }
    if (lines_from < chain.size()) emit_lines(all.subspan(lines_from));
  }

  Turned middle(std::uint32_t i) const { return {(all_[i].from + all_[i].to) / 2, y(i)}; }

  /// About how wide the strip is that a chain runs along, across the line through the middles.
  double about_across(std::span<const std::uint32_t> chain, std::size_t i) const {
    const Turned a = middle(chain[i == 0 ? 0 : i - 1]), b = middle(chain[std::min(i + 1, chain.size() - 1)]);
    const double way = std::hypot(b.x - a.x, b.y - a.y);
    return way > 0 ? length(chain[i]) * (b.y - a.y) / way : length(chain[i]);
  }

  /// A place in the strip that a chain runs along, on a line of the chain, and how wide the strip is across there.
  struct Across {
    double x = 0, width = 0;
  };
  /// The place that is as many times as far from the strip's right side as from its left one as `share` says: half is
  /// on its axis, which runs beside the lines' middles where its sides lean towards each other.
  Across across(std::span<const std::uint32_t> chain, std::size_t i, double share = 0.5) const {
    const std::uint32_t before = chain[i == 0 ? 0 : i - 1], after = chain[std::min(i + 1, chain.size() - 1)];
    const double way = y(after) - y(before);
    const auto sine = [way](double from, double to) { return way > 0 ? way / std::hypot(way, to - from) : 1; };
    const double left = sine(all_[before].from, all_[after].from), right = sine(all_[before].to, all_[after].to);
    const double from_left = length(chain[i]) * share * right / ((1 - share) * left + share * right);
    return {all_[chain[i]].from + from_left, from_left * left + (length(chain[i]) - from_left) * right};
  }

  /// How many lines from i on cross a strip of that many strands; none when the place is not a strip.
  std::pair<std::size_t, int> strip_at(std::span<const std::uint32_t> chain, std::size_t i) const {
    const double lines = about_across(chain, i) / lines_.spacing;
    if (lines > widest_pair) return {0, 0};
    const int strands = lines < widest_strand ? 1 : 2;
    bool turns = false;  // one of the lines is long enough to turn at
    std::size_t end = i;
    for (; end < chain.size(); ++end) {
      const double width = about_across(chain, end) / lines_.spacing / strands;
      if (width > widest_strand || (strands > 1 && width < narrowest_strand)) break;
      turns |= length(chain[end]) >= short_lines * lines_.spacing;
    }
    const std::size_t least = turns ? 4 : 2;
    return end - i < least ? std::pair<std::size_t, int>{0, 0} : std::pair{end - i, strands};
  }

  /// There and back: each line a bead, or joined with the last one by a turn, also with the last one of the chain that
  /// was laid before where this one goes on from it.
  void emit_lines(std::span<const std::uint32_t> lines) {
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const std::uint32_t here = lines[i];
      if (is_nothing(here)) {
        end_bead();
        continue;
      }
      const std::optional<Joint> joint = open_ ? joint_to(here) : std::nullopt;
      const bool rightwards = joint || (i > 0 && open_) ? !open_->rightwards : nearer_to_left(here);
      double start = rightwards ? left_[here] : right_[here];
      const double end = rightwards ? right_[here] : left_[here];
      if (joint) {
        append_line(path_, open_->line, open_->start, open_->end - open_->along() * joint->before);
        start -= open_->along() * joint->after;
      } else {
        end_bead();
        start += (rightwards ? 1 : -1) * std::max(0.0, kept_within(here, !rightwards));
      }
      prolonged_ += std::max(0.0, all_[here].from - left_[here]) + std::max(0.0, right_[here] - all_[here].to);
      open_ = {here, rightwards, start, end};
      at_ = {end, y(here)}, started_ = true;
    }
  }

  bool nearer_to_left(std::uint32_t i) const {
    return !started_ || std::abs(left_[i] - at_.x) <= std::abs(right_[i] - at_.x);
  }

  void end_bead() {
    if (!open_) return;
    const double back = std::max(0.0, kept_within(open_->line, open_->rightwards));
    append_line(path_, open_->line, open_->start, open_->end - open_->along() * back);
    open_.reset();
    add(std::exchange(path_, {}), style_.role);
  }

  /// What a turn takes of the line before it and of the one after it: together as much as it is long.
  struct Joint {
    double before = 0, after = 0;
  };

  /// The turn from the line that is laid to one above it. As much is taken of both, but of one that is too short for it
  /// less, so that no line of an acute corner is a dab of its own.
  std::optional<Joint> joint_to(std::uint32_t next) const {
    const auto& [line, rightwards, start, end] = *open_;
    if (!style_.connect || all_[next].line != all_[line].line + 1 || ends_early(line, rightwards) ||
        ends_early(next, rightwards))
      return std::nullopt;
    const double turn = turn_length(line, next, rightwards);
    if (turn == 0) return std::nullopt;
    const double least = least_left * lines_.spacing, here = std::abs(end - start), there = length(next);
    if (here - turn / 2 > least && there > turn + least) return Joint{turn / 2, turn / 2};
    const double shorter_by = open_->along() * (end - (rightwards ? right_ : left_)[next]);
    for (const double after : {(there - least) / 2, there - least}) {
      const double back = shorter_by + 2 * after;  // √(spacing² + (back − taken)²) = taken
      if (after < 0 || after > turn / 2 || back <= 0) continue;
      const double taken = (lines_.spacing * lines_.spacing + back * back) / (2 * back), before = taken - after;
      if (before >= 0 && before <= turn && here - before > least) return Joint{before, after};
    }
    return std::nullopt;
  }

  /// A line from x to x, as wide at each place as its sides reach.
  void append_line(std::vector<Vertex>& path, std::uint32_t i, double from, double to) const {
    if (!sides_ || sides_->is_plain(i)) {
      for (const double x : {from, to}) path.push_back({{x, y(i)}, width_});
      return;
    }
    const std::vector<Sides> corners = sides_->of(i);
    const auto at = [&](double x) {
      auto after = std::find_if(corners.begin(), corners.end(), [x](const Sides& each) { return each.x >= x; });
      if (after == corners.end()) --after;
      const Sides& b = *after;
      const Sides& a = after == corners.begin() ? b : after[-1];
      const double t = b.x > a.x ? std::clamp((x - a.x) / (b.x - a.x), 0.0, 1.0) : 0;
      const double below = std::lerp(a.below, b.below, t), above = std::lerp(a.above, b.above, t);
      return Vertex{{x, y(i) + (above - below) / 2}, rounded(below + above)};
    };
    const auto inside = [&](const Sides& each) { return each.x > std::min(from, to) && each.x < std::max(from, to); };
    path.push_back(at(from));
    if (from < to) {
      for (auto c = corners.begin(); c != corners.end(); ++c)
        if (inside(*c)) path.push_back(at(c->x));
    } else {
      for (auto c = corners.rbegin(); c != corners.rend(); ++c)
        if (inside(*c)) path.push_back(at(c->x));
    }
    path.push_back(at(to));
  }

  /// Follows the edge from the right (or left) end of a line up to the same end of one on the next line: how far, in x,
  /// it stands inwards of the straight way between them; nothing when it does not lead there.
  std::optional<double> way(std::uint32_t a, std::uint32_t b, bool right) const {
    const double xa = right ? all_[a].to : all_[a].from, xb = right ? all_[b].to : all_[b].from;
    const std::uint32_t last = right ? all_[b].to_edge : all_[b].from_edge;
    std::uint32_t edge = right ? all_[a].to_edge : all_[a].from_edge;
    const bool with_ring = outline_.points()[outline_.next(edge)].y > outline_.points()[edge].y;
    const double low = y(a), high = y(b);
    double bump = 0;
    for (int steps = 0; edge != last; ++steps) {
      constexpr int most_steps = 1000;
      const std::uint32_t vertex = with_ring ? outline_.next(edge) : edge;
      const Turned v = outline_.points()[vertex];
      if (v.y < low || v.y > high || steps > most_steps) return std::nullopt;
      const double x = xa + (xb - xa) * (v.y - low) / lines_.spacing;
      bump = std::max(bump, right ? x - v.x : v.x - x);
      edge = with_ring ? vertex : outline_.previous(edge);
    }
    return bump;
  }

  /// Length of the turn at the right (or left) end from a line to the next, or 0 where the edge between them does not
  /// allow one.
  double turn_length(std::uint32_t a, std::uint32_t b, bool right) const {
    const double length = std::hypot(lines_.spacing, right ? all_[b].to - all_[a].to : all_[b].from - all_[a].from);
    if (length > longest_turn * lines_.spacing) return 0;
    const std::optional<double> bump = way(a, b, right);
    return bump && *bump <= deepest_bump * lines_.spacing ? length : 0;
  }

  /// Beads along a strip, side by side, together as wide as the strip is across.
  void emit_strip(std::span<const std::uint32_t> strip, int strands) {
    end_bead();
    if (strands == 1 && !style_.gaps) return;
    const Role role = strands == 1 && !style_.fixed_strand ? Role::gap_fill : style_.role;
    for (int k = 0; k < strands; ++k) {
      std::vector<Vertex> vertices;
      for (std::size_t i = 0; i < strip.size(); ++i) {
        const Across at = across(strip, i, (k + 0.5) / strands);
        vertices.push_back({{at.x, y(strip[i])}, rounded(at.width / strands)});
      }
      // The strip reaches half a line beyond its first and its last line, and so do round ends that lie there.
      const auto beyond = [](const Vertex& end, const Vertex& next) {
        return Vertex{{end.at.x - (next.at.x - end.at.x) / 2, end.at.y - (next.at.y - end.at.y) / 2}, end.width};
      };
      if (!style_.ends_within) {
        const Vertex first = beyond(vertices[0], vertices[1]),
                     last = beyond(vertices.back(), vertices[vertices.size() - 2]);
        vertices.insert(vertices.begin(), first), vertices.push_back(last);
      }
      const auto away = [&](const Vertex& v) { return std::hypot(v.at.x - at_.x, v.at.y - at_.y); };
      const bool turned = started_ && away(vertices.back()) < away(vertices.front());
      if (turned) std::reverse(vertices.begin(), vertices.end());
      add(without_thin_ends(vertices), role);
    }
  }

  /// A strip that runs out to nothing ends where a bead in it would be too thin to be laid.
  std::vector<Vertex> without_thin_ends(const std::vector<Vertex>& path) const {
    const Um least = rounded(narrowest_side * style_.band);
    const auto thick = [least](const Vertex& v) { return v.width >= least; };
    const auto from = std::find_if(path.begin(), path.end(), thick);
    const auto to = std::find_if(path.rbegin(), path.rend(), thick).base();
    if (from == path.end()) return {};
    const auto between = [least](const Vertex& thin, const Vertex& wide) {
      const double t = static_cast<double>(least - thin.width) / (wide.width - thin.width);
      return Vertex{{std::lerp(thin.at.x, wide.at.x, t), std::lerp(thin.at.y, wide.at.y, t)}, least};
    };
    std::vector<Vertex> out;
    if (from != path.begin()) out.push_back(between(from[-1], *from));
    out.insert(out.end(), from, to);
    if (to != path.end()) out.push_back(between(*to, to[-1]));
    return out;
  }

  void add(const std::vector<Vertex>& path, Role role) {
    // a sliver that cutting areas apart left between them
    const auto is_sliver = [&](const Vertex& v) { return v.width < narrowest_side * style_.band; };
    if (!style_.fixed_strand && std::all_of(path.begin(), path.end(), is_sliver)) return;
    double total = 0;
    for (std::size_t i = 1; i < path.size(); ++i)
      total += std::hypot(path[i].at.x - path[i - 1].at.x, path[i].at.y - path[i - 1].at.y);
    if (total - 2 * style_.overlap.um < shortest_bead * style_.band) return;
    Bead bead;
    bead.role = role, bead.part = style_.part, bead.sequence = style_.sequence;
    bead.path.reserve(path.size());
    for (const Vertex& vertex : path) {
      const Junction j{frame_.back(vertex.at), std::max(1, vertex.width), static_cast<float>(style_.flow)};
      if (bead.path.empty() || bead.path.back().at != j.at) bead.path.push_back(j);
    }
    if (bead.path.size() < 2) return;
    at_ = path.back().at, started_ = true;
    beads_.push_back(std::move(bead));
  }

  const SolidStyle& style_;
  Beads& beads_;
  Frame frame_;
  Outline outline_;
  LineSet lines_;
  Um width_ = 0;
  std::optional<SideFit> sides_;  // of lines that may be narrower and wider
  std::vector<Interval> all_;
  std::vector<double> left_, right_;  // ends of each interval, reaching over the edge
  /// A line that is to be laid as soon as it is known how it ends.
  struct OpenLine {
    std::uint32_t line = 0;
    bool rightwards = false;
    double start = 0, end = 0;
    double along() const { return rightwards ? 1 : -1; }
  };
  std::optional<OpenLine> open_;
  std::vector<Vertex> path_;  // of the bead that it ends
  Turned at_;
  bool started_ = false;
  double prolonged_ = 0;  // length of lines beyond their edges
};

}  // namespace

void fill_solid(const Region& region, const SolidStyle& style, Beads& beads) {
  if (style.band <= 0 || region.outer.size() < 3) return;
  Filler(region, style, beads).run();
}

}  // namespace weft::infill
