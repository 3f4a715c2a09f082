#include "walls/laying.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace weft::walls {
namespace {

constexpr double same_um = 1e-3;

class Planner {
 public:
  Planner(Skeleton& skeleton, const Widths& widths, const LayingOptions& options)
      : s_(skeleton), w_(widths), o_(options) {}

  Laying run() {
    find_core();
    cut_at_thresholds();
    filter();
    ramps();
    for (std::uint32_t e = 0; e < core_.size(); ++e) set_core_bounds(e);
    run_into_corners();
    return std::move(out_);
  }

 private:
  /// How a core edge's bounds approach those of a neighbouring count.
  struct Blend {
    Count other;
    double at_start = 0, at_end = 0;  ///< share of the other
  };

  double slope(std::uint32_t e) const {
    const double length = s_.length(e);
    const double rise = std::abs(s_.start(2 * e).clearance - s_.end(2 * e).clearance);
    return length > same_um ? rise / length : 0;
  }

  template <class F>
  void for_each_leaving(std::uint32_t half, F f) const {  // all halves that leave the node `half` leaves
    std::uint32_t h = half;
    do {
      f(h);
      h = s_.halves[Skeleton::twin(h)].next;
    } while (h != half);
  }

  // ---- what runs into corners and what does not --------------------------------------------------------------------

  void find_core() {
    const auto edges = static_cast<std::uint32_t>(s_.edge_count());
    core_.assign(edges, 1);
    steep_.assign(edges, 0);
    std::vector<int> degree(s_.nodes.size(), 0);
    std::vector<double> shallow(s_.nodes.size(), 0);  // length of flat stretches cut off so far
    for (std::uint32_t e = 0; e < edges; ++e) {
      steep_[e] = slope(e) > o_.steep;
      ++degree[s_.halves[2 * e].from];
      ++degree[s_.halves[2 * e + 1].from];
    }
    any_.resize(s_.nodes.size());
    for (std::uint32_t h = 0; h < s_.halves.size(); ++h) any_[s_.halves[h].from] = h;
    // From the thinnest up, so that what is left last of a part that is all corners is its thickest place.
    const auto thicker = [&](std::uint32_t a, std::uint32_t b) {
      return s_.nodes[a].clearance != s_.nodes[b].clearance ? s_.nodes[a].clearance > s_.nodes[b].clearance : a > b;
    };
    std::vector<std::uint32_t> leaves;
    for (std::uint32_t n = 0; n < degree.size(); ++n)
      if (degree[n] == 1) leaves.push_back(n);
    std::make_heap(leaves.begin(), leaves.end(), thicker);
    const auto add_leaf = [&](std::uint32_t n) {
      leaves.push_back(n);
      std::push_heap(leaves.begin(), leaves.end(), thicker);
    };
    while (!leaves.empty()) {
      std::pop_heap(leaves.begin(), leaves.end(), thicker);
      const std::uint32_t n = leaves.back();
      leaves.pop_back();
      if (degree[n] != 1) continue;
      std::uint32_t h = any_[n];
      for_each_leaving(any_[n], [&](std::uint32_t g) {
        if (core_[g / 2]) h = g;
      });
      const std::uint32_t m = s_.to(h);
      const double rise = s_.nodes[m].clearance - s_.nodes[n].clearance;
      if (rise < -dip_share * s_.nodes[n].clearance) continue;  // the thickest place of its surroundings stays
      double flat = shallow[n];
      if (slope(h / 2) <= o_.corner || rise < 0) flat += s_.length(h / 2);
      if (flat > stub_share * s_.nodes[m].clearance) continue;
      core_[h / 2] = 0;
      --degree[n];
      shallow[m] = std::max(shallow[m], flat);
      if (--degree[m] == 1) add_leaf(m);
      if (degree[m] == 0) peaks_.push_back(m);
    }
    cut_bent_tips(degree);
    cut_mouths(degree);
  }

