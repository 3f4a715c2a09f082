// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/support_beads.h"

#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/convex.h"
#include "geometry/offset.h"
#include "geometry/simplify.h"
#include "geometry/spatial_index.h"
#include "infill/solid.h"
#include "infill/sparse.h"
#include "model/flow.h"
#include "pipeline/feet.h"
#include "pipeline/reaches_further.h"
#include "support/column_steps.h"
#include "support/lengths.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

namespace weft::pipeline {
namespace {

struct PatternRow {
  SupportPattern pattern;
  InfillPattern as;
  bool connect;
};
constexpr std::array pattern_rows{
    PatternRow{SupportPattern::lines, InfillPattern::lines, false},
    PatternRow{SupportPattern::zigzag, InfillPattern::lines, true},
    PatternRow{SupportPattern::grid, InfillPattern::grid, true},
    PatternRow{SupportPattern::triangles, InfillPattern::triangles, true},
    PatternRow{SupportPattern::concentric, InfillPattern::concentric, true},
    PatternRow{SupportPattern::gyroid, InfillPattern::gyroid, true},
};
static_assert(in_order(pattern_rows, &PatternRow::pattern), "row i of pattern_rows is pattern i");

/// Lays the beads of one layer.
class Filler {
 public:
  explicit Filler(const SupportToFill& what)
      : s_(what.settings.support),
        layer_(what.layer),
        origin_(what.origin),
        line_(support::line_width(s_, what.settings.machine.nozzle_diameter)),
        span_(support::roof_span(what.settings.machine.nozzle_diameter)),
        narrow_span_(support::narrow_roof_span(what.settings.machine.nozzle_diameter)),
        between_feet_(support::between_feet(what.settings.machine.nozzle_diameter)),
        band_(flow::band(line_, layer_.height)),
        columns_(shares_of_columns(what.settings)),
        usual_band_(columns_.band) {}

  /// @param columns  what `column` and `under_roof` made of the layer's
  SupportBeads filled(Beads columns, const BesideLayer& beside) && {
    beads_ = std::move(columns), below_ = &beside.below;
    branches();
    interface(layer_.bottom, across());
    interface(layer_.roof, s_.support_infill_angle);
    joists();
    beads_ = on_feet(std::move(beads_), layer_.feet, beside.above,
                     {.foot = support::foot_length(line_), .apart = between_feet_});
    for (Bead& bead : beads_) {
      const auto tool = bead.role == Role::support ? s_.support_infill_extruder_nr : s_.support_interface_extruder_nr;
      if (tool) bead.tool = static_cast<ToolId>(*tool);
    }
    return {std::move(beads_), std::move(hang_at_)};
  }

  /// Columns with walls.
  Beads walled(const NearSteps& near) && {
    const Regions inside = loops(layer_.columns, s_.support_wall_count.value_or(0), Role::support);
    lines_of(thinned(inside, near), 0);
    return std::move(beads_);
  }
  /// What a roof's strands lie on.
  Beads under_roof() && {
    const bool joined = s_.support_interface_pattern != SupportPattern::lines;
    sparse(layer_.under_roof, support::under_roof_share(s_), joined ? SupportPattern::zigzag : SupportPattern::lines,
           across(), Role::support);
    return std::move(beads_);
  }
  /// A column without walls: hollow where it is narrow.
  Beads column(const Region& column, const NearSteps& near) && {
    if (near.empty() || layer_.first)
      dense_column(column);
    else
      for (const Region& piece : thinned({column}, near)) dense_column(piece);
    return std::move(beads_);
  }

 private:
  static constexpr double dense = 0.995;  // a share that leaves nothing between beads
  static constexpr int most_loops = 1000;

