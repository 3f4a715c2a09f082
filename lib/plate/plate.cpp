// SPDX-License-Identifier: GPL-3.0-or-later
#include "plate/plate.h"

#include "core/error.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace weft {

std::string_view name_of(VolumeKind kind) {
  constexpr std::array<std::string_view, 7> names{
      "model", "negative volume", "modifier", "paint", "support enforcer", "support blocker", "support"};
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
    const auto is = [](VolumeKind kind) { return [kind](const Volume& volume) { return volume.kind == kind; }; };
    if (std::none_of(object.volumes.begin(), object.volumes.end(), is(VolumeKind::model)))
      refuse("it has no part that is printed");
    for (const auto& volume : object.volumes)
      if (volume.kind > VolumeKind::tint)
        refuse(fmt::format("a {} ('{}') is a mark, not a volume", name_of(volume.kind), volume.name));
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
    add(object.said);
    for (const auto& volume : object.volumes) add(volume.said);
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

std::vector<const Overlay*> overlays_at(const Object& object, const Volume& part, Um bottom,
                                        std::span<const std::size_t> modifiers) {
  std::vector<const Overlay*> out{&object.overlay};
  for (const auto& range : object.ranges)
    if (bottom >= range.from && bottom < range.to) out.push_back(&range.overlay);
  out.push_back(&part.overlay);
  for (const std::size_t m : modifiers) out.push_back(&object.volumes[m].overlay);
  out.push_back(&object.said);
  out.push_back(&part.said);
  for (const std::size_t m : modifiers) out.push_back(&object.volumes[m].said);
  return out;
}

namespace {

Box3 common(const Box3& a, const Box3& b) {
  return {{std::max(a.min.x, b.min.x), std::max(a.min.y, b.min.y), std::max(a.min.z, b.min.z)},
          {std::min(a.max.x, b.max.x), std::min(a.max.y, b.max.y), std::min(a.max.z, b.max.z)}};
}

constexpr std::size_t most_mixes = 4096;  // of an object; scopes are numbered by two bytes

}  // namespace

std::vector<Mix> mixes_of(const Object& object) {
  std::vector<Mix> out;
  std::vector<Box3> boxes;  // beside them: where all of a mix overlap
  std::vector<std::size_t> modifiers;
  for (std::size_t v = 0; v < object.volumes.size(); ++v) {
    if (object.volumes[v].kind == VolumeKind::model)
      out.push_back({v}), boxes.push_back(box_of(object.volumes[v].mesh));
    if (object.volumes[v].kind == VolumeKind::modifier) modifiers.push_back(v);
  }
  const std::size_t with_volumes = modifiers.size();
  for (std::size_t v = 0; v < object.volumes.size(); ++v)
    if (object.volumes[v].kind == VolumeKind::tint) modifiers.push_back(v);
  std::size_t untinted = 0;  // of the mixes; there is one paint in a place
  for (std::size_t n = 0; n < modifiers.size(); ++n) {
    const std::size_t m = modifiers[n];
    const bool tints = n >= with_volumes;
    if (!tints || n == with_volumes) untinted = out.size();
    const Box3 box = box_of(object.volumes[m].mesh);
    for (std::size_t i = 0; i < untinted; ++i) {
      const Box3 both = tints ? boxes[i] : common(boxes[i], box);  // paint reaches into the part
      if (both.empty()) continue;
      Mix mix = out[i];
      mix.modifiers.push_back(m);
      out.push_back(std::move(mix)), boxes.push_back(both);
      if (out.size() > most_mixes)
        throw Error{Error::Kind::settings,
                    fmt::format("object '{}': its modifiers overlap in more than {} ways", object.name, most_mixes),
                    {},
                    "join those that say the same"};
    }
  }
  return out;
}

}  // namespace weft
