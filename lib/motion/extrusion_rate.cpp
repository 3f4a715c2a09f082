// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/extrusion_rate.h"

#include "core/tolerances.h"
#include "model/moves.h"
#include "motion/speeds.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace weft::motion {
namespace {

/// Beads with less travel between them are one to the pressure in the nozzle.
constexpr double short_travel_um = 3000;
/// A change of flow is told in steps of that share of it.
constexpr double flow_step = 0.05;
/// What differs by less is one flow. Two such differences, within what is told at once and from there to what follows,
/// are a step.
constexpr double same_flow = flow_step / 2;

/// How fast flow may change, mm³/s².
struct Slopes {
  double up = std::numeric_limits<double>::infinity(), down = up;
  double least_mm_s = 0;
  double flow = 1;  ///< what material_flow makes of a bead's volume

  bool limited() const { return up < std::numeric_limits<double>::infinity() || down < up; }
};

Slopes slopes_of(const Rules& rules, const Rules& layer) {
  Slopes out;
  const auto& s = rules.speeds;
  if (s.max_extrusion_rate_slope) out.up = out.down = *s.max_extrusion_rate_slope;
  if (s.max_extrusion_rate_slope_down) out.down = *s.max_extrusion_rate_slope_down;
  out.least_mm_s = layer.cooling.cool_min_speed;
  out.flow = rules.material.material_flow / 100.0;
  return out;
}

/// A move of a bead, along which it is extruded evenly; in parts it would not be, where its ends differ in width.
struct Piece {
  std::size_t from, to;  ///< junctions of the bead
  double length_mm, area_mm2, speed_mm_s;
  double begin_mm2 = area_mm2, end_mm2 = area_mm2;  ///< at its ends; their mean is its area
  double volume() const { return length_mm * area_mm2; }
  double flow() const { return area_mm2 * speed_mm_s; }
  /// Up to which share of its length so much of it is laid.
  double share_of(double volume_mm3) const {
    const double mm2 = volume_mm3 / length_mm;
    return 2 * mm2 / (begin_mm2 + std::sqrt(std::max(begin_mm2 * begin_mm2 + 2 * (end_mm2 - begin_mm2) * mm2, 0.0)));
  }
};

/// @param flow what material_flow makes of a volume
Piece piece_of(const Extrude& bead, std::size_t from, const BeadMove& move, double flow) {
  double um = 0;
  for (std::size_t i = from + 1; i <= move.to; ++i) um += distance(bead.path[i - 1].at, bead.path[i].at);
  const double speed =
      bead.segment_speed_mm_s.empty() ? bead.speed_mm_s : static_cast<double>(bead.segment_speed_mm_s[move.piece - 1]);
  Piece out{from, move.to, um / 1000, move.volume_mm3 * flow / (um / 1000), speed};
  const auto laid = [](const Junction& j) { return j.width * static_cast<double>(j.flow); };
  const double a = laid(bead.path[from]), b = laid(bead.path[move.to]);
  if (move.to == from + 1 && a + b > 0)
    out.begin_mm2 = 2 * out.area_mm2 * a / (a + b), out.end_mm2 = 2 * out.area_mm2 * b / (a + b);
  return out;
}

/// The beads that follow each other, and all their pieces.
struct Chain {
  Slopes slopes;
  std::vector<Extrude*> beads;
  std::vector<std::size_t> counts;  ///< of pieces, by bead
  std::vector<Piece> pieces;