  /// What of a column is no further down than the first step.
  void dense_column(const Region& column) {
    const Regions wide = wide_enough({column}, 0);
    if (wide.empty()) return narrow_column({column});
    const std::size_t from = beads_.size();
    lines_of(wide, 0);
    bend_lone_lines(column, 0, from);
    const Um half = least_half(0);
    if (reaches_further(column, wide, half))
      narrow_column(geometry::opening(geometry::subtract({column}, coarsely(wide, half)), band_ / 4));
  }
  /// Hollow, but on the bed where that is to be covered.
  void narrow_column(const Regions& areas) {
    if (is_dense_foot())
      loops(areas, most_loops, Role::support);
    else
      loops(areas, 1, Role::support, true);
  }
  /// Beads beside each other are nearer to the density of the first layer than a loop around nothing.
  bool is_dense_foot() const { return layer_.first && share(0) > 0.5; }
  /// Lays the lines of what is further down, from the lowest step up.
  /// @return what is no further down than the first step, and what is too narrow for lines of others
  Regions thinned(const Regions& area, const NearSteps& near) {
    Regions left = area;
    for (std::size_t step = layer_.first ? 0 : near.size(); step > 0 && !left.empty(); --step) {
      const Regions away = near[step - 1].empty() ? left : geometry::subtract(left, near[step - 1]);
      const Regions here = laid_joined(away, step);
      if (here.empty()) continue;
      left = geometry::opening(geometry::subtract(left, here), band_ / 4);
    }
    return left;
  }
  /// Lays lines where these are joined. @return where
  Regions laid_joined(Regions area, std::size_t step) {
    const Um half = least_half(step);
    const std::size_t from = beads_.size();
    for (;;) {
      const Regions wide = wide_enough(area, step);
      if (wide.empty()) return {};
      area = geometry::intersect(area, coarsely(wide, half));
      lines_of(area, step);
      const Regions alone = shares_of_lone_lines(step, from);
      if (alone.empty()) return area;
      beads_.resize(from);
      area = geometry::subtract(area, alone);
    }
  }
  /// What lines that are joined to no other take of a column: nearer to each other they are joined.
  Regions shares_of_lone_lines(std::size_t step, std::size_t from) const {
    if (s_.support_pattern != SupportPattern::zigzag) return {};
    std::vector<Ring> rings;
    for (const Bead& bead : std::span(beads_).subspan(from))
      if (straight(bead)) rings.push_back(around(bead, rounded(usual_band_ / share(step) / 2)));
    return rings.empty() ? Regions{} : geometry::regions_from_rings(rings);
  }
  Um least_half(std::size_t step) const {
    if (step == 0)
      return is_dense_foot() ? support::narrow_roof / 2  // lines aslant across what is narrower would be dabs
                             : std::max(support::hollow_column(usual_band_, share(0)), band_);
    return support::least_half(s_.support_pattern, usual_band_, columns_.shares, step);
  }
  /// What of a column is wide enough for lines that far apart.
  Regions wide_enough(const Regions& area, std::size_t step) const {
    const Um half = least_half(step);
    // Where narrow columns meet, two or three short lines would stand alone.
    const double alone_mm = 2.5 * to_mm(support::hollow_column(usual_band_, share(step))),
                 least_mm2 = alone_mm * alone_mm;
    Regions out;
    for (const Region& region : area) {
      const Box box = box_of(region.outer);
      if (std::min(box.size().x, box.size().y) > 2 * half) support::append(out, wider({region}, half));
    }
    std::erase_if(out, [&](const Region& piece) { return area_mm2(piece) < least_mm2; });
    return out;
  }
  void lines_of(const Regions& wide, std::size_t step) {
    const double turned = step % 2 == 0 ? 0 : 90;  // so that the lines of the step above lie across
    sparse(wide, share(step), s_.support_pattern, s_.support_infill_angle + turned, Role::support);
  }

  /// What of an area is wider than twice that. Its corners may be as coarse as support is.
  static Regions wider(const Regions& area, Um by) { return coarsely(coarsely(area, -by), by); }
  static Regions coarsely(const Regions& from, Um by) {
    constexpr Um coarse = 50;
    return geometry::offset(from, {.by = by, .corner = geometry::Corner::round, .arc_tolerance = coarse});
  }
  static double radians(double degrees) { return degrees * std::numbers::pi / 180; }

