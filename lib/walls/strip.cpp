// SPDX-License-Identifier: GPL-3.0-or-later
#include "walls/strip.h"

#include "walls/stub.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace weft::walls {
namespace {

using Vertex = Line::Vertex;

constexpr double tip_step_um = 40;
constexpr double direction_share = 0.5;  // of the free width: so far before and behind a direction is told
constexpr double before_end_um = 4;      // the last chord: a square end need not be quite square
constexpr double off_share = 0.9;        // the middle of a chord stays within so much of the free width of the axis
constexpr double straight_share = 0.8;   // of the free width at its end: so far before it a bead goes straight on
constexpr double most_lean = 0.25;       // … and leans no more than so much to where there is more room
constexpr double closing = 2.5;          // sides that close in faster than this are the end
constexpr double width_of_end = 0.5;     // … no further than so many widths before it
constexpr double square_share = 0.4;     // … if all of it is at least so near to its mean distance
constexpr double squarish = 0.9;         // sine between an end's edge and the way to it: it is met squarely
constexpr double longer_axis = 2.5;  // … if the axis is longer than so many free widths; else it has no way of its own
constexpr double last_piece = 0.4;   // of the width: so long is what meets it
constexpr double sidestep = 0.6;     // … and so long the one before, which leads from the axis to it
constexpr double piece_share = 0.9;     // of the last piece that goes straight, the rest is the sidestep's
constexpr double end_beside = 0.4;      // of the width: beside its middle a blunt end is looked at, too
constexpr double stubby_share = 1.2;    // of its width: a strip whose axis is shorter is filled straight across
constexpr double outside_um = 8;        // so far a corner of a band may reach over the part's outline
constexpr std::uint32_t end_tags = 64;  // so many pieces of the axis before an end may have sides ahead of it
constexpr double reach_share = 1.9;     // a chord goes no further than so many times the free width on its side

double quad_area(Place a, Place b, Place c, Place d) {
  return 0.5 * std::abs(cross({c.x - a.x, c.y - a.y}, {d.x - b.x, d.y - b.y}));
}

/// The last piece of a path goes the given way, in the middle of the room it has and as wide as that, on average.
void square_off(std::vector<Vertex>& path, Place origin, Place way) {
  const auto along = [&](const Vertex& v) { return (v.at.x - origin.x) * way.x + (v.at.y - origin.y) * way.y; };
  const auto aside = [&](const Vertex& v) { return (v.at.y - origin.y) * way.x - (v.at.x - origin.x) * way.y; };
  const double end = along(path.back()), piece = last_piece * path.back().width;
  double length = 0, shift = 0, width = 0;
  while (path.size() > 1 && end - along(path.back()) < piece) {
    const Vertex &a = path[path.size() - 2], &b = path.back();
    const double l = along(b) - along(a);
    length += l, shift += l * (aside(a) + aside(b)) / 2, width += l * (a.width + b.width) / 2;
    path.pop_back();
  }
  if (length <= 0) return;
  shift /= length, width /= length;
  const double begin = end - piece_share * length;
  while (path.size() > 1 && begin - along(path.back()) < sidestep * width) path.pop_back();
  for (const double x : {begin, end})
    path.push_back({{origin.x + x * way.x - shift * way.y, origin.y + x * way.y + shift * way.x}, width});
}

}  // namespace

void Strip::add_axis(Place at, double free) {
  along_.push_back(axis_.empty() ? 0 : along_.back() + distance(axis_.back(), at));
  axis_.push_back(at);
  free_.push_back(free);
}

void Strip::add_bend(Place at, double free) {
  add_axis(at, free);
  bends_.push_back(along_.back());
}

