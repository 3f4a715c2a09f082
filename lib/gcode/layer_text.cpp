// SPDX-License-Identifier: GPL-3.0-or-later
#include "gcode/layer_text.h"

#include "core/stop.h"
#include "gcode/custom_code.h"
#include "model/flow.h"
#include "model/moves.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace weft::gcode {
namespace {

/// Widths in comments differ at least by this: a viewer's eye sees no less, and the audit, which judges by them how far
/// a bead reaches, is off by a quarter of it at most on average and half in the worst case.
constexpr Um width_step = 20;

/// E in units of its last decimal.
constexpr double units_per_mm = 1e5;

std::int64_t nearest(double v) {
  return static_cast<std::int64_t>(v < 0 ? v - 0.5 : v + 0.5);
}

std::size_t expected_bytes(const LayerPlan& plan) {
  std::size_t n = 512;
  for (const auto& step : plan.steps) {
    n += 64;
    // "G1 X123.456 Y123.456 E.12345", and now and then F
    if (const auto* bead = std::get_if<Extrude>(&step)) n += 30 * bead->path.size();
  }
  return n;
}

/// What is extruded between two junctions, as it lies there: a strand over air is round, sparse infill printed for
/// several layers is as high as they are, and a bead of less flow is as much narrower.
struct Size {
  Um width, height;
};
Size size_of(const Extrude& bead, std::size_t from, std::size_t to) {
  const Junction &a = bead.path[from], &b = bead.path[to];
  const double flow = (static_cast<double>(a.flow) + static_cast<double>(b.flow)) / 2;
  const double band = (a.width + b.width) / 2.0;
  if (bead.follows_surface) {
    const Um exact = bead.height - (bead.below[from] + bead.below[to]) / 2;
    const Um height = std::max((exact + width_step / 2) / width_step, 1) * width_step;
    return {flow::line_width(rounded(band * flow * bead.height / exact), height), height};
  }
  if (bead.role == Role::bridge) {
    const Um diameter = rounded(std::sqrt(4 / std::numbers::pi * band * flow * bead.height));
    return {diameter, diameter};
  }
  const bool higher = bead.role == Role::infill || bead.role == Role::wipe_tower;
  const Um height = higher && flow > 1 ? rounded(bead.height * flow) : bead.height;
  return {flow::line_width(rounded(band * flow * bead.height / height), height), height};
}

/// About how long a step takes: at its speed, all along.
double seconds_at_speed(const Step& step) {
  double s = 0;
  if (const auto* bead = std::get_if<Extrude>(&step))
    for (std::size_t i = 1; i < bead->path.size(); ++i) {
      const double mm_s =
          bead->segment_speed_mm_s.empty() ? bead->speed_mm_s : static_cast<double>(bead->segment_speed_mm_s[i - 1]);
      s += distance(bead->path[i - 1].at, bead->path[i].at) / 1000 / std::max(mm_s, 1e-3);
    }
  if (const auto* travel = std::get_if<Travel>(&step))
    for (std::size_t i = 1; i < travel->path.size(); ++i)
      s += distance(flat(travel->path[i - 1]), flat(travel->path[i])) / 1000 / std::max(travel->speed_mm_s, 1e-3);
  return s;
}

class LayerText {
 public:
  explicit LayerText(const LayerJob& job) : job_(job), state_(job.entry), out_(expected_bytes(job.plan)) {
    writes_e_ = job.settings.gcode.write_extrusion;
    use(state_.tool);
  }

  std::string all() && {
    head();
    bool arrived = job_.after_layer.empty();
    StopNowAndThen stop(16);
    for (const auto& step : job_.plan.steps) {
      stop.step();
      if (!arrived && std::holds_alternative<Extrude>(step)) {
        custom(job_.after_layer);
        arrived = true;
      }
      std::visit([&](const auto& s) { print(s); }, step);
      if (!job_.timed.empty()) say_timed(seconds_at_speed(step));
    }
    if (job_.comments.dialect == CommentDialect::cura)
      out_ << ";TIME_ELAPSED:" << fmt::format("{:.6f}", job_.end_s) << '\n';
    return std::move(out_).take();
  }

