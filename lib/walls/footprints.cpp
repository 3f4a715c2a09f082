// SPDX-License-Identifier: GPL-3.0-or-later
#include "walls/footprints.h"

#include "walls/keep_volume.h"
#include "walls/move_aside.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace weft::walls {
namespace {

constexpr double noticed_um = 9.3;  // walls may reach over the outline by 10, and where is told to a micron
// … and are made to by no more than the first, for neighbours move with a piece; than the others where all would cost
// too much of the part's volume.
constexpr std::array outside_um{8.0, 9.2};
constexpr Um nominal_within = 2;  // a width so close to the nominal one is that: the lattice and the part's volume
constexpr double most_slant = 3;  // a piece that meets the outline more squarely would vanish
constexpr int most_rounds = 3;    // a piece moves the next one's ends

/// What a bead lays at a junction.
double laid(const Junction& j) {
  return j.width * static_cast<double>(j.flow);
}

/// Below the narrowest planned width the flow gives way.
void lay(Junction& j, double width, Um narrowest) {
  const double planned = std::max<double>(j.flow < 1.F ? j.width : width, narrowest);
  j.width = rounded(planned);
  j.flow = static_cast<float>(std::clamp(width / planned, 1 / planned, 1.0));
}

struct Piece {
  Place a, b;
  double half;
};
Piece piece_of(const Bead& bead, std::size_t k, Point origin) {
  const Junction &a = bead.path[k], &b = bead.path[(k + 1) % bead.path.size()];
  const auto place = [&](const Junction& j) {
    return Place{static_cast<double>(j.at.x - origin.x), static_cast<double>(j.at.y - origin.y)};
  };
  return {place(a), place(b), (laid(a) + laid(b)) / 4};
}

/// So much a piece must give on the right of its way, which has room for half a width of `room` there, to reach over
/// the outline by no more than `outside`.
double too_far(Room& in, Place a, Place b, double half, double room, double outside) {
  if (half - room <= noticed_um) return 0;
  // The outline may run slantwise, or the piece end where it does: only how far out its corners lie counts.
  const Place way = unit(a, b);
  double beyond = 0;
  for (const double t : {0.0, 0.5, 1.0}) {
    const Place p = lerp(a, b, t);
    beyond = std::max(beyond, in.beyond({p.x + half * way.y, p.y - half * way.x}));
  }
  return beyond <= noticed_um ? 0 : (beyond - outside) * std::min(most_slant, (half - room) / beyond);
}

/// How much a junction must give on either side.
struct Give {
  double left = 0, right = 0;
};

/// Junctions in the long pieces beside those that give way, a bead's width from them: what lies beyond stays. `giving`
/// and `pieces` by their first junction; those that are cut are looked at from now on.
void hold_beyond(const std::vector<std::uint8_t>& giving, Bead& bead, std::vector<std::size_t>& pieces) {
  const std::size_t n = bead.path.size(), last = bead.closed ? n : n - 1;
  std::vector<Junction> path;
  path.reserve(n + 8);
  std::vector<std::size_t> looked_at;
  auto piece = pieces.begin();
  for (std::size_t k = 0; k < n; ++k) {
    const Junction &a = bead.path[k], &b = bead.path[(k + 1) % n];
    const bool suspect = piece != pieces.end() && *piece == k;
    if (suspect) ++piece, looked_at.push_back(path.size());
    path.push_back(a);
    if (k == last || giving[k] != 0) continue;
    const bool before = (k > 0 || bead.closed) && giving[(k + n - 1) % n] != 0,
               after = (k + 1 < last || bead.closed) && giving[(k + 1) % n] != 0;
    const double length = distance(a.at, b.at), width = std::max(laid(a), laid(b));
    if (length <= (before + after + 1) * width) continue;
    const auto cut = [&](double t) {
      path.push_back({lerp(a.at, b.at, t), rounded(a.width + t * (b.width - a.width)),
                      static_cast<float>(a.flow + t * static_cast<double>(b.flow - a.flow))});
    };
    if (before && !suspect) looked_at.push_back(path.size() - 1);
    if (before) cut(width / length);
    if (after) cut(1 - width / length), looked_at.push_back(path.size() - 1);
  }
  bead.path = std::move(path), pieces = std::move(looked_at);
}

void give_way(const std::vector<Give>& gives, Um narrowest, Bead& bead) {
  std::vector<double> inwards;
  for (std::size_t j = 0; j < bead.path.size(); ++j) {
    const auto [left, right] = gives[j];
    if (const double less = 2 * (bead.closed ? std::min(left, right) : std::max(left, right)); less > 0)
      lay(bead.path[j], laid(bead.path[j]) - less, narrowest);
    inwards.push_back(right - left);
  }
  if (bead.closed) move_left(bead, inwards);  // others stay in their middle, where they begin and end at beads
}

}  // namespace

