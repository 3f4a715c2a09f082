// SPDX-License-Identifier: GPL-3.0-or-later
#include "slice/heights.h"

#include "core/stop.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>

namespace weft::slice {
namespace {

constexpr float never = std::numeric_limits<float>::infinity();
constexpr Um step = Relief::step;

// What a way is judged by: a layer costs 1.
constexpr float missed_50_um = 3;        // a face that lies 50 µm off the end of a layer
constexpr float another_height = 0.02F;  // a layer that is 10 µm higher or lower than the one below
constexpr float not_as_wanted = 0.02F;   // … than wanted

/// The cheapest layers from a height on: boundaries lie on steps, each with the height of the layer that ends there.
class Way {
 public:
  Way(const Relief& relief, const HeightRules& rules, Um from, Um to)
      : relief_(relief), rules_(rules), from_(from), to_(to) {
    least_ = std::max(1, (rules.least + step - 1) / step);
    count_ = static_cast<std::size_t>(std::max(rules.most / step, least_) - least_) + 1;
    target_ = (to - from + step / 2) / step;
    beyond_ = least_ / 2;
    cells_ = static_cast<std::size_t>(target_ + beyond_) + 1;
    cost_.assign(cells_ * count_, never);
    came_.assign(cells_ * count_, 0);
  }

  std::vector<Plane> planes(std::optional<Um> before) {
    StopNowAndThen stop(256);
    for (std::size_t k = 0; k < cells_; ++k) {
      stop.step();
      if (k == 0)
        begin(before);
      else
        arrive(k);
      leave(k);
    }
    return back();
  }

 private:
  Um z_of(std::size_t k) const { return from_ + static_cast<Um>(k) * step; }
  Um height_of(std::size_t j) const { return (least_ + static_cast<Um>(j)) * step; }

  /// Whatever the layer below is like, what differs from it costs.
  void begin(std::optional<Um> before) {
    best_.assign(count_, 0), from_height_.assign(count_, 0);
    for (std::size_t j = 0; j < count_ && before; ++j)
      best_[j] = another_height * static_cast<float>(std::abs(height_of(j) - *before)) / step;
  }

  /// For each height of the next layer, which height below it comes from at least cost.
  void arrive(std::size_t k) {
    const float* cost = &cost_[k * count_];
    best_.assign(cost, cost + count_);
    for (std::size_t j = 0; j < count_; ++j) from_height_[j] = static_cast<std::uint16_t>(j);
    const auto pass = [&](std::size_t j, std::size_t other) {
      if (best_[other] + another_height < best_[j])
        best_[j] = best_[other] + another_height, from_height_[j] = from_height_[other];
    };
    for (std::size_t j = 1; j < count_; ++j) pass(j, j - 1);
    for (std::size_t j = count_ - 1; j-- > 0;) pass(j, j + 1);
  }

  void leave(std::size_t k) {
    const std::size_t cell = static_cast<std::size_t>(z_of(k)) / static_cast<std::size_t>(step);
    const Flat* flat = relief_.flats.data();
    const Flat* const end = flat + (rules_.flats ? relief_.flats.size() : 0);
    flat = std::upper_bound(flat, end, z_of(k), [](Um z, const Flat& f) { return z < f.z; });
    for (std::size_t j = 0; j < count_; ++j) {
      const Um height = height_of(j);
      const std::size_t to = k + static_cast<std::size_t>(height / step);
      if (to >= cells_ || (j > 0 && !allowed(cell, height))) break;
      if (best_[j] == never) continue;
      const float cost = best_[j] + of_layer(height) + of_flats(flat, end, z_of(k), height);
      if (float& known = cost_[to * count_ + j]; cost < known) known = cost, came_[to * count_ + j] = from_height_[j];
    }
  }
  /// May a layer from that step on be so high?
  bool allowed(std::size_t cell, Um height) const {
    if (rules_.wanted) return true;
    const std::size_t last = cell + static_cast<std::size_t>(height / step);
    for (std::size_t i = cell; i < last && i < relief_.most.size(); ++i)
      if (relief_.most[i] < height) return false;
    return true;
  }
  float of_layer(Um height) const {
    return rules_.wanted ? not_as_wanted * static_cast<float>(std::abs(height - *rules_.wanted)) / step : 1;
  }
  static float of_miss(Um um) { return missed_50_um * static_cast<float>(um) / 50; }
  static float of_flats(const Flat* flat, const Flat* end, Um z, Um height) {
    float sum = 0;
    for (; flat != end && flat->z < z + height; ++flat) sum += of_miss(std::min(flat->z - z, z + height - flat->z));
    return sum;
  }