  /// A line of a zigzag that is joined to no other would stand there alone, as high as its column and as thin as a
  /// bead, until the nozzle knocks it over: it goes in waves. These cross their line every so often, and so lie on it
  /// where it is still joined below; where they have no room, a loop around the line's share of the column is laid.
  /// @param from  the first bead of the column
  void bend_lone_lines(const Region& column, std::size_t step, std::size_t from) {
    const double apart = usual_band_ / share(step);
    if (s_.support_pattern != SupportPattern::zigzag || apart < 2 * band_)
      return;  // lines that near lean on each other
    const auto lone = std::stable_partition(beads_.begin() + static_cast<std::ptrdiff_t>(from), beads_.end(),
                                            [&](const Bead& b) { return !straight(b); });
    Beads lines(std::make_move_iterator(lone), std::make_move_iterator(beads_.end()));
    beads_.erase(lone, beads_.end());
    if (lines.empty()) return;
    const geometry::SegmentIndex inside(geometry::offset({column}, {.by = -band_ / 2}));
    for (Bead& line : lines) {
      const Ring share_of_column = around(line, rounded(apart / 2));
      bend(line, apart, inside);
      if (straight(line))
        loops(geometry::intersect({column}, {{share_of_column, {}}}), 1, Role::support, true);
      else
        beads_.push_back(std::move(line));
    }
  }
  /// Bends a line to waves that lie on those of other layers, as wide as two thirds of the lines' distance.
  void bend(Bead& line, double apart, const geometry::SegmentIndex& inside) const {
    Junction from = line.path.front(), to = line.path.back();
    if (to.at < from.at) std::swap(from, to);
    const double length = std::max(distance(from.at, to.at), 1.0);
    const double x = (to.at.x - from.at.x) / length, y = (to.at.y - from.at.y) / length;
    const bool is_long = length > 2 * apart;
    const double half_wave = is_long ? std::min<double>(apart, span_) : length / 2;
    const double first = is_long ? (from.at.x - origin_.x) * x + (from.at.y - origin_.y) * y : 0;  // from the origin on
    std::vector<Junction> path{from};
    for (double n = std::ceil(first / half_wave - 0.5); (n + 0.5) * half_wave < first + length; ++n) {
      const double along = (n + 0.5) * half_wave - first, aside = std::fmod(n, 2) == 0 ? apart / 3 : -apart / 3;
      Junction bent = from;
      for (const double share : {1.0, 0.5, 0.0}) {  // where a bend has no room, the line itself lies on what is below
        bent.at = from.at + Point{rounded(along * x - share * aside * y), rounded(along * y + share * aside * x)};
        if (!inside.region_at(bent.at)) continue;
        path.push_back(bent);
        break;
      }
    }
    path.push_back(to);
    line.path = std::move(path);
  }
  /// Whether no bend of a bead leaves its chord by more than a bead: seen along it, it is as thin as one.
  bool straight(const Bead& bead) const {
    const Point a = bead.path.front().at, b = bead.path.back().at;
    return !bead.closed && std::all_of(bead.path.begin(), bead.path.end(), [&](const auto& place) {
      return geometry::foot_of(place.at, {a, b}).distance_um <= static_cast<double>(band_);
    });
  }
  /// The rectangle of all that is no further from a bead's chord than that, along it or beside.
  static Ring around(const Bead& bead, Um by) {
    const Point a = bead.path.front().at, b = bead.path.back().at;
    const double length = std::max(distance(a, b), 1.0);
    const Point on{rounded((b.x - a.x) / length * by), rounded((b.y - a.y) / length * by)}, beside{-on.y, on.x};
    return {a - on - beside, b + on - beside, b + on + beside, a - on + beside};
  }

  double share(std::size_t step) const {
    return layer_.first ? s_.support_initial_layer_density / 100 : columns_.shares[step];
  }
  /// Hollow, or nearly: loops, two around thick ones, and what support_tree_infill_rate puts inside.
  void branches() {
    const double double_mm = to_mm(s_.support_tree_branch_diameter_double_wall);
    const double thick_mm2 = double_mm > 0 ? std::numbers::pi / 4 * double_mm * double_mm : 1e9;
    for (const Region& branch : layer_.branches) {
      const int usual = area_mm2(branch) > thick_mm2 ? 2 : 1;
      const Regions inside =
          loops({branch}, s_.support_wall_count.value_or(usual), Role::support, s_.support_tree_infill_rate <= 0);
      sparse(inside, s_.support_tree_infill_rate / 100, s_.support_pattern, s_.support_infill_angle, Role::support);
    }
  }

