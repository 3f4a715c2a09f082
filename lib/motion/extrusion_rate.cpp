// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/extrusion_rate.h"

#include "core/tolerances.h"
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

/// A piece of a bead, along which it is extruded evenly.
struct Piece {
  double length_mm, area_mm2, speed_mm_s;
  double volume() const { return length_mm * area_mm2; }
  double flow() const { return area_mm2 * speed_mm_s; }
};

/// The beads that follow each other, and all their pieces.
struct Chain {
  Slopes slopes;
  std::vector<Extrude*> beads;
  std::vector<Piece> pieces;

  bool empty() const { return beads.empty(); }
  void add(Extrude& bead) {
    beads.push_back(&bead);
    const double height_mm = to_mm(bead.height);
    for (std::size_t i = 1; i < bead.path.size(); ++i) {
      const auto &a = bead.path[i - 1], &b = bead.path[i];
      const double speed =
          bead.segment_speed_mm_s.empty() ? bead.speed_mm_s : static_cast<double>(bead.segment_speed_mm_s[i - 1]);
      pieces.push_back({distance(a.at, b.at) / 1000, mean_area_mm2(a, b, height_mm) * slopes.flow, speed});
    }
  }
};

/// Flow at the beginning of each piece, and at the end of the last.
std::vector<double> flows_between(const Chain& chain) {
  const auto& pieces = chain.pieces;
  std::vector<double> out(pieces.size() + 1);
  out.front() = pieces.front().flow(), out.back() = pieces.back().flow();
  for (std::size_t i = 1; i < pieces.size(); ++i) out[i] = std::min(pieces[i - 1].flow(), pieces[i].flow());
  const auto reach = [](double flow, double slope, double volume) {
    return std::sqrt(flow * flow + 2 * slope * volume);
  };
  for (std::size_t i = 0; i < pieces.size(); ++i)
    out[i + 1] = std::min(out[i + 1], reach(out[i], chain.slopes.up, pieces[i].volume()));
  for (std::size_t i = pieces.size(); i-- > 0;)
    out[i] = std::min(out[i], reach(out[i + 1], chain.slopes.down, pieces[i].volume()));
  return out;
}

/// A part of a piece: up to which share of its length, and how fast.
struct Cut {
  double to, speed_mm_s;
};

/// How a piece is laid whose flow is given at both ends: it grows, stays at what was asked for, and falls.
class Profile {
 public:
  Profile(const Piece& piece, const Slopes& slopes, double begin, double end) : piece_(piece), slopes_(slopes) {
    const double volume = piece.volume();
    double most = piece.flow();
    const double up = volume_to(begin, most, slopes.up), down = volume_to(end, most, slopes.down);
    if (up + down > volume) {  // it does not come to what was asked for
      const double at = volume_of_peak(begin, end);
      const double grown2 = begin * begin + 2 * slopes.up * at, falls2 = end * end + 2 * slopes.down * (volume - at);
      most = std::min(most, std::sqrt(std::isinf(slopes.up) ? falls2 : grown2));
      ramp(begin, most, 0, at);
      ramp(most, end, at, volume);
      return;
    }
    ramp(begin, most, 0, up);
    if (up + down < volume) add(volume - down, most);
    ramp(most, end, volume - down, volume);
  }

  const std::vector<Cut>& cuts() const { return cuts_; }

 private:
  /// Where flow is highest that grows from the beginning on and falls until the end.
  double volume_of_peak(double begin, double end) const {
    const double volume = piece_.volume();
    if (std::isinf(slopes_.up)) return 0;
    if (std::isinf(slopes_.down)) return volume;
    const double at = (end * end - begin * begin + 2 * slopes_.down * volume) / (2 * (slopes_.up + slopes_.down));
    return std::clamp(at, 0.0, volume);
  }
  static double volume_to(double from, double to, double slope) {
    return std::isinf(slope) ? 0 : std::max((to * to - from * from) / (2 * slope), 0.0);
  }