 private:
  /// The tool's filament, and where its nozzle stands.
  void use(ToolId tool) {
    of_tool_ = tool < job_.tools.size() ? &job_.tools[tool] : &job_.settings;
    const auto& offsets = job_.settings.machine.nozzle_offsets;
    offset_ = !job_.tools.empty() && tool < offsets.size() ? offsets[tool] : Point{};
    const auto& material = of_tool_->material;
    const double diameter_mm = to_mm(material.filament_diameter);
    const bool volumetric = job_.settings.gcode.volumetric_extrusion;
    const double area_mm2 = std::numbers::pi / 4 * diameter_mm * diameter_mm;
    e_per_mm3_ = material.material_flow / 100.0 / (volumetric ? 1 : area_mm2) * units_per_mm;
    e_per_mm_ = (volumetric ? area_mm2 : 1) * units_per_mm;
  }

  /// What is due when a step is done that takes so long.
  void say_timed(double seconds) {
    if (all_s_ == 0)
      for (const auto& step : job_.plan.steps) all_s_ += seconds_at_speed(step);
    done_s_ += seconds;
    for (; timed_ < job_.timed.size() && job_.timed[timed_].share * all_s_ <= done_s_; ++timed_)
      out_ << job_.timed[timed_].text;
  }

  void head() {
    height_ = job_.plan.height;
    job_.comments.layer(out_, job_.index, job_.plan.z, job_.plan.height,
                        job_.before_layer.find(";BEFORE_LAYER_CHANGE") != std::string_view::npos);
    out_ << job_.preamble;
    if (!job_.settings.gcode.relative_extrusion && writes_e_) out_ << "G92 E0\n";
    custom(job_.before_layer);
  }

  void custom(std::string_view code) {
    if (code.empty()) return;
    job_.comments.custom(out_);
    out_ << code;
    if (code.back() != '\n') out_ << '\n';
    role_ = -1;
    feed_ = 0;
    state_.print_acceleration = state_.travel_acceleration = 0;
  }

  void accelerate(double mm_s2, bool travel) {
    if (mm_s2 <= 0) return;
    const bool own = travel && job_.dialect.separate_travel_acceleration();
    double& now = own ? state_.travel_acceleration : state_.print_acceleration;
    if (now == mm_s2) return;
    now = mm_s2;
    if (travel)
      job_.dialect.travel_acceleration(out_, std::llround(mm_s2));
    else
      job_.dialect.print_acceleration(out_, std::llround(mm_s2));
  }

  /// X, Y and Z as far as they change.
  bool axes(Point3 to) {
    const auto& at = state_.at;
    if (at == to) return false;
    if (!at || at->x != to.x) (out_ << " X").length(to.x - offset_.x);
    if (!at || at->y != to.y) (out_ << " Y").length(to.y - offset_.y);
    if (!at || at->z != to.z) (out_ << " Z").length(to.z);
    return true;
  }

  void feed(double speed_mm_s) {
    const auto f = feed_of(speed_mm_s);
    if (f == feed_) return;
    feed_ = f;
    out_ << " F" << f;
  }

  /// E for what is wanted in sum so far.
  void filament(double units) {
    if (!writes_e_) return;
    e_wanted_ += units;
    const std::int64_t step = nearest(e_wanted_) - e_written_;
    if (step == 0) return;
    e_written_ += step;
    (out_ << " E").filament(job_.settings.gcode.relative_extrusion ? step : e_written_);
  }

  void travel_to(Point3 to, double speed_mm_s) {
    if (state_.at == to) return;
    out_ << "G0";
    axes(to);
    feed(speed_mm_s);
    out_ << '\n';
    state_.at = to;
  }