void Strip::collect_sides() {
  const auto last = static_cast<std::uint32_t>(axis_.size() - 1);
  for (const auto* points : {&right_, &left_})
    for (std::size_t i = 1; i < points->size(); ++i)
      sides_.push_back({(*points)[i - 1].at, (*points)[i].at, (*points)[i - 1].tag});
  if (closed) {
    sides_.push_back({right_.back().at, right_.front().at, last});
    sides_.push_back({left_.back().at, left_.front().at, last});
  } else {
    auto add_tip = [&](Place from, const std::vector<Place>& tip, Place to, std::uint32_t tag) {
      if (tip.empty()) return;
      for (const Place p : tip) {
        sides_.push_back({from, p, tag});
        from = p;
      }
      sides_.push_back({from, to, tag});
    };
    add_tip(left_.front().at, first_tip, right_.front().at, 0);
    add_tip(right_.back().at, last_tip, left_.back().at, last);
  }
  std::stable_sort(sides_.begin(), sides_.end(), [](const Side& a, const Side& b) { return a.tag < b.tag; });
  first_.assign(axis_.size() + 1, 0);
  for (const Side& side : sides_) ++first_[side.tag + 1];
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
}

double Strip::area() const {
  double right = 0, left = 0;
  auto add = [o = axis_.front()](double& sum, Place a, Place b) {
    sum += 0.5 * cross({a.x - o.x, a.y - o.y}, {b.x - o.x, b.y - o.y});
  };
  for (std::size_t i = 1; i < right_.size(); ++i) add(right, right_[i - 1].at, right_[i].at);
  for (std::size_t i = 1; i < left_.size(); ++i) add(left, left_[i - 1].at, left_[i].at);
  if (closed) {
    add(right, right_.back().at, right_.front().at);
    add(left, left_.back().at, left_.front().at);
    return std::abs(right - left);
  }
  double tips = 0;
  auto add_tip = [&](Place from, const std::vector<Place>& tip, Place to) {
    for (const Place p : tip) {
      add(tips, from, p);
      from = p;
    }
    add(tips, from, to);
  };
  add_tip(right_.back().at, last_leans_ ? std::vector{axis_.back()} : last_tip, left_.back().at);
  add_tip(left_.front().at, first_leans_ ? std::vector{axis_.front()} : first_tip, right_.front().at);
  return std::abs(right - left + tips);
}

Place Strip::at(double s, std::size_t& edge) const {
  if (closed) s = std::fmod(s + along_.back(), along_.back());
  const auto it = std::upper_bound(along_.begin(), along_.end(), s);
  edge = static_cast<std::size_t>(
      std::clamp<std::ptrdiff_t>(it - along_.begin() - 1, 0, static_cast<std::ptrdiff_t>(axis_.size()) - 2));
  const double length = std::max(1e-9, along_[edge + 1] - along_[edge]);
  return lerp(axis_[edge], axis_[edge + 1], (s - along_[edge]) / length);
}

double Strip::free_at(double s) const {
  std::size_t edge = 0;
  at(s, edge);
  if (closed) s = std::fmod(s + along_.back(), along_.back());
  const double length = std::max(1e-9, along_[edge + 1] - along_[edge]);
  const double t = std::clamp((s - along_[edge]) / length, 0.0, 1.0);
  return free_[edge] + t * (free_[edge + 1] - free_[edge]);
}

Place Strip::direction(double s, double over) const {
  std::size_t edge = 0;
  if (closed) {
    over = std::min(over, along_.back() / 6);
    return unit(at(s - over, edge), at(s + over, edge));
  }
  return unit(at(std::max(0.0, s - over), edge), at(std::min(along_.back(), s + over), edge));
}