  /// Where the axis climbs steeply from a thin part into a thick one, the walls of the thick part turn back as they do
  /// in a corner, and the beads of the thin part end.
  void cut_mouths(std::vector<int>& degree) {
    mouth_.assign(core_.size(), 0);
    const auto climbs = [&](std::uint32_t h) {
      return core_[h / 2] && !mouth_[h / 2] && slope(h / 2) > o_.corner && s_.end(h).clearance > s_.start(h).clearance;
    };
    std::vector<std::uint32_t> run;
    for (std::uint32_t start = 0; start < s_.halves.size(); ++start) {
      if (!climbs(start)) continue;
      std::uint32_t below = start;  // begins there: what leads to it does not climb
      for (std::uint32_t h = onward(Skeleton::twin(start)); h != Skeleton::twin(below) && climbs(Skeleton::twin(h));
           h = onward(h))
        below = Skeleton::twin(h);
      run.assign(1, below);
      for (std::uint32_t h = onward(below); h != run.back() && climbs(h); h = onward(h)) run.push_back(h);
      const std::uint32_t low = s_.halves[below].from, high = s_.to(run.back());
      const int fewer = count_for(w_, 2 * s_.nodes[low].clearance, false).beads();
      const int more = count_for(w_, 2 * s_.nodes[high].clearance, true).beads();
      const double rise = s_.nodes[high].clearance - s_.nodes[low].clearance;
      const bool splits = fewer == 1 && 2 * s_.nodes[high].clearance > wide_bead() && rise > 0.3 * w_.inner;
      if (more - fewer < (splits ? 1 : 2)) continue;
      for (const std::uint32_t h : run) {
        core_[h / 2] = 0;
        mouth_[h / 2] = 1;
        --degree[s_.halves[h].from];
        --degree[s_.to(h)];
      }
      tops_.push_back(high);
    }
    for (const std::uint32_t n : tops_) {
      bool peak = degree[n] == 0;
      for_each_leaving(any_[n], [&](std::uint32_t h) { peak = peak && !climbs_mouth(h); });
      if (peak && std::find(peaks_.begin(), peaks_.end(), n) == peaks_.end()) peaks_.push_back(n);
    }
  }
  bool climbs_mouth(std::uint32_t h) const { return mouth_[h / 2] && s_.end(h).clearance > s_.start(h).clearance; }

  /// A tip is led on to only straight ahead: at the end of a rib the axis also bends into the sharper of two corners.
  void cut_bent_tips(std::vector<int>& degree) {
    constexpr double most_bend_cos = 0.82;
    for (std::uint32_t n = 0; n < degree.size(); ++n) {
      if (degree[n] != 1 || s_.nodes[n].clearance > 5) continue;
      std::uint32_t h = any_[n];
      for_each_leaving(any_[n], [&](std::uint32_t g) {
        if (core_[g / 2]) h = g;
      });
      std::vector<std::uint32_t> chain;
      while (steep_[h / 2]) {
        chain.push_back(h);
        if (degree[s_.to(h)] != 2) break;
        const std::uint32_t g = onward(h);
        if (g == h) break;
        const Place u = direction(h), v = direction(g);
        if (u.x * v.x + u.y * v.y < most_bend_cos) {
          for (const std::uint32_t c : chain) core_[c / 2] = 0;
          degree[n] = 0;
          degree[s_.to(h)] = 1;
          break;
        }
        h = g;
      }
    }
  }
  Place direction(std::uint32_t h) const {
    const Place a = s_.start(h).at, b = s_.end(h).at;
    const double d = std::max(1e-9, std::hypot(b.x - a.x, b.y - a.y));
    return {(b.x - a.x) / d, (b.y - a.y) / d};
  }

  // ---- how many beads ----------------------------------------------------------------------------------------------

  Count count_of(std::uint32_t e) const {
    return count_for(w_, s_.start(2 * e).clearance + s_.end(2 * e).clearance, steep_[e] != 0);
  }

