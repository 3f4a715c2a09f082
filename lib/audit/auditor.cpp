// SPDX-License-Identifier: GPL-3.0-or-later
#include "audit/auditor.h"

#include "core/stop.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft::audit {
namespace {

Vec vec_of(Point p) {
  return {to_mm(p.x), to_mm(p.y)};
}

Shape surface_of(const MachineSettings& machine) {
  if (machine.bed_shape != BedShape::circle) return Shape::polygon(print_surface(machine));
  const double radius_mm = to_mm(machine.machine_width) / 2;
  return Shape::disc(machine.machine_center_is_zero ? Vec{} : Vec{radius_mm, radius_mm}, radius_mm);
}

std::optional<Vec> point_of(const std::optional<Ring>& point) {
  if (!point || point->empty()) return std::nullopt;
  return vec_of(point->front());
}

std::optional<double> height_of(const std::optional<Um>& height) {
  return height ? std::optional(to_mm(*height)) : std::nullopt;
}

std::array<Um, 6> beyond(const MachineSettings& machine, const Bounds& surface, const Bounds& reach) {
  const auto um = [](double mm) { return static_cast<Um>(std::lround(std::max(0.0, mm) * 1000)); };
  return {um(surface.min.x - reach.min.x),         um(reach.max.x - surface.max.x),
          um(surface.min.y - reach.min.y),         um(reach.max.y - surface.max.y),
          um(-to_mm(machine.machine_reach_z_min)), um(to_mm(reach_z_max(machine) - machine.machine_height))};
}

Reader::Machine reader_machine(const MachineSettings& machine) {
  return {.home = point_of(machine.home_position),
          .home_z = height_of(machine.home_z),
          .after_macro = point_of(machine.macro_position),
          .after_macro_z = height_of(machine.macro_z),
          .firmware = machine.firmware};
}

constexpr double by_hand_mm = 0.6;  // width of what custom G-code lays, about
// Slicers write lengths and heights to 3 decimals: what two of them tell is known to so much.
constexpr double length_rounding_mm = 2e-3;

double disc_area_mm2(Um diameter) {
  return std::numbers::pi * to_mm(diameter) * to_mm(diameter) / 4;
}

/// A bead of stated width is a rectangle with half-round ends, or round where it is narrower than high; its band is the
/// rectangle of the same height and volume. Source: Slic3r manual, "flow math".
double band_mm(double width_mm, double height_mm) {
  constexpr double quarter_pi = std::numbers::pi / 4;
  return width_mm >= height_mm ? width_mm - height_mm * (1 - quarter_pi) : quarter_pi * width_mm * width_mm / height_mm;
}

}  // namespace

std::optional<Point> place_after(const MachineSettings& machine, std::string_view gcode) {
  Reader reader(reader_machine(machine));
  Lines lines;
  const auto read = [&](const Lines::Line& l) { reader.line(l.begin, l.end); };
  lines.feed(gcode, read);
  lines.finish(read);
  const auto place = reader.place();
  return place ? std::optional(Point{from_mm(place->x), from_mm(place->y)}) : std::nullopt;
}

Volumes::Volumes(const MachineSettings& machine, const AuditSettings& audit)
    : surface(surface_of(machine)),
      reach(machine.machine_reach.empty() ? surface : Shape::polygon(reach_area(machine))),
      reach_is_box(reach.box()),
      reach_is_convex(reach.convex()),
      reach_z_min_mm(to_mm(machine.machine_reach_z_min)),
      reach_z_max_mm(to_mm(reach_z_max(machine))),
      no_go_below_mm(to_mm(exclude_height(machine))),
      tolerance_mm(to_mm(audit.audit_tolerance)),
      reach_beyond(beyond(machine, surface.bounds(), reach.bounds())),
      surface_inside(surface.inner_box()),
      reach_inside(reach.inner_box()) {
  for (const Ring& ring : machine.bed_exclude_areas) no_go.push_back(Shape::polygon(ring));
  for (const Point p : machine.nozzle_offsets) nozzle_offsets.push_back(vec_of(p));
}