Strip::Chord Strip::across(Place p, Place way, double s, double free) const {
  const Place n{-way.y, way.x};  // to the left
  const double window = 2.5 * free + 50;
  const auto last = static_cast<std::ptrdiff_t>(axis_.size()) - 1;
  auto tag_at = [&](double along) {
    return std::clamp<std::ptrdiff_t>(std::upper_bound(along_.begin(), along_.end(), along) - along_.begin() - 1, 0,
                                      last);
  };
  double left = 1e18, right = -1e18;
  auto look = [&](std::ptrdiff_t from, std::ptrdiff_t to) {
    for (std::size_t i = first_[static_cast<std::size_t>(from)]; i < first_[static_cast<std::size_t>(to) + 1]; ++i) {
      const auto t = meets(p, n, sides_[i].a, sides_[i].b);
      if (!t) continue;
      if (*t >= 0)
        left = std::min(left, *t);
      else
        right = std::max(right, *t);
    }
  };
  look(tag_at(s - window), tag_at(s + window));
  if (closed && s - window < 0) look(tag_at(s - window + along_.back()), last);
  if (closed && s + window > along_.back()) look(0, tag_at(s + window - along_.back()));
  const bool found = left < 1e17 && right > -1e17;
  if (left > 1e17) left = free;  // beside the last rib, which leans
  if (right < -1e17) right = -free;
  const double most = reach_share * free + 20;
  left = std::min(left, most), right = std::max(right, -most);
  return {{p.x + left * n.x, p.y + left * n.y}, {p.x + right * n.x, p.y + right * n.y}, found};
}

Strip::Ahead Strip::ahead(Place p, Place way, bool first) const {
  Ahead out{1e18, {}};
  const auto last = static_cast<std::uint32_t>(axis_.size() - 1), some = std::min(last, end_tags);
  for (std::size_t i = first_[first ? 0 : last - some]; i < first_[first ? some + 1 : last + 1]; ++i) {
    const auto t = meets(p, way, sides_[i].a, sides_[i].b);
    if (t && *t > 0 && *t < out.reach) out = {*t, unit(sides_[i].a, sides_[i].b)};
  }
  return out.reach < 1e17 ? out : Ahead{};
}

/// The axis itself bends into the sharper corner of an end that is not quite square, and the bead would turn aside: it
/// goes straight on instead, square to the end's edge if it can. Returns where on the axis that begins; `out` gets its
/// vertices from there to the end.
double Strip::end_straight(bool first, std::vector<Vertex>& out) const {
  const double whole = along_.back(), s_end = first ? 0 : whole, free = std::max(free_at(s_end), 20.0);
  const double before = std::min(straight_share * free, 0.4 * whole), back = std::min(whole, before + 2 * free);
  std::size_t edge = 0;
  const auto inward = [&](double u) { return at(first ? u : whole - u, edge); };
  const double s = first ? before : whole - before;
  const Place start = inward(before), axis_way = unit(inward(back), start),
              edge_way = ahead(start, axis_way, first).edge;
  const double turn = cross(axis_way, edge_way);
  const bool square = whole > longer_axis * free && std::abs(turn) >= squarish;
  const Place way = !square    ? axis_way
                    : turn > 0 ? Place{edge_way.y, -edge_way.x}
                               : Place{-edge_way.y, edge_way.x},
              n{-way.y, way.x};
  double shift = 0, x = 0;
  const auto on_line = [&](double along, double aside) {
    return Place{start.x + along * way.x + aside * n.x, start.y + along * way.y + aside * n.y};
  };
  const auto lay = [&](double most) {
    const Place p = on_line(x, shift);
    const Chord chord = across(p, way, s_end, std::max(free, 100.0));
    if (!chord.found && x > before) return false;  // beside the axis a rib may lean
    const double left = (chord.left.x - p.x) * n.x + (chord.left.y - p.y) * n.y;
    const double right = (p.x - chord.right.x) * n.x + (p.y - chord.right.y) * n.y;
    const double by = std::clamp((left - right) / 2, -most, most);
    const double width = std::max(1.0, 2 * std::min(left - by, right + by));
    shift += by;
    out.push_back({on_line(x, shift), width});
    return true;
  };
  lay(off_share * free_at(s));
  const double reach = ahead(out.back().at, way, first).reach - before_end_um;
  const int pieces = std::clamp(static_cast<int>(std::ceil(reach / tip_step_um)), 0, 100);
  bool blunt = true;  // until proven tapered
  for (int i = 1; i <= pieces; ++i) {
    const double laid = x, straight = shift, width = out.back().width;
    x = reach * i / pieces;
    if (!lay(most_lean * reach / pieces)) return s;
    if (!blunt || reach - x > width_of_end * width || out.back().width > width - closing * tip_step_um) continue;
    // The end's own edge, nearly square: it is met in the middle.
    double least = 1e18, sum = 0;
    for (const double aside : {-end_beside * width, 0.0, end_beside * width}) {
      const double d = std::min(ahead(on_line(laid, straight + aside), way, first).reach, width);
      least = std::min(least, d), sum += d / 3;
    }
    blunt = i == pieces || least > square_share * sum;
    if (!blunt) continue;
    const double on = (outline ? std::min(sum, least + outside_um) : sum) - before_end_um;
    out.pop_back();
    if (on > 0) out.push_back({on_line(laid + on, straight), width});
    break;
  }
  if (square && !outline) square_off(out, start, way);
  return s;
}