  std::uint32_t split(std::uint32_t e, double t) {
    const std::uint32_t f = s_.split(e, t);
    any_[s_.halves[2 * f + 1].from] = 2 * f + 1;
    any_.push_back(2 * f);
    core_.push_back(core_[e]);
    steep_.push_back(steep_[e]);
    mouth_.push_back(mouth_[e]);
    return f;
  }

  void cut_at_thresholds() {
    const auto edges = static_cast<std::uint32_t>(core_.size());
    std::vector<double> cuts;
    for (std::uint32_t e = 0; e < edges; ++e) {
      if (!core_[e]) continue;
      const double a = 2 * s_.start(2 * e).clearance, b = 2 * s_.end(2 * e).clearance;
      const double low = std::min(a, b), high = std::max(a, b);
      if (high - low < same_um) continue;
      cuts.clear();
      for (int n = std::max(0, count_for(w_, low, false).beads() - 1); n <= 2 * w_.walls; ++n) {
        if (steep_[e] && n % 2 == 0 && n > 0 && n < 2 * w_.walls) continue;
        const double t = threshold(w_, n);
        if (t >= high) break;
        if (t > low) cuts.push_back((t - low) / (high - low));
      }
      if (a > b) {
        for (double& t : cuts) t = 1 - t;
        std::reverse(cuts.begin(), cuts.end());
      }
      double done = 0;
      std::uint32_t rest = e;
      for (const double t : cuts) {
        rest = split(rest, (t - done) / (1 - done));
        done = t;
      }
    }
    count_.resize(core_.size());
    for (std::uint32_t e = 0; e < core_.size(); ++e)
      if (core_[e]) count_[e] = count_of(e);
  }

  /// How wide a bead may grow for a short way, rather than be joined by another.
  double wide_bead() const { return std::min(w_.most, 1.7 * std::min(w_.inner, w_.outer)); }

  /// The band of the widest bead when that many share a thickness.
  double widest(Count count, double thickness) {
    scratch_.resize(static_cast<std::size_t>(count.pairs) + 1);
    bounds_for(w_, count, thickness / 2, scratch_.data());
    double most = count.middle ? thickness - 2 * scratch_.back() : 0;
    for (std::size_t i = 1; i < scratch_.size(); ++i) most = std::max(most, scratch_[i] - scratch_[i - 1]);
    return most;
  }