  /// The direction across columns' lines.
  double across() const { return s_.support_infill_angle + 90; }
  /// Of beads from that one on.
  void note_hanging(std::size_t from) {
    if (below_->empty()) return;
    const auto hanging = below_->hanging(laid(from), span_);
    hang_at_.insert(hang_at_.end(), hanging.at.begin(), hanging.at.end());
  }
  void interface(const Regions& areas, double angle) {
    const double share = s_.support_interface_density / 100;
    const Regions inner = loops(areas, s_.support_roof_wall_count, Role::support_interface);
    if (share < dense) {
      sparse(inner, share, s_.support_interface_pattern, angle, Role::support_interface);
      return;
    }
    constexpr Um half = support::narrow_roof / 2;
    for (const Region& area : inner) {
      const Box box = box_of(area.outer);
      const Regions wide = std::min(box.size().x, box.size().y) > 2 * half ? wider({area}, half) : Regions{};
      if (wide.empty()) {
        narrow({area});
        continue;
      }
      const Regions reached = coarsely(wide, half / 2);
      const std::size_t from = beads_.size();
      solid(geometry::intersect({area}, reached), angle, Role::support_interface,
            row_of(pattern_rows, s_.support_interface_pattern).connect);
      note_hanging(from);
      narrow(geometry::opening(geometry::subtract({area}, reached), band_ / 4));
    }
  }
  /// Strands from rim to rim of what is that narrow lie on little, beads along it cross what is below; but where many
  /// of these hang, as between two lines, strands across these lie on them every so often.
  void narrow(const Regions& areas) {
    for (const Region& area : areas) {
      stop_if_asked();
      const std::size_t from = beads_.size();
      loops({area}, most_loops, Role::support_interface);
      if (below_->empty()) continue;
      const auto hanging = better_across(area, from, below_->hanging(laid(from), narrow_span_));
      hang_at_.insert(hang_at_.end(), hanging.at.begin(), hanging.at.end());
    }
  }
  std::span<const Bead> laid(std::size_t from) const { return std::span(beads_).subspan(from); }
  /// @param from  the first of the beads along it, of which so much hangs
  /// @return what hangs of those that were chosen
  Hanging better_across(const Region& area, std::size_t from, Hanging of_along) {
    constexpr double many = 0.3;
    const auto begin = static_cast<std::ptrdiff_t>(from);
    if (of_along.um < narrow_span_ || of_along.um < many * length_um(laid(from))) return of_along;
    Beads along(std::make_move_iterator(beads_.begin() + begin), std::make_move_iterator(beads_.end()));
    beads_.erase(beads_.begin() + begin, beads_.end());
    for (const double angle : {s_.support_infill_angle, across()}) {
      solid({area}, angle, Role::support_interface);
      Hanging of_across = below_->hanging(laid(from), narrow_span_);
      if (2 * of_across.um < of_along.um) return of_across;
      beads_.erase(beads_.begin() + begin, beads_.end());
    }
    std::move(along.begin(), along.end(), std::back_inserter(beads_));
    return of_along;
  }
  static double length_um(std::span<const Bead> beads) {
    double mm = 0;
    for (const Bead& bead : beads) mm += length_mm(bead);
    return mm * 1000;
  }

  /// Rims, and lines from branch to branch.
  void joists() {
    loops(layer_.joists.rimmed, 1, Role::support, true);
    joists(layer_.joists.lines, 0);
    joists(layer_.joists.after, 1);
  }
  void joists(const std::vector<Polyline>& lines, std::uint32_t sequence) {
    for (const Polyline& line : lines) {
      Bead bead;
      bead.role = Role::support, bead.sequence = sequence;
      for (Point p : line) bead.path.push_back({p, band_, 1.F});
      beads_.push_back(std::move(bead));
    }
  }

