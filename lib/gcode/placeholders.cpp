// SPDX-License-Identifier: GPL-3.0-or-later
#include "gcode/placeholders.h"

#include "core/escape.h"
#include "prusaslicer/keys.h"
#include "prusaslicer/text.h"
#include "settings/catalogue.h"
#include "settings/gcode_variables.h"
#include "settings/value.h"

#include <algorithm>

namespace weft::gcode {
namespace {

using macro::Scalar;
using macro::Variable;
using macro::Variables;

Variable number(double v) {
  return macro::variable_of(value::number(v));
}

/// `[name]` of a flag is 1 or 0.
Variable in_brackets(const std::string& text) {
  auto out = macro::variable_of(text);
  if (out.values.size() == 1 && std::holds_alternative<bool>(out.values[0])) out.text.clear();
  return out;
}

/// A setting's value as expressions see it.
Variable variable(const CatalogueEntry& entry, const std::string& text) {
  Variable out;
  if (entry.automatic && text == "auto")
    out.missing = "is auto";
  else if (entry.type == "text" || !entry.choices.empty())
    out = macro::variable(escape::one_line(text));
  else
    out = macro::variable_of(escape::one_line(text));
  return out;
}

/// Line widths in mm: what a share is of is not known in G-code.
std::string in_mm(const CatalogueEntry& entry, const std::string& text, Um nozzle) {
  if (!entry.key.ends_with("line_width") && !entry.key.starts_with("wall_line_width_")) return text;
  if (!text.ends_with('%')) return text;
  LengthOrShare width;
  value::parse(text, Unit::mm, width);
  return value::print(width.of(nozzle), Unit::mm);
}

/// The same value in PrusaSlicer's words.
Variable in_their_words(const prusaslicer::Key& row, const Variable& ours, const std::string& text) {
  using prusaslicer::Form;
  switch (row.form) {
    case Form::times_100:
      if (ours.values.empty()) return ours;
      if (const auto* whole = std::get_if<std::int64_t>(&ours.values[0]))
        return number(static_cast<double>(*whole) / 100);
      if (const auto* real = std::get_if<double>(&ours.values[0])) return number(*real / 100);
      return ours;
    case Form::zero_is_auto:
      return text == "auto" ? number(0) : ours;
    case Form::flag: {
      Variable out = ours;
      out.text.assign(1, text == "true" ? '1' : '0');
      return out;
    }
    case Form::choice:
      for (const auto& choice : prusaslicer::choice_rows)
        if (choice.key == row.name && choice.ours == text) return macro::variable(std::string(choice.theirs));
      return ours;
    case Form::none:
    case Form::length:
    case Form::number:
    case Form::share:
    case Form::text:
    case Form::width:
    case Form::speed:
    case Form::acceleration:
    case Form::limit:
    case Form::reckoned:
      break;
  }
  Variable out = ours;
  const bool flag = ours.values.size() == 1 && std::holds_alternative<bool>(ours.values[0]);
  if (flag) out.text.assign(1, std::get<bool>(ours.values[0]) ? '1' : '0');
  if (ours.text.ends_with('%') && row.initial && !row.initial->ends_with('%')) out.text.pop_back();
  // What is for weft to find out has the value there that nobody has chosen.
  if (!ours.missing.empty()) {
    if (row.initial) return macro::variable_of(*row.initial);
    out.missing.clear(), out.values = {macro::Nil{}};
  }
  return out;
}

}  // namespace

Variables variables_of(const Settings& settings) {
  Variables out;
  for (const auto& entry : catalogue()) {
    const std::string text = in_mm(entry, entry.print(settings), settings.machine.nozzle_diameter);
    auto ours = variable(entry, text);
    for (const auto& row : prusaslicer::keys())
      if (row.ours == entry.key) out.emplace(std::string(row.name), in_their_words(row, ours, text));
    // Of a name that both have PrusaSlicer's own value stands in for what is for weft to find out, and a value that is
    // the same is written as PrusaSlicer does.
    const auto theirs = out.find(entry.key);
    if (theirs == out.end())
      out.emplace(std::string(entry.key), std::move(ours));
    else if (ours.missing.empty() && theirs->second.values != ours.values)
      theirs->second = std::move(ours);
  }
  const auto set = [&](const char* key, const char* prusa, double v) { out[key] = out[prusa] = number(v); };
  const auto& m = settings.material;
  set("material_print_temperature_layer_0", "first_layer_temperature",
      m.material_print_temperature_layer_0.value_or(m.material_print_temperature));
  set("material_bed_temperature_layer_0", "first_layer_bed_temperature",
      m.material_bed_temperature_layer_0.value_or(m.material_bed_temperature));
  set("initial_layer_height", "first_layer_height",
      to_mm(settings.layers.initial_layer_height.value_or(settings.layers.layer_height)));
  // A switch there, a length of 0 here.
  out["retract_length"] =
      number(settings.retraction.retraction_enable ? to_mm(settings.retraction.retraction_amount) : 0);
  for (const auto& further : parse_gcode_variables(settings.gcode.gcode_variables)) {
    std::string values;
    for (const auto& e : further.elements)
      values += (values.empty() ? "" : ", ") + (e.quoted ? quoted_variable(e.text) : e.text);
    out.emplace(further.name, in_brackets(values));  // a setting of that name is nearer
  }
  // What no profile says otherwise is as PrusaSlicer has it; where the tower stands is found here.
  for (const auto& row : prusaslicer::keys())
    if (row.initial && row.name != "wipe_tower_x" && row.name != "wipe_tower_y" && !out.contains(row.name))
      out.emplace(std::string(row.name), in_brackets(prusaslicer::in_macro_words(row.name, *row.initial)));
  return out;
}

}  // namespace weft::gcode
