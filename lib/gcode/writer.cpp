// SPDX-License-Identifier: GPL-3.0-or-later
#include "gcode/writer.h"

#include "core/stop.h"
#include "gcode/custom_code.h"
#include "gcode/header.h"
#include "gcode/layer_text.h"
#include "gcode/left_by.h"
#include "settings/first_layer.h"
#include "settings/tools.h"

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

/// A number out of a text: the seed of random().
std::uint64_t seed_of(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325U;  // FNV-1a
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  return hash;
}

/// Whether any custom G-code names a variable.
bool names_any(const CustomCode& code, const std::vector<CustomCode>& of_tools, const ToolSettings& tools) {
  return code.names_any() ||
         std::any_of(of_tools.begin(), of_tools.end(), [](const CustomCode& own) { return own.names_any(); }) ||
         std::any_of(tools.gcode_at_heights.begin(), tools.gcode_at_heights.end(),
                     [](const HeightMark& mark) { return !template_of(mark).names().empty(); });
}

}  // namespace

Writer::Writer(const Job& job, bool lenient)
    : job_(job),
      lenient_(lenient),
      first_(on_first_layer(job.settings).material),
      dialect_(dialect_of(job.settings)),
      substitutions_(job.settings.gcode.gcode_substitutions),
      progress_(dialect_, job.statistics, job.plan.layers.size()),
      names_(label_names(job.plan.objects)) {
  const auto& layers = job.plan.layers;
  MachineState state;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    entries_.push_back(state);
    advance(state, digest_of(job, i));
  }
  entries_.push_back(state);
  if (!job.tools.empty())
    for (std::size_t i = 0; i < layers.size(); ++i)
      for (const auto& change : digest_of(job, i).changes)
        if (std::find(used_.begin(), used_.end(), change.tool) == used_.end()) used_.push_back(change.tool);
  if (!used_.empty()) first_ = on_first_layer(job.tools[used_.front()]).material;
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
  std::vector<CustomCode> of_tools;
  for (const auto& tool : job_.tools) of_tools.emplace_back(tool.gcode);
  auto variables = print_variables(job_, names_any(code, of_tools, job_.settings.tools));
  code.check(variables);
  macro::Scope scope{{}, seed_of(job_.settings.gcode.machine_start_gcode), lenient_};
  const auto expanded = [&](const macro::Template& t) { return with_newline(t.expand(variables, scope)); };
  for (const auto& own : of_tools) own.check(variables);
  const auto of_tool = [&](ToolId tool) -> const CustomCode& { return tool < of_tools.size() ? of_tools[tool] : code; };
  if (!used_.empty()) {
    set_tool_change(variables, used_.front(), used_.front(), 0);
    set_initial_tool(variables, used_.front());
  }
  start_ = expanded(code.start) + (used_.empty() ? expanded(code.load) : std::string());
  start_selects_ = !used_.empty() && has_command(start_, fmt::format("T{}", used_.front()));
  head_selects_ = !used_.empty() && !start_selects_ && dialect_.selects_to_heat() && !shares_nozzle(job_.tools);
  const auto& material = used_.empty() ? job_.settings.material : job_.tools[used_.front()].material;
  const auto heating = heating_in(start_, code.start, material);
  start_sets_nozzle_ = heating.nozzle, start_sets_bed_ = heating.bed, start_sets_chamber_ = heating.chamber;
  const auto& g = job_.settings.gcode;
  const auto& layers = job_.plan.layers;
  before_layer_.resize(layers.size()), after_layer_.resize(layers.size()), tool_changes_.resize(layers.size());
  pauses_.resize(layers.size()), loaded_.resize(layers.size());
  std::optional<ToolId> loaded = used_.empty() ? std::optional<ToolId>(0) : std::nullopt;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    stop_if_asked();
    const bool next_object = layers[i].time.comes_down;  // one object after the other
    const bool codes_changes = !g.tool_change_gcode.empty() || !used_.empty();
    const auto changes = codes_changes ? digest_of(job_, i).changes : std::vector<LayerDigest::Change>{};
    const bool coded = !g.pause_gcode.empty() || !g.color_change_gcode.empty();
    const auto pauses = coded ? digest_of(job_, i).pauses : std::vector<Pause>{};
    if (g.before_layer_gcode.empty() && g.layer_gcode.empty() && !next_object && changes.empty() && pauses.empty() &&
        job_.settings.tools.gcode_at_heights.empty())
      continue;
    set_layer(variables, i, layers[i].z);
    if (next_object) before_layer_[i] = expanded(code.between_objects);
    before_layer_[i] += expanded(code.before_layer) + code_at_heights(i, variables, scope);
    after_layer_[i] = expanded(code.layer);
    for (const auto& change : changes) {
      const ToolId from = loaded.value_or(change.tool);
      set_tool_change(variables, from, change.tool, layers[i].z);
      if (!loaded && !used_.empty()) variables["previous_extruder"] = macro::variable(std::int64_t{-1});
      auto text = loaded && !used_.empty() ? expanded(of_tool(from).unload) : std::string();
      set_filament(variables, change.tool);
      tool_changes_[i].push_back(text + expanded(code.tool_change));
      set_current_tool(variables, change.tool);
      loaded_[i].push_back(used_.empty() ? std::string() : expanded(of_tool(change.tool).load));
      loaded = change.tool;
    }
    for (const auto& pause : pauses)
      pauses_[i].push_back(expanded(pause.swaps_filament ? code.color_change : code.pause));
  }
  if (!layers.empty()) set_layer(variables, layers.size() - 1, layers.back().z);
  end_ = expanded(of_tool(loaded.value_or(0)).unload) + expanded(code.end);
  if (lenient_) {
    expanded(code.tool_change), expanded(code.between_objects), expanded(code.pause), expanded(code.color_change);
    for (const auto& mark : job_.settings.tools.gcode_at_heights) template_of(mark).check(variables, scope.globals);
  }
}