  /// From one flow to another, between two volumes of the piece.
  void ramp(double from, double to, double begin, double end) {
    if (end <= begin) return;
    const double length_um = 1000 * (end - begin) / piece_.area_mm2, higher = std::max(from, to);
    const double wanted = higher > 0 ? std::abs(to - from) / (flow_step * higher) : 0;
    const int steps =
        std::max(1, static_cast<int>(std::min(std::ceil(wanted), length_um / tolerances::shortest_piece)));
    for (int k = 1; k <= steps; ++k) {
      // Parts of equal volume: where flow is low they are not shorter.
      const double a = static_cast<double>(k - 1) / steps, b = static_cast<double>(k) / steps;
      const auto flow_at = [&](double t) { return std::sqrt(from * from + t * (to * to - from * from)); };
      add(begin + b * (end - begin), (flow_at(a) + flow_at(b)) / 2);
    }
  }
  void add(double to_volume, double flow) {
    const double least = std::min(slopes_.least_mm_s, piece_.speed_mm_s);
    cuts_.push_back({to_volume / piece_.volume(), std::clamp(flow / piece_.area_mm2, least, piece_.speed_mm_s)});
  }

  const Piece& piece_;
  const Slopes& slopes_;
  std::vector<Cut> cuts_;
};

/// The bead with its pieces cut.
class Rebuilt {
 public:
  explicit Rebuilt(Extrude& bead) : bead_(bead) {
    path_.push_back(bead.path.front());
    if (!bead.below.empty()) below_.push_back(bead.below.front());
  }

  /// Piece i of the bead as it was.
  void add(std::size_t i, const std::vector<Cut>& cuts) {
    const Junction &a = bead_.path[i], &b = bead_.path[i + 1];
    for (std::size_t k = 0; k < cuts.size(); ++k) {
      const double t = k + 1 == cuts.size() ? 1 : cuts[k].to;
      const Junction j = t == 1 ? b
                                : Junction{lerp(a.at, b.at, t), rounded(a.width + t * (b.width - a.width)),
                                           static_cast<float>(a.flow + t * static_cast<double>(b.flow - a.flow))};
      if (t < 1 && j.at == path_.back().at) continue;
      path_.push_back(j);
      if (!below_.empty())
        below_.push_back(rounded(bead_.below[i] + t * (static_cast<double>(bead_.below[i + 1]) - bead_.below[i])));
      speeds_.push_back(static_cast<float>(cuts[k].speed_mm_s));
    }
  }

  void put() {
    bead_.path = std::move(path_), bead_.below = std::move(below_);
    const auto [least, most] = std::minmax_element(speeds_.begin(), speeds_.end());
    if (*least == *most) {
      bead_.segment_speed_mm_s.clear();
      bead_.speed_mm_s = static_cast<double>(*least);
      return;
    }
    bead_.speed_mm_s = static_cast<double>(*least);
    bead_.segment_speed_mm_s = std::move(speeds_);
  }

 private:
  Extrude& bead_;
  std::vector<Junction> path_;
  std::vector<Um> below_;
  std::vector<float> speeds_;
};

void limit(Chain& chain) {
  if (chain.pieces.empty()) return;
  const auto flows = flows_between(chain);
  std::size_t next = 0;  // piece
  for (Extrude* bead : chain.beads) {
    const std::size_t first = next, count = bead->path.size() - 1;
    next += count;
    bool stays = true;
    for (std::size_t i = 0; i < count && stays; ++i) {
      const double flow = chain.pieces[first + i].flow();
      stays = flows[first + i] == flow && flows[first + i + 1] == flow;
    }
    if (stays) continue;
    Rebuilt rebuilt(*bead);
    for (std::size_t i = 0; i < count; ++i) {
      const Piece& piece = chain.pieces[first + i];
      if (piece.volume() <= 0 || piece.speed_mm_s <= 0)
        rebuilt.add(i, {{1, piece.speed_mm_s}});
      else
        rebuilt.add(i, Profile(piece, chain.slopes, flows[first + i], flows[first + i + 1]).cuts());
    }
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
    chain = Chain{slopes_of(of_tool(all, tool, rules), rules), {}, {}};
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
