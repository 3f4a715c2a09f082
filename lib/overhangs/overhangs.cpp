// SPDX-License-Identifier: GPL-3.0-or-later
#include "overhangs/overhangs.h"

#include "core/stop.h"
#include "core/tolerances.h"
#include "model/flow.h"
#include "overhangs/air.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <utility>

namespace weft::overhangs {
namespace {

constexpr double step_um = 400;            // between looks: about a bead's width
constexpr double edge_um = 50;             // how exactly edges below are found
constexpr double shortest_um = 1000;       // of a piece
constexpr double shortest_whole_um = 500;  // of one that lies on nothing: more than a bead's width of it curls
constexpr double least_share = 0.1;        // of the width: less is the roughness of a wall
constexpr double whole_share = 0.95;

/// How a place of a bead lies: 0 on what is below, 1 … 4 quarters over air, `whole` all over air.
using Level = std::uint8_t;
constexpr Level whole = 5;

Level level_of(double share) {
  if (share < least_share) return 0;
  return share >= whole_share ? whole : static_cast<Level>(std::clamp(std::ceil(share * 4), 1.0, 4.0));
}

/// A place on a path: on the segment from that junction.
struct Place {
  std::size_t segment = 0;
  double along = 0;
};

/// A stretch of a bead that lies in one way.
struct Run {
  Place from, to;
  double length_um = 0;
  double in_air_um = 0;  ///< ∫ share of the width that lies over air
  Level level = 0;
  bool strand = false;
  double around_um = 0;  ///< how much further it goes behind the seam of a loop
};

void add(const Run& run, std::vector<Run>& runs) {
  if (!runs.empty() && runs.back().level == run.level)
    runs.back().to = run.to, runs.back().length_um += run.length_um, runs.back().in_air_um += run.in_air_um,
    runs.back().around_um += run.around_um;
  else
    runs.push_back(run);
}

/// How a place of a segment lies.
struct Look {
  double along = 0, share = 0;
};

/// Where what lies below begins or ends at once between two looks: how long a run is decides about it, and between
/// looks it is not known. Where the share changes slowly, halfway is as good.
template <class LookAt>
std::optional<double> edge_between(Look here, Look there, double length_um, const LookAt& look) {
  const auto steps = [](const Look& a, const Look& b) {
    return std::abs(static_cast<int>(level_of(a.share)) - static_cast<int>(level_of(b.share)));
  };
  if (steps(here, there) < 2) return std::nullopt;
  while ((there.along - here.along) * length_um > edge_um) {
    const Look middle = look((here.along + there.along) / 2);
    (steps(here, middle) <= steps(middle, there) ? here : there) = middle;
  }
  return (here.along + there.along) / 2;
}

/// A part thinner than a bead may be has one with less flow: the plastic lies over what is below the part, and not over
/// what is below the width that the bead has in name.
double laid_width(const Junction& j) {
  return j.width * std::min(1.0, static_cast<double>(j.flow));
}

/// How the bead lies all along.
std::vector<Run> runs_of(const std::vector<Junction>& path, Air& air) {
  std::vector<Run> runs;
  StopNowAndThen stop(64);
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    stop.step();
    const Junction &a = path[i], &b = path[i + 1];
    const double length = distance(a.at, b.at);
    if (length == 0) continue;
    if (!air.edge_near(a.at, b.at, std::max(a.width, b.width) / 2)) {
      const double share = air.at(lerp(a.at, b.at, 0.5)) ? 1 : 0;
      add({{i, 0}, {i, 1}, length, share * length, level_of(share)}, runs);
      continue;
    }
    const int looks = static_cast<int>(std::ceil(length / step_um));
    const double nx = -(b.at.y - a.at.y) / length, ny = (b.at.x - a.at.x) / length;
    const auto look = [&](double along) {
      const double half = (laid_width(a) + along * (laid_width(b) - laid_width(a))) / 2;
      return Look{along, air.share(lerp(a.at, b.at, along), {rounded(half * nx), rounded(half * ny)})};
    };
    double from = 0;
    Look last = look(0.5 / looks);
    const auto end_at = [&](double to) {
      const double um = (to - from) * length;
      add({{i, from}, {i, to}, um, last.share * um, level_of(last.share)}, runs);
      from = to;
    };
    for (int k = 1; k < looks; ++k) {
      const Look next = look((k + 0.5) / looks);
      end_at(edge_between(last, next, length, look).value_or(static_cast<double>(k) / looks));
      last = next;
    }
    end_at(1);
  }
  return runs;
}

bool is_short(const Run& run) {
  if (run.length_um < tolerances::least_move) return true;  // a piece of its own all the same, and a jog at its corner
  return run.length_um + run.around_um < (run.level == whole ? shortest_whole_um : shortest_um);
}

/// Whether what lies at a bead's end goes on at its beginning.
bool is_loop(const Extrude& bead) {
  return bead.loop_length > 0 || bead.path.front().at == bead.path.back().at;
}

/// The runs of a loop's two ends are one where they lie in one way: a seam makes neither of them short.
std::vector<Run> joined_around(std::vector<Run> runs) {
  if (runs.size() < 2 || runs.front().level != runs.back().level) return runs;
  runs.front().around_um = runs.back().length_um;
  runs.back().around_um = runs.front().length_um;
  return runs;
}

int unlike(const Run& a, const Run& b) {
  return std::abs(static_cast<int>(a.level) - static_cast<int>(b.level));
}

/// Short runs that follow each other, and hang further together than what lies before and behind them, are one that
/// lies as they do on the mean: each alone would go to its neighbours.
std::vector<Run> with_short_ones_joined(const std::vector<Run>& runs) {
  std::vector<Run> out;
  for (auto at = runs.begin(); at != runs.end();) {
    const auto end = std::find_if_not(at, runs.end(), is_short);
    const Level beside =
        std::max(at == runs.begin() ? Level{0} : at[-1].level, end == runs.end() ? Level{0} : end->level);
    while (at != end) {
      Run joined = *at;
      auto next = at + 1;
      for (; next != end && is_short(joined); ++next)
        joined.to = next->to, joined.length_um += next->length_um, joined.in_air_um += next->in_air_um;
      joined.level = level_of(joined.in_air_um / joined.length_um);
      if (!is_short(joined) && joined.level > beside)
        add(joined, out);
      else
        std::for_each(at, next, [&](const Run& run) { add(run, out); });
      at = next;
    }
    if (at != runs.end()) add(*at++, out);
  }
  return out;
}

/// Short runs go to the neighbour that is most like them, where both are to the one that hangs further.
std::vector<Run> without_short(const std::vector<Run>& runs) {
  std::vector<Run> out;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    add(runs[i], out);
    Run& last = out.back();
    const bool first = out.size() == 1, end = i + 1 == runs.size();
    if (!is_short(last) || (first && end)) continue;
    const auto before = [&] { return out[out.size() - 2]; };
    const bool back =
        end ||
        (!first && (unlike(last, before()) < unlike(last, runs[i + 1]) ||
                    (unlike(last, before()) == unlike(last, runs[i + 1]) && before().level >= runs[i + 1].level)));
    if (!back) {
      last.level = runs[i + 1].level;
      continue;
    }
    Run short_one = last;
    out.pop_back();
    short_one.level = out.back().level;
    add(short_one, out);
  }
  // Where something bears it in between again and again, it does not lie on nothing.
  for (Run& run : out)
    if (const Level mean = level_of(run.in_air_um / run.length_um); run.level == whole && mean < 4) run.level = mean;
  return out;
}