Auditor::Auditor(const MachineSettings& machine, const MaterialSettings& material, const AuditSettings& audit,
                 const PlateSettings& plate, bool keep_marks)
    : volumes_(machine, audit),
      filament_area_mm2_(disc_area_mm2(material.filament_diameter)),
      reader_(reader_machine(machine)),
      tally_(audit.audit_max_findings, volumes_.tolerance_mm, keep_marks),
      owners_(to_mm(plate.conflict_tolerance)),
      unmarked_(audit.audit_max_findings, volumes_.tolerance_mm, keep_marks) {
  const auto slabs = head_of(plate, machine);
  if (slabs.empty()) return;
  Bounds area = volumes_.surface.bounds();
  area.add(volumes_.reach.bounds().min), area.add(volumes_.reach.bounds().max);
  head_.emplace(slabs, area, to_mm(machine.nozzle_diameter));
}

void Auditor::feed(std::string_view bytes) {
  StopNowAndThen stop(256);
  lines_.feed(bytes, [&](const Lines::Line& l) {
    stop.step();
    line(l);
  });
}

Report Auditor::finish() {
  lines_.finish([&](const Lines::Line& l) { line(l); });
  const bool unmarked = !reader_.context().began();
  if (unmarked) {
    tally_.merge(std::move(unmarked_));
    for (std::size_t i = 0; i < unmarked_by_cause_.size(); ++i) {
      unaudited_by_cause_.resize(std::max(unaudited_by_cause_.size(), i + 1));
      unaudited_by_cause_[i] += unmarked_by_cause_[i];
      unaudited_ += unmarked_by_cause_[i];
      checked_ -= unmarked_by_cause_[i];
    }
  }
  Report report;
  tally_.report(report);
  report.checked_moves = checked_;
  report.unaudited_moves = unaudited_;
  report_unaudited(report);
  report.opaque.assign(reader_.opaque().begin(), reader_.opaque().end());
  report.opaque_count = reader_.opaque_count();
  report.lines = reader_.line_number();
  report.reach_beyond = volumes_.reach_beyond;
  report.bytes = lines_.bytes();
  report.tolerance = static_cast<Um>(std::lround(volumes_.tolerance_mm * 1000));
  report.conflicts = owners_.conflicts();
  for (auto& conflict : report.conflicts) conflict.blocks = conflict.blocks && !reader_.context().labels_meshes();
  report.labelled = owners_.labelled();
  report.verdict = report.violation_count > 0 || report.blocking() != nullptr ? Verdict::rejected
                   : report.clean()                                           ? Verdict::pass
                                                                              : Verdict::unaudited;
  if (!report.empty() && unmarked)
    report.notices.push_back(
        {"audit_no_features",
         "no comment tells the print from custom G-code: every extrusion was held against the print surface"});
  return report;
}

void Auditor::line(const Lines::Line& l) {
  const std::string_view text(l.begin, static_cast<std::size_t>(l.end - l.begin));
  const auto place = [&] {
    const Context& context = reader_.context();
    return Place{context, context.custom() ? "custom" : context.feature(), reader_.line_number(), l.offset, text};
  };
  const auto damaged = [&](std::string_view problem) {
    Violation v;
    v.kind = Finding::Kind::damaged;
    v.excess.mm = 0;
    v.problem = problem;
    tally_.add(v, place());
  };
  if (l.cut) {
    reader_.skip_line();
    if (const auto front = text.find_first_not_of(" \t"); front == std::string_view::npos || text[front] != ';')
      damaged("a line of over a megabyte");
    return;
  }
  reader_.line(l.begin, l.end);
  line_offset_ = l.offset;
  if (reader_.motions().empty() && reader_.problems().empty()) return;
  violation_.excess.mm = surface_violation_.excess.mm = 0;
  for (const Motion& m : reader_.motions()) judge(m);
  if (violation_.excess.mm > 0)
    tally_.add(violation_, place());
  else if (!reader_.problems().empty())
    damaged(reader_.problems().front().what);
  else if (surface_violation_.excess.mm > 0)
    unmarked_.add(surface_violation_, {reader_.context(), {}, reader_.line_number(), l.offset, text});
}

void Auditor::judge(const Motion& m) {
  if (!m.continues) count(m);
  const bool known = m.from_known && m.x_known && m.y_known;
  if (m.x_known && m.y_known) {
    judge_reach(m);
    const bool printing = m.extrudes && known && (!reader_.context().custom() || !reader_.context().began());
    const double margin_mm = printing ? half_bead_mm(m) : 0;
    if (printing) judge_surface(m, margin_mm);
    if (head_) judge_head(m);
    if (printing) lay(m, margin_mm);
    if (head_ && m.extrudes && known && !printing && m.z_known) head_->lay(m.path, {}, by_hand_mm / 2, m.z_to);
    if (!volumes_.no_go.empty()) judge_no_go(m, reader_.context().custom() ? 0 : margin_mm);
  } else {
    judge_half_known(m);
  }
  if (m.z_known) judge_height(m);
}

