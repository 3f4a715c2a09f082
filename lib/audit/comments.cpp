// SPDX-License-Identifier: GPL-3.0-or-later
#include "audit/comments.h"

#include "audit/scan.h"

#include <algorithm>
#include <array>
#include <charconv>

namespace weft::audit {
namespace {

struct FeatureName {
  std::string_view slicers, wefts;
};

// Sorted by the slicer's name in lower case, with its spaces as they are.
constexpr std::array feature_names{
    FeatureName{"bottom surface", "skin"},
    FeatureName{"bridge", "bridge"},
    FeatureName{"bridge infill", "bridge"},
    FeatureName{"brim", "brim"},
    FeatureName{"custom", "custom"},
    FeatureName{"external perimeter", "outer_wall"},
    FeatureName{"fill", "infill"},
    FeatureName{"gap fill", "gap_fill"},
    FeatureName{"gap infill", "gap_fill"},
    FeatureName{"infill", "infill"},
    FeatureName{"inner perimeter", "inner_wall"},
    FeatureName{"inner wall", "inner_wall"},
    FeatureName{"internal bridge", "bridge"},
    FeatureName{"internal bridge infill", "bridge"},
    FeatureName{"internal infill", "infill"},
    FeatureName{"internal perimeter", "inner_wall"},
    FeatureName{"internal solid infill", "skin"},
    FeatureName{"ironing", "ironing"},
    FeatureName{"outer perimeter", "outer_wall"},
    FeatureName{"outer wall", "outer_wall"},
    FeatureName{"overhang perimeter", "overhang_wall"},
    FeatureName{"overhang wall", "overhang_wall"},
    FeatureName{"perimeter", "inner_wall"},
    FeatureName{"prime tower", "wipe_tower"},
    FeatureName{"prime-tower", "wipe_tower"},
    FeatureName{"skin", "skin"},
    FeatureName{"skirt", "skirt"},
    FeatureName{"skirt/brim", "skirt"},
    FeatureName{"solid infill", "skin"},
    FeatureName{"solid layer", "skin"},
    FeatureName{"sparse infill", "infill"},
    FeatureName{"support", "support"},
    FeatureName{"support interface", "support_interface"},
    FeatureName{"support material", "support"},
    FeatureName{"support material interface", "support_interface"},
    FeatureName{"support transition", "support"},
    FeatureName{"support-interface", "support_interface"},
    FeatureName{"thin wall", "thin_wall"},
    FeatureName{"top solid infill", "top_skin"},
    FeatureName{"top surface", "top_skin"},
    FeatureName{"wall-inner", "inner_wall"},
    FeatureName{"wall-outer", "outer_wall"},
    FeatureName{"wipe tower", "wipe_tower"},
};
static_assert(std::is_sorted(feature_names.begin(), feature_names.end(),
                             [](const FeatureName& a, const FeatureName& b) { return a.slicers < b.slicers; }));

bool take(std::string_view& text, std::string_view prefix) {
  if (!text.starts_with(prefix)) return false;
  text.remove_prefix(prefix.size());
  while (!text.empty() && scan::is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && (scan::is_blank(text.back()) || text.back() == '\r')) text.remove_suffix(1);
  return true;
}

double length_from(std::string_view text) {
  double v = 0;
  std::from_chars(text.data(), text.data() + text.size(), v);
  return v > 0 && v < 100 ? v : 0;
}

int whole_from(std::string_view text) {
  int v = 0;
  std::from_chars(text.data(), text.data() + text.size(), v);
  return v;
}

}  // namespace

Context::Context() : names_{"", "custom"} {}

void Context::set_feature(std::string_view slicers_name) {
  std::array<char, most_name> lower;
  const std::size_t n = std::min(slicers_name.size(), lower.size());
  std::transform(slicers_name.begin(), slicers_name.begin() + static_cast<std::ptrdiff_t>(n), lower.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  std::string_view name(lower.data(), n);
  const auto known = std::lower_bound(feature_names.begin(), feature_names.end(), name,
                                      [](const FeatureName& f, std::string_view key) { return f.slicers < key; });
  if (known != feature_names.end() && known->slicers == name) name = known->wefts;
  auto at = std::find(names_.begin(), names_.end(), name);
  if (at == names_.end() && names_.size() < most_names) at = names_.emplace(names_.end(), name);
  feature_ = at == names_.end() ? std::uint8_t{0} : static_cast<std::uint8_t>(at - names_.begin());
  if (feature_ != custom_index) began_ = true;
}

void Context::next_layer(int number) {
  layer_ = number;
  layer_height_mm_ = 0;
  began_ = true;
  ended_ = false;
  if (feature_ == custom_index) feature_ = 0;  // a layer's own moves come before its first feature is named
}

void Context::layer_named(std::string_view number) {
  next_layer(whole_from(number));
}

void Context::one_layer_on(std::string_view) {
  next_layer(layer_ + 1);
}

/// Simplify3D: "layer 2, Z = 0.4".
void Context::layer_at_height(std::string_view rest) {
  if (rest.find(", Z =") != std::string_view::npos) next_layer(layer_ + 1);
}

void Context::count_layers(std::string_view number) {
  layer_count_ = whole_from(number);
}

/// Cura says the time after each layer.
void Context::layer_done(std::string_view) {
  if (layer_count_ > 0 && layer_ + 1 >= layer_count_) ended_ = true;
}

void Context::end(std::string_view) {
  ended_ = true;
}

void Context::set_width(std::string_view length) {
  width_mm_ = length_from(length);
}

void Context::set_height(std::string_view length) {
  height_mm_ = length_from(length);
  if (layer_height_mm_ == 0) layer_height_mm_ = height_mm_;
}

/// weft, below PrusaSlicer's "Skirt/Brim".
void Context::brim(std::string_view rest) {
  if (rest.empty()) set_feature("brim");
}

/// weft, below "Bridge infill".
void Context::overhang(std::string_view rest) {
  if (rest.empty()) set_feature("overhang_skin");
}

void Context::mesh(std::string_view name) {
  labels_meshes_ = true;
  set_object(name == "NONMESH" ? std::string_view{} : name);
}

void Context::printing_object(std::string_view rest) {
  set_object(rest.substr(0, rest.find(" id:")), rest);
}

void Context::no_object(std::string_view) {
  set_object({});
}

void Context::read(std::string_view c) {
  struct Sign {
    std::string_view prefix;
    void (Context::*read)(std::string_view rest);
  };
  using C = Context;
  static constexpr Sign signs[] = {
      {"TYPE:", &C::set_feature},
      {"WIDTH:", &C::set_width},
      {"HEIGHT:", &C::set_height},
      {"LAYER_CHANGE", &C::one_layer_on},
      {"LAYER:", &C::layer_named},
      {"LAYER_COUNT:", &C::count_layers},
      {"TIME_ELAPSED:", &C::layer_done},
      {"MESH:", &C::mesh},
      {"printing object ", &C::printing_object},
      {"stop printing object", &C::no_object},
      {"brim", &C::brim},
      {"overhang", &C::overhang},
      {"CHANGE_LAYER", &C::one_layer_on},  // Bambu
      {"FEATURE:", &C::set_feature},
      {"LINE_WIDTH:", &C::set_width},
      {"LAYER_HEIGHT:", &C::set_height},
      {"OBJECT_ID:", &C::set_object},
      {"start printing object, unique label id:", &C::set_object},
      {"MACHINE_END_GCODE_START", &C::end},
      {"EXECUTABLE_BLOCK_END", &C::end},
      {"End of Gcode", &C::end},
      {"feature ", &C::set_feature},  // Simplify3D
      {"layer ", &C::layer_at_height},
      {"BEGIN_LAYER", &C::one_layer_on},   // KISSlicer
      {"; --- layer ", &C::one_layer_on},  // Kiri:Moto
  };
  while (!c.empty() && scan::is_blank(c.front())) c.remove_prefix(1);
  if (c.empty()) return;
  for (const Sign& s : signs)
    if (s.prefix.front() == c.front() && take(c, s.prefix)) return (this->*s.read)(c);
}

}  // namespace weft::audit
