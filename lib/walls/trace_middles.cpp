#include "walls/trace.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace weft::walls {
namespace {

using Vertex = Line::Vertex;
constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

double distance(Place a, Place b) {
  return std::hypot(b.x - a.x, b.y - a.y);
}
double cross(Place o, Place a, Place b) {
  return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}
double quad_area(Place a, Place b, Place c, Place d) {
  return 0.5 * std::abs(cross(a, b, c) + cross(a, c, d));
}
Place unit(Place from, Place to) {
  const double d = std::max(1e-9, distance(from, to));
  return {(to.x - from.x) / d, (to.y - from.y) / d};
}

class Tracer {
 public:
  Tracer(const Skeleton& s, const Laying& laying) : s_(s), laying_(laying), onward_(s.halves.size(), none) {}

  std::vector<Line> run() {
    join_nodes();
    std::vector<std::uint8_t> seen(s_.edge_count(), 0);
    for (const bool loops : {false, true})
      for (std::uint32_t h = 0; h < s_.halves.size(); ++h) {
        if (!middle(h) || seen[h / 2]) continue;
        if (!loops && onward_[Skeleton::twin(h)] != none) continue;  // not the start of an open line
        follow(h, loops, seen);
      }
    for (const std::uint32_t h : laying_.dots) dot(h);
    return std::move(out_);
  }

 private:
  bool middle(std::uint32_t h) const { return laying_.spans[h / 2].middle; }

  /// At each node the two middles that are straightest to each other go on in one another.
  void join_nodes() {
    std::vector<std::uint8_t> done(s_.halves.size(), 0);
    std::vector<std::uint32_t> leaving;
    for (std::uint32_t start = 0; start < s_.halves.size(); ++start) {
      if (!middle(start) || done[start]) continue;
      leaving.clear();
      std::uint32_t h = start;
      do {
        if (middle(h)) {
          leaving.push_back(h);
          done[h] = 1;
        }
        h = s_.halves[Skeleton::twin(h)].next;
      } while (h != start);
      while (leaving.size() > 1) {
        std::size_t a = 0, b = 1;
        double best = 2;
        for (std::size_t i = 0; i < leaving.size(); ++i)
          for (std::size_t j = i + 1; j < leaving.size(); ++j) {
            if (laying_.spans[leaving[i] / 2].pairs != laying_.spans[leaving[j] / 2].pairs) continue;
            const Place u = direction(leaving[i]), v = direction(leaving[j]);
            const double c = u.x * v.x + u.y * v.y;
            if (c < best) best = c, a = i, b = j;
          }
        if (best > 1.5) break;
        onward_[Skeleton::twin(leaving[a])] = leaving[b];
        onward_[Skeleton::twin(leaving[b])] = leaving[a];
        leaving.erase(leaving.begin() + static_cast<long>(b));
        leaving.erase(leaving.begin() + static_cast<long>(a));
      }
    }
  }

  Place direction(std::uint32_t h) const { return unit(s_.start(h).at, s_.end(h).at); }

  Vertex vertex(Place at, double width) const { return {at, width}; }

  /// Where the part widens abruptly: the area between the ribs, as a share of the bead's.
  double fit(std::uint32_t h, double a, double b, double bead) const {
    const auto &p = s_.start(h), &q = s_.end(h);
    const std::uint32_t t = Skeleton::twin(h);
    a = std::min(a, p.clearance), b = std::min(b, q.clearance);
    const double area = quad_area(s_.on_start_rib(h, a), s_.on_end_rib(h, b), q.at, p.at) +
                        quad_area(s_.on_start_rib(t, b), s_.on_end_rib(t, a), p.at, q.at);
    return bead > 1 ? std::clamp(area / bead, 0.5, 1.1) : 1.0;
  }