  std::vector<Plane> back() const {
    std::size_t k = 0, j = 0;
    float least = never;
    for (std::size_t end = static_cast<std::size_t>(std::max(target_ - beyond_, 1)); end < cells_; ++end)
      for (std::size_t h = 0; h < count_; ++h) {
        const float cost = cost_[end * count_ + h] +
                           of_miss(static_cast<Um>(std::abs(static_cast<std::int64_t>(end) - target_)) * step);
        if (cost < least) least = cost, k = end, j = h;
      }
    std::vector<Plane> out;
    if (least == never) return out;
    for (std::size_t at = k; at > 0;) {
      const Um height = height_of(j);
      out.push_back({z_of(at), height, 0});
      const std::size_t came = came_[at * count_ + j];
      at -= static_cast<std::size_t>(height / step);
      j = came;
    }
    std::reverse(out.begin(), out.end());
    if (static_cast<Um>(k) == target_) out.back().z = to_;
    settle(out);
    return out;
  }

  /// Ends of layers that lie less than a step off a face are moved there; heights follow.
  void settle(std::vector<Plane>& planes) const {
    if (rules_.flats)
      for (std::size_t i = 0; i + 1 < planes.size(); ++i) {
        const auto near = std::lower_bound(relief_.flats.begin(), relief_.flats.end(), planes[i].z - step + 1,
                                           [](const Flat& f, Um z) { return f.z < z; });
        if (near != relief_.flats.end() && near->z < planes[i].z + step) planes[i].z = near->z;
      }
    Um below = from_;
    for (Plane& plane : planes) plane.height = plane.z - below, below = plane.z;
  }

  const Relief& relief_;
  const HeightRules& rules_;
  Um from_, to_;
  Um least_ = 1, target_ = 0, beyond_ = 0;  // steps
  std::size_t count_ = 0, cells_ = 0;
  std::vector<float> cost_;          // by boundary and height of the layer that ends there
  std::vector<std::uint16_t> came_;  // likewise: the height of the layer before
  std::vector<float> best_;          // of the boundary at hand, by height of the next layer
  std::vector<std::uint16_t> from_height_;
};

/// Where it is cut: in its middle.
void cut_in_the_middle(std::vector<Plane>& planes, Um top) {
  for (Plane& plane : planes) plane.below = std::min(plane.z - plane.height + plane.height / 2, top - 1);
}

}  // namespace

std::vector<Plane> fitted_planes(const Relief& relief, const HeightRules& rules, Um from, Um to,
                                 std::optional<Um> before) {
  if (to - from < rules.least / 2) return {};
  auto out = Way(relief, rules, from, to).planes(before);
  cut_in_the_middle(out, std::max(to, Um{1}));
  return out;
}

std::vector<Plane> profile_planes(std::span<const mesh::HeightAt> profile, Um first, Um least, Um top) {
  std::vector<Plane> out;
  const auto height_at = [&](Um z) {
    const auto above =
        std::upper_bound(profile.begin(), profile.end(), z, [](Um at, const mesh::HeightAt& p) { return at < p.z; });
    if (above == profile.begin()) return profile.front().height;
    if (above == profile.end()) return profile.back().height;
    const mesh::HeightAt &a = *std::prev(above), &b = *above;
    return a.height + rounded(static_cast<double>(b.height - a.height) * (z - a.z) / (b.z - a.z));
  };
  for (Um z = 0;;) {
    const Um height = z == 0 ? first : std::max(height_at(z + least / 2), Um{20});
    if (z + height / 2 > top) break;
    z += height;
    out.push_back({z, height, 0});
  }
  cut_in_the_middle(out, top);
  return out;
}

}  // namespace weft::slice
