// SPDX-License-Identifier: GPL-3.0-or-later
#include "gcode/writer.h"

#include "core/stop.h"
#include "gcode/custom_code.h"
#include "gcode/header.h"
#include "gcode/layer_text.h"
#include "gcode/left_by.h"
#include "settings/first_layer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace weft::gcode {
namespace {

std::string with_newline(std::string code) {
  if (!code.empty() && code.back() != '\n') code += '\n';
  return code;
}

Progress progress(double elapsed_s, double total_s) {
  const double share = total_s > 0 ? std::clamp(elapsed_s / total_s, 0.0, 1.0) : 0;
  return {static_cast<std::int64_t>(100 * share), std::llround((total_s - elapsed_s) / 60)};
}

/// A number out of a text: the seed of random().
std::uint64_t seed_of(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325U;  // FNV-1a
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  return hash;
}

}  // namespace

Writer::Writer(const Job& job, bool lenient)
    : job_(job),
      lenient_(lenient),
      first_(on_first_layer(job.settings).material),
      dialect_(dialect_of(job.settings.machine, job.settings.gcode)),
      names_(label_names(job.plan.objects)) {
  const auto& layers = job.plan.layers;
  MachineState state;
  double elapsed_s = 0;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    entries_.push_back(state);
    elapsed_s_.push_back(elapsed_s);
    advance(state, digest_of(job, i));
    elapsed_s += i < job.statistics.layer_s.size() ? job.statistics.layer_s[i] : 0;
  }
  entries_.push_back(state);
  elapsed_s_.push_back(elapsed_s);
  expand_custom_code();
  begin_where_start_ends();
}

/// The first layer begins with what start G-code has left; no later one does, as a layer begins with a travel.
void Writer::begin_where_start_ends() {
  const auto left = left_by(start_);
  MachineState& state = entries_.front();
  state.z = left.z;
  state.set_retracted(left.drawn_mm > 0 || (left.by_firmware && job_.settings.retraction.firmware_retraction));
  if (left.drawn_mm > 0) state.drawn_mm = left.drawn_mm;
}

void Writer::expand_custom_code() {
  const CustomCode code(job_.settings.gcode);
  auto variables = print_variables(job_);
  code.check(variables);
  macro::Scope scope{{}, seed_of(job_.settings.gcode.machine_start_gcode), lenient_};
  const auto expanded = [&](const macro::Template& t) { return with_newline(t.expand(variables, scope)); };
  start_ = expanded(code.start);
  const auto heating = heating_in(start_, code.start, job_.settings.material);
  start_sets_nozzle_ = heating.nozzle, start_sets_bed_ = heating.bed, start_sets_chamber_ = heating.chamber;
  const auto& g = job_.settings.gcode;
  const auto& layers = job_.plan.layers;
  before_layer_.resize(layers.size()), after_layer_.resize(layers.size()), tool_changes_.resize(layers.size());
  for (std::size_t i = 0; i < layers.size(); ++i) {
    stop_if_asked();
    const bool next_object = layers[i].time.comes_down;  // one object after the other
    const auto changes = g.tool_change_gcode.empty() ? std::vector<LayerDigest::Change>{} : digest_of(job_, i).changes;
    if (g.before_layer_gcode.empty() && g.layer_gcode.empty() && !next_object && changes.empty()) continue;
    set_layer(variables, i, layers[i].z);
    if (next_object) before_layer_[i] = expanded(code.between_objects);
    before_layer_[i] += expanded(code.before_layer);
    after_layer_[i] = expanded(code.layer);
    ToolId loaded = entries_[i].tool;
    for (const auto& change : changes) {
      set_tool_change(variables, std::exchange(loaded, change.tool), change.tool, layers[i].z);
      tool_changes_[i].push_back(expanded(code.tool_change));
    }
  }
  if (!layers.empty()) set_layer(variables, layers.size() - 1, layers.back().z);
  end_ = expanded(code.end);
  if (lenient_) expanded(code.tool_change), expanded(code.between_objects);
}