  void print(const Extrude& bead) {
    if (bead.path.size() < 2) return;
    release();
    travel_to(place_of(bead, 0, job_.plan.z), job_.settings.speeds.speed_travel);
    if (role_ != static_cast<int>(bead.role)) {
      role_ = static_cast<int>(bead.role);
      job_.comments.feature(out_, bead.role);
    }
    accelerate(bead.acceleration_mm_s2, false);
    const bool varies = !bead.segment_speed_mm_s.empty(), flow_comments = job_.settings.gcode.gcode_flow_comments;
    const auto speed = [&](std::size_t piece) {
      return varies ? static_cast<double>(bead.segment_speed_mm_s[piece - 1]) : bead.speed_mm_s;
    };
    const auto line = [&](const BeadMove& move) {
      const auto &a = bead.path[move.piece - 1], &b = bead.path[move.piece];
      if (job_.comments.says_sizes()) sizes(size_of(bead, move.piece - 1, move.piece));
      out_ << "G1";
      const Point3 to = place_of(bead, move.to, job_.plan.z);
      axes(to);
      filament(move.volume_mm3 * e_per_mm3_);
      feed(speed(move.piece));
      if (flow_comments && (a.flow != 1.F || b.flow != 1.F)) {
        out_ << " ; flow ";
        out_.spelled(rounded(500.0 * static_cast<double>(a.flow + b.flow)));
      }
      out_ << '\n';
      state_.at = to;
    };
    for_each_move(bead, line,
                  [&](const Arc& arc, double volume_mm3) { curve(bead, arc, volume_mm3, speed(arc.last)); });
  }

  /// Both axes are said, and the centre from where it begins: what every firmware reads.
  void curve(const Extrude& bead, const Arc& arc, double volume_mm3, double speed_mm_s) {
    const auto &a = bead.path[arc.first], &b = bead.path[arc.last];
    if (job_.comments.says_sizes()) sizes(size_of(bead, arc.first, arc.last));
    const Point from_centre = arc.centre - a.at;
    ((out_ << (arc.ccw ? "G3 X" : "G2 X")).length(b.at.x - offset_.x) << " Y").length(b.at.y - offset_.y);
    ((out_ << " I").length(from_centre.x) << " J").length(from_centre.y);
    filament(volume_mm3 * e_per_mm3_);
    feed(speed_mm_s);
    out_ << '\n';
    state_.at = place_of(bead, arc.last, job_.plan.z);
  }

  /// Where it changes by more than a viewer sees.
  void sizes(Size size) {
    if (size.height != height_) (out_ << ";HEIGHT:").spelled(height_ = size.height) << '\n';
    if (std::abs(size.width - width_) < width_step) return;
    (out_ << ";WIDTH:").spelled(width_ = size.width) << '\n';
  }

  void print(const Travel& travel) {
    if (travel.path.empty()) return;
    accelerate(travel.acceleration_mm_s2, true);
    if (!state_.at) return first(travel);
    for (const Point3 to : travel.path)
      travel_to(to, state_.at ? speed_between(travel, *state_.at, to) : travel.speed_mm_s);
  }

  /// From where start G-code left the nozzle: up before it goes across the bed, and down when it is there. From an
  /// unknown height Z comes first too: what is too low does harm on the way.
  void first(const Travel& travel) {
    const Um z = travel.path.front().z;
    const auto go_to_z = [&](Um to) {
      (out_ << "G0 Z").length(to);
      feed(travel.z_speed_mm_s > 0 ? travel.z_speed_mm_s : travel.speed_mm_s);
      out_ << '\n';
    };
    const bool down = state_.z && *state_.z > z;
    if (!down && state_.z != z) go_to_z(z);
    for (const Point3 to : travel.path) {
      if (state_.at) {
        travel_to(down ? Point3{to.x, to.y, *state_.z} : to, speed_between(travel, *state_.at, to));
        continue;
      }
      ((out_ << "G0 X").length(to.x - offset_.x) << " Y").length(to.y - offset_.y);
      feed(travel.speed_mm_s);
      out_ << '\n';
      state_.at = {to.x, to.y, down ? *state_.z : z};
    }
    if (down) go_to_z(travel.path.back().z);
    state_.at = travel.path.back();
  }

  void extruder_only(double units, double speed_mm_s) {
    if (!writes_e_) return;
    if (nearest(e_wanted_ + units) == e_written_) return void(e_wanted_ += units);
    out_ << "G1";
    filament(units);
    feed(speed_mm_s);
    out_ << '\n';
  }

