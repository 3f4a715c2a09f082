#include "prusaslicer/text.h"

#include "core/join.h"
#include "settings/gcode_variables.h"
#include "settings/value.h"

#include <algorithm>
#include <array>

namespace weft::prusaslicer {
namespace {

constexpr std::array<std::string_view, 19> single_texts{"printer_model",
                                                        "printer_variant",
                                                        "printer_vendor",
                                                        "printer_notes",
                                                        "printer_settings_id",
                                                        "print_settings_id",
                                                        "notes",
                                                        "inherits",
                                                        "start_gcode",
                                                        "end_gcode",
                                                        "before_layer_gcode",
                                                        "layer_gcode",
                                                        "between_objects_gcode",
                                                        "toolchange_gcode",
                                                        "color_change_gcode",
                                                        "pause_print_gcode",
                                                        "template_custom_gcode",
                                                        "output_filename_format",
                                                        "filament_vendor"};
constexpr std::array<std::string_view, 8> text_lists{
    "filament_type",   "filament_settings_id", "filament_notes",     "filament_colour",
    "extruder_colour", "start_filament_gcode", "end_filament_gcode", "post_process"};

constexpr std::array<std::string_view, 59> flags{
    "autoemit_temperature_commands",
    "automatic_extrusion_widths",
    "automatic_infill_combination",
    "avoid_crossing_curled_overhangs",
    "avoid_crossing_perimeters",
    "binary_gcode",
    "clip_multipart_objects",
    "complete_objects",
    "cooling",
    "dont_support_bridges",
    "enable_dynamic_fan_speeds",
    "enable_dynamic_overhang_speeds",
    "external_perimeters_first",
    "extra_perimeters",
    "extra_perimeters_on_overhangs",
    "fan_always_on",
    "filament_abrasive",
    "filament_soluble",
    "gap_fill_enabled",
    "gcode_comments",
    "high_current_on_filament_swap",
    "infill_first",
    "infill_only_where_needed",
    "interface_shells",
    "ironing",
    "nozzle_high_flow",
    "only_one_perimeter_first_layer",
    "only_retract_when_crossing_perimeters",
    "ooze_prevention",
    "overhangs",
    "prefer_clockwise_movements",
    "remaining_times",
    "retract_layer_change",
    "scarf_seam_only_on_smooth",
    "silent_mode",
    "single_extruder_multi_material",
    "single_extruder_multi_material_priming",
    "spiral_vase",
    "staggered_inner_seams",
    "support_material",
    "support_material_auto",
    "support_material_buildplate_only",
    "support_material_interface_contact_loops",
    "support_material_synchronize_layers",
    "support_material_with_sheath",
    "thick_bridges",
    "thin_walls",
    "travel_lift_before_obstacle",
    "travel_ramping_lift",
    "use_firmware_retraction",
    "use_relative_e_distances",
    "use_volumetric_e",
    "variable_layer_height",
    "wipe",
    "wipe_into_infill",
    "wipe_into_objects",
    "wipe_tower",
    "wipe_tower_no_sparse_layers",
    "wiping_volumes_use_custom_matrix",
};

template <class List>
bool among(const List& list, std::string_view key) {
  return std::find(list.begin(), list.end(), key) != list.end();
}

}  // namespace

bool is_text_list(std::string_view key) {
  return among(text_lists, key);
}
bool is_flag(std::string_view key) {
  return among(flags, key);
}
bool is_text(std::string_view key) {
  return is_text_list(key) || among(single_texts, key);
}

std::vector<std::string> texts_of(std::string_view list) {
  std::vector<std::string> out;
  list = value::trimmed(list);
  while (!list.empty()) {
    std::string element;
    std::size_t i = 0;
    if (list.front() == '"') {
      for (i = 1; i < list.size() && list[i] != '"'; ++i) {
        if (list[i] == '\\' && i + 1 < list.size()) {
          const char c = list[++i];
          if (c != '"') element += '\\';
          element += c;
        } else {
          element += list[i];
        }
      }
      i = std::min(list.find(';', std::min(i + 1, list.size())), list.size());
    } else {
      i = std::min(list.find(';'), list.size());
      element = std::string(value::trimmed(list.substr(0, i)));
    }
    out.push_back(std::move(element));
    list = value::trimmed(list.substr(std::min(i + 1, list.size())));
  }
  return out;
}

std::vector<std::string> elements_of(std::string_view key, std::string_view text) {
  if (is_text_list(key)) return texts_of(text);
  if (is_text(key)) {
    if (text.size() >= 2 && text.front() == '"' && text.back() == '"') return texts_of(text);
    std::string out;  // a quote may be escaped in a single text as well
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (text[i] == '\\' && i + 1 < text.size() && text[i + 1] != '"')
        out += text[i++];
      else if (text[i] == '\\' && i + 1 < text.size())
        ++i;
      out += text[i];
    }
    return {out};
  }
  std::vector<std::string> out;
  for (;;) {
    const auto at = text.find(',');
    out.emplace_back(value::trimmed(text.substr(0, at)));
    if (at == std::string_view::npos) return out;
    text.remove_prefix(at + 1);
  }
}

std::string in_macro_words(std::string_view key, std::string_view text) {
  auto elements = elements_of(key, text);
  for (auto& element : elements) {
    if (is_text(key)) {
      std::string decoded;
      value::parse(element, Unit::none, decoded);
      element = quoted_variable(decoded);
    } else if (is_flag(key)) {
      element = element == "1" ? "true" : element == "0" ? "false" : element;
    }
  }
  return joined(elements);
}

}  // namespace weft::prusaslicer