/// The motion is judged by its whole extent, or counted with what kept it from being.
void Auditor::count(const Motion& m) {
  const Context& context = reader_.context();
  const bool known = m.from_known && m.x_known && m.y_known && m.judgeable && !(m.moves_z && m.z == Known::no);
  const bool laid = m.extrudes && context.began() && !context.custom();
  if (known || can_be_judged(m, laid)) {
    ++checked_;
    if (known || !m.extrudes || context.began()) return;
    const auto cause = static_cast<std::size_t>(std::max<int>(m.cause, 0));
    unmarked_by_cause_.resize(std::max(unmarked_by_cause_.size(), cause + 1));
    ++unmarked_by_cause_[cause];
    return;
  }
  ++unaudited_;
  const auto cause = static_cast<std::size_t>(std::max<int>(m.cause, 0));
  unaudited_by_cause_.resize(std::max(unaudited_by_cause_.size(), cause + 1));
  if (unaudited_by_cause_[cause]++ == 0)
    tally_.mark(
        {line_offset_, reader_.line_number(), "; WEFT-AUDIT not audited: " + describe(reader_.causes()[cause])});
}

/// Can a motion from a place that is not known be judged, taken to start anywhere in the reach? Every segment between
/// two places of a convex reach stays in it; a bead and what may meet a no-go area need their start.
bool Auditor::can_be_judged(const Motion& m, bool laid) const {
  if (!m.judgeable || (m.moves_z && m.z == Known::no)) return false;
  if (!m.moves_xy) return true;  // straight up or down
  if (m.from == Known::no || m.x == Known::no || m.y == Known::no || m.path.arc || laid) return false;
  if (!volumes_.no_go.empty() && below_no_go(m)) return false;
  return m.x_known && m.y_known ? volumes_.reach_is_convex : volumes_.reach_is_box;
}

/// Where Z is not known the nozzle is taken to be low, as it is after homing.
bool Auditor::below_no_go(const Motion& m) const {
  return !m.z_known || std::min(m.z_from, m.z_to) < volumes_.no_go_below_mm;
}

void Auditor::report_unaudited(Report& report) const {
  for (std::size_t i = 0; i < unaudited_by_cause_.size(); ++i)
    if (unaudited_by_cause_[i] > 0) report.unaudited.push_back({reader_.causes()[i], unaudited_by_cause_[i]});
  std::stable_sort(report.unaudited.begin(), report.unaudited.end(),
                   [](const Unaudited& a, const Unaudited& b) { return a.cause.line < b.cause.line; });
}

void Auditor::offer(Violation& worst, Finding::Kind kind, const Motion& m, const Excess& excess, int area) {
  if (excess.mm <= volumes_.tolerance_mm || excess.mm <= worst.excess.mm) return;
  worst = {.kind = kind, .move = m.kind, .excess = excess, .z_mm = m.z_to, .area = area};
}

void Auditor::judge_reach(const Motion& m) {
  const Bounds& inside = volumes_.reach_inside;
  if (!m.path.arc && inside.holds(m.path.from, 0) && inside.holds(m.path.to, 0)) return;
  Path path = m.path;
  if (m.from_home && !path.arc) {  // homing switches may stand outside; the way in from there is the machine's
    if (!m.moves_xy) return;
    path = volumes_.reach.from_inside(path);
  }
  offer(violation_, Finding::Kind::reach, m, volumes_.reach.leaving(path, 0));
}

void Auditor::judge_surface(const Motion& m, double margin_mm) {
  const Bounds& inside = volumes_.surface_inside;
  Path path = m.path;
  if (!volumes_.nozzle_offsets.empty()) {
    const Vec offset = volumes_.nozzle_offset(m.tool);
    path.from = path.from + offset, path.to = path.to + offset, path.centre = path.centre + offset;
  }
  if (!path.arc && inside.holds(path.from, margin_mm) && inside.holds(path.to, margin_mm)) return;
  // Until a comment tells where the print begins, what may yet turn out to be start G-code is set aside.
  offer(reader_.context().began() ? violation_ : surface_violation_, Finding::Kind::surface, m,
        volumes_.surface.leaving(path, margin_mm));
}