  /// Regions of one count along the core, joined where they touch.
  void filter() {
    for (int round = 0; round < 4; ++round) {
      const auto edges = static_cast<std::uint32_t>(core_.size());
      std::vector<std::uint32_t> root(edges);
      std::iota(root.begin(), root.end(), 0U);
      auto find = [&](std::uint32_t e) {
        while (root[e] != e) e = root[e] = root[root[e]];
        return e;
      };
      for (std::uint32_t h = 0; h < s_.halves.size(); ++h) {
        if (!core_[h / 2]) continue;
        std::uint32_t g = s_.halves[h].next;  // the next core edge around the end
        while (!core_[g / 2]) g = s_.halves[Skeleton::twin(g)].next;
        if (count_[g / 2] == count_[h / 2])
          root[std::max(find(g / 2), find(h / 2))] = std::min(find(g / 2), find(h / 2));
      }
      std::vector<double> length(edges, 0), low(edges, 1e18), high(edges, 0);
      for (std::uint32_t e = 0; e < edges; ++e) {
        if (!core_[e]) continue;
        const std::uint32_t r = find(e);
        length[r] += s_.length(e);
        for (const std::uint32_t h : {2 * e, 2 * e + 1}) {
          low[r] = std::min(low[r], 2 * s_.start(h).clearance);
          high[r] = std::max(high[r], 2 * s_.start(h).clearance);
        }
      }
      struct Border {
        std::uint32_t region, other;
      };
      std::vector<Border> borders;
      for (std::uint32_t h = 0; h < s_.halves.size(); ++h) {
        if (!core_[h / 2]) continue;
        std::uint32_t g = s_.halves[h].next;
        while (!core_[g / 2]) g = s_.halves[Skeleton::twin(g)].next;
        if (find(g / 2) != find(h / 2)) {
          borders.push_back({find(h / 2), find(g / 2)});
          borders.push_back({find(g / 2), find(h / 2)});
        }
      }
      std::sort(borders.begin(), borders.end(), [&](const Border& p, const Border& q) {
        if (length[p.region] != length[q.region]) return length[p.region] < length[q.region];
        if (p.region != q.region) return p.region < q.region;
        return length[p.other] > length[q.other];
      });
      std::vector<double> mouths(edges, 0);  // ends of each region, twice
      for (const Border& b : borders) mouths[b.region] += 1;
      std::vector<std::uint8_t> fixed(edges, 0);
      std::vector<Count> changed(edges);
      bool any = false;
      for (const Border& b : borders) {
        if (length[b.region] >= o_.filter || fixed[b.region] || fixed[b.other]) continue;
        if (length[b.other] <= length[b.region]) continue;
        const Count mine = count_[b.region], other = count_[b.other];
        if (std::abs(mine.beads() - other.beads()) != 1) continue;
        const double t = threshold(w_, std::min(mine.beads(), other.beads()));
        if (mine.beads() == 0 || other.beads() == 0) continue;
        const double deviation = other.beads() > mine.beads() ? t - low[b.region] : high[b.region] - t;
        // Where several parts meet there is a little more room than in each: no wall turns back in that.
        const bool junction = mouths[b.region] > 5;
        const double widest_there = widest(other, high[b.region]);
        const bool cramped =
            mine.beads() > other.beads() && length[b.region] < mouths[b.region] / 2 * w_.inner &&
            (other.pairs > 0
                 ? junction && widest_there < wide_bead()
                 : widest_there < (junction && high[b.region] < 1.5 * low[b.other] ? w_.most : wide_bead()));
        if (deviation > o_.filter_deviation && !cramped) continue;
        fixed[b.region] = fixed[b.other] = 1;
        changed[b.region] = other;
        fixed[b.region] = 2;
        any = true;
      }
      if (!any) return;
      for (std::uint32_t e = 0; e < edges; ++e)
        if (core_[e] && fixed[find(e)] == 2) count_[e] = changed[find(e)];
    }
  }

  // ---- ramps between counts ----------------------------------------------------------------------------------------

  void ramps() {
    blend_.assign(core_.size(), Blend{});
    // The stretch of equal count that begins with a half, until its count changes, branches, or the core ends. A ramp
    // at one end of an edge leaves its other end to a new edge, which is looked at in its turn.
    for (std::uint32_t h = 0; h < s_.halves.size(); ++h) {
      if (!core_[h / 2]) continue;
      const Count mine = count_[h / 2];
      Count other = mine;
      for_each_leaving(h, [&](std::uint32_t g) {
        if (core_[g / 2] && count_[g / 2] != mine && other == mine) other = count_[g / 2];
      });
      if (other == mine || other.beads() == 0 || mine.beads() == 0) continue;
      const double reach = std::min(o_.ramp / 2, stretch(h) / 2);
      if (reach > same_um) blend_along(h, other, reach);
    }
  }

  /// The one core half that leads on from the end of h, or h itself when there is none or more.
  std::uint32_t onward(std::uint32_t h) const {
    std::uint32_t found = h;
    int count = 0;
    for_each_leaving(Skeleton::twin(h), [&](std::uint32_t g) {
      if (g != Skeleton::twin(h) && core_[g / 2]) found = g, ++count;
    });
    return count == 1 ? found : h;
  }

  double stretch(std::uint32_t h) const {
    double length = 0;
    const Count mine = count_[h / 2];
    for (;;) {
      length += s_.length(h / 2);
      if (length > 2 * o_.ramp) return length;
      const std::uint32_t g = onward(h);
      if (g == h || count_[g / 2] != mine) return g == h ? 2 * length : length;  // a free end takes the whole ramp
      h = g;
    }
  }