Footprints::Footprints(Room& room, Point origin, Um nominal, Um narrowest, const Beads& beads)
    : room_(room), origin_(origin), narrowest_(narrowest) {
  for (std::size_t i = 0; i < beads.size(); ++i) {
    const Bead& bead = beads[i];
    if (bead.inset != 0) continue;
    const std::size_t n = bead.path.size(), pieces = bead.closed ? n : n - 1;
    Suspect suspect{i, {}};
    for (std::size_t k = 0; k < pieces; ++k) {
      const auto is_nominal = [&](std::size_t j) { return std::abs(bead.path[j].width - nominal) <= nominal_within; };
      if (bead.closed && is_nominal(k) && is_nominal((k + 1) % n)) continue;
      const Piece p = piece_of(bead, k, origin);
      const double swollen = (1 + most_change) * p.half;
      if (swollen - room.beside(p.a, p.b, swollen) > noticed_um) suspect.pieces.push_back(k);
    }
    if (!suspect.pieces.empty()) suspects_.push_back(std::move(suspect));
  }
}

Bead Footprints::kept(const Suspect& suspect, double outside, const Bead& bead) const {
  Bead out = bead;
  auto pieces = suspect.pieces;
  const auto give_of = [&](std::size_t k) {
    const Piece p = piece_of(out, k, origin_);
    const auto room = room_.sides(p.a, p.b, p.half);
    return Give{too_far(room_, p.b, p.a, p.half, room.left, outside),
                too_far(room_, p.a, p.b, p.half, room.right, outside)};
  };
  for (int round = 0; round < most_rounds; ++round) {
    if (round == 0) {
      std::vector<std::uint8_t> giving(out.path.size(), 0);
      bool any = false;
      for (const std::size_t k : pieces) {
        const Give give = give_of(k);
        giving[k] = give.left + give.right > 0;
        any = any || giving[k] != 0;
      }
      if (!any) break;
      hold_beyond(giving, out, pieces);
    }
    const std::size_t n = out.path.size();
    std::vector<Give> gives(n);
    bool any = false;
    for (const std::size_t k : pieces) {
      const Give give = give_of(k);
      any = any || give.left + give.right > 0;
      for (const std::size_t j : {k, (k + 1) % n})
        gives[j] = {std::max(gives[j].left, give.left), std::max(gives[j].right, give.right)};
    }
    if (!any) break;
    give_way(gives, narrowest_, out);
  }
  return out;
}

bool Footprints::keep(double least, Beads& beads) const {
  for (const double outside : outside_um) {
    std::vector<std::pair<std::size_t, Bead>> kept_beads;
    double gain = 0;
    for (const Suspect& suspect : suspects_) {
      const Bead& bead = beads[suspect.bead];
      Bead other = kept(suspect, outside, bead);
      if (other.path == bead.path) continue;
      gain += volume_mm3(other, 1_mm) - volume_mm3(bead, 1_mm);
      kept_beads.emplace_back(suspect.bead, std::move(other));
    }
    if (kept_beads.empty()) return false;
    if (laid_mm2(beads) + gain < least) continue;
    for (auto& [i, bead] : kept_beads) beads[i] = std::move(bead);
    return true;
  }
  return false;
}

}  // namespace weft::walls
