// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/sequence.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace weft {
namespace {

struct Found {
  LayerHeight at;
  TimelineLayer::Part part;
};

/// All layers of a pass, upwards, then by object.
std::vector<Found> layers_of(const Pass& pass, std::span<const Stack> stacks) {
  std::vector<ObjectId> wanted = pass.objects;
  std::sort(wanted.begin(), wanted.end());
  std::vector<Found> found;
  for (std::uint32_t s = 0; s < stacks.size(); ++s)
    for (const auto& member : stacks[s].objects) {
      if (!std::binary_search(wanted.begin(), wanted.end(), member.object)) continue;
      for (std::uint32_t i = 0; i < member.layers; ++i)
        if (const auto& at = stacks[s].layers[i]; at.z > pass.from && at.z <= pass.to)
          found.push_back({at, {member.object, i, s}});
    }
  std::sort(found.begin(), found.end(), [](const Found& a, const Found& b) {
    return std::tuple(a.at.z, a.part.object, a.part.stack) < std::tuple(b.at.z, b.part.object, b.part.stack);
  });
  return found;
}

}  // namespace

Sequence by_layer(std::size_t objects) {
  Pass all;
  all.objects.resize(objects);
  std::iota(all.objects.begin(), all.objects.end(), ObjectId{0});
  return {std::move(all)};
}

Timeline timeline_of(const Sequence& sequence, std::span<const Stack> stacks) {
  Timeline out;
  for (std::uint32_t p = 0; p < sequence.size(); ++p) {
    const auto found = layers_of(sequence[p], stacks);
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (i == 0 || found[i].at.z != found[i - 1].at.z) {
        TimelineLayer next;
        next.z = found[i].at.z;
        next.time.index = static_cast<std::uint32_t>(out.size());
        next.time.pass = p;
        if (!out.empty()) {
          const auto& before = out.back();
          const bool same_rise = sequence[before.time.pass].rise == sequence[p].rise;
          next.time.comes_down = !same_rise;
          next.time.number = same_rise ? before.time.number + (next.z != before.z ? 1 : 0) : 0;
        }
        out.push_back(std::move(next));
      }
      out.back().height = std::max(out.back().height, found[i].at.height);
      out.back().parts.push_back(found[i].part);
    }
  }
  return out;
}

}  // namespace weft