std::string Writer::head() const {
  const auto& m = job_.settings.material;
  const int nozzle = first_.material_print_temperature, bed = first_.material_bed_temperature;
  const bool sets_nozzle = !start_sets_nozzle_ && nozzle > 0, sets_bed = !start_sets_bed_ && bed > 0;
  const bool sets_chamber = !start_sets_chamber_ && m.build_volume_temperature > 0;
  Text out;
  out << top_comments(job_) << '\n';
  dialect_.define_objects(out, job_.plan.objects, names_);
  if (job_.settings.gcode.gcode_progress) out << dialect_.progress(progress(0, elapsed_s_.back()));
  Comments{job_.settings.gcode.gcode_comment_dialect}.custom(out);
  if (job_.settings.gcode.gcode_machine_limits) out << dialect_.machine_limits(job_.settings.machine);
  if (sets_chamber) out << "M141 S" << std::int64_t{m.build_volume_temperature} << '\n';
  if (sets_bed) out << "M140 S" << std::int64_t{bed} << '\n';
  if (sets_nozzle) out << "M104 S" << std::int64_t{nozzle} << '\n';
  if (sets_bed && m.material_bed_temp_wait) out << "M190 S" << std::int64_t{bed} << '\n';
  if (sets_chamber && m.material_bed_temp_wait) out << "M191 S" << std::int64_t{m.build_volume_temperature} << '\n';
  out << start_;
  if (sets_nozzle && m.material_print_temp_wait) out << "M109 S" << std::int64_t{nozzle} << '\n';
  out << "G21\nG90\n";
  if (job_.settings.gcode.write_extrusion) out << (job_.settings.gcode.relative_extrusion ? "M83\n" : "M82\n");
  return std::move(out).take();
}

std::string Writer::layer(std::size_t index) const {
  const auto& m = job_.settings.material;
  std::string preamble;
  const bool first = job_.plan.layers[index].time.first();
  if (index > 0 && job_.plan.layers[index - 1].time.first() != first) {  // the first layer is over, or another begins
    const auto& now = first ? first_ : m;
    if (m.material_print_temperature != first_.material_print_temperature)
      preamble += fmt::format("M104 S{}\n", now.material_print_temperature);
    if (m.material_bed_temperature != first_.material_bed_temperature)
      preamble += fmt::format("M140 S{}\n", now.material_bed_temperature);
  }
  if (job_.settings.gcode.gcode_progress && index > 0) {
    const auto now = progress(elapsed_s_[index], elapsed_s_.back());
    if (now != progress(elapsed_s_[index - 1], elapsed_s_.back())) preamble += dialect_.progress(now);
  }
  return layer_text({.settings = job_.settings,
                     .dialect = dialect_,
                     .comments = {job_.settings.gcode.gcode_comment_dialect},
                     .plan = job_.plan.layers[index],
                     .index = index,
                     .entry = entries_[index],
                     .names = names_,
                     .preamble = preamble,
                     .before_layer = before_layer_[index],
                     .after_layer = after_layer_[index],
                     .tool_changes = tool_changes_[index],
                     .end_s = elapsed_s_[index + 1]});
}

std::string Writer::tail() const {
  Text out;
  Comments{job_.settings.gcode.gcode_comment_dialect}.custom(out);
  if (entries_.back().fan > 0) dialect_.fan(out, 0);
  out << end_;
  if (job_.settings.gcode.gcode_progress) out << dialect_.progress({100, 0});
  out << '\n' << bottom_comments(job_);
  return std::move(out).take();
}

std::string write(const Job& job) {
  const Writer writer(job);
  std::vector<std::string> pieces{writer.head()};
  for (std::size_t i = 0; i < job.plan.layers.size(); ++i) pieces.push_back(writer.layer(i));
  pieces.push_back(writer.tail());
  std::size_t size = 0;
  for (const auto& piece : pieces) size += piece.size();
  std::string out;
  out.reserve(size);
  for (const auto& piece : pieces) out += piece;
  return out;
}

void check_custom_code(const Settings& settings) {
  // A cube of 20 mm in the middle of the bed.
  const Point middle = box_of(print_surface(settings.machine)).centre();
  const Ring outline{{middle.x - 10'000, middle.y - 10'000},
                     {middle.x + 10'000, middle.y - 10'000},
                     {middle.x + 10'000, middle.y + 10'000},
                     {middle.x - 10'000, middle.y + 10'000}};
  PrintPlan cube;
  for (std::uint32_t i = 0; i < 100; ++i)
    cube.layers.push_back({.z = 200 * static_cast<Um>(i + 1), .height = 200, .time = {.index = i, .number = i}});
  Extrude bead{.path = {}, .role = Role::outer_wall, .height = 200, .speed_mm_s = 50};
  for (const Point p : outline) bead.path.push_back({p, 400, 1.F});
  cube.layers.front().steps.emplace_back(bead);
  cube.objects.push_back({"cube", middle, outline});
  Statistics some;
  some.layer_s.assign(cube.layers.size(), 10);
  some.print_time_s = 1000, some.filament_mm = 1000, some.filament_mm3 = 2405, some.filament_g = 3;
  const Job job{settings, cube, some, "cube", {}};
  Writer(job, true);
}

}  // namespace weft::gcode
