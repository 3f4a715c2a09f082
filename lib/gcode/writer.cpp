#include "gcode/writer.h"

#include "gcode/header.h"
#include "gcode/layer_text.h"
#include "gcode/placeholders.h"
#include "settings/value.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace weft::gcode {
namespace {

char upper(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

/// Does a line of the code begin with that command?
bool has_command(std::string_view code, std::string_view command) {
  while (!code.empty()) {
    const auto end = std::min(code.find('\n'), code.size());
    const auto line = value::trimmed(code.substr(0, end));
    const bool same = line.size() >= command.size() && std::equal(command.begin(), command.end(), line.begin(),
                                                                  [](char a, char b) { return a == upper(b); });
    if (same && (line.size() == command.size() || line[command.size()] < '0' || line[command.size()] > '9'))
      return true;
    code.remove_prefix(std::min(end + 1, code.size()));
  }
  return false;
}

/// A macro that is handed a temperature sets it.
bool mentions(const Expansion& code, std::initializer_list<std::string_view> names) {
  return std::any_of(code.used.begin(), code.used.end(),
                     [&](const auto& used) { return std::find(names.begin(), names.end(), used) != names.end(); });
}

int first_nozzle(const MaterialSettings& m) {
  return m.material_print_temperature_layer_0.value_or(m.material_print_temperature);
}
int first_bed(const MaterialSettings& m) {
  return m.material_bed_temperature_layer_0.value_or(m.material_bed_temperature);
}

std::string with_newline(std::string code) {
  if (!code.empty() && code.back() != '\n') code += '\n';
  return code;
}

/// Percent done and minutes left, as displays show them.
struct Progress {
  std::int64_t percent, minutes;
  bool operator==(const Progress&) const = default;
};
Progress progress(double elapsed_s, double total_s) {
  const double share = total_s > 0 ? std::clamp(elapsed_s / total_s, 0.0, 1.0) : 0;
  return {static_cast<std::int64_t>(100 * share), std::llround((total_s - elapsed_s) / 60)};
}
std::string progress_line(Progress p) {
  return fmt::format("M73 P{} R{}\n", p.percent, p.minutes);
}

std::vector<std::string> pair_of(double a, double b) {
  return {value::number(a, 3), value::number(b, 3)};
}

Variables print_variables(const Job& job) {
  auto out = variables_of(job.settings);
  const auto box = first_layer_box(job.plan);
  const Box covered = box.empty() ? Box{{0, 0}, {0, 0}} : box;
  out["first_layer_print_min"] = pair_of(to_mm(covered.min.x), to_mm(covered.min.y));
  out["first_layer_print_max"] = pair_of(to_mm(covered.max.x), to_mm(covered.max.y));
  out["first_layer_print_size"] = pair_of(to_mm(covered.size().x), to_mm(covered.size().y));
  const auto bed = box_of(print_surface(job.settings.machine));
  out["print_bed_min"] = pair_of(to_mm(bed.min.x), to_mm(bed.min.y));
  out["print_bed_max"] = pair_of(to_mm(bed.max.x), to_mm(bed.max.y));
  out["print_bed_size"] = pair_of(to_mm(bed.size().x), to_mm(bed.size().y));
  out["total_layer_count"] = {fmt::format("{}", job.plan.layers.size())};
  Um top = 0;
  for (const auto& layer : job.plan.layers) top = std::max(top, layer.z);
  out["max_layer_z"] = {value::print(top, Unit::mm)};
  out["layer_num"] = {"0"};
  out["layer_z"] = {"0"};
  out["print_time"] = out["normal_print_time"] = {duration(job.statistics.print_time_s)};
  out["used_filament"] = {value::number(job.statistics.filament_mm / 1000, 2)};  // metres, as in PrusaSlicer
  out["extruded_volume"] = {value::number(job.statistics.filament_mm3, 2)};
  out["total_weight"] = {value::number(job.statistics.filament_g, 2)};
  out["num_objects"] = out["num_instances"] = {fmt::format("{}", job.plan.objects.size())};
  out["num_extruders"] = out["num_printing_extruders"] = {"1"};
  for (const auto* tool : {"initial_tool", "initial_extruder", "current_extruder"}) out[tool] = {"0"};
  out["input_filename_base"] = {escaped_name(job.input_name)};
  return out;
}

}  // namespace

Writer::Writer(const Job& job)
    : job_(job),
      dialect_{job.settings.machine.firmware, job.settings.gcode.gcode_label_objects},
      names_(label_names(job.plan.objects)) {
  const auto& layers = job.plan.layers;
  MachineState state;
  double elapsed_s = 0;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    entries_.push_back(state);
    elapsed_s_.push_back(elapsed_s);
    advance(state, dialect_, layers[i]);
    elapsed_s += i < job.statistics.layer_s.size() ? job.statistics.layer_s[i] : 0;
  }
  entries_.push_back(state);
  elapsed_s_.push_back(elapsed_s);
  expand_custom_code();
}

