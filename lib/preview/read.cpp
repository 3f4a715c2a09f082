// SPDX-License-Identifier: GPL-3.0-or-later
#include "audit/reader.h"
#include "core/stop.h"
#include "model/flow.h"
#include "preview/in_force.h"
#include "preview/toolpaths.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

namespace weft::preview {
namespace {

constexpr double shortest_mm = 0.0005;   // of a piece that is drawn: half the lattice
constexpr double full_flow = 0.93;       // below this share of the announced bead a piece counts as compensated
constexpr double layer_step_mm = 0.005;  // files without comments: a bead this much higher begins a layer

/// Gathers the motions of an audit::Reader into layers.
class Gatherer {
 public:
  enum class LayersBy { comments, height };
  Gatherer(Um filament_diameter, Chord chord, LayersBy by)
      : filament_mm2_(std::numbers::pi / 4 * to_mm(filament_diameter) * to_mm(filament_diameter)),
        chord_(chord),
        by_(by) {
    feature_of_.fill(none);
    out_.filament_mm2 = filament_mm2_;
  }

  void line(const char* begin, const char* end) {
    stop_.step();
    reader_.line(begin, end);
    in_force_.line({begin, end});
    notice_events();
    for (const audit::Motion& motion : reader_.motions()) add(motion);
  }

  bool has_comments() const { return reader_.context().began(); }
  /// Slic3r tells where its start G-code ends, and nothing of layers.
  bool has_layers() const { return has_comments() && reader_.context().layer() >= 0; }

  Toolpaths finish() {
    if (!out_.layers.empty()) {
      auto& events = out_.layers.front().events;
      events.insert(events.begin(), before_.events.begin(), before_.events.end());
    }
    if (!has_comments() && custom_ != none) out_.features[custom_] = "";  // nobody said what it is
    return std::move(out_);
  }

 private:
  static constexpr std::uint8_t none = 255;

  void add(const audit::Motion& motion) {
    constexpr double reach_mm = max_coord / 1000.0 - 1;
    const audit::Vec from = motion.path.from, to = motion.path.to;
    if (!motion.from_known || !motion.x_known || !motion.y_known || !motion.judgeable) return;
    if (std::max({std::abs(from.x), std::abs(from.y), std::abs(to.x), std::abs(to.y), std::abs(motion.z_to)}) >
        reach_mm)
      return;
    const double length = audit::length_mm(motion.path);
    const bool climbs = std::abs(motion.z_to - motion.z_from) >= shortest_mm;
    if (length < shortest_mm && !climbs) return;
    PathLayer& layer = layer_of(motion);
    if (motion.extrudes && layer.z == 0 && !custom()) start(layer, motion);
    if (motion.e_mm < 0 && !drawn_back_) event(layer, Event::Kind::retract, 0);  // while it wipes
    if (motion.extrudes && drawn_back_) event(layer, Event::Kind::prime, 0);
    if (motion.tool != tool_) {
      event(layer, Event::Kind::tool_change, 0);
      tool_ = motion.tool;
    }
    emit(layer, motion, look(motion, layer, length));
  }

  /// What the line did without moving along X, Y or Z.
  void notice_events() {
    const double pushed = reader_.pushed_alone(), drawn = reader_.drawn_alone();
    if (drawn > drawn_ || reader_.retracted() > by_firmware_)
      event(last_layer(), Event::Kind::retract, drawn - drawn_);
    else if ((pushed > pushed_ || reader_.retracted() < by_firmware_) && drawn_back_)
      event(last_layer(), Event::Kind::prime, pushed - pushed_);
    if (in_force_.pauses() > pauses_) event(last_layer(), Event::Kind::pause, 0);
    pushed_ = pushed, drawn_ = drawn, by_firmware_ = reader_.retracted(), pauses_ = in_force_.pauses();
  }
  void event(PathLayer& layer, Event::Kind kind, double mm) {
    if (kind == Event::Kind::retract) drawn_back_ = true;
    if (kind == Event::Kind::prime) drawn_back_ = false;
    const double speed_mm_s = reader_.speed_mm_s();
    layer.events.push_back({kind, static_cast<std::uint32_t>(layer.strokes.size()), static_cast<float>(std::abs(mm)),
                            static_cast<float>(speed_mm_s > 0 ? std::abs(mm) / speed_mm_s : 0)});
  }

  /// The layer that was written to last; what comes before the first motion waits for the first layer.
  PathLayer& last_layer() { return out_.layers.empty() ? before_ : out_.layers.back(); }

  bool custom() const { return by_ == LayersBy::comments && reader_.context().custom(); }

  PathLayer& layer_of(const audit::Motion& motion) {
    if (by_ == LayersBy::comments) {
      const std::size_t index = static_cast<std::size_t>(std::clamp(reader_.context().layer(), 0, 1'000'000));
      if (index >= out_.layers.size()) out_.layers.resize(index + 1);
      return out_.layers[index];
    }
    if (out_.layers.empty() ||
        (motion.extrudes && motion.z_to > to_mm(out_.layers.back().z) + layer_step_mm && out_.layers.back().z != 0))
      out_.layers.emplace_back();
    return out_.layers.back();
  }

  /// Z and height, from the first bead of the layer.
  void start(PathLayer& layer, const audit::Motion& motion) {
    layer.z = from_mm(motion.z_to);
    const audit::Context& context = reader_.context();
    const double said_mm = context.layer_height_mm() > 0 ? context.layer_height_mm() : context.height_mm();
    const std::size_t index = static_cast<std::size_t>(&layer - out_.layers.data());
    const Um below = index > 0 ? out_.layers[index - 1].z : 0;
    layer.height = said_mm > 0 && said_mm < 10 ? from_mm(said_mm) : std::max(layer.z - below, 1);
  }