/// What gcode_at_heights wants before this layer: the first that reaches above the mark, in each rise.
std::string Writer::code_at_heights(std::size_t index, const macro::Variables& variables, macro::Scope& scope) const {
  const auto& layer = job_.plan.layers[index];
  const Um offset = job_.settings.machine.z_offset;
  const Um below = index > 0 && !layer.time.comes_down ? job_.plan.layers[index - 1].z - offset : 0;
  std::string out;
  for (const auto& mark : job_.settings.tools.gcode_at_heights)
    if (mark.z >= below && mark.z < layer.z - offset) out += with_newline(template_of(mark).expand(variables, scope));
  return out;
}

std::string Writer::head() const {
  const auto& m = job_.settings.material;
  const int nozzle = first_.material_print_temperature, bed = first_.material_bed_temperature;
  const bool sets_nozzle = !start_sets_nozzle_ && nozzle > 0, sets_bed = !start_sets_bed_ && bed > 0;
  const std::int64_t chamber = start_sets_chamber_ ? 0 : m.build_volume_temperature;
  const std::int64_t warm =
      start_sets_chamber_ ? 0 : m.build_volume_wait_temperature.value_or(m.build_volume_temperature);
  Text out;
  dialect_.define_objects(out, job_.plan.objects, names_);
  if (job_.settings.gcode.gcode_progress) out << progress_.at(0);
  Comments{job_.settings.gcode.gcode_comment_dialect}.custom(out);
  if (job_.settings.gcode.gcode_machine_limits) out << dialect_.machine_limits(job_.settings.machine);
  if (chamber > 0) out << "M141 S" << chamber << '\n';
  if (sets_bed) out << "M140 S" << std::int64_t{bed} << '\n';
  if (!used_.empty())
    heat_at_start(out, false);
  else if (sets_nozzle)
    out << "M104 S" << std::int64_t{nozzle} << '\n';
  if (sets_bed && m.material_bed_temp_wait) out << "M190 S" << std::int64_t{bed} << '\n';
  if (warm > 0 && m.material_bed_temp_wait) {
    out << "M191 S" << warm << '\n';
    if (chamber > 0 && chamber != warm) out << "M141 S" << chamber << '\n';  // M191 has made it the target
  }
  out << start_;
  if (head_selects_) {
    const auto& changes = tool_changes_.front();
    const auto code = changes.empty() ? std::string_view() : std::string_view(changes.front());
    out << code;
    if (!has_command(code, fmt::format("T{}", used_.front()))) dialect_.select(out, used_.front());
  }
  if (!used_.empty() && m.material_print_temp_wait)
    heat_at_start(out, true);
  else if (sets_nozzle && m.material_print_temp_wait)
    out << "M109 S" << std::int64_t{nozzle} << '\n';
  out << "G21\nG90\n";
  if (job_.settings.gcode.write_extrusion) out << (job_.settings.gcode.relative_extrusion ? "M83\n" : "M82\n");
  return top_comments(job_) + '\n' + substitutions_.done(std::move(out).take());
}