Junction junction_at(const std::vector<Junction>& path, Place place) {
  const Junction &a = path[place.segment], &b = path[place.segment + 1];
  if (place.along <= 0) return a;
  if (place.along >= 1) return b;
  const auto t = static_cast<float>(place.along);
  return {lerp(a.at, b.at, place.along), rounded(a.width + place.along * (b.width - a.width)),
          a.flow + t * (b.flow - a.flow)};
}

std::vector<Junction> piece_of(const std::vector<Junction>& path, const Run& run) {
  std::vector<Junction> piece{junction_at(path, run.from)};
  const auto add_junction = [&](const Junction& j) {
    if (j.at != piece.back().at || j != path[run.from.segment]) piece.push_back(j);
  };
  for (std::size_t i = run.from.segment + 1; i <= run.to.segment; ++i) add_junction(path[i]);
  const Junction end = junction_at(path, run.to);
  if (end.at != piece.back().at || piece.size() < 2) piece.push_back(end);
  return piece;
}

/// Whether the path keeps to the straight line between its ends: over air it is pulled there.
bool straight(const std::vector<Junction>& path, Um within) {
  const geometry::Segment chord{path.front().at, path.back().at};
  return std::all_of(path.begin(), path.end(),
                     [&](const Junction& j) { return geometry::foot_of(j.at, chord).distance_um <= within; });
}

/// Whether what lies beside a run over air carries its end.
bool holds(const Run& beside) {
  return beside.level <= 2;
}