/// Where chords are laid: at each point of the axis, and closer where the sides may turn.
void Strip::sample(double from, double to, std::vector<double>& out) const {
  out.push_back(from);
  for (std::size_t i = 0; i + 1 < axis_.size(); ++i) {
    const double a = along_[i], b = along_[i + 1], step = std::max(30.0, 0.35 * std::min(free_[i], free_[i + 1]));
    if (a > from && a < to) out.push_back(a);
    const int most = static_cast<int>((b - a) / (2 * step));
    const int pieces = std::min(6, most);
    for (int k = 1; k <= pieces; ++k)
      if (a + k * step > from && a + k * step < to) out.push_back(a + k * step);
    for (int k = pieces; k >= 1; --k)
      if (b - k * step > from && b - k * step < to) out.push_back(b - k * step);
  }
  if (to > from) out.push_back(to);
  // Before and behind a bend directions look past it: chords would be aslant.
  const auto within = [&](double s) { return s > from && s < to; };
  for (const double bend : bends_) {
    const double beside = direction_share * free_at(bend);
    std::erase_if(out, [&](double s) { return within(s) && within(bend) && std::abs(s - bend) < beside; });
  }
  std::copy_if(bends_.begin(), bends_.end(), std::back_inserter(out), within);
  std::sort(out.begin(), out.end());
}

/// Where a strip ends for a change of count, its last ribs lean: on average it ends half as far away as their feet.
void Strip::lean() {
  auto beyond = [](Place end, Place before, Place a, Place b) {
    const Place way = unit(before, end);
    return ((a.x + b.x - 2 * end.x) * way.x + (a.y + b.y - 2 * end.y) * way.y) / 4;
  };
  first_leans_ = first_tip.empty() && !first_pointed && skip_first == 0;
  last_leans_ = last_tip.empty() && !last_pointed && skip_last == 0;
  if (first_leans_) skip_first = -beyond(axis_.front(), axis_[1], right_.front().at, left_.front().at);
  if (last_leans_) skip_last = -beyond(axis_.back(), axis_[axis_.size() - 2], right_.back().at, left_.back().at);
}

/// A chord becomes a vertex; the widths of both ends of a piece are those whose volume is the area between their
/// chords.
void Strip::add(std::vector<Vertex>& path, const Chord& chord, Place on_axis, Place way, double free) {
  Place centre = lerp(chord.left, chord.right, 0.5);
  const double off = distance(on_axis, centre), most_off = off_share * free;  // within that circle is nothing but part
  if (off > most_off) centre = lerp(on_axis, centre, most_off / off);
  if (!path.empty()) {  // in a tight bend chords cross: the bead goes on where they no longer do
    const Place step{centre.x - path.back().at.x, centre.y - path.back().at.y};
    if (step.x * way.x + step.y * way.y <= 0 && std::hypot(step.x, step.y) < free) return;
  }
  double width = distance(chord.left, chord.right);
  if (!path.empty()) {
    const double length = distance(path.back().at, centre);
    if (length < 2) return;
    const double mean = (width + distance(last_.left, last_.right)) / 2;
    const double area = quad_area(last_.left, last_.right, chord.right, chord.left);
    const double fit = mean * length > 1 ? std::clamp(area / (mean * length), 0.8, 1.25) : 1;
    path.back().width *= (1 + fit) / 2;
    width *= (1 + fit) / 2;
  }
  path.push_back({centre, width});
  last_ = chord;
}