void Writer::expand_custom_code() {
  const auto& g = job_.settings.gcode;
  auto variables = print_variables(job_);
  const auto start = expand(g.machine_start_gcode, variables, "machine_start_gcode");
  start_ = with_newline(start.text);
  start_sets_nozzle_ = has_command(start_, "M104") || has_command(start_, "M109") || has_command(start_, "M568") ||
                       mentions(start, {"material_print_temperature", "material_print_temperature_layer_0",
                                        "temperature", "first_layer_temperature"});
  start_sets_bed_ = has_command(start_, "M140") || has_command(start_, "M190") ||
                    mentions(start, {"material_bed_temperature", "material_bed_temperature_layer_0", "bed_temperature",
                                     "first_layer_bed_temperature"});
  const auto count = job_.plan.layers.size();
  before_layer_.resize(count), after_layer_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    if (g.before_layer_gcode.empty() && g.layer_gcode.empty()) break;
    variables["layer_num"] = {fmt::format("{}", i)};
    variables["layer_z"] = {value::print(job_.plan.layers[i].z, Unit::mm)};
    before_layer_[i] = with_newline(expand(g.before_layer_gcode, variables, "before_layer_gcode").text);
    after_layer_[i] = with_newline(expand(g.layer_gcode, variables, "layer_gcode").text);
  }
  end_ = with_newline(expand(g.machine_end_gcode, variables, "machine_end_gcode").text);
}

std::string Writer::head() const {
  const auto& m = job_.settings.material;
  const bool sets_nozzle = !start_sets_nozzle_ && first_nozzle(m) > 0, sets_bed = !start_sets_bed_ && first_bed(m) > 0;
  Text out;
  out << top_comments(job_) << '\n';
  dialect_.define_objects(out, job_.plan.objects, names_);
  if (job_.settings.gcode.gcode_progress) out << progress_line(progress(0, elapsed_s_.back()));
  out << ";TYPE:Custom\n";
  if (sets_bed) out << "M140 S" << std::int64_t{first_bed(m)} << '\n';
  if (sets_nozzle) out << "M104 S" << std::int64_t{first_nozzle(m)} << '\n';
  if (sets_bed) out << "M190 S" << std::int64_t{first_bed(m)} << '\n';
  out << start_;
  if (sets_nozzle) out << "M109 S" << std::int64_t{first_nozzle(m)} << '\n';
  out << "G21\nG90\n" << (job_.settings.gcode.relative_extrusion ? "M83\n" : "M82\n");
  return std::move(out).take();
}

std::string Writer::layer(std::size_t index) const {
  const auto& m = job_.settings.material;
  std::string preamble;
  if (index == 1) {  // the first layer is over
    if (m.material_print_temperature != first_nozzle(m))
      preamble += fmt::format("M104 S{}\n", m.material_print_temperature);
    if (m.material_bed_temperature != first_bed(m)) preamble += fmt::format("M140 S{}\n", m.material_bed_temperature);
  }
  if (job_.settings.gcode.gcode_progress && index > 0) {
    const auto now = progress(elapsed_s_[index], elapsed_s_.back());
    if (now != progress(elapsed_s_[index - 1], elapsed_s_.back())) preamble += progress_line(now);
  }
  return layer_text({job_.settings, dialect_, job_.plan.layers[index], entries_[index], names_, preamble,
                     before_layer_[index], after_layer_[index]});
}

std::string Writer::tail() const {
  Text out;
  out << ";TYPE:Custom\n";
  if (entries_.back().fan > 0) dialect_.fan(out, 0);
  out << end_;
  if (job_.settings.gcode.gcode_progress) out << "M73 P100 R0\n";
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
  PrintPlan one_layer;
  one_layer.layers.resize(1);
  const Statistics nothing;
  Writer({settings, one_layer, nothing, {}, {}});
}

}  // namespace weft::gcode