  void blend_along(std::uint32_t h, Count other, double reach) {
    double done = 0;
    const Count mine = count_[h / 2];
    while (done < reach - same_um) {
      if (count_[h / 2] != mine || blend_[h / 2].at_start > 0 || blend_[h / 2].at_end > 0) return;
      const double length = s_.length(h / 2);
      if (done + length > reach + same_um) {  // ends within this edge
        const double t = (reach - done) / length;
        const std::uint32_t e = h / 2, f = split(e, h % 2 == 0 ? t : 1 - t);
        count_.push_back(mine);
        blend_.push_back({});
        if (h % 2 == 1) h = 2 * f + 1;
      }
      const double from = 0.5 * (1 - done / reach);
      done += s_.length(h / 2);
      const double to = std::max(0.0, 0.5 * (1 - done / reach));
      blend_[h / 2] = h % 2 == 0 ? Blend{other, from, to} : Blend{other, to, from};
      const std::uint32_t g = onward(h);
      if (g == h) return;
      h = g;
    }
  }

  void set_core_bounds(std::uint32_t e) {
    if (out_.spans.size() <= e) out_.spans.resize(core_.size());
    if (!core_[e]) return;
    Span& span = out_.spans[e];
    const Blend& blend = blend_[e];
    const bool blended = blend.at_start > 0 || blend.at_end > 0;
    Count shape = count_[e];
    // Towards one bead more a middle opens; a middle that will split stays one until the change itself.
    if (blended && blend.other.pairs == shape.pairs && blend.other.middle) shape.middle = true;
    span.core = true;
    span.pairs = shape.pairs;
    span.open = is_open(w_, shape);
    span.middle = shape.middle && !span.open && count_[e].beads() > 0;
    span.at_start = bounds_at(count_[e], blend.other, blended ? blend.at_start : 0, s_.start(2 * e).clearance);
    span.at_end = bounds_at(count_[e], blend.other, blended ? blend.at_end : 0, s_.end(2 * e).clearance);
  }

  std::uint32_t bounds_at(Count mine, Count other, double share, double half) {
    const auto at = static_cast<std::uint32_t>(out_.bounds.size());
    out_.bounds.resize(at + static_cast<std::size_t>(mine.pairs) + 1);
    bounds_for(w_, mine, half, &out_.bounds[at]);
    if (share > 0) {
      scratch_.resize(static_cast<std::size_t>(other.pairs) + 1);
      bounds_for(w_, other, half, scratch_.data());
      for (int i = 1; i <= std::min(mine.pairs, other.pairs); ++i) {
        double& b = out_.bounds[at + static_cast<std::size_t>(i)];
        b += share * (scratch_[static_cast<std::size_t>(i)] - b);
      }
      for (int i = std::min(mine.pairs, other.pairs) + 1; i <= mine.pairs; ++i) {
        double& b = out_.bounds[at + static_cast<std::size_t>(i)];
        b = std::max(b, out_.bounds[at + static_cast<std::size_t>(i) - 1]);
      }
    }
    return at;
  }

  // ---- corners -----------------------------------------------------------------------------------------------------

  void run_into_corners() {
    const auto nodes = static_cast<std::uint32_t>(any_.size());
    for (std::uint32_t n = 0; n < nodes; ++n) {
      std::uint32_t core = ~0U;
      for_each_leaving(any_[n], [&](std::uint32_t h) {
        if (core_[h / 2] && (core == ~0U || out_.spans[h / 2].pairs > out_.spans[core / 2].pairs)) core = h;
      });
      if (core == ~0U) continue;
      Span span = out_.spans[core / 2];
      const std::uint32_t at = core % 2 == 0 ? span.at_start : span.at_end;
      span.core = span.middle = false;
      span.at_start = span.at_end = at;
      descend_from(n, span);
    }
    for (const std::uint32_t n : peaks_) {
      const double half = s_.nodes[n].clearance;
      Count count = count_for(w_, 2 * half, true);
      if (count.pairs > 0 && !count.middle && widest(count, 2 * half) > wide_bead()) count.middle = true;
      Span span;
      span.pairs = count.pairs;
      span.open = is_open(w_, count);
      span.at_start = span.at_end = bounds_at(count, {}, 0, half);
      descend_from(n, span);
      if (count.middle && !span.open) out_.dots.push_back(any_[n]);
    }
  }