  /// Filament is swapped: from its first move on until the next retraction or bead.
  void hold() {
    if (holds_ || of_tool_->tools.parking_pos_retraction == 0) return;
    holds_ = true;
    const auto command = job_.dialect.advance_command();
    job_.dialect.hold(out_, !command.empty() && has_command(of(job_.loaded, tool_changes_), command));
  }
  void release() {
    if (holds_) job_.dialect.release(out_);
    holds_ = false;
  }

  void print(const Retract& retract) {
    release();
    const auto& r = of_tool_->retraction;
    const Um wanted = retract.to_change ? of_tool_->tools.switch_extruder_retraction_amount : r.retraction_amount;
    const Um drawn = !state_.retracted()                   ? 0
                     : state_.drawn_to_change[state_.tool] ? wanted
                                                           : std::min(wanted, r.retraction_amount);
    const double amount = to_mm(wanted - drawn) * e_per_mm_;
    const bool draws = !state_.retracted() || (retract.to_change && !r.firmware_retraction && wanted > drawn);
    state_.set_retracted(true, retract.to_change);
    const double before = r.firmware_retraction ? 1 : retract.before_wipe;
    if (draws && r.firmware_retraction && writes_e_)
      out_ << "G10\n";
    else if (draws)
      extruder_only(-amount * before, r.retraction_retract_speed);
    if (retract.wipe.empty() || !state_.at) return;
    const double whole = distance(flat(*state_.at), retract.wipe.front()) + length_of(retract.wipe);
    if (whole <= 0) return;
    out_ << ";WIPE_START\n";
    for (const Point p : retract.wipe) {
      const Point3 to{p.x, p.y, state_.at->z};
      if (to == *state_.at) continue;
      out_ << "G1";
      axes(to);
      if (draws) filament(-amount * (1 - before) * distance(flat(*state_.at), p) / whole);
      feed(retract.wipe_speed_mm_s);
      out_ << '\n';
      state_.at = to;
    }
    out_ << ";WIPE_END\n";
  }

  void print(const Prime& prime) {
    const double extra = prime.extra_mm3 * e_per_mm3_;
    if (!state_.retracted()) {
      const auto& r = of_tool_->retraction;
      if (extra > 0) extruder_only(extra, r.retraction_prime_speed.value_or(r.retraction_retract_speed));
      return;
    }
    const bool changed = state_.drawn_to_change[state_.tool];
    state_.set_retracted(false);
    const auto& r = of_tool_->retraction;
    const auto& t = of_tool_->tools;
    const double speed = r.retraction_prime_speed.value_or(r.retraction_retract_speed);
    if (r.firmware_retraction && !state_.drawn_mm && writes_e_) out_ << "G11\n";
    const Um drawn = r.firmware_retraction ? 0 : changed ? t.switch_extruder_retraction_amount : r.retraction_amount;
    const double drawn_mm = state_.drawn_mm.value_or(to_mm(drawn));
    const double mm =
        drawn_mm + to_mm(changed ? t.switch_extruder_extra_prime_amount : r.retraction_extra_prime_amount);
    state_.drawn_mm.reset();
    extruder_only(mm * e_per_mm_ + extra, speed);
  }

  void print(const SetPressureAdvance& advance) {
    if (advance.seconds == state_.pressure_advance_s) return;
    state_.pressure_advance_s = advance.seconds;
    job_.dialect.pressure_advance(out_, advance.seconds, state_.tool);
  }
  void print(const SetFan& fan) {
    if (fan.share == state_.fan) return;
    state_.fan = fan.share;
    job_.dialect.fan(out_, fan.share);
  }

  /// Firmware or the user may have had the nozzle elsewhere: the place is said again before anything is laid down.
  void lose_place() {
    state_.at.reset(), state_.z = MachineState::from_above;
    feed_ = 0;
  }

