// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/stop.h"
#include "core/tolerances.h"
#include "geometry/spatial_index.h"
#include "slice/stitch.h"

#include <algorithm>
#include <numeric>

namespace weft::slice {
namespace {

void note(Gaps& gaps, Point from, Point to) {
  const double width_um = distance(from, to);
  if (gaps.count++ > 0 && width_um <= gaps.widest_um) return;
  gaps.widest_um = width_um;
  gaps.at = lerp(from, to, 0.5);
}

/// Which chain follows each chain: mutually nearest ends are joined, round by round, which gives what joining the
/// nearest pair of all, again and again, would give. Each round joins at least one pair and most of them; soups in
/// which it does not are joined in their order after `most_rounds`.
std::vector<std::size_t> successors(const std::vector<Polyline>& chains) {
  constexpr int most_rounds = 40;
  constexpr std::size_t none = static_cast<std::size_t>(-1);
  std::vector<std::size_t> next(chains.size(), none), tails(chains.size());
  std::iota(tails.begin(), tails.end(), std::size_t{0});  // chains whose end, and chains whose start, is not joined yet
  std::vector<std::size_t> heads = tails;
  for (int round = 0; round < most_rounds && !tails.empty(); ++round) {
    std::vector<geometry::Segment> points;
    points.reserve(heads.size());
    for (const std::size_t h : heads) points.push_back({chains[h].front(), chains[h].front()});
    const geometry::SegmentIndex index(std::move(points));
    struct Offer {
      std::size_t tail = none;
      double distance_um = 0;
    };
    std::vector<Offer> best(heads.size());
    StopNowAndThen stop(64);
    for (const std::size_t t : tails) {
      stop.step();
      const auto nearest = index.nearest(chains[t].back());
      Offer& offer = best[nearest->segment];
      if (offer.tail == none || nearest->distance_um < offer.distance_um) offer = {t, nearest->distance_um};
    }
    std::vector<std::size_t> unjoined;
    for (std::size_t k = 0; k < heads.size(); ++k) {
      if (best[k].tail == none)
        unjoined.push_back(heads[k]);
      else
        next[best[k].tail] = heads[k];
    }
    heads = std::move(unjoined);
    std::erase_if(tails, [&](std::size_t t) { return next[t] != none; });
  }
  for (std::size_t k = 0; k < tails.size(); ++k) next[tails[k]] = heads[k];
  return next;
}
}  // namespace

void close(Chains& chains, Gaps& closed, Gaps& bridged) {
  const std::vector<std::size_t> next = successors(chains.open);
  std::vector<std::uint8_t> done(next.size(), 0);
  for (std::size_t first = 0; first < next.size(); ++first) {
    if (done[first]) continue;
    Ring ring;
    for (std::size_t i = first; !done[i]; i = next[i]) {
      done[i] = 1;
      ring.insert(ring.end(), chains.open[i].begin(), chains.open[i].end());
      const Point from = chains.open[i].back(), to = chains.open[next[i]].front();
      if (from == to) continue;
      note(distance(from, to) <= tolerances::stitch_gap ? closed : bridged, from, to);
    }
    chains.rings.push_back(std::move(ring));
  }
  chains.open.clear();
}

}  // namespace weft::slice