  void follow(std::uint32_t h, bool closed, std::vector<std::uint8_t>& seen) {
    Line line;
    line.closed = closed;
    line.inset = laying_.spans[h / 2].pairs;
    const std::uint32_t begin = h;
    std::uint32_t last = h;
    while (h != none && !seen[h / 2]) {
      seen[h / 2] = 1;
      const auto k = static_cast<std::size_t>(laying_.spans[h / 2].pairs);
      const double a = laying_.start(h)[k], b = laying_.end(h)[k];
      const auto &p = s_.start(h), &q = s_.end(h);
      double wa = 2 * std::max(0.0, p.clearance - a), wb = 2 * std::max(0.0, q.clearance - b);
      // The ribs lean against the axis by the angle at which the part tapers; the bead is measured across the axis.
      const double length = distance(p.at, q.at), lean = std::abs(q.clearance - p.clearance) / std::max(1.0, length);
      const double f = lean < 0.35 ? 1 / std::sqrt(1 - lean * lean) : fit(h, a, b, (wa + wb) / 2 * length);
      wa *= f, wb *= f;
      append(line.path, {p.at, wa}, {q.at, wb});
      last = h;
      h = onward_[h];
    }
    if (!closed) {
      lead_on(line.path, last);
      std::reverse(line.path.begin(), line.path.end());
      lead_on(line.path, Skeleton::twin(begin));
      if (line.path.size() < 2) return;
    } else if (line.path.size() > 2) {
      line.path.front().width = (line.path.front().width + line.path.back().width) / 2;
      line.path.pop_back();
    }
    out_.push_back(std::move(line));
  }

  /// What lies beyond the end of a middle that ends because the part ends: the outline of it, at the distance of the
  /// walls around the middle.
  std::vector<Place> tip_of(std::uint32_t h, double inner) const {
    std::vector<Place> ring{s_.on_end_rib(h, std::min(inner, s_.end(h).clearance))};
    for (std::uint32_t g = s_.halves[h].next; g != Skeleton::twin(h); g = s_.halves[g].next) {
      if (laying_.spans[g / 2].core || laying_.spans[g / 2].mouth) return {};
      add_piece(g, inner, ring);
    }
    ring.push_back(s_.end(h).at);
    return ring;
  }

  /// The line at distance `inner` over one half, up to where the axis comes nearer to the outline than that.
  void add_piece(std::uint32_t g, double inner, std::vector<Place>& ring) const {
    const double a = s_.start(g).clearance, b = s_.end(g).clearance;
    const auto level = [&] {
      const double t = (inner - a) / (b - a);
      const Place p = s_.start(g).at, q = s_.end(g).at;
      return Place{p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)};
    };
    if (a < inner && b < inner) return;
    ring.push_back(a < inner ? level() : s_.on_start_rib(g, inner));
    ring.push_back(b < inner ? level() : s_.on_end_rib(g, inner));
  }

  bool ends_at_fork(std::uint32_t h) const {
    int others = 0;
    for (std::uint32_t g = s_.halves[h].next; g != Skeleton::twin(h); g = s_.halves[Skeleton::twin(g)].next)
      others += laying_.spans[g / 2].core ? 1 : 0;
    return others >= 2;
  }

  /// Where other beads pass by the end of a branch, it ends at its mouth: between the feet of its last ribs.
  void make_room(std::vector<Vertex>& path, std::uint32_t h) const {
    const Place right = s_.halves[s_.halves[h].next].foot, left = s_.halves[Skeleton::twin(h)].foot,
                node = s_.end(h).at;
    const Place back = unit(node, s_.start(h).at);
    double by = ((right.x + left.x) / 2 - node.x) * back.x + ((right.y + left.y) / 2 - node.y) * back.y;
    while (by > 0 && path.size() > 1) {
      const Vertex last = path.back(), before = path[path.size() - 2];
      const double d = distance(last.at, before.at);
      if (d > by) {
        const double t = by / d;
        path.back() = {{last.at.x + t * (before.at.x - last.at.x), last.at.y + t * (before.at.y - last.at.y)},
                       last.width + t * (before.width - last.width)};
        return;
      }
      by -= d;
      path.pop_back();
    }
  }