  bool empty() const { return beads.empty(); }
  void add(Extrude& bead) {
    beads.push_back(&bead);
    std::size_t from = 0;
    counts.push_back(pieces.size());
    for_each_move(bead.path, to_mm(bead.height), [&](const BeadMove& move) {
      pieces.push_back(piece_of(bead, from, move, slopes.flow));
      from = move.to;
    });
    counts.back() = pieces.size() - counts.back();
  }
};

/// Pieces that follow each other with about the same flow.
struct Run {
  std::size_t end = 0;  ///< behind its last piece
  double volume = 0, seconds = 0;
  double flow() const { return seconds > 0 ? volume / seconds : 0; }
};

std::vector<Run> runs_of(const std::vector<Piece>& pieces) {
  std::vector<Run> out;
  double least = 0, most = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const double flow = pieces[i].flow();
    if (out.empty() || std::max(most, flow) > (1 + same_flow) * std::min(least, flow)) {
      out.emplace_back();
      least = most = flow;
    }
    least = std::min(least, flow), most = std::max(most, flow);
    out.back().end = i + 1;
    out.back().volume += pieces[i].volume();
    out.back().seconds += pieces[i].speed_mm_s > 0 ? pieces[i].length_mm / pieces[i].speed_mm_s : 0;
  }
  return out;
}

/// Flow at the beginning of each run, and at the end of the last.
std::vector<double> flows_between(const std::vector<Run>& runs, const Slopes& slopes) {
  std::vector<double> out(runs.size() + 1);
  out.front() = runs.front().flow(), out.back() = runs.back().flow();
  for (std::size_t i = 1; i < runs.size(); ++i) out[i] = std::min(runs[i - 1].flow(), runs[i].flow());
  const auto reach = [](double flow, double slope, double volume) {
    return std::sqrt(flow * flow + 2 * slope * volume);
  };
  for (std::size_t i = 0; i < runs.size(); ++i)
    out[i + 1] = std::min(out[i + 1], reach(out[i], slopes.up, runs[i].volume));
  for (std::size_t i = runs.size(); i-- > 0;) out[i] = std::min(out[i], reach(out[i + 1], slopes.down, runs[i].volume));
  return out;
}

/// How a run is laid whose flow is given at both ends: it grows, stays at what was asked for, and falls.
class Profile {
 public:
  Profile(const Run& run, const Slopes& slopes, double begin, double end)
      : slopes_(slopes), volume_(run.volume), asked_(run.flow()), most_(asked_), begin_(begin), end_(end) {
    up_ = volume_to(begin, most_, slopes.up), down_ = volume_to(end, most_, slopes.down);
    if (up_ + down_ <= volume_) return;
    // It does not come to what was asked for.
    up_ = volume_of_peak(), down_ = volume_ - up_;
    most_ = std::min(most_, std::sqrt(std::isinf(slopes.up) ? end * end + 2 * slopes.down * down_
                                                            : begin * begin + 2 * slopes.up * up_));
  }

  /// Is all of it as asked for, but for what is one flow?
  bool stays() const { return (1 + same_flow) * std::min(begin_, end_) >= asked_; }
  /// Where it stops to grow, and where it begins to fall.
  double grown() const { return up_; }
  double falls() const { return volume_ - down_; }
  double flow_at(double volume) const {
    if (volume < up_) return std::min(most_, std::sqrt(begin_ * begin_ + 2 * slopes_.up * volume));
    if (volume <= volume_ - down_) return most_;
    return std::min(most_, std::sqrt(end_ * end_ + 2 * slopes_.down * std::max(volume_ - volume, 0.0)));
  }

 private:
  static double volume_to(double from, double to, double slope) {
    return std::isinf(slope) ? 0 : std::max((to * to - from * from) / (2 * slope), 0.0);
  }
  double volume_of_peak() const {
    if (std::isinf(slopes_.up)) return 0;
    if (std::isinf(slopes_.down)) return volume_;
    const double at = (end_ * end_ - begin_ * begin_ + 2 * slopes_.down * volume_) / (2 * (slopes_.up + slopes_.down));
    return std::clamp(at, 0.0, volume_);
  }

  const Slopes& slopes_;
  double volume_, asked_, most_, begin_, end_, up_ = 0, down_ = 0;
};

/// A part of a piece: up to which share of its length, and how fast.
struct Cut {
  double to, speed_mm_s;
};

/// Cuts the pieces of a run where its flow grows or falls, and tells each part its speed.
class Cutter {
 public:
  Cutter(const Profile& profile, const Slopes& slopes) : profile_(profile), slopes_(slopes) {}