  /// What the profile brings for it, and the tool itself unless that has chosen it.
  static std::string_view of(const std::vector<std::string>& codes, std::size_t i) {
    return i < codes.size() ? std::string_view(codes[i]) : std::string_view();
  }
  void print(const ToolChange& change) {
    const std::string_view code = of(job_.tool_changes, tool_changes_), loaded = of(job_.loaded, tool_changes_);
    const bool chosen_already = job_.first_is_chosen && tool_changes_ == 0;
    ++tool_changes_;
    if (!chosen_already) {
      custom(code);
      Text chosen;
      job_.dialect.select(chosen, change.tool);
      const auto select = std::move(chosen).take();
      if (!has_command(code, std::string_view(select).substr(0, select.find('\n')))) out_ << select;
    }
    custom(loaded);
    state_.tool = change.tool;
    state_.pressure_advance_s.reset();
    use(change.tool);
    lose_place();
    if (job_.settings.gcode.relative_extrusion) return;
    out_ << "G92 E0\n";
    e_wanted_ = 0, e_written_ = 0;
  }
  void print(const SetTemperature& heat) {
    job_.dialect.temperature(out_, heat);
    const bool nozzle = heat.heater == SetTemperature::Heater::nozzle && heat.tool != any_tool;
    if (nozzle && !heat.wait && heat.celsius > 0 && heat.tool != state_.tool) job_.dialect.stand_by(out_, heat.tool);
  }
  void print(const Feed& step) {
    hold();
    if (step.mm == 0) {
      out_ << "G4 P" << static_cast<std::int64_t>(std::llround(1000 * step.seconds)) << '\n';
      return;
    }
    if (!step.moves || !state_.at) return extruder_only(step.mm * e_per_mm_, std::abs(step.mm) / step.seconds);
    if (role_ != static_cast<int>(Role::wipe_tower)) {
      role_ = static_cast<int>(Role::wipe_tower);
      job_.comments.feature(out_, Role::wipe_tower);
    }
    if (job_.comments.says_sizes()) sizes({step.width, height_});
    const Point3 to{step.to.x, step.to.y, state_.at->z};
    const double um = distance(flat(*state_.at), step.to);
    out_ << "G1";
    axes(to);
    filament(step.mm * e_per_mm_);
    feed(std::max(um / 1000, 1e-3) / step.seconds);
    out_ << '\n';
    state_.at = to;
  }
  void print(const Pause& pause) {
    const auto index = pauses_++;
    const std::string_view code = index < job_.pauses.size() ? std::string_view(job_.pauses[index]) : "";
    job_.comments.pause(out_, pause.swaps_filament, state_.tool);
    if (!code.empty())
      custom(code);
    else if (pause.swaps_filament)
      job_.dialect.color_change(out_, pause.text);
    else
      job_.dialect.pause(out_, pause.text);
    lose_place();
  }

  void print(const ObjectStart& object) { job_.dialect.object_start(out_, object.object, job_.names); }
  void print(const ObjectEnd& object) { job_.dialect.object_end(out_, object.object, job_.names); }

  const LayerJob& job_;
  const Settings* of_tool_ = nullptr;
  Point offset_;  ///< of its nozzle, where the firmware does not allow for it
  MachineState state_;
  Text out_;
  double e_per_mm3_ = 0, e_per_mm_ = 0;  // units
  bool writes_e_ = true;
  double e_wanted_ = 0;         // units since the layer began
  std::int64_t e_written_ = 0;  // likewise
  std::int64_t feed_ = 0;       // 0: not said in this layer
  int role_ = -1;
  bool holds_ = false;  ///< what the firmware and the user add to the extruder's motion
  std::size_t tool_changes_ = 0, pauses_ = 0, timed_ = 0;
  double all_s_ = 0, done_s_ = 0;  ///< of the steps
  Um height_ = 0, width_ = 0;
};

}  // namespace

std::int64_t feed_of(double speed_mm_s) {
  return std::max<std::int64_t>(1, static_cast<std::int64_t>(speed_mm_s * 60 + 1e-3));
}

std::string layer_text(const LayerJob& job) {
  return LayerText(job).all();
}

}  // namespace weft::gcode