void Auditor::judge_no_go(const Motion& m, double margin_mm) {
  if (!below_no_go(m)) return;
  for (std::size_t i = 0; i < volumes_.no_go.size(); ++i)
    offer(violation_, Finding::Kind::no_go, m, volumes_.no_go[i].entering(m.path, margin_mm), static_cast<int>(i) + 1);
}

void Auditor::judge_height(const Motion& m) {
  const double above = m.z_to - volumes_.reach_z_max_mm, below = volumes_.reach_z_min_mm - m.z_to;
  Excess e;
  e.mm = std::max(above, below);
  e.side = above > below ? Side::plus_z : Side::minus_z;
  e.at = m.path.to;
  offer(violation_, Finding::Kind::reach, m, e);
}

/// Only X or only Y is known: the motion is outside wherever the other is when the one lies beyond the reach
/// altogether.
void Auditor::judge_half_known(const Motion& m) {
  const Bounds& reach = volumes_.reach.bounds();
  const auto beyond = [&](double mm, Side side) {
    Excess e;
    e.mm = mm, e.side = side, e.at = m.path.to;
    e.by_side[static_cast<std::size_t>(side)] = mm;
    offer(violation_, Finding::Kind::reach, m, e);
  };
  if (m.x_known) beyond(reach.min.x - m.path.to.x, Side::minus_x), beyond(m.path.to.x - reach.max.x, Side::plus_x);
  if (m.y_known) beyond(reach.min.y - m.path.to.y, Side::minus_y), beyond(m.path.to.y - reach.max.y, Side::plus_y);
}

/// Of what the motion lays, as far as it is known.
double Auditor::bead_height_mm() const {
  const double said = reader_.context().height_mm();
  return said > 0 ? said : layer_height_mm_;
}

/// The nozzle passes beads of the layer that it prints, lower ones beside higher ones; the rest of what stands must not
/// meet the head.
void Auditor::judge_head(const Motion& m) {
  if (!m.z_known) return;
  if (const int layer = reader_.context().layer(); layer != head_layer_) head_layer_ = layer, highest_bead_mm_ = 0;
  highest_bead_mm_ = std::max(highest_bead_mm_, bead_height_mm());
  const double passes_mm = std::max(volumes_.tolerance_mm, highest_bead_mm_ + length_rounding_mm);
  const auto met = head_->meets(m.path, m.z_from, m.z_to, passes_mm);
  if (!met || met->depth_mm <= violation_.excess.mm) return;
  violation_ = {.kind = Finding::Kind::head, .move = m.kind, .excess = {}, .z_mm = m.z_to};
  violation_.excess.mm = met->depth_mm, violation_.excess.at = met->nozzle;
  violation_.above_tip_mm = met->head_from_mm, violation_.met = met->at;
}

/// Remembers a bead: how high plastic stands there, and whose it is.
void Auditor::lay(const Motion& m, double half_width_mm) {
  if (!m.z_known) return;
  const Context& context = reader_.context();
  const Vec offset = volumes_.nozzle_offset(m.tool);
  if (head_) head_->lay(m.path, offset, half_width_mm, m.z_to);
  if (!context.custom())
    owners_.lay(context.owner(), context.feature(), m.path, offset, half_width_mm, m.z_to, bead_height_mm(),
                context.layer());
}

/// Half the width of the bead that the motion lays: of the band of equal volume, by the width that the slicer states,
/// else by what the filament spreads to at least.
double Auditor::half_bead_mm(const Motion& m) {
  const Context& context = reader_.context();
  constexpr double thickest_layer_mm = 3;
  if (m.z_known && m.z_to != layer_z_mm_) {
    if (const double step = m.z_to - layer_z_mm_; step > 0 && step < thickest_layer_mm) layer_height_mm_ = step;
    layer_z_mm_ = m.z_to;
  }
  const double width_mm = context.width_mm();
  const double height_mm = bead_height_mm();
  if (height_mm <= 0) return width_mm / 2;
  if (width_mm > 0) return band_mm(width_mm, height_mm) / 2;
  // E is written to 5 decimals: on very short moves rounding alone would fake a wide bead.
  constexpr double e_rounding_mm = 1e-5, widest_mm = 10;
  const double volume_mm3 = m.volumetric ? m.e_mm : (m.e_mm - e_rounding_mm) * filament_area_mm2_;
  return std::clamp(volume_mm3 / ((length_mm(m.path) + length_rounding_mm) * height_mm), 0.0, widest_mm) / 2;
}

}  // namespace weft::audit
