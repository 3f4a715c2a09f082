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
  began_ = true;
  ended_ = false;
  if (feature_ == custom_index) feature_ = 0;  // a layer's own moves come before its first feature is named
}

void Context::read(std::string_view c) {
  while (!c.empty() && scan::is_blank(c.front())) c.remove_prefix(1);
  if (c.empty()) return;
  switch (c.front()) {
    case 'T':
      if (take(c, "TYPE:"))
        set_feature(c);
      else if (c.starts_with("TIME_ELAPSED:") && layer_count_ > 0 && layer_ + 1 >= layer_count_)
        ended_ = true;  // Cura
      break;
    case 'F':
      if (take(c, "FEATURE:")) set_feature(c);  // Bambu
      break;
    case 'f':
      if (take(c, "feature ")) set_feature(c);  // Simplify3D
      break;
    case 'L':
      if (c.starts_with("LAYER_CHANGE"))
        next_layer(layer_ + 1);
      else if (take(c, "LAYER:"))
        next_layer(whole_from(c));
      else if (take(c, "LAYER_COUNT:"))
        layer_count_ = whole_from(c);
      else if (take(c, "LINE_WIDTH:"))
        width_mm_ = length_from(c);
      else if (take(c, "LAYER_HEIGHT:"))
        height_mm_ = length_from(c);
      break;
    case 'l':
      if (c.starts_with("layer ") && c.find(", Z =") != std::string_view::npos) next_layer(layer_ + 1);  // Simplify3D
      break;
    case 'B':
      if (c.starts_with("BEGIN_LAYER")) next_layer(layer_ + 1);  // KISSlicer
      break;
    case ';':
      if (c.starts_with("; --- layer ")) next_layer(layer_ + 1);  // Kiri:Moto
      break;
    case 'b':
      if (c == "brim") set_feature(c);  // weft, below PrusaSlicer's "Skirt/Brim"
      break;
    case 'C':
      if (c.starts_with("CHANGE_LAYER")) next_layer(layer_ + 1);  // Bambu
      break;
    case 'W':
      if (take(c, "WIDTH:")) width_mm_ = length_from(c);
      break;
    case 'H':
      if (take(c, "HEIGHT:")) height_mm_ = length_from(c);
      break;
    case 'M':
      if (take(c, "MESH:"))
        set_object(c == "NONMESH" ? std::string_view{} : c);
      else if (c.starts_with("MACHINE_END_GCODE_START"))
        ended_ = true;
      break;
    case 'E':
      if (c.starts_with("EXECUTABLE_BLOCK_END") || c.starts_with("End of Gcode")) ended_ = true;
      break;
    case 'O':
      if (take(c, "OBJECT_ID:")) set_object(c);  // Bambu
      break;
    case 'p':
      if (take(c, "printing object ")) set_object(c.substr(0, c.find(" id:")));
      break;
    case 's':
      if (c.starts_with("stop printing object"))
        set_object({});
      else if (take(c, "start printing object, unique label id:"))
        set_object(c);
      break;
    default:
      break;
  }
}

}  // namespace weft::audit
