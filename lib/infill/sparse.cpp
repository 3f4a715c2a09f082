// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/sparse.h"

#include "core/stop.h"
#include "geometry/offset.h"
#include "infill/concentric.h"
#include "infill/fermat.h"
#include "infill/few_points.h"
#include "infill/medial.h"
#include "infill/multiply.h"
#include "infill/pattern.h"
#include "infill/prepared.h"
#include "infill/streamlines.h"
#include "infill/web.h"
#include "model/flow.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft::infill {
namespace {

/// Of the region in a frame.
Span2 span_of(const Region& region, const Frame& frame) {
  Span2 area{{1e300, 1e300}, {-1e300, -1e300}};
  for (const Point p : region.outer) {
    const Turned t = frame.into(p);
    area.min = {std::min(area.min.x, t.x), std::min(area.min.y, t.y)};
    area.max = {std::max(area.max.x, t.x), std::max(area.max.y, t.y)};
  }
  return area;
}

std::vector<Web::Curve> turned_back(const std::vector<Curve>& curves, const Frame& frame, Um tolerance) {
  std::vector<Web::Curve> out;
  out.reserve(curves.size());
  for (const Curve& curve : curves) {
    stop_if_asked();
    Polyline line;
    line.reserve(curve.points.size());
    for (const Turned t : curve.points) line.push_back(frame.back(t));
    out.push_back({few_points(line, curve.closed, tolerance), curve.closed});
  }
  return out;
}

/// What was found for the whole object, or nothing; where the density varies, that is what cubes go by.
const CubeTree* cubes_of(const PatternRow& row, const SparseStyle& style) {
  const bool of_cubes = row.pattern == InfillPattern::cubicsubdiv || row.pattern == InfillPattern::support_cubic;
  if (!of_cubes || style.prepared == nullptr || style.prepared->density) return nullptr;
  return style.prepared->cubes ? &*style.prepared->cubes : nullptr;
}

/// How the pattern is turned in that layer.
double angle_of(const PatternRow& row, const SparseStyle& style) {
  if (cubes_of(row, style) != nullptr) return style.prepared->cubes_angle_rad;
  if (!style.turned || row.turn_deg <= 0) return style.angle_rad;
  const auto turns = static_cast<std::size_t>(std::lround(360 / row.turn_deg));
  return style.angle_rad + static_cast<double>(style.turn % turns) * row.turn_deg * std::numbers::pi / 180;
}

PatternPlace place_of(const Region& region, const SparseStyle& style, const Frame& frame) {
  PatternPlace place{.band = static_cast<double>(style.band),
                     .density = style.density / style.multiplier,
                     .z = static_cast<double>(style.z),
                     .index = style.turn,
                     .area = span_of(region, frame),
                     .reach = style.reach};
  // turned by any angle, the object's box reaches farther by the root of two
  const double own = std::max({-place.area.min.x, -place.area.min.y, place.area.max.x, place.area.max.y});
  place.reach = std::max(place.reach * std::numbers::sqrt2, own);
  return place;
}

/// Whether lines of both are those of the coarser, and others midway between them.
bool doubles(const Family& coarse, const Family& fine) {
  constexpr double same = 1;  // µm
  const double off = std::remainder(coarse.phase - fine.phase, fine.pitch);
  return coarse.angle_rad == fine.angle_rad && std::abs(coarse.pitch - 2 * fine.pitch) < same && std::abs(off) < same;
}

/// What the pattern is at each level; nothing where its lines are not of the next one.
std::vector<Drawing> nested(const Region& region, SparseStyle style, const PatternRow& row,
                            const std::vector<DenseLevel>& levels) {
  std::vector<Drawing> out;
  for (const DenseLevel& level : levels) {
    style.density = level.density;
    const Drawing drawing = row.draw(place_of(region, style, Frame(angle_of(row, style), style.origin)));
    if (!drawing.curves.empty() || drawing.families.size() < 2) return {};
    if (!out.empty()) {
      const auto &coarse = out.back().families, &fine = drawing.families;
      if (!std::equal(coarse.begin(), coarse.end(), fine.begin(), fine.end(), doubles)) return {};
    }
    out.push_back(drawing);
  }
  return out;
}

/// Cuts a pattern with the region and joins what is left.
void fill_drawn(const Region& region, const SparseStyle& style, const PatternRow& row, Beads& beads) {
  const double angle = angle_of(row, style);
  const Frame frame(angle, style.origin);
  const PatternPlace place = place_of(region, style, frame);
  const CubeTree* cubes = cubes_of(row, style);
  Drawing drawing = cubes != nullptr ? Drawing{.curves = cubes->cut(place.z), .pitch = 3 * place.spacing(), .longer = 1}
                                     : row.draw(place);
  multiply(drawing, style.multiplier, style.band);
  Web web(region, style);
  for (const Family& family : drawing.families)
    web.add_lines(region, {angle + family.angle_rad, family.pitch, family.phase});
  const bool bent = style.bend && drawing.curves.empty() && drawing.families.size() > 1;
  if (bent) web.bend_crossings();
  if (!drawing.curves.empty()) web.add_curves(region, turned_back(drawing.curves, frame, tolerance_of(style.density)));
  const double joint = style.anchor_max >= 0 ? style.anchor_max : row.longest_joint * drawing.pitch;
  const bool as_usual = drawing.longer > 0 || !style.even;
  if (as_usual && !bent)
    web.emit(joint, std::max(1, rounded(drawing.longer > 0 ? style.band / drawing.longer : style.band)), 0, beads);
  else
    web.emit(joint, style.band, style.density * area_mm2(region) * 1e6 / style.band, beads);
}

/// Closed lines beside the edge, from outside inwards. @returns what they leave
Regions add_loops(const Region& region, const SparseStyle& style, Beads& beads) {
  Regions rest{region};
  for (int i = 0; i < style.loops && !rest.empty(); ++i) {
    for (const Region& r : geometry::offset(rest, {.by = -style.band / 2})) {
      const auto add = [&](const Ring& ring) {
        Bead& bead = beads.emplace_back();
        bead.role = Role::infill, bead.part = style.part, bead.closed = true;
        for (const Point p : ring) bead.path.push_back({p, style.band, static_cast<float>(style.layers)});
      };
      add(r.outer);
      for (const Ring& hole : r.holes) add(hole);
    }
    rest = geometry::offset(rest, {.by = -style.band});
  }
  return rest;
}

/// Branches as they were found for the whole object.
void fill_branches(const Region& region, const SparseStyle& style, const PatternRow& row, Beads& beads) {
  const auto& branches = style.prepared->branches;
  if (style.index >= branches.size()) return;
  std::vector<Web::Curve> curves;
  for (const Polyline& line : branches[style.index]) curves.push_back({line, false});
  Web web(region, style);
  web.add_curves(region, curves);
  const double joint = style.anchor_max >= 0 ? style.anchor_max : row.longest_joint * style.band / style.density;
  web.emit(joint, style.band, 0, beads);
}

void fill_one(const Region& region, const SparseStyle& style, Beads& beads) {
  const PatternRow& row = row_of(style.pattern);
  if (style.pattern == InfillPattern::lightning && style.prepared != nullptr)
    return fill_branches(region, style, row, beads);
  if (row.draw != nullptr) return fill_drawn(region, style, row, beads);
  if (style.pattern == InfillPattern::fermat) return fill_fermat(region, style, beads);
  if (style.pattern == InfillPattern::medial) return fill_medial(region, style, beads);
  if (style.pattern == InfillPattern::streamlines) return fill_streamlines(region, style, beads);
  fill_concentric(region, style, beads);
}

}  // namespace