  void descend_from(std::uint32_t n, const Span& span) {
    for_each_leaving(any_[n], [&](std::uint32_t h) {
      if (!core_[h / 2] && !climbs_mouth(h)) leave_.push_back({h, span});
    });
    while (!leave_.empty()) {
      const Descent d = leave_.back();
      leave_.pop_back();
      descend(d.half, d.span);
    }
  }

  struct Descent {
    std::uint32_t half;
    Span span;
  };

  double track(const Span& span, int i) const {
    const double* b = &out_.bounds[span.at_start];
    return (b[i] + b[i + 1]) / 2;
  }

  /// Beads end on the axis where the clearance falls to their distance.
  void descend(std::uint32_t h, Span span) {
    for (;;) {
      if (reached_.size() < core_.size()) reached_.resize(core_.size(), 0);
      if (reached_[h / 2]) return;
      const double from = s_.start(h).clearance, to = s_.end(h).clearance, low = std::min(from, to);
      while (span.open && out_.bounds[span.at_start + static_cast<std::size_t>(span.pairs)] > from + same_um)
        span.open = false;
      while (span.pairs > 0 && track(span, span.pairs - 1) > from + same_um) --span.pairs;
      double cut = -1;
      if (span.open && out_.bounds[span.at_start + static_cast<std::size_t>(span.pairs)] > low + same_um)
        cut = out_.bounds[span.at_start + static_cast<std::size_t>(span.pairs)];
      else if (span.pairs > 0 && track(span, span.pairs - 1) > low + same_um)
        cut = track(span, span.pairs - 1);
      std::uint32_t rest = h;
      if (cut >= 0 && from - to > same_um) {
        const double t = (from - cut) / (from - to);
        if (t > 1e-9) {
          const std::uint32_t e = h / 2, f = split(e, h % 2 == 0 ? t : 1 - t);
          reached_.push_back(0);
          if (h % 2 == 1) h = 2 * f + 1;
          rest = s_.halves[h].next;
        }
      }
      if (out_.spans.size() < core_.size()) out_.spans.resize(core_.size());
      if (rest == h && cut >= 0) {  // begins exactly where a bead ends
        if (span.open)
          span.open = false;
        else
          --span.pairs;
        continue;
      }
      out_.spans[h / 2] = span;
      out_.spans[h / 2].mouth = mouth_[h / 2] != 0;
      reached_[h / 2] = 1;
      if (rest != h) {
        if (span.open)
          span.open = false;
        else
          --span.pairs;
        h = rest;
        continue;
      }
      const std::uint32_t back = Skeleton::twin(h);
      bool at_core = false;
      for_each_leaving(back, [&](std::uint32_t g) { at_core = at_core || core_[g / 2]; });
      if (at_core) return;
      for_each_leaving(back, [&](std::uint32_t g) {
        if (g != back && !climbs_mouth(g)) leave_.push_back({g, span});
      });
      return;
    }
  }

  static constexpr double stub_share = 0.25;  // of the clearance: flat ends of the axis shorter than this are corners
  static constexpr double dip_share = 0.02;   // of the clearance: … and never reach over a rise of more than this

  Skeleton& s_;
  const Widths& w_;
  const LayingOptions& o_;
  std::vector<std::uint32_t> any_, peaks_, tops_;  // a half that leaves each node; nodes with corners all around
  std::vector<std::uint8_t> core_, steep_, mouth_, reached_;
  std::vector<Count> count_;
  std::vector<Blend> blend_;
  std::vector<double> scratch_;
  std::vector<Descent> leave_;
  Laying out_;
};

}  // namespace

Laying lay(Skeleton& skeleton, const Widths& widths, const LayingOptions& options) {
  return Planner(skeleton, widths, options).run();
}

}  // namespace weft::walls
