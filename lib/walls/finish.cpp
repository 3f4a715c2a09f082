// SPDX-License-Identifier: GPL-3.0-or-later
#include "walls/finish.h"

#include "core/stop.h"
#include "model/simplify.h"
#include "model/widths.h"

#include <algorithm>
#include <cmath>

namespace weft::walls {
namespace {

using Vertex = Line::Vertex;

/// Widths that plastic can follow, along a path with as few vertices as it needs.
void simplify(std::vector<Vertex>& path, bool closed, double steady) {
  VertexPath simple;
  simple.reserve(path.size());
  for (const Vertex& v : path) simple.push_back({v.at.x, v.at.y, v.width});
  steady_widths(simple, closed, steady);
  stop_if_asked();
  simplify(simple, closed);
  stop_if_asked();
  cut_ramps(simple, closed);
  path.clear();
  for (const PathVertex& v : simple) path.push_back({{v.x, v.y}, v.band});
}

/// What a bead may not be wide it is elsewhere, within limits.
void keep_within(std::vector<Vertex>& path, double most) {
  constexpr double most_more = 1.1;
  if (std::none_of(path.begin(), path.end(), [&](const Vertex& v) { return v.width > most; })) return;
  const double wanted = area_of(path);
  for (int round = 0; round < 3; ++round) {  // again, for some that grow reach the limit themselves
    for (Vertex& v : path) v.width = std::min(most, v.width);
    const double more = std::min(most_more, wanted / std::max(1.0, area_of(path)));
    for (Vertex& v : path)
      if (v.width < most) v.width *= more;
  }
}

struct Stretch {
  double from = 0;  ///< along the line
  std::vector<Vertex> path{};
};

/// The stretches of a line at least `least` wide; ends lie where the width passes it.
std::vector<Stretch> thick_stretches(const std::vector<Vertex>& path, double least) {
  std::vector<Stretch> out;
  double along = 0;
  bool open = false;
  auto between = [&](const Vertex& a, const Vertex& b) {
    return Vertex{lerp(a.at, b.at, (least - a.width) / (b.width - a.width)), least};
  };
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (i > 0) along += distance(path[i - 1].at, path[i].at);
    const bool thick = path[i].width >= least;
    if (thick && !open) {
      out.push_back({along});
      if (i > 0) {
        out.back().path.push_back(between(path[i - 1], path[i]));
        out.back().from -= distance(out.back().path.back().at, path[i].at);
      }
    } else if (!thick && open) {
      out.back().path.push_back(between(path[i - 1], path[i]));
    }
    if (thick) out.back().path.push_back(path[i]);
    open = thick;
  }
  return out;
}

/// The place so far along a path.
Place at_length(const std::vector<Vertex>& path, double along) {
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double piece = distance(path[i - 1].at, path[i].at);
    if (along <= piece && piece > 0) return lerp(path[i - 1].at, path[i].at, along / piece);
    along -= piece;
  }
  return path.back().at;
}

}  // namespace

void append_bead(const Line& line, const FinishOptions& o, Beads& out) {
  Bead bead;
  bead.role = line.inset == 0 ? Role::outer_wall : Role::inner_wall;
  bead.closed = line.closed;
  bead.inset = static_cast<std::uint16_t>(line.inset);
  bead.part = o.part;
  const double stable = line.inset == 0 ? o.stable_outer : o.stable_inner;
  bead.path.reserve(line.path.size());
  for (const Vertex& v : line.path) {
    Junction j{{o.origin.x + rounded(v.at.x), o.origin.y + rounded(v.at.y)},
               rounded(std::clamp(v.width, 1.0, o.most_width)),
               1.F};
    if (o.compensate && v.width < stable) {
      j.width = rounded(stable);
      j.flow = static_cast<float>(std::clamp(v.width / stable, o.least_flow, o.most_flow));
    }
    if (!bead.path.empty() && bead.path.back().at == j.at) continue;
    bead.path.push_back(j);
  }
  if (bead.closed && bead.path.size() > 2 && bead.path.front().at == bead.path.back().at) bead.path.pop_back();
  if (bead.closed && bead.path.size() < 3) bead.closed = false;
  if (bead.path.size() >= 2) out.push_back(std::move(bead));
}

void finish(Line line, const FinishOptions& o, std::vector<Line>& out, LeftOut& left_out) {
  if (line.path.size() < 2) return;
  const double steady = line.inset == 0 ? o.steady_outer : o.steady_loop;
  if (line.closed) line.path.push_back(line.path.front());
  const bool all_thick =
      std::all_of(line.path.begin(), line.path.end(), [&](const Vertex& v) { return v.width >= o.least_feature; });
  if (line.closed && all_thick) {
    line.path.pop_back();
    simplify(line.path, true, steady);
    out.push_back(std::move(line));
    return;
  }
  double done = 0;  // what lies before it along the line is laid, or told
  const auto leave_out = [&](double to) {
    if (to <= done) return;
    const Place middle = at_length(line.path, (done + to) / 2);
    left_out.add((to - done) / 1000, {o.origin.x + rounded(middle.x), o.origin.y + rounded(middle.y)});
  };
  const bool tip = o.has_walls && line.inset == 0;
  for (auto& [from, stretch] : thick_stretches(line.path, o.least_feature)) {
    const double length = length_of(stretch);
    if (stretch.size() < 2 || !worth_a_bead(o, tip, length, area_of(stretch))) continue;
    leave_out(from);
    done = from + length;
    bool first_meets = line.first_meets && distance(stretch.front().at, line.path.front().at) < 1;
    bool last_meets = line.last_meets && distance(stretch.back().at, line.path.back().at) < 1;
    // A bead begins at its thin end: what swells behind the nozzle there is least.
    if (stretch.front().width > stretch.back().width) {
      std::swap(first_meets, last_meets);
      std::reverse(stretch.begin(), stretch.end());
    }
    keep_within(stretch, o.most_width);
    simplify(stretch, false, line.inset == 0 ? o.steady_outer : o.steady_open);
    out.push_back({std::move(stretch), false, line.inset, first_meets, last_meets});
  }
  leave_out(length_of(line.path));
}

void put_in_order(Beads& beads, WallOrder order) {
  auto rank = [&](const Bead& bead) {
    const int inset = bead.inset;
    switch (order) {
      case WallOrder::inside_out:
        return -inset;
      case WallOrder::outside_in:
        return inset;
      case WallOrder::outer_inner_outer: {
        double area = 0;
        for (std::size_t i = 0; i < bead.path.size(); ++i) {
          const Point a = bead.path[i].at, b = bead.path[(i + 1) % bead.path.size()].at;
          area += static_cast<double>(a.x) * b.y - static_cast<double>(b.x) * a.y;
        }
        return inset == 0 && bead.closed && area < 0 ? 1 << 20 : inset;
      }
    }
    return 0;
  };
  std::stable_sort(beads.begin(), beads.end(), [&](const Bead& a, const Bead& b) { return rank(a) < rank(b); });
}

}  // namespace weft::walls