Um width_of_sparse(const InfillSettings& infill, Um nozzle, Um height) {
  return length_or(infill.infill_line_width, nozzle, flow::automatic_width(nozzle, height, false));
}

SparseStyle sparse_style(const InfillSettings& infill, const SparseLayer& layer) {
  const Numbers& angles = infill.infill_angles;
  const double angle = angles.empty() ? infill.infill_angle : angles[layer.turn % angles.size()];
  const double turned_rad = infill.infill_angle_frame == InfillFrame::part ? layer.turned_rad : 0;
  return {.pattern = infill.infill_pattern,
          .density = infill.infill_sparse_density / 100,
          .band = flow::band(width_of_sparse(infill, layer.nozzle, layer.height), layer.height),
          .angle_rad = angle * std::numbers::pi / 180 + turned_rad,
          .connect = infill.infill_connect_lines,
          .z = layer.z,
          .origin = layer.origin + Point{infill.infill_offset_x, infill.infill_offset_y},
          .index = layer.index,
          .turn = layer.turn,
          .turned = angles.empty(),
          .reach = layer.reach + std::max(std::abs(infill.infill_offset_x), std::abs(infill.infill_offset_y)),
          .anchor_max = infill.infill_anchor_max ? static_cast<double>(*infill.infill_anchor_max) : -1,
          .anchor_um = static_cast<double>(infill.infill_anchor_length),
          .loops = infill.infill_wall_line_count,
          .multiplier = infill.infill_multiplier,
          .bend = infill.infill_crossings == InfillCrossings::bend};
}

bool fill_levels(const Region& region, const SparseStyle& style, const std::vector<DenseLevel>& levels, Beads& beads) {
  const PatternRow& row = row_of(style.pattern);
  if (row.draw == nullptr || style.multiplier > 1 || style.loops > 0 || style.bend || levels.size() < 2) return false;
  if (cubes_of(row, style) != nullptr || region.outer.size() < 3) return false;
  const std::vector<Drawing> drawings = nested(region, style, row, levels);
  if (drawings.empty()) return false;
  const double angle = angle_of(row, style);
  Web web(region, style);
  for (std::size_t f = 0; f < drawings.front().families.size(); ++f)
    for (std::size_t k = 0; k < levels.size(); ++k) {
      const Family& own = drawings[k].families[f];
      const double turned = angle + own.angle_rad;
      if (k == 0)
        web.add_lines(region, {turned, own.pitch, own.phase});
      else  // those midway
        web.add_lines(region,
                      {turned, 2 * own.pitch, drawings[k - 1].families[f].phase + own.pitch, &levels[k].within, true});
    }
  web.end_at_lines(drawings.front().pitch);
  double wanted = 0;  // µm²
  for (std::size_t k = 0; k < levels.size(); ++k)
    for (const Region& r : levels[k].within)
      wanted += (levels[k].density - (k > 0 ? levels[k - 1].density : 0)) * area_mm2(r) * 1e6;
  const double joint = style.anchor_max >= 0 ? style.anchor_max : row.longest_joint * drawings.back().pitch;
  web.emit(joint, style.band, wanted / style.band, beads);
  return true;
}

void fill_sparse(const Region& region, const SparseStyle& style, Beads& beads) {
  if (style.band <= 0 || style.density <= 0 || region.outer.size() < 3) return;
  if (style.loops <= 0) return fill_one(region, style, beads);
  for (const Region& rest : add_loops(region, style, beads)) fill_one(rest, style, beads);
}

}  // namespace weft::infill
