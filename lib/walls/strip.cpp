#include "walls/strip.h"

#include <algorithm>
#include <cmath>

namespace weft::walls {
namespace {

using Vertex = Line::Vertex;

constexpr double tip_step_um = 40;
constexpr double before_end_um = 4;  // the last chord: a square end need not be quite square
constexpr double off_share = 0.9;    // the middle of a chord stays within so much of the free width of the axis
constexpr double reach_share = 1.9;  // a chord goes no further than so many times the free width on its side

double quad_area(Place a, Place b, Place c, Place d) {
  return 0.5 * std::abs(cross({c.x - a.x, c.y - a.y}, {d.x - b.x, d.y - b.y}));
}

}  // namespace

void Strip::add_axis(Place at, double free) {
  along_.push_back(axis_.empty() ? 0 : along_.back() + distance(axis_.back(), at));
  axis_.push_back(at);
  free_.push_back(free);
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
      const Side& side = sides_[i];
      const Place a{side.a.x - p.x, side.a.y - p.y}, b{side.b.x - p.x, side.b.y - p.y};
      const double da = cross(n, a), db = cross(n, b);
      if ((da < 0) == (db < 0)) continue;
      const double u = da / (da - db);
      const double t = n.x * (a.x + u * (b.x - a.x)) + n.y * (a.y + u * (b.y - a.y));
      if (t >= 0)
        left = std::min(left, t);
      else
        right = std::max(right, t);
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

/// How far it is from an end of the axis straight on to the outline.
double Strip::reach_of_tip(Place end, Place way, bool first) const {
  double reach = 1e18;
  Place from = first ? left_.front().at : right_.back().at;
  auto meet = [&](Place to) {
    const Place a{from.x - end.x, from.y - end.y}, b{to.x - end.x, to.y - end.y};
    const double da = cross(way, a), db = cross(way, b);
    if ((da < 0) != (db < 0)) {
      const double u = da / (da - db), t = way.x * (a.x + u * (b.x - a.x)) + way.y * (a.y + u * (b.y - a.y));
      if (t > 0) reach = std::min(reach, t);
    }
    from = to;
  };
  for (const Place p : first ? first_tip : last_tip) meet(p);
  meet(first ? right_.front().at : left_.back().at);
  return reach < 1e17 ? reach : 0;
}

/// Where chords are laid: at each point of the axis, and closer where the sides may turn.
void Strip::sample(std::vector<double>& out) const {
  const double from = skip_first, to = along_.back() - skip_last;
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
  std::sort(out.begin(), out.end());
}

/// Where a strip ends for a change of count, its last ribs lean: on average it ends half as far away as their feet.
void Strip::lean() {
  auto beyond = [](Place end, Place before, Place a, Place b) {
    const Place way = unit(before, end);
    return ((a.x + b.x - 2 * end.x) * way.x + (a.y + b.y - 2 * end.y) * way.y) / 4;
  };
  first_leans_ = first_tip.empty() && skip_first == 0;
  last_leans_ = last_tip.empty() && skip_last == 0;
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

std::vector<Vertex> Strip::bead() {
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
  std::vector<double> samples;
  sample(samples);
  auto lead_on = [&](bool first) {  // beyond the axis, to the end of the tip
    if (closed || (first ? skip_first > 0 || first_tip.empty() : skip_last > 0 || last_tip.empty())) return;
    const double s = first ? 0 : whole, free = std::max(free_at(s), 20.0), over = std::min(whole, 2 * free);
    std::size_t edge = 0;
    const Place inner = at(first ? over : whole - over, edge), end = first ? axis_.front() : axis_.back();
    const Place way = unit(inner, end);
    const double reach = reach_of_tip(end, way, first);
    const int pieces = std::clamp(static_cast<int>(std::ceil(reach / tip_step_um)), 1, 60);
    if (reach < 5) return;
    for (int i = 1; i <= pieces; ++i) {
      const double x = reach * i / pieces - (i == pieces ? before_end_um : 0);
      const Place p{end.x + x * way.x, end.y + x * way.y};
      const Chord chord = across(p, first ? Place{-way.x, -way.y} : way, s, std::max(free, 100.0));
      if (!chord.found) break;
      if (first) {
        path.insert(path.begin(), {lerp(chord.left, chord.right, 0.5), distance(chord.left, chord.right)});
      } else {
        path.push_back({lerp(chord.left, chord.right, 0.5), distance(chord.left, chord.right)});
      }
    }
  };
  for (const double s : samples) {
    const double free = free_at(s);
    std::size_t edge = 0;
    const Place way = direction(s, std::max(0.5 * free, 10.0));
    const Chord chord = across(at(s, edge), way, s, free);
    add(path, chord, at(s, edge), way, free);
  }
  if (path.size() < 2) return {};
  if (closed) {
    path.front().width = (path.front().width + path.back().width) / 2;
    path.pop_back();
  }
  lead_on(true);
  lead_on(false);
  double volume = 0;
  for (std::size_t i = 1; i < path.size(); ++i)
    volume += distance(path[i - 1].at, path[i].at) * (path[i - 1].width + path[i].width) / 2;
  if (closed) volume += distance(path.back().at, path.front().at) * (path.back().width + path.front().width) / 2;
  if (volume < 1) return {};
  double own = area();  // and what walls that turn back at its ends leave of theirs
  own += 2 * (free_.front() * lean_first + free_.back() * lean_last);
  if (turn_first) own -= free_at(skip_first) * skip_first;  // in an arc
  if (turn_last) own -= free_at(whole - skip_last) * skip_last;
  const double scale = std::clamp(own / volume, 0.85, 1.15);
  for (Vertex& v : path) v.width *= scale;
  return path;
}

}  // namespace weft::walls
