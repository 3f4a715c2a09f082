// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/tints.h"

#include "core/number.h"
#include "mesh/three_mf_colours.h"
#include "settings/catalogue.h"
#include "settings/tools.h"
#include "tools/purge.h"

#include <algorithm>
#include <array>
#include <limits>

#include <fmt/format.h>

namespace weft::pipeline {
namespace {

/// Tools of features: paint is for all of them.
constexpr std::array feature_keys{"wall_extruder_nr",   "wall_0_extruder_nr",     "wall_x_extruder_nr",
                                  "infill_extruder_nr", "top_bottom_extruder_nr", "roofing_extruder_nr"};

void tell_once(Notices& notices, std::string code, std::string message) {
  const auto same = [&](const Notice& notice) { return notice.code == code && notice.message == message; };
  if (std::none_of(notices.begin(), notices.end(), same)) notices.push_back({std::move(code), std::move(message)});
}

std::string names_of_tools(std::size_t count) {
  return count == 1 ? "T0 alone" : fmt::format("T0 … T{}", count - 1);
}

/// The tool of the nearest filament. @param file for messages
std::optional<int> tool_for(Rgb colour, const Settings& plate, const std::string& file, Notices& notices) {
  const auto all = settings_of_tools(plate);
  std::optional<int> best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto& own = all[i].tools.filament_colour;
    const double differs = own ? tools::difference(*own, colour) : least;
    if (differs < least) least = differs, best = static_cast<int>(i);
  }
  if (!best && all.size() > 1)
    tell_once(notices, "colours_left_out",
              fmt::format("{}: its colours are left out: no tool has a filament_colour", file));
  if (best && all.size() > 1 && least > plate.tools.colour_match)
    tell_once(
        notices, "colour_far_off",
        fmt::format("{}: {} is printed with T{}, whose filament_colour is {} (ΔE {:.0f})", file, mesh::text_of(colour),
                    *best, mesh::text_of(*all[static_cast<std::size_t>(*best)].tools.filament_colour), least));
  return best;
}

/// Does anything that holds for the object name a tool for that feature?
bool is_named(const char* key, const Object& object, const Settings& plate) {
  const auto says = [&](const Overlay& overlay) {
    return std::any_of(overlay.values.begin(), overlay.values.end(),
                       [&](const auto& value) { return value.row->key == key; });
  };
  return find_setting(key)->print(plate) != "auto" || says(object.overlay) || says(object.said) ||
         std::any_of(object.ranges.begin(), object.ranges.end(), [&](const auto& r) { return says(r.overlay); }) ||
         std::any_of(object.volumes.begin(), object.volumes.end(),
                     [&](const Volume& volume) { return says(volume.overlay) || says(volume.said); });
}

}  // namespace

std::vector<mesh::ForeignSetting> with_extruders(std::vector<mesh::ForeignSetting> said, const Settings& plate,
                                                 const std::string& file, Notices& notices) {
  for (auto& setting : said) {
    if (setting.key != mesh::colour_key) continue;
    const auto colour = mesh::colour_of(setting.value);
    const auto tool = colour ? tool_for(*colour, plate, file, notices) : std::nullopt;
    setting = tool ? mesh::ForeignSetting{"extruder", std::to_string(*tool + 1)} : mesh::ForeignSetting{};
  }
  std::erase_if(said, [](const auto& setting) { return setting.key.empty(); });
  return said;
}

std::optional<Volume> tint_of(mesh::Mark mark, const Object& object, const Settings& plate, const std::string& file,
                              Notices& notices) {
  const auto said = with_extruders(std::move(mark.settings), plate, file, notices);
  if (said.empty()) return std::nullopt;
  const auto extruder = as_number<int>(said.front().value).value_or(0);
  const auto count = tool_count(plate);
  if (extruder < 1 || static_cast<std::size_t>(extruder) > count) {
    tell_once(notices, "paint_left_out",
              fmt::format("{}: object '{}': what is painted for extruder {} is left out: the printer has {}", file,
                          object.name, extruder, names_of_tools(count)));
    return std::nullopt;
  }
  const auto tool = std::to_string(extruder - 1);
  Volume out{.name = "T" + tool, .mesh = std::move(mark.mesh), .kind = VolumeKind::tint};
  out.overlay = {fmt::format("paint of object '{}' for T{}", object.name, tool), Scope::region};
  out.overlay.add("extruder_nr", tool, file);
  for (const char* key : feature_keys)
    if (is_named(key, object, plate)) out.overlay.add(key, tool, file);
  return out;
}

void join(Volume& tint, Mesh facets) {
  const auto first = static_cast<std::uint32_t>(tint.mesh.vertices.size());
  tint.mesh.vertices.insert(tint.mesh.vertices.end(), facets.vertices.begin(), facets.vertices.end());
  for (const auto& [a, b, c] : facets.triangles) tint.mesh.triangles.push_back({a + first, b + first, c + first});
}

}  // namespace weft::pipeline