  std::vector<Cut> next(const Piece& piece) {
    const double begin = at_, end = at_ + piece.volume();
    at_ = end;
    if (profile_.stays() || (begin >= profile_.grown() && end <= profile_.falls())) return {{1, piece.speed_mm_s}};
    std::vector<Cut> out;
    double from = begin, done = 0;  // volume, and share of the length
    for (const double to : ends_of_parts(piece, begin, end)) {
      const double a = profile_.flow_at(from), b = profile_.flow_at(to), share = piece.share_of(to - begin);
      const double wanted = std::abs(b - a) / (flow_step * std::max({a, b, 1e-9}));
      const double room = 1000 * piece.length_mm * (share - done) / tolerances::shortest_piece;
      const int steps = std::max(1, static_cast<int>(std::min(std::ceil(wanted), room)));
      for (int k = 1; k <= steps; ++k) {  // parts of equal volume: where flow is low they are not shorter
        const double v0 = from + (to - from) * (k - 1) / steps, v1 = from + (to - from) * k / steps;
        const double next = piece.share_of(v1 - begin), area_mm2 = (v1 - v0) / (piece.length_mm * (next - done));
        out.push_back({next, speed(piece, profile_.flow_at((v0 + v1) / 2) / area_mm2)});
        done = next;
      }
      from = to;
    }
    out.back().to = 1;
    return out;
  }

 private:
  double speed(const Piece& piece, double mm_s) const {
    return std::clamp(mm_s, std::min(slopes_.least_mm_s, piece.speed_mm_s), piece.speed_mm_s);
  }

  /// A piece is cut where its flow stops to grow, and where it begins to fall, unless that leaves a part too short to
  /// be printed at a speed of its own.
  std::vector<double> ends_of_parts(const Piece& piece, double begin, double end) const {
    std::vector<double> out;
    double done = 0;
    for (const double turn : {profile_.grown(), profile_.falls()}) {
      if (turn <= begin || turn >= end) continue;
      const double share = piece.share_of(turn - begin), least = tolerances::shortest_piece / (1000 * piece.length_mm);
      if (share - done < least || 1 - share < least) continue;
      out.push_back(turn), done = share;
    }
    out.push_back(end);
    return out;
  }

  const Profile& profile_;
  const Slopes& slopes_;
  double at_ = 0;
};

/// The bead with its pieces cut.
class Rebuilt {
 public:
  explicit Rebuilt(Extrude& bead) : bead_(bead) {
    path_.push_back(bead.path.front());
    if (!bead.below.empty()) below_.push_back(bead.below.front());
  }

  void add(const Piece& piece, const std::vector<Cut>& cuts) {
    auto cut = cuts.begin();
    double done = 0;  // mm of it
    for (std::size_t i = piece.from; i < piece.to; ++i) {
      const double mm = distance(bead_.path[i].at, bead_.path[i + 1].at) / 1000;
      for (; cut + 1 != cuts.end() && cut->to * piece.length_mm < done + mm; ++cut)
        add_place(i, (cut->to * piece.length_mm - done) / mm, cut->speed_mm_s);
      add_place(i, 1, cut->speed_mm_s);
      done += mm;
    }
    next_ = piece.to;
  }

  void put() {
    for (; next_ + 1 < bead_.path.size(); ++next_) add_place(next_, 1, static_cast<double>(speeds_.back()));
    bead_.path = std::move(path_), bead_.below = std::move(below_);
    const auto [least, most] = std::minmax_element(speeds_.begin(), speeds_.end());
    bead_.speed_mm_s = static_cast<double>(*least);
    if (*least == *most)
      bead_.segment_speed_mm_s.clear();
    else
      bead_.segment_speed_mm_s = std::move(speeds_);
  }

