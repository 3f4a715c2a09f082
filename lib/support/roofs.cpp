// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/roofs.h"

#include "core/stop.h"
#include "geometry/boolean.h"
#include "support/branch_areas.h"
#include "support/columns.h"
#include "support/lengths.h"
#include "tasks/parallel.h"

#include <algorithm>
#include <utility>

namespace weft::support {
namespace {

/// What of a contact, together with those of its neighbours, is wide enough to lie on more than one branch.
Regions wide_part(const std::vector<Regions>& contacts, std::size_t k, std::size_t count, Um least) {
  Regions around;
  for (std::size_t j = k >= count ? k - count + 1 : 0; j < std::min(contacts.size(), k + count); ++j)
    append(around, contacts[j]);
  const Regions wide = geometry::opening(grown(geometry::unite(around), 20), least / 2);
  return wide.empty() ? wide : geometry::opening(geometry::intersect(contacts[k], grown(wide, 50)), 20);
}

}  // namespace

Roofs::Roofs(const SupportSettings& settings, const Object& object, const Stack& stack,
             const std::vector<Regions>& contacts)
    : s_(settings),
      o_(object),
      stack_(stack),
      contacts_(contacts),
      bare_(contacts.size()),
      begins_(contacts.size()),
      laid_(contacts.size()),
      held_from_(contacts.size()),
      wide_(contacts.size()) {
  if (!settings.support_roof_enable || settings.support_roof_height <= 0) {
    bare_ = contacts;
    return;
  }
  const Um least = branch_style(settings).tip * 3 / 2;
  wide_ = tasks::parallel_map(contacts.size(), [&](std::size_t k) {
    stop_if_asked();
    if (contacts[k].empty()) return Regions{};
    return wide_part(contacts, k, interface_levels(stack, k, settings.support_roof_height), least);
  });
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    if (contacts[k].empty()) continue;
    bare_[k] =
        wide_[k].empty() ? contacts[k] : geometry::opening(geometry::subtract(contacts[k], grown(wide_[k], 100)), 20);
    if (wide_[k].empty()) continue;
    const std::size_t count = interface_levels(stack, k, settings.support_roof_height);
    if (count > k) {  // it lies on the plate
      for (std::size_t j = 0; j <= k; ++j) append(laid_[j], wide_[k]);
      continue;
    }
    held_from_[k - count].push_back(k);
    append(begins_[k - count], wide_[k]);
  }
  for (auto& regions : begins_)
    if (regions.size() > 1) regions = geometry::unite(regions);
}

void Roofs::rest(std::size_t level, const std::vector<Point>& branches, Um spans) {
  const Box box = box_of(begins_[level]).grown(spans);
  std::vector<Ring> rings;
  for (const Point p : branches)
    if (box.contains(p)) rings.push_back(circle_around({p, static_cast<double>(spans)}));
  if (rings.empty()) return;
  const Regions held = geometry::regions_from_rings(rings);
  for (const std::size_t k : held_from_[level]) {
    const Regions part = geometry::intersect(wide_[k], held);
    for (std::size_t j = level + 1; j <= k; ++j) append(laid_[j], part);
  }
}

std::vector<Regions> Roofs::areas(const std::vector<KeepOut>& keep_out) && {
  const Um line = line_width(s_, o_.nozzle);
  return tasks::parallel_map(laid_.size(), [&](std::size_t k) {
    if (laid_[k].empty()) return Regions{};
    stop_if_asked();
    Regions area = geometry::unite(laid_[k]);
    if (s_.support_join_distance > 0) area = geometry::closing(area, s_.support_join_distance / 2);
    thicken(area, area, line);
    return geometry::opening(free_part(area, keep_out[k], geometry::unite(laid_[k]), o_), line * 4 / 10);
  });
}

}  // namespace weft::support