  void lead_on(std::vector<Vertex>& path, std::uint32_t h) const {
    const auto k = static_cast<std::size_t>(laying_.spans[h / 2].pairs);
    const double inner = laying_.end(h)[k];
    if (ends_at_fork(h)) {
      make_room(path, h);
      return;
    }
    if (s_.end(h).clearance - inner < 5) return;
    const auto ring = tip_of(h, inner);
    if (ring.size() < 3) return;
    // The direction over the last stretch as long as the part is thick.
    std::size_t back = path.size() - 1;
    while (back > 0 && distance(path[back].at, path.back().at) < s_.end(h).clearance) --back;
    const Place d = unit(path[back].at, path.back().at);
    slice(ring, path.back().at, d, path);
  }

  /// Continues a path from `from` along d over a ring: the chords across give places and widths.
  void slice(const std::vector<Place>& ring, Place from, Place d, std::vector<Vertex>& path) const {
    auto along = [&](Place p) { return (p.x - from.x) * d.x + (p.y - from.y) * d.y; };
    auto across = [&](Place p) { return (p.y - from.y) * d.x - (p.x - from.x) * d.y; };
    double reach = 0;
    for (const Place p : ring) reach = std::max(reach, along(p));
    if (reach < 5) return;
    const int pieces = std::clamp(static_cast<int>(std::ceil(reach / 40)), 2, 40);
    for (int i = 0; i <= pieces; ++i) {
      const double x = std::clamp(reach * i / pieces, 0.5, reach - 0.5);
      double low = 1e18, high = -1e18;
      for (std::size_t j = 0; j < ring.size(); ++j) {
        const Place p = ring[j], q = ring[(j + 1) % ring.size()];
        const double a = along(p), b = along(q);
        if ((a < x) == (b < x)) continue;
        const double y = across(p) + (x - a) / (b - a) * (across(q) - across(p));
        low = std::min(low, y), high = std::max(high, y);
      }
      if (high <= low) continue;
      const double y = (low + high) / 2, at = reach * i / pieces;
      if (i == 0) {
        path.back().width = (path.back().width + high - low) / 2;
        continue;
      }
      path.push_back({{from.x + at * d.x - y * d.y, from.y + at * d.y + y * d.x}, high - low});
    }
  }

  /// A part as long as it is wide, with a single bead: laid along its longest edge.
  void dot(std::uint32_t start) {
    std::vector<Place> ring;
    std::uint32_t h = start;
    do {
      ring.push_back(s_.halves[h].foot);
      h = s_.halves[h].next;
    } while (h != start);
    Place d{1, 0};
    double longest = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const double length = distance(ring[i], ring[(i + 1) % ring.size()]);
      if (length > longest) longest = length, d = unit(ring[i], ring[(i + 1) % ring.size()]);
    }
    const Place centre = s_.start(start).at;
    double behind = 0, ahead = 0, area = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Place p = ring[i], q = ring[(i + 1) % ring.size()];
      area += cross(centre, p, q) / 2;
      const double a = (p.y - centre.y) * d.x - (p.x - centre.x) * d.y,
                   b = (q.y - centre.y) * d.x - (q.x - centre.x) * d.y;
      if ((a < 0) == (b < 0)) continue;
      const double t = a / (a - b);  // where the line through the centre leaves the part
      const double at = (p.x + t * (q.x - p.x) - centre.x) * d.x + (p.y + t * (q.y - p.y) - centre.y) * d.y;
      behind = std::min(behind, at), ahead = std::max(ahead, at);
    }
    if (ahead - behind < 1) return;
    const double width = area / (ahead - behind);
    Line line;
    line.path.push_back({{centre.x + behind * d.x, centre.y + behind * d.y}, width});
    line.path.push_back({{centre.x + ahead * d.x, centre.y + ahead * d.y}, width});
    out_.push_back(std::move(line));
  }

  const Skeleton& s_;
  const Laying& laying_;
  std::vector<std::uint32_t> onward_;  // by half: the half after it in the middle's line
  std::vector<Line> out_;
};

}  // namespace

std::vector<Line> trace_middles(const Skeleton& skeleton, const Laying& laying) {
  return Tracer(skeleton, laying).run();
}

}  // namespace weft::walls
