// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/stop.h"
#include "walls/mitre.h"
#include "walls/strip.h"
#include "walls/stub.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace weft::walls {
namespace {

using Vertex = Line::Vertex;
constexpr double pointed_um = 5;          // of half its width: so narrow an end is none
constexpr double within_um = 2;           // a chord so far within a strip meets both its sides
constexpr double least_within_um = 0.45;  // … where its end is square, too: less than half of what the lattice tells
constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

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
  bool middle(std::uint32_t h) const { return laying_.spans[h / 2].middle && !dot_edge(h); }
  /// A node where more than three parts meet is several nodes in one place.
  bool dot_edge(std::uint32_t h) const { return s_.length(h / 2) < 2; }
  /// The half that leaves a node after h, counter-clockwise.
  std::uint32_t turn_from(std::uint32_t h) const {
    std::uint32_t g = s_.halves[Skeleton::twin(h)].next;
    for (int i = 0; i < 20 && dot_edge(g); ++i) g = s_.halves[g].next;
    return g;
  }

  /// At each node the two middles that are straightest to each other go on in one another; others end there.
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
        h = turn_from(h);
      } while (h != start && leaving.size() < 100);
      join_straightest(leaving);
    }
  }

  void join_straightest(const std::vector<std::uint32_t>& leaving) {
    std::uint32_t a = none, b = none;
    double best = 0.3;  // a sharper turn is none
    for (std::size_t i = 0; i < leaving.size(); ++i)
      for (std::size_t j = i + 1; j < leaving.size(); ++j) {
        if (laying_.spans[leaving[i] / 2].pairs != laying_.spans[leaving[j] / 2].pairs) continue;
        const Place u = direction(leaving[i]), v = direction(leaving[j]);
        const double c = u.x * v.x + u.y * v.y;
        if (c < best) best = c, a = leaving[i], b = leaving[j];
      }
    if (a == none) return;
    onward_[Skeleton::twin(a)] = b;
    onward_[Skeleton::twin(b)] = a;
  }

  Place direction(std::uint32_t h) const { return unit(s_.start(h).at, s_.end(h).at); }

  bool leaves_strip(std::uint32_t g) const { return laying_.spans[g / 2].core || laying_.spans[g / 2].mouth; }

  /// The halves of a line, in order, and how it ends.
  void follow(std::uint32_t h, bool closed, std::vector<std::uint8_t>& seen) {
    stop_if_asked();
    std::vector<std::uint32_t> chain;
    const int inset = laying_.spans[h / 2].pairs;
    while (h != none && !seen[h / 2]) {
      seen[h / 2] = 1;
      chain.push_back(h);
      h = onward_[h];
    }
    // From its thinner end, so that the mirror image of a part is walked the mirrored way.
    if (!closed && thins_out(chain)) turn_round(chain);
    Strip strip;
    strip.closed = closed;
    strip.outline = inset == 0;
    if (!closed) {
      strip.skip_last = into_mouth(chain, strip.turn_last);
      turn_round(chain);
      strip.skip_first = into_mouth(chain, strip.turn_first);
      turn_round(chain);
    }
    fill(strip, chain);
    if (!closed) {
      const std::uint32_t last = chain.back(), first = Skeleton::twin(chain.front());
      strip.last_pointed = pointed(last);
      strip.first_pointed = pointed(first);
      if (!strip.last_pointed) strip.last_tip = tip_of(last, level(last, false));
      if (!strip.first_pointed) strip.first_tip = tip_of(first, level(first, false));
    }
    Line line;
    line.closed = closed;
    line.inset = inset;
    line.first_meets = !strip.first_pointed && strip.first_tip.empty();
    line.last_meets = !strip.last_pointed && strip.last_tip.empty();
    line.path = strip.bead();
    if (line.path.size() >= 2) out_.push_back(std::move(line));
  }

  bool thins_out(const std::vector<std::uint32_t>& chain) const {
    for (std::size_t i = 0; i < chain.size(); ++i) {
      const double here = s_.start(chain[i]).clearance, there = s_.end(chain[chain.size() - 1 - i]).clearance;
      if (std::abs(here - there) > 0.1) return here > there;
    }
    return false;
  }
  static void turn_round(std::vector<std::uint32_t>& chain) {
    for (auto& h : chain) h = Skeleton::twin(h);
    std::reverse(chain.begin(), chain.end());
  }

  /// Distance from the outline at which the walls around the middle end.
  double level(std::uint32_t h, bool at_start) const {
    const Span& span = laying_.spans[h / 2];
    const auto k = static_cast<std::size_t>(std::min(span.pairs, inset_limit(h)));
    return at_start ? laying_.start(h)[k] : laying_.end(h)[k];
  }
  int inset_limit(std::uint32_t h) const { return laying_.spans[h / 2].pairs; }

  void fill(Strip& strip, const std::vector<std::uint32_t>& chain) const {
    // Left first: its points are found walking back, so they are kept until their turn.
    std::vector<std::vector<Place>> left(chain.size());
    for (std::size_t j = chain.size(); j-- > 0;) {
      const std::uint32_t t = Skeleton::twin(chain[j]);
      const std::size_t before = j > 0 ? j - 1 : chain.size() - 1;
      left[j].push_back(side(t, true));
      if (const auto p = bend_of(s_, laying_, t, mean_level(t))) left[j].push_back(*p);
      left[j].push_back(side(t, false));
      if (j > 0 || strip.closed) around(t, Skeleton::twin(chain[before]), left[j]);
      std::reverse(left[j].begin(), left[j].end());
    }
    for (std::size_t j = 0; j < chain.size(); ++j) {
      const std::uint32_t h = chain[j];
      add_axis(h, strip);
      for (const Place p : left[j]) strip.add_left(p);
      std::vector<Place> right;  // what lies around a node goes with the piece behind it, as on the left
      if (j > 0 || strip.closed) around(chain[j > 0 ? j - 1 : chain.size() - 1], h, right);
      right.push_back(side(h, true));
      for (const Place p : right) strip.add_right(p);
      add_bend(h, strip);
      strip.add_right(side(h, false));
    }
    const auto& to = s_.end(chain.back());
    strip.add_axis(to.at, std::max(1.0, to.clearance - level(chain.back(), false)));
  }

  /// The start of a half, or the middle between walls that are mitred there.
  void add_axis(std::uint32_t h, Strip& strip) const {
    const auto& node = s_.start(h);
    Place sum{0, 0};
    int mitred = 0;
    double free = node.clearance - level(h, true);
    for (const std::uint32_t g : {h, s_.halves[Skeleton::twin(h)].next}) {
      const Mitre& mitre = laying_.mitres[g];
      if (mitre.axis <= 0) continue;
      const Place p = s_.on_start_rib(g, mitre.axis);
      sum.x += p.x, sum.y += p.y, ++mitred;
      free = std::min(free, mitre.axis / mitre.out - level(h, true));
    }
    strip.add_axis(mitred > 0 ? Place{sum.x / mitred, sum.y / mitred} : node.at, std::max(1.0, free));
  }

  /// Where walls on one side are mitred between the ends of a half.
  void add_bend(std::uint32_t h, Strip& strip) const {
    for (const std::uint32_t g : {h, Skeleton::twin(h)})
      if (const auto& bend = laying_.mitres[g].bend)
        strip.add_bend(*bend_of(s_, laying_, g, bend->middle), std::max(1.0, bend->middle - mean_level(g)));
    if (const auto p = bend_of(s_, laying_, h, mean_level(h))) strip.add_right(*p);
  }
  double mean_level(std::uint32_t h) const { return (level(h, true) + level(h, false)) / 2; }

  Place side(std::uint32_t h, bool at_start) const {
    const double out = laying_.mitres[at_start ? h : s_.halves[h].next].out, d = out * level(h, at_start);
    const auto rib = at_start ? s_.start_rib(h) : s_.end_rib(h);
    return rib.at(out > 1 ? d : std::min(d, rib.top.clearance));
  }

  /// What lies right of the axis between the end of h and the start of g: corners are followed, mouths are passed.
  void around(std::uint32_t h, std::uint32_t g, std::vector<Place>& out) const {
    const double inner = level(h, false);
    bool passed = false;  // the mouth of a branch: what lies between it and the next one's is a side, too
    for (std::uint32_t x = s_.halves[h].next; x != g;) {
      if (dot_edge(x)) {
        x = s_.halves[x].next;
      } else if (leaves_strip(x)) {
        if (passed) out.push_back(s_.on_start_rib(x, inner));
        passed = true;
        x = s_.halves[Skeleton::twin(x)].next;
      } else {
        add_piece(x, inner, out);
        passed = false;
        x = s_.halves[x].next;
      }
    }
  }

  /// Where a line ends because a part opens into a thicker one, it goes on to the wall that turns back there; where it
  /// ends at a line that passes by, it ends at its own mouth. Returns how much to leave out before the end, µm.
  double into_mouth(std::vector<std::uint32_t>& chain, bool& turn) const {
    const std::uint32_t h = chain.back();
    const auto k = static_cast<std::size_t>(laying_.spans[h / 2].pairs);
    if (ends_at_fork(h)) return mouth_before_end(h);
    std::uint32_t g = climbing_from(Skeleton::twin(h));
    if (g == none) return 0;
    while (g != none && static_cast<std::size_t>(laying_.spans[g / 2].pairs) == k && chain.size() < 100'000) {
      chain.push_back(g);
      g = climbing_from(Skeleton::twin(g));
    }
    if (g == none || static_cast<std::size_t>(laying_.spans[g / 2].pairs) <= k) return 0;
    turn = true;
    return (laying_.start(g)[k + 1] - laying_.start(g)[k]) / 2;
  }

  std::uint32_t climbing_from(std::uint32_t half) const {
    std::uint32_t h = half;
    do {
      if (laying_.spans[h / 2].mouth && s_.end(h).clearance > s_.start(h).clearance) return h;
      h = s_.halves[Skeleton::twin(h)].next;
    } while (h != half);
    return none;
  }

  /// Whether the sides of a middle meet at the end of a half.
  bool pointed(std::uint32_t h) const { return s_.end(h).clearance - level(h, false) < pointed_um; }

  /// What lies beyond the end of a middle that ends because the part ends: the outline of it, at the distance of the
  /// walls around the middle.
  std::vector<Place> tip_of(std::uint32_t h, double inner) const {
    std::vector<Place> ring;
    for (std::uint32_t g = s_.halves[h].next; g != Skeleton::twin(h); g = s_.halves[g].next) {
      if (leaves_strip(g)) return {};
      add_piece(g, inner, ring);
    }
    return ring;
  }

  /// The line at distance `inner` over one half, up to where the axis comes nearer to the outline than that.
  void add_piece(std::uint32_t g, double inner, std::vector<Place>& ring) const {
    const double a = s_.start(g).clearance, b = s_.end(g).clearance;
    const auto crossing = [&] { return lerp(s_.start(g).at, s_.end(g).at, (inner - a) / (b - a)); };
    if (a < inner && b < inner) return;
    ring.push_back(a < inner ? crossing() : s_.on_start_rib(g, inner));
    ring.push_back(b < inner ? crossing() : s_.on_end_rib(g, inner));
  }

  bool ends_at_fork(std::uint32_t h) const {
    int others = 0;
    for (std::uint32_t g = turn_from(Skeleton::twin(h)); g != Skeleton::twin(h); g = turn_from(g))
      others += laying_.spans[g / 2].core ? 1 : 0;
    return others >= 2;
  }

  /// How far before its end the mouth of a branch lies: the line between where its last ribs meet the walls around it.
  double mouth_before_end(std::uint32_t h) const {
    const double inner = level(h, false);
    const Place right = s_.on_end_rib(h, inner), left = s_.on_start_rib(Skeleton::twin(h), inner), node = s_.end(h).at;
    const Place back = unit(node, s_.start(h).at);
    const auto before = [&](Place p) { return (p.x - node.x) * back.x + (p.y - node.y) * back.y; };
    const double r = before(right), l = before(left);
    return std::max(0.0, std::max(r, l) + std::clamp(std::abs(r - l), least_within_um, within_um));
  }

  /// The half after h around what is further than `inner` from the outline: where that ends, it turns back. Other parts
  /// are as thick again behind necks, and have beads of their own.
  std::uint32_t around_dot(std::uint32_t h, double inner) const {
    std::uint32_t g = s_.end(h).clearance < inner ? Skeleton::twin(h) : s_.halves[h].next;
    while (laying_.spans[g / 2].core) g = s_.halves[Skeleton::twin(g)].next;
    return g;
  }

  /// What is as long as it is wide, a part or the middle of one.
  void dot(std::uint32_t start) {
    std::vector<Place> ring;
    std::uint32_t h = start;
    const auto pairs = static_cast<std::size_t>(laying_.spans[start / 2].pairs);
    const double inner = laying_.start(start)[pairs];
    do {
      add_piece(h, inner, ring);
      h = around_dot(h, inner);
    } while (h != start);
    Line line;
    line.inset = static_cast<int>(pairs);
    line.path = stub_bead(ring);
    if (line.path.size() < 2) return;
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
