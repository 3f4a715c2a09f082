// SPDX-License-Identifier: GPL-3.0-or-later
#include "walls/mitre.h"

#include "core/stop.h"

#include <algorithm>
#include <cmath>

namespace weft::walls {
namespace {

constexpr double least_cos = 0.5;  // of half a turn of 120°: around a sharper corner walls would reach far out
constexpr double within = 0.9;     // of the free width around the axis: so far from it is nothing but part

double dot(Place a, Place b) {
  return a.x * b.x + a.y * b.y;
}

/// The halves whose ribs stand in one corner, in order.
class Fan {
 public:
  Fan(const Skeleton& s, const Laying& laying) : s_(s), laying_(laying) {}

  bool has(std::uint32_t h) const { return stands_in_a_corner(s_, h); }

  /// From its first half on. False where walls are as they are: without a bead between those of both sides, or of other
  /// numbers before and behind the corner.
  bool find(std::uint32_t first) {
    halves_.clear();
    pairs_ = static_cast<std::size_t>(laying_.spans[first / 2].pairs);
    for (std::uint32_t h = first; has(h); h = s_.halves[h].next) {
      const Span& span = laying_.spans[h / 2];
      if (!span.core || !span.middle || static_cast<std::size_t>(span.pairs) != pairs_) return false;
      halves_.push_back(h);
    }
    return pairs_ > 1;
  }

  void mitre(std::vector<Mitre>& out) const {
    const auto &first = s_.start(halves_.front()), &last = s_.end(halves_.back());
    const Place u = way(first), v = way(last);
    const double cos_turn = dot(u, v);
    if (cos_turn < 2 * least_cos * least_cos - 1) return;
    std::vector<Mitre> found(halves_.size());
    std::size_t bends = 0;
    for (std::size_t i = 1; i < halves_.size(); ++i) {
      const auto& node = s_.start(halves_[i]);
      const Place w = way(node);
      const double before = std::max(dot(u, w), 1e-3), behind = std::max(dot(v, w), 1e-3);
      if (before > behind) bends = i;
      Mitre& mitre = found[i];
      mitre.out = 1 / std::max(before, behind);
      mitre.axis = std::min(first.clearance / before, last.clearance / behind);
      const double bound = laying_.start(halves_[i])[pairs_];
      const double room = node.clearance + within * (node.clearance - bound);
      if (mitre.axis > room || mitre.axis < mitre.out * bound) return;
    }
    found[bends].bend = Mitre::Bend{{(u.x + v.x) / (1 + cos_turn), (u.y + v.y) / (1 + cos_turn)},
                                    std::min(first.clearance, last.clearance)};
    for (std::size_t i = 0; i < halves_.size(); ++i) out[halves_[i]] = found[i];
  }

 private:
  Place way(const Skeleton::Node& node) const { return unit(s_.halves[halves_.front()].foot, node.at); }

  const Skeleton& s_;
  const Laying& laying_;
  std::vector<std::uint32_t> halves_;
  std::size_t pairs_ = 0;
};

}  // namespace

void mitre_inner_walls(const Skeleton& s, Laying& laying) {
  laying.mitres.assign(s.halves.size(), {});
  Fan fan(s, laying);
  StopNowAndThen stop(256);
  for (std::uint32_t h = 0; h < s.halves.size(); ++h) {
    stop.step();
    if (laying.spans[h / 2].middle && fan.has(h) && !fan.has(s.halves[h].previous) && fan.find(h))
      fan.mitre(laying.mitres);
  }
}

}  // namespace weft::walls