/// Every nozzle that is used gets warm; the first is waited for. What the start G-code sets it sets itself.
void Writer::heat_at_start(Text& out, bool wait) const {
  const auto heat = [&](ToolId tool) {
    const int celsius = on_first_layer(job_.tools[tool]).material.material_print_temperature;
    const bool own = !shares_nozzle(job_.tools);
    if (celsius > 0) dialect_.temperature(out, {SetTemperature::Heater::nozzle, own ? tool : any_tool, celsius, wait});
  };
  if (!start_sets_nozzle_) heat(used_.front());
  if (wait || shares_nozzle(job_.tools)) return;
  const auto& cold = job_.cold_at_start;
  for (const ToolId tool : used_)
    if (tool != used_.front() && std::find(cold.begin(), cold.end(), tool) == cold.end()) {
      heat(tool);
      dialect_.stand_by(out, tool);
    }
}

/// The nozzle's temperature when the first layer is over, or another begins; others get theirs when they are loaded.
std::string Writer::heat_after_first_layer(std::size_t index, bool first) const {
  Text out;
  const auto heat = [&](ToolId tool, ToolId named) {
    const auto& usual = job_.tools[tool].material;
    const auto low = on_first_layer(job_.tools[tool]).material;
    if (usual.material_print_temperature != low.material_print_temperature)
      dialect_.temperature(
          out, {SetTemperature::Heater::nozzle, named, (first ? low : usual).material_print_temperature, false});
  };
  const ToolId loaded = entries_[index].tool;
  heat(loaded, shares_nozzle(job_.tools) ? any_tool : loaded);
  return std::move(out).take();
}

/// What a mixing nozzle is told when its share changes.
std::string Writer::mixing(std::size_t index) const {
  const auto& t = job_.settings.tools;
  if (!t.gradient_tools || t.gradient_mode != GradientMode::mix) return {};
  const auto told = [&](std::size_t i) {
    Text out;
    dialect_.mix(out, share_at(t.gradient_stops, to_mm(job_.plan.layers[i].z - job_.settings.machine.z_offset)));
    return std::move(out).take();
  };
  auto now = told(index);
  return index > 0 && told(index - 1) == now ? std::string() : now;
}

std::string Writer::layer(std::size_t index) const {
  const auto& m = used_.empty() ? job_.settings.material : job_.tools[used_.front()].material;
  std::string preamble;
  const bool first = job_.plan.layers[index].time.first();
  if (index > 0 && job_.plan.layers[index - 1].time.first() != first) {  // the first layer is over, or another begins
    const auto& now = first ? first_ : m;
    if (!used_.empty())
      preamble += heat_after_first_layer(index, first);
    else if (m.material_print_temperature != first_.material_print_temperature)
      preamble += fmt::format("M104 S{}\n", now.material_print_temperature);
    if (m.material_bed_temperature != first_.material_bed_temperature)
      preamble += fmt::format("M140 S{}\n", now.material_bed_temperature);
  }
  const bool tells = job_.settings.gcode.gcode_progress;
  if (tells) preamble += progress_.before(index);
  preamble += mixing(index);
  auto text = layer_text({.settings = job_.settings,
                          .tools = job_.tools,
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
                          .loaded = loaded_[index],
                          .pauses = pauses_[index],
                          .first_is_chosen = (start_selects_ || head_selects_) && index == 0,
                          .end_s = progress_.begin_s(index + 1),
                          .timed = tells ? progress_.within(index) : std::vector<TimedLine>{}});
  return substitutions_.done(std::move(text));
}

std::string Writer::tail() const {
  Text out;
  Comments{job_.settings.gcode.gcode_comment_dialect}.custom(out);
  if (entries_.back().fan > 0) dialect_.fan(out, 0);
  out << end_;
  if (job_.settings.gcode.gcode_progress) out << progress_.done();
  out << '\n';
  return substitutions_.done(std::move(out).take()) + bottom_comments(job_);
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