  /// Loops along the edge, from outside in; what is too thin for one gets a bead along its middle.
  /// @param hollow  nobody asks for what is left inside
  /// @return what is left inside
  Regions loops(const Regions& areas, int count, Role role, bool hollow = false) {
    Regions left = areas;
    for (int n = 0; n < count && !left.empty(); ++n) {
      stop_if_asked();
      Regions next;
      for (const Region& region : left)
        for (Region& inside : loops_of(region, n, role, hollow && n + 1 == count)) next.push_back(std::move(inside));
      left = std::move(next);
    }
    return left;
  }
  Regions loops_of(const Region& region, int inset, Role role, bool hollow) {
    if (region.holes.empty())  // most branches: nothing of them is thin
      if (auto middle = geometry::inset_of_convex(region.outer, band_ / 2)) {
        loop(*middle, inset, role);
        if (hollow) return {};
        if (auto inside = geometry::inset_of_convex(region.outer, band_)) return {{*std::move(inside), {}}};
        return geometry::offset({{*std::move(middle), {}}}, {.by = -band_ / 2});
      }
    const Regions middle = geometry::offset({region}, {.by = -band_ / 2});
    for (const Region& part : middle) {
      loop(part.outer, inset, role);
      for (const Ring& hole : part.holes) loop(hole, inset, role);
    }
    if (reaches_further(region, middle, band_ * 8 / 10)) {  // than corners do
      const Regions laid = geometry::offset(middle, {.by = band_ / 2 + 10});
      solid(geometry::opening(geometry::subtract({region}, laid), band_ / 5), 0, role);
    }
    return hollow ? Regions{} : geometry::offset(middle, {.by = -band_ / 2});
  }
  void loop(const Ring& ring, int inset, Role role) {
    Bead bead;
    bead.role = role, bead.closed = true, bead.inset = static_cast<std::uint16_t>(inset);
    for (Point p : geometry::simplified(ring, support::outline_bound)) bead.path.push_back({p, band_, 1.F});
    beads_.push_back(std::move(bead));
  }

  void sparse(const Regions& areas, double share, SupportPattern pattern, double angle, Role role) {
    if (share <= 0 || areas.empty()) return;
    const auto& row = row_of(pattern_rows, pattern);
    if (share >= dense) return solid(areas, angle, role, row.connect);
    const std::size_t from = beads_.size();
    const infill::SparseStyle style{.pattern = row.as,
                                    .density = share * band_ / usual_band_,
                                    .band = band_,
                                    .angle_rad = radians(angle),
                                    .overlap = {0},
                                    .connect = row.connect,
                                    .z = layer_.z,
                                    .origin = origin_,
                                    .even = false,
                                    .alone = true};
    // A bead's end is round and reaches half its width further than its path.
    for (const Region& region : geometry::offset(areas, {.by = -band_ / 2})) {
      stop_if_asked();
      infill::fill_sparse(region, style, beads_);
    }
    call(from, role);
  }
  void solid(const Regions& areas, double angle, Role role, bool connect = true) {
    const std::size_t from = beads_.size();
    for (const Region& region : areas) {
      stop_if_asked();
      infill::fill_solid(
          region,
          {.role = Role::solid_infill,
           .band = band_,
           .angle_rad = radians(angle),
           .overlap = {0},
           .connect = connect,
           .origin = origin_,
           .turned = false,
           .ends_within = true,  // they are round, and what they stood out would be off the gap to the part
           .ordered = false},
          beads_);
    }
    call(from, role);
  }
  void call(std::size_t from, Role role) {
    for (std::size_t i = from; i < beads_.size(); ++i) beads_[i].role = role;
  }

  const SupportSettings& s_;
  const support::SupportLayer& layer_;
  Point origin_;
  Um line_;
  Um span_;         ///< what a bead crosses without sagging
  Um narrow_span_;  ///< … one of a narrow roof
  Um between_feet_, band_;
  ColumnShares columns_;
  Um usual_band_;  ///< at layer_height: what shares are of, so that lines of layers of any height lie on each other
  const LayerPlastic* below_ = nullptr;
  Beads beads_;
  std::vector<Point> hang_at_;
};

}  // namespace

Beads fill_column(const SupportToFill& what, const Region& column, const NearSteps& near) {
  return Filler(what).column(column, near);
}

Beads fill_walled_columns(const SupportToFill& what, const NearSteps& near) {
  return Filler(what).walled(near);
}

Beads fill_under_roof(const SupportToFill& what) {
  return Filler(what).under_roof();
}

SupportBeads fill_support_layer(const SupportToFill& what, Beads columns, const BesideLayer& beside) {
  return Filler(what).filled(std::move(columns), beside);
}

}  // namespace weft::pipeline
