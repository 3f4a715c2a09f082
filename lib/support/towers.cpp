// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/towers.h"

#include "geometry/boolean.h"
#include "support/branch_areas.h"
#include "support/lengths.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft::support {
namespace {

bool on_tower(const SupportSettings& s, const Region& region) {
  const Point size = box_of(region.outer).size();
  return s.support_use_towers && std::max(size.x, size.y) <= s.support_tower_maximum_supported_diameter;
}

}  // namespace

TowersAndOthers for_towers(const SupportSettings& settings, const std::vector<Regions>& contacts) {
  TowersAndOthers out{std::vector<Regions>(contacts.size()), std::vector<Regions>(contacts.size())};
  for (std::size_t k = 0; k < contacts.size(); ++k)
    for (const Region& region : contacts[k])
      (on_tower(settings, region) ? out.towers : out.others)[k].push_back(region);
  return out;
}

void Towers::begin(const Regions& contacts, Um z) {
  for (const Region& region : contacts)
    if (on_tower(s_, region)) growing_.push_back({box_of(region.outer), z});
}

bool Towers::add(Um z, Regions& falling) {
  const double most = s_.support_tower_diameter / 2.0;
  std::vector<Ring> rings;
  std::erase_if(growing_, [&](const Tower& tower) {
    const double least = std::max(tower.box.size().x, tower.box.size().y) / 2.0;
    const double slope = std::tan(s_.support_tower_roof_angle * std::numbers::pi / 180);
    const double radius = slope > 0 ? std::min(most, least + (tower.z - z) / slope) : most;
    if (radius > 0) rings.push_back(circle_around({tower.box.centre(), radius}));
    return radius >= most;
  });
  if (rings.empty()) return false;
  append(falling, geometry::regions_from_rings(rings));
  falling = geometry::unite(falling);
  return true;
}

}  // namespace weft::support
