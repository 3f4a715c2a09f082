// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/stack.h"

#include "support/lengths.h"

#include <algorithm>
#include <map>

namespace weft::support {
namespace {

Um top_below(const SupportSettings& settings, const SlicedLayer& layer) {
  return layer.z - layer.height - top_gap(settings);
}

Um least_height(Um nozzle) {
  return nozzle / 4;
}

/// Where every level is to end, ascending, each once: with the part's layers, or below each of them.
std::vector<Um> every_top(const SupportSettings& settings, const Object& object) {
  std::vector<Um> own, out;
  for (const auto* layer : object.layers) own.push_back(layer->z);
  for (std::size_t i = 1; i < object.layers.size(); ++i) {
    const Um top = top_below(settings, *object.layers[i]);
    if (!settings.support_synchronize_layers) {
      out.push_back(top);
      continue;
    }
    const auto above = std::upper_bound(own.begin(), own.end(), top);
    if (above != own.begin()) out.push_back(*std::prev(above));
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

/// The tops below which most is held, as far from each other as lets the levels between be nearly as high as they may:
/// the largest first.
std::vector<Um> main_tops(const SupportSettings& settings, const Object& object, const Demand& demand, Um most) {
  std::map<Um, double> held_mm2;
  for (std::size_t i = 1; i < object.layers.size(); ++i)
    if (!demand[i].wanted.empty()) held_mm2[top_below(settings, *object.layers[i])] += area_mm2(demand[i].wanted);
  std::vector<std::pair<double, Um>> order;
  for (const auto& [top, mm2] : held_mm2) order.push_back({-mm2, top});
  std::sort(order.begin(), order.end());
  std::vector<Um> out;
  const Um apart = 6 * most;  // levels between two that far apart are lower by no more than a seventh
  for (const auto& [mm2, top] : order) {
    const auto near = [apart, top = top](Um other) { return std::abs(other - top) < apart; };
    if (std::none_of(out.begin(), out.end(), near)) out.push_back(top);
  }
  const Um last = held_mm2.empty() ? 0 : held_mm2.rbegin()->first;
  if (!out.empty() && *std::max_element(out.begin(), out.end()) < last) out.push_back(last);
  std::sort(out.begin(), out.end());
  return out;
}

/// The level that a contact which is to end at that height stands on.
Stack::Contact contact_at(const std::vector<Stack::Level>& levels, Um top, Um least) {
  auto above =
      std::upper_bound(levels.begin(), levels.end(), top, [](Um z, const Stack::Level& level) { return z < level.z; });
  if (above == levels.begin()) return {};
  --above;
  if (top > above->z && top - above->z < least && above != levels.begin()) --above;  // no cap is as thin as that
  const Um cap = top - above->z;
  return {static_cast<std::uint32_t>(above - levels.begin()), cap < least ? 0 : cap};
}

}  // namespace

Um most_height(const SupportSettings& settings, Um nozzle) {
  return std::clamp(settings.support_infill_sparse_thickness.value_or(nozzle * 3 / 4), least_height(nozzle), nozzle);
}

Stack stack_of(const SupportSettings& settings, const Object& object, const Demand& demand) {
  Stack out;
  out.contacts.resize(object.layers.size());
  if (object.layers.empty()) return out;
  const Um least = least_height(object.nozzle), most = most_height(settings, object.nozzle);
  Um below = object.floor;
  const auto add = [&](Um z) {
    const Um way = z - below;
    const Um pieces = std::max<Um>(1, (way + most - 1) / most);
    for (Um p = 1; p <= pieces; ++p) {
      const Um to = p == pieces ? z : below + (z - below) / (pieces - p + 1);
      out.levels.push_back({to, to - below});
      below = to;
    }
  };
  if (!object.on_raft) {  // what lies on the bed is printed as one layer
    out.levels.push_back({object.layers.front()->z, object.layers.front()->z - object.floor});
    below = object.layers.front()->z;
  }
  // What somebody drew is printed as it is, layer by layer.
  const bool every = settings.support_synchronize_layers || !object.given.empty();
  for (const Um z : every ? every_top(settings, object) : main_tops(settings, object, demand, most))
    if (z - below >= std::min(least, object.layers.back()->height)) add(z);
  for (std::size_t i = 1; i < object.layers.size(); ++i) {
    if (demand[i].wanted.empty()) continue;
    const bool capped = !settings.support_synchronize_layers;
    out.contacts[i] = contact_at(out.levels, top_below(settings, *object.layers[i]), capped ? least : 0);
    if (!capped) out.contacts[i].cap = 0;
  }
  return out;
}

std::vector<Um> lowest_caps(const Stack& stack) {
  std::vector<Um> out(stack.levels.size(), max_coord);
  for (const auto& contact : stack.contacts)
    if (contact.level < out.size()) out[contact.level] = std::min(out[contact.level], contact.cap);
  return out;
}

std::size_t interface_levels(const Stack& stack, std::size_t level, Um height) {
  std::size_t count = 0;
  for (Um below = height; count <= level; below -= stack.levels[level - count++].height)
    if (below < stack.levels[level - count].height / 2) break;
  return std::max<std::size_t>(1, count);
}

std::size_t roof_levels(const Stack& stack, std::size_t level, Um cap, Um height) {
  const bool is_capped = cap > 0 && 2 * cap >= stack.levels[level].height;
  return std::max<std::size_t>(is_capped ? 1 : 2, interface_levels(stack, level, std::max<Um>(height - cap, 1)));
}

}  // namespace weft::support