  /// Everything of a stroke but its place.
  Stroke look(const audit::Motion& motion, const PathLayer& layer, double length) {
    Stroke stroke;
    stroke.line = static_cast<std::uint32_t>(reader_.line_number());
    stroke.speed_mm_s = static_cast<float>(reader_.speed_mm_s());
    stroke.feature = feature();
    stroke.z = from_mm(motion.z_to);
    stroke.tool = static_cast<std::uint8_t>(std::clamp(motion.tool, 0, 255));
    stroke.fan_percent = in_force_.fan_percent();
    stroke.nozzle_c = in_force_.nozzle_c();
    stroke.acceleration_mm_s2 = in_force_.acceleration_mm_s2(motion.extrudes);
    if (!motion.extrudes || motion.e_mm <= 0 || length < shortest_mm) return stroke;
    const double area_mm2 = motion.e_mm * (motion.volumetric ? 1.0 : filament_mm2_) / length;
    const double height_mm = bead_height_mm(layer);
    stroke.height = from_mm(height_mm);
    const double band_mm = std::min(area_mm2 / height_mm, 10.0);  // a blob in one place is none that is wider
    stroke.width = std::max(flow::line_width(from_mm(band_mm), from_mm(height_mm)), 1);
    stroke.flow_mm3_s = static_cast<float>(area_mm2) * stroke.speed_mm_s;
    const bool bridge = out_.features[stroke.feature] == "bridge";
    if (bridge)  // nothing presses it flat: a round strand
      stroke.width = std::min(stroke.width, std::max(from_mm(2 * std::sqrt(area_mm2 / std::numbers::pi)), 1));
    const double said_mm = reader_.context().width_mm();
    stroke.compensated =
        said_mm > 0 && !bridge && !custom() && area_mm2 < full_flow * flow::area_mm2(said_mm, height_mm);
    return stroke;
  }

  /// As the file says it here: what fills two layers at once is twice as high.
  double bead_height_mm(const PathLayer& layer) const {
    const double said_mm = reader_.context().height_mm();
    if (by_ == LayersBy::comments && said_mm > 0 && said_mm < 10 && !custom()) return said_mm;
    constexpr double unknown_mm = 0.2;  // start G-code purges before any layer is known
    return layer.height > 0 ? to_mm(layer.height) : unknown_mm;
  }

  std::uint8_t feature() {
    const audit::Context& context = reader_.context();
    if (context.custom()) {
      if (custom_ == none) custom_ = named("custom");
      return custom_;
    }
    std::uint8_t& known = feature_of_[context.feature_index()];
    if (known == none) known = named(context.feature());
    return known;
  }

  std::uint8_t named(std::string_view name) {
    const auto at = std::find(out_.features.begin(), out_.features.end(), name);
    if (at == out_.features.end())
      return out_.features.emplace_back(name), static_cast<std::uint8_t>(out_.features.size() - 1);
    return static_cast<std::uint8_t>(at - out_.features.begin());
  }

  void emit(PathLayer& layer, const audit::Motion& motion, Stroke stroke) {
    int pieces = 1;
    if (motion.path.arc) {
      const double sweep_rad = std::abs(motion.path.sweep_rad);
      const double span_mm = motion.path.radius_mm * std::min(2.0, sweep_rad);
      const double chord = std::max(chord_.mm, chord_.share * span_mm);
      const double step_rad = 2 * std::acos(1 - chord / std::max(motion.path.radius_mm, chord));
      pieces = static_cast<int>(std::clamp(std::ceil(sweep_rad / step_rad), 1.0, 10'000.0));
    }
    Point last = point(motion.path.from);
    const double rise = motion.z_to - motion.z_from;
    for (int i = 1; i <= pieces; ++i) {
      stroke.z = from_mm(i == pieces ? motion.z_to : motion.z_from + rise * i / pieces);
      const Point next = point(i == pieces ? motion.path.to : audit::at(motion.path, static_cast<double>(i) / pieces));
      stroke.from = last, stroke.to = next;
      layer.strokes.push_back(stroke);
      last = next;
    }
  }
  static Point point(audit::Vec v) { return {from_mm(v.x), from_mm(v.y)}; }

  double filament_mm2_;
  Chord chord_;
  StopNowAndThen stop_{1000};
  LayersBy by_;
  audit::Reader reader_{{}};
  InForce in_force_;
  bool drawn_back_ = false, by_firmware_ = false;
  double pushed_ = 0, drawn_ = 0;
  std::uint32_t pauses_ = 0;
  int tool_ = 0;
  PathLayer before_;
  std::array<std::uint8_t, 256> feature_of_{};
  std::uint8_t custom_ = none;
  Toolpaths out_;
};

void read_lines(Gatherer& gatherer, std::string_view gcode) {
  std::size_t at = 0;
  for (std::size_t end; (end = gcode.find('\n', at)) != std::string_view::npos; at = end + 1)
    gatherer.line(gcode.data() + at, gcode.data() + end);
  if (at == gcode.size()) return;
  const std::string last = std::string(gcode.substr(at)) + '\n';
  gatherer.line(last.data(), last.data() + last.size() - 1);
}

}  // namespace

Toolpaths read(std::string_view gcode, Um filament_diameter, Chord chord) {
  Gatherer gatherer(filament_diameter, chord, Gatherer::LayersBy::comments);
  read_lines(gatherer, gcode);
  if (gatherer.has_layers()) return gatherer.finish();
  Gatherer again(filament_diameter, chord, Gatherer::LayersBy::height);
  read_lines(again, gcode);
  return again.finish();
}

}  // namespace weft::preview
