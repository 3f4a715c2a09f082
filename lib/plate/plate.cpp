// SPDX-License-Identifier: GPL-3.0-or-later
#include "plate/plate.h"

#include "core/error.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace weft {

std::string_view name_of(VolumeKind kind) {
  constexpr std::array<std::string_view, 6> names{"model",           "negative volume", "modifier", "support enforcer",
                                                  "support blocker", "support"};
  return names[static_cast<std::size_t>(kind)];
}

std::size_t copies_on(const Plate& plate) {
  std::size_t copies = 0;
  for (const auto& object : plate.objects) copies += object.copies.size();
  return copies;
}

void check_printable(const Plate& plate) {
  if (plate.objects.empty()) throw Error{Error::Kind::model, "the plate holds no objects", {}, {}};
  for (const auto& object : plate.objects) {
    const auto refuse = [&](std::string what) {
      throw Error{Error::Kind::model, fmt::format("object '{}': {}", object.name, what), {}, {}};
    };
    if (object.copies.empty()) refuse("no copy of it stands on the plate");
    if (object.volumes.empty()) refuse("it has no volumes");
    for (const auto& volume : object.volumes)
      if (volume.kind != VolumeKind::model)
        refuse(
            fmt::format("a {} ('{}') has no effect on a print yet; leave it out", name_of(volume.kind), volume.name));
  }
}

std::string overlay_lines(const Plate& plate) {
  std::string out;
  const auto add = [&](const Overlay& overlay) {
    for (const auto& laid : overlay.values)
      out += fmt::format("; weft_overlay = {}: {} = {} ({})\n", overlay.what, laid.row->key, laid.origin.text,
                         laid.origin.where);
  };
  for (const auto& object : plate.objects) {
    add(object.overlay);
    for (const auto& range : object.ranges) add(range.overlay);
    for (const auto& volume : object.volumes) add(volume.overlay);
  }
  return out;
}

std::vector<Um> heights_of_change(const Object& object) {
  std::vector<Um> heights{0};
  for (const auto& range : object.ranges)
    if (range.from < range.to) heights.push_back(std::max<Um>(range.from, 0)), heights.push_back(range.to);
  std::sort(heights.begin(), heights.end());
  heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
  while (heights.front() < 0) heights.erase(heights.begin());
  return heights;
}

std::vector<const Overlay*> overlays_at(const Object& object, const Volume& volume, Um bottom) {
  std::vector<const Overlay*> out{&object.overlay};
  for (const auto& range : object.ranges)
    if (bottom >= range.from && bottom < range.to) out.push_back(&range.overlay);
  out.push_back(&volume.overlay);
  return out;
}

}  // namespace weft