 private:
  /// The place at share t between junction i and the next, and how fast what leads there is.
  void add_place(std::size_t i, double t, double mm_s) {
    const Junction &a = bead_.path[i], &b = bead_.path[i + 1];
    const Junction j = t >= 1 ? b
                              : Junction{lerp(a.at, b.at, t), rounded(a.width + t * (b.width - a.width)),
                                         static_cast<float>(a.flow + t * static_cast<double>(b.flow - a.flow))};
    if (t < 1 && j.at == path_.back().at) return;
    path_.push_back(j);
    if (!below_.empty())
      below_.push_back(rounded(bead_.below[i] + t * (static_cast<double>(bead_.below[i + 1]) - bead_.below[i])));
    speeds_.push_back(static_cast<float>(mm_s));
  }

  Extrude& bead_;
  std::size_t next_ = 0;  // junction that is not there yet, less one
  std::vector<Junction> path_;
  std::vector<Um> below_;
  std::vector<float> speeds_;
};

void limit(Chain& chain) {
  if (chain.pieces.empty()) return;
  const auto runs = runs_of(chain.pieces);
  const auto flows = flows_between(runs, chain.slopes);
  std::vector<std::vector<Cut>> cuts(chain.pieces.size());
  for (std::size_t r = 0, i = 0; r < runs.size(); ++r) {
    const Profile profile(runs[r], chain.slopes, flows[r], flows[r + 1]);
    Cutter cutter(profile, chain.slopes);
    for (; i < runs[r].end; ++i) {
      const Piece& piece = chain.pieces[i];
      if (piece.volume() > 0 && piece.speed_mm_s > 0)
        cuts[i] = cutter.next(piece);
      else
        cuts[i] = {{1, piece.speed_mm_s}};
    }
  }
  std::size_t first = 0;  // piece of the bead
  for (std::size_t b = 0; b < chain.beads.size(); first += chain.counts[b++]) {
    const std::size_t end = first + chain.counts[b];
    bool stays = true;
    for (std::size_t k = first; k < end; ++k)
      stays = stays && cuts[k].size() == 1 && cuts[k][0].speed_mm_s == chain.pieces[k].speed_mm_s;
    if (stays) continue;
    Rebuilt rebuilt(*chain.beads[b]);
    for (std::size_t k = first; k < end; ++k) rebuilt.add(chain.pieces[k], cuts[k]);
    rebuilt.put();
  }
}

}  // namespace

bool limits_extrusion_rate(const AllRules& all, const LayerPlan& layer) {
  const Rules& rules = of_scope(all, layer.scope);
  if (all.tools.empty()) return slopes_of(rules, rules).limited();
  return std::any_of(all.tools.begin(), all.tools.end(),
                     [&](const Rules& tool) { return slopes_of(tool, rules).limited(); });
}

void limit_extrusion_rate(const AllRules& all, LayerPlan& layer) {
  const Rules& rules = of_scope(all, layer.scope);
  ToolId tool = all.loaded;
  Chain chain;
  double travelled_um = 0;
  std::optional<Point> at;
  const auto end_chain = [&] {
    if (!chain.empty()) limit(chain);
    chain = Chain{slopes_of(of_tool(all, tool, rules), rules), {}, {}, {}};
  };
  end_chain();
  const overloaded see{[&](Extrude& bead) {
                         if (travelled_um >= short_travel_um) end_chain();
                         travelled_um = 0;
                         if (bead.path.size() < 2) return;
                         if (chain.slopes.limited()) chain.add(bead);
                         at = bead.path.back().at;
                       },
                       [&](Travel& travel) {
                         for (const Point3 p : travel.path) {
                           travelled_um += at ? distance(*at, flat(p)) : 0;
                           at = flat(p);
                         }
                       },
                       [&](Retract&) { end_chain(); },
                       [&](Prime&) { end_chain(); },
                       [&](ToolChange& change) {
                         tool = change.tool;
                         end_chain();
                       },
                       [&](Pause&) { end_chain(); },
                       [&](Feed&) { end_chain(); },
                       LeavesAlone<SetFan, ObjectStart, ObjectEnd, SetTemperature, SetPressureAdvance>{}};
  for (auto& step : layer.steps) std::visit(see, step);
  end_chain();
}

}  // namespace weft::motion
