// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/layer_heights.h"

#include "slice/heights.h"

#include <algorithm>
#include <cstdlib>

namespace weft::pipeline {
namespace {

/// Where layers have heights of their own: what the settings of the object say, and its ranges.
HeightBands bands_of(const Object& object, const ObjectScopes& scopes, const SliceHands& handed) {
  HeightBands out;
  for (const auto& range : object.ranges) {
    const auto& laid = range.overlay.values;
    if (std::none_of(laid.begin(), laid.end(), [](const Laid& value) { return value.row->key == "layer_height"; }))
      continue;
    const auto& [layers, nozzle] = handed[at(scopes, std::max(range.from, Um{1})).of_mix.front()];
    out.push_back({range.from, range.to, layers.layer_height});
  }
  const auto& [layers, nozzle] = handed[scopes.front().of_mix.front()];
  out.insert(out.end(), layers.layer_height_ranges.begin(), layers.layer_height_ranges.end());
  std::stable_sort(out.begin(), out.end(), [](const HeightBand& a, const HeightBand& b) { return a.from < b.from; });
  return out;
}

/// Heights by where layers begin, bands among them.
std::vector<slice::HeightFrom> heights_of(const ObjectScopes& scopes, const SliceHands& handed,
                                          const HeightBands& own) {
  std::vector<slice::HeightFrom> out;
  for (const auto& from : scopes) {
    const auto& [layers, nozzle] = handed[from.of_mix.front()];
    out.push_back({from.bottom, layers.layer_height});
  }
  const auto height_at = [&](Um bottom) {
    const auto above = std::upper_bound(out.begin(), out.end(), bottom,
                                        [](Um b, const slice::HeightFrom& from) { return b < from.bottom; });
    return std::prev(above)->layer_height;
  };
  for (const HeightBand& band : own) {
    // The first layer has a height of its own, unless nothing says one.
    const auto& [layers, nozzle] = handed[scopes.front().of_mix.front()];
    const Um from = band.from == 0 && layers.initial_layer_height ? 1 : band.from;
    const Um after = height_at(band.to);
    std::erase_if(out, [&](const auto& each) { return each.bottom >= from && each.bottom <= band.to; });
    out.push_back({from, band.height});
    out.push_back({band.to, after});
    std::sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.bottom < b.bottom; });
  }
  return out;
}

/// Layers by the surface, and between them those of bands.
class Fitted {
 public:
  Fitted(const slice::Relief& relief, const slice::HeightRules& rules, Um top)
      : relief_(relief), rules_(rules), top_(top) {}

  void add_uniform(Um height, Um to) {
    while (z_ < to && z_ + height / 2 <= top_) {
      out_.push_back({z_ + height, height, std::min(z_ + height / 2, top_ - 1)});
      z_ += height;
    }
  }
  void add_fitted(Um to) {
    const auto before = out_.empty() ? std::nullopt : std::optional(out_.back().height);
    auto planes = slice::fitted_planes(relief_, rules_, z_, std::min(to, top_), before);
    if (!planes.empty()) z_ = planes.back().z;
    out_.insert(out_.end(), planes.begin(), planes.end());
  }
  std::vector<slice::Plane> take() && { return std::move(out_); }

 private:
  const slice::Relief& relief_;
  const slice::HeightRules& rules_;
  Um top_, z_ = 0;
  std::vector<slice::Plane> out_;
};

}  // namespace

bool follows_profile(const Object& object, Um top) {
  constexpr Um as_high = 50;
  return !object.heights.empty() && std::abs(object.heights.back().z - top) <= as_high;
}

std::vector<slice::Plane> layers_of(const Object& object, const ObjectScopes& scopes, const SliceHands& handed,
                                    Um top) {
  const auto& [layers, nozzle] = handed[scopes.front().of_mix.front()];
  const Um first = layers.layer_height;
  if (follows_profile(object, top))
    return slice::profile_planes(object.heights, first, layers.adaptive_layer_height_min, top);
  const auto bands = bands_of(object, scopes, handed);
  const bool adaptive = layers.adaptive_layer_height_enabled;
  const bool flats = layers.adaptive_layer_height_flats.value_or(adaptive);
  const auto heights = heights_of(scopes, handed, layers.layer_height_ranges);
  if (!adaptive && !flats) return slice::planes(heights, top);

  std::vector<const Mesh*> meshes;
  for (const auto& volume : object.volumes)
    if (volume.kind == VolumeKind::model) meshes.push_back(&volume.mesh);
  const auto relief = slice::relief_of(meshes, top, layers.adaptive_layer_height_error);
  const auto& [usual, same_nozzle] = handed[at(scopes, 1).of_mix.front()];
  slice::HeightRules rules{.flats = flats};
  if (adaptive) {
    rules.least = layers.adaptive_layer_height_min;
    rules.most = layers.adaptive_layer_height_max.value_or(nozzle * 3 / 4);
  } else {
    rules.wanted = usual.layer_height;
    rules.least = rounded(usual.layer_height * 0.9), rules.most = rounded(usual.layer_height * 1.1);
  }
  Fitted out(relief, rules, top);
  out.add_uniform(heights.front().layer_height, 1);
  for (const HeightBand& band : bands) {
    out.add_fitted(band.from);
    out.add_uniform(band.height, band.to);
  }
  out.add_fitted(top);
  return std::move(out).take();
}

}  // namespace weft::pipeline