/// Whether the strip is hardly longer than wide.
bool Strip::stubby() const {
  if (closed || first_tip.empty() || last_tip.empty()) return false;
  return along_.back() < stubby_share * 2 * *std::max_element(free_.begin(), free_.end());
}

std::vector<Place> Strip::ring() const {
  std::vector<Place> out;
  for (const Point& p : right_) out.push_back(p.at);
  out.insert(out.end(), last_tip.begin(), last_tip.end());
  for (auto p = left_.rbegin(); p != left_.rend(); ++p) out.push_back(p->at);
  out.insert(out.end(), first_tip.begin(), first_tip.end());
  return out;
}

std::vector<Vertex> Strip::bead() {
  if (stubby()) return stub_bead(ring());
  std::vector<Vertex> path;
  const double whole = along_.back();
  double lean_first = 0, lean_last = 0;
  if (!closed) {
    lean();
    if (first_leans_ && skip_first > 0) std::swap(lean_first, skip_first);
    if (last_leans_ && skip_last > 0) std::swap(lean_last, skip_last);
  }
  const double most = std::max(0.0, whole - 20);
  const double skipped = std::max(0.0, skip_first) + std::max(0.0, skip_last);
  if (skipped > most)
    skip_first = std::min(skip_first, skip_first * most / skipped),
    skip_last = std::min(skip_last, skip_last * most / skipped);
  collect_sides();
  double from = skip_first, to = whole - skip_last;
  std::vector<Vertex> first_end, last_end;
  if (!closed && skip_first <= 0 && !first_tip.empty()) from = end_straight(true, first_end);
  if (!closed && skip_last <= 0 && !last_tip.empty()) to = end_straight(false, last_end);
  std::vector<double> samples;
  sample(from, to, samples);
  for (const double s : samples) {
    const double free = free_at(s);
    std::size_t edge = 0;
    const Place way = direction(s, std::max(direction_share * free, 10.0));
    const Place p = at(s, edge);
    const bool point = (first_pointed && s <= 0) || (last_pointed && s >= whole);
    add(path, point ? Chord{p, p, true} : across(p, way, s, free), p, way, free);
  }
  if (closed && path.size() > 1) {
    path.front().width = (path.front().width + path.back().width) / 2;
    path.pop_back();
  }
  if (!first_end.empty()) {
    if (!path.empty()) path.erase(path.begin());  // the end begins there
    path.insert(path.begin(), first_end.rbegin(), first_end.rend());
  }
  if (!last_end.empty()) {
    if (path.size() > first_end.size()) path.pop_back();
    path.insert(path.end(), last_end.begin(), last_end.end());
  }
  if (path.size() < 2) return {};
  double laid = area_of(path);
  if (closed) laid += area_between(path.back(), path.front());
  if (laid < 1) return {};
  double own = area();  // and what walls that turn back at its ends leave of theirs
  own += 2 * (free_.front() * lean_first + free_.back() * lean_last);
  if (turn_first) own -= free_at(skip_first) * skip_first;  // in an arc
  if (turn_last) own -= free_at(whole - skip_last) * skip_last;
  const double scale = std::clamp(own / laid, 0.85, 1.15);
  for (Vertex& v : path) v.width *= scale;
  return path;
}

}  // namespace weft::walls