/// Marks runs that are laid as strands. Where a closed bead begins over air, its end leads on to its beginning.
void find_strands(const Extrude& bead, const Strand& strand, std::vector<Run>& runs) {
  const std::size_t count = runs.size();
  if (count < 2) return;
  const bool round = is_loop(bead);
  const bool joined = round && runs.front().level == whole && runs.back().level == whole;
  const Um within = strand.nozzle / 2;
  for (std::size_t i = 0; i < count; ++i) {
    if (runs[i].level != whole || runs[i].length_um < shortest_um || (joined && (i == 0 || i + 1 == count))) continue;
    if (!round && (i == 0 || i + 1 == count)) continue;
    const Run &before = runs[(i + count - 1) % count], &after = runs[(i + 1) % count];
    runs[i].strand = holds(before) && holds(after) && straight(piece_of(bead.path, runs[i]), within);
  }
  if (!joined || count < 3) return;
  auto both = piece_of(bead.path, runs.back());
  const auto first = piece_of(bead.path, runs.front());
  both.insert(both.end(), first.begin(), first.end());
  runs.front().strand = runs.back().strand = holds(runs[1]) && holds(runs[count - 2]) && straight(both, within);
}

/// The pieces of a bead, with what each of them is.
void cut(const Extrude& bead, const std::vector<Run>& runs, const Strand& strand, std::vector<Step>& steps) {
  const auto flow = static_cast<float>(flow::bridge_flow(strand.nozzle, bead.height) * strand.share);
  for (const Run& run : runs) {
    Extrude piece = bead;
    piece.path = piece_of(bead.path, run);
    piece.air_quarters = std::min<Level>(run.level, 4);
    if (run.level == whole) piece.role = row_of(bead.role).hangs_as.value_or(bead.role);
    if (run.strand)
      for (Junction& j : piece.path) j.width = strand.nozzle, j.flow = flow;
    steps.emplace_back(std::move(piece));
  }
}

/// Walls, and lines of solid infill: bridges are laid for it, and what lies upon skin does not hang.
bool may_hang(Role role) {
  return row_of(role).hangs_as.has_value() || role == Role::gap_fill || role == Role::top_skin;
}

}  // namespace

Regions worth_keeping(Regions over_air) {
  constexpr double narrow_um = 200;                                           // of beads
  constexpr double least_mm2 = least_share * shortest_um * narrow_um * 1e-6;  // less hangs nowhere far and long enough
  std::erase_if(over_air, [&](const Region& region) { return area_mm2(region) < least_mm2; });
  return over_air;
}

void mark(std::span<const Strand> strands, Regions over_air, LayerPlan& layer) {
  if (std::none_of(strands.begin(), strands.end(), [](const Strand& strand) { return strand.marked; })) return;
  const Regions wide = worth_keeping(std::move(over_air));
  if (wide.empty()) return;
  Air air(wide);
  std::vector<Step> steps;
  steps.reserve(layer.steps.size() + 16);
  for (Step& step : layer.steps) {
    stop_if_asked();
    const auto* bead = std::get_if<Extrude>(&step);
    const Strand& strand = strands[bead != nullptr && bead->scope < strands.size() ? bead->scope : 0];
    if (bead != nullptr && strand.marked && may_hang(bead->role) && bead->below.empty() && bead->path.size() > 1) {
      Box box;
      Um widest = 0;
      for (const Junction& j : bead->path) box.add(j.at), widest = std::max(widest, j.width);
      if (air.near(box, widest / 2)) {
        auto found = runs_of(bead->path, air);
        if (is_loop(*bead)) found = joined_around(std::move(found));
        auto runs = without_short(with_short_ones_joined(found));
        if (runs.size() > 1 || (runs.size() == 1 && runs[0].level > 0)) {
          if (is_wall(bead->role)) find_strands(*bead, strand, runs);
          cut(*bead, runs, strand, steps);
          continue;
        }
      }
    }
    steps.push_back(std::move(step));
  }
  layer.steps = std::move(steps);
}

double longest_span_mm(const Regions& over_air, const LayerPlan& layer) {
  if (over_air.empty()) return 0;
  Air air(over_air);
  double longest_um = 0;
  for (const Step& step : layer.steps) {
    const auto* bead = std::get_if<Extrude>(&step);
    if (bead == nullptr || !row_of(bead->role).over_air) continue;
    for (std::size_t i = 1; i < bead->path.size(); ++i)
      longest_um = std::max(longest_um, air.longest_um(bead->path[i - 1].at, bead->path[i].at));
  }
  return longest_um / 1000;
}

}  // namespace weft::overhangs
