// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/three_mf_colours.h"

#include "core/number.h"

#include <algorithm>
#include <charconv>
#include <set>
#include <tuple>

#include <fmt/format.h>

namespace weft::mesh {
namespace {

/// More colours than any printer has filaments are told apart in steps of 16 only.
constexpr std::size_t most_colours = 64;
constexpr int coarse_step = 16;

std::tuple<int, int, int> key_of(Rgb c) {
  return {c.r, c.g, c.b};
}

Rgb coarse(Rgb c) {
  const auto step = [](std::uint8_t v) {
    return static_cast<std::uint8_t>(std::min(255, v / coarse_step * coarse_step + coarse_step / 2));
  };
  return {step(c.r), step(c.g), step(c.b)};
}

}  // namespace

std::optional<Rgb> colour_of(std::string_view text) {
  if ((text.size() != 7 && text.size() != 9) || text.front() != '#') return std::nullopt;
  Rgb out;
  std::uint8_t* const channels[] = {&out.r, &out.g, &out.b};
  for (std::size_t i = 0; i < 3; ++i) {
    const char* begin = text.data() + 1 + 2 * i;
    const auto read = std::from_chars(begin, begin + 2, *channels[i], 16);
    if (read.ec != std::errc() || read.ptr != begin + 2) return std::nullopt;
  }
  return out;
}

std::string text_of(Rgb colour) {
  return fmt::format("#{:02X}{:02X}{:02X}", colour.r, colour.g, colour.b);
}

std::optional<Rgb> PropertyGroups::find(std::uint32_t group, std::uint32_t index) const {
  const auto at = groups_.find(group);
  return at == groups_.end() || index >= at->second.size() ? std::nullopt : at->second[index];
}

void settle_colours(Resource& resource) {
  auto& own = resource.coloured;
  const bool all = own.size() == resource.triangles.size() && !own.empty();
  if (all && std::all_of(own.begin(), own.end(), [&](const auto& c) { return c.colour == own.front().colour; }))
    resource.colour = own.front().colour;
  std::erase_if(own, [&](const auto& c) { return resource.colour == c.colour; });
  std::set<std::tuple<int, int, int>> different;
  for (const auto& c : own)
    if (different.insert(key_of(c.colour)); different.size() > most_colours) break;
  if (different.size() > most_colours)
    for (auto& c : own) c.colour = coarse(c.colour);
}

void tell_colours(ThreeMf& document) {
  const auto setting = [](Rgb colour) { return ForeignSetting{std::string(colour_key), text_of(colour)}; };
  auto& said = document.parts.objects;
  std::set<std::uint32_t> printed;
  for (const auto& item : document.items)
    if (item.object.first == document.root) printed.insert(item.object.second);
  for (const auto id : printed) {
    const auto object = document.objects.find({document.root, id});
    if (object == document.objects.end() || said.contains(id)) continue;
    if (object->second.colour) said[id].settings.push_back(setting(*object->second.colour));
    const auto& components = object->second.components;
    const auto part_of = [&](const Reference& component) -> const Resource* {
      const auto at = document.objects.find(component.object);
      return at == document.objects.end() ? nullptr : &at->second;
    };
    const auto is_coloured = [&](const Reference& component) {
      const auto* part = part_of(component);
      return part != nullptr && part->colour.has_value();
    };
    if (std::none_of(components.begin(), components.end(), is_coloured)) continue;
    if (components.size() == 1) said[id].settings.push_back(setting(*part_of(components.front())->colour));
    if (components.size() == 1) continue;
    for (const auto& component : components) {
      auto& volumes = said[id].components;
      VolumeSaid volume{.number = volumes.size()};
      if (const auto* part = part_of(component)) volume.name = part->name;
      if (is_coloured(component)) volume.settings = {setting(*part_of(component)->colour)};
      volumes.try_emplace(component.object.second, std::move(volume));
    }
  }
}

}  // namespace weft::mesh
