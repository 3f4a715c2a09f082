// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/add_adhesion.h"

#include "adhesion/adhesion.h"
#include "pipeline/add_raft.h"
#include "pipeline/nozzles.h"
#include "settings/exact.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <string>
#include <utility>

namespace weft::pipeline {
namespace {

/// What lies around things on the bed: as the plate has it, and as copies have brims of their own.
struct Around {
  AdhesionSettings plate;
  std::vector<AdhesionSettings> of_copy;  ///< empty: all of them are as the plate has it

  std::size_t layers_needed() const {
    std::size_t out = adhesion::layers_needed(plate);
    for (const auto& own : of_copy) out = std::max(out, adhesion::layers_needed(own));
    return out;
  }
};

std::string bytes_of(const AdhesionSettings& settings) {
  std::string out;
  exact::add_group(out, settings, adhesion_schema);
  return out;
}

Around around_of(const Scopes& scopes, const std::vector<ScopeId>& feet) {
  Around out{adhesion_of(scopes[0].adhesion), {}};
  const auto usual = bytes_of(out.plate);
  bool differ = false;
  for (const ScopeId foot : feet) {
    out.of_copy.push_back(adhesion_of(scopes[foot].adhesion));
    differ = differ || bytes_of(out.of_copy.back()) != usual;
  }
  if (!differ) out.of_copy.clear();
  return out;
}

constexpr Um thickest = 2000;  // of any layer

/// What has equal brims is one.
class Feet {
 public:
  void add(const Regions& outlines, const AdhesionSettings& settings) {
    auto [at, is_new] = number_.try_emplace(bytes_of(settings), feet_.size());
    if (is_new) feet_.push_back({{}, settings});
    auto& to = feet_[at->second].outlines;
    to.insert(to.end(), outlines.begin(), outlines.end());
  }
  std::span<const adhesion::Foot> all() const { return feet_; }

 private:
  std::vector<adhesion::Foot> feet_;
  std::map<std::string, std::size_t> number_;
};

void add_to_rise(const Settings& settings, const Around& around, std::span<travel::LayerInput> rise,
                 const Regions& others, Notices& notices) {
  const std::size_t needed = around.layers_needed();
  // What rises after others on a raft has the raft's skirt.
  if (needed == 0 || rise.front().z > rise.front().height) return;
  std::vector<adhesion::PlateLayer> plate;
  std::vector<travel::LayerInput*> bottoms;  // of each height the first that is printed
  Feet feet;
  if (!around.of_copy.empty() && !others.empty()) feet.add(others, around.plate);
  for (auto& layer : rise) {
    const bool goes_around = layer.time.number < needed;
    if (!goes_around && layer.z > thickest) break;
    if (goes_around && layer.time.number == plate.size())
      plate.push_back({{}, layer.height}), bottoms.push_back(&layer);
    if (goes_around && plate.back().outlines.empty()) plate.back().outlines = others;
    for (const auto& object : layer.objects) {
      const auto add = [&](Regions& to) { to.insert(to.end(), object.outline.begin(), object.outline.end()); };
      if (goes_around) add(plate.back().outlines);
      // Of an object whose first layer is thicker than others' the top is higher up.
      const bool lies = layer.z <= (object.height != 0 ? object.height : layer.height);
      if (lies && layer.time.number > 0) add(plate.front().outlines);
      if (!around.of_copy.empty() && (lies || layer.time.number == 0))
        feet.add(object.outline, object.object < around.of_copy.size() ? around.of_copy[object.object] : around.plate);
    }
  }
  const Ring surface = print_surface(settings.machine);
  auto built = adhesion::build(around.plate, {.layers = plate,
                                              .nozzle = nozzle_of(settings, settings.tools.adhesion_extruder_nr),
                                              .print_surface = &surface,
                                              .feet = feet.all()});
  for (std::size_t i = 0; i < built.layers.size(); ++i) {
    for (auto& bead : built.layers[i]) bead.scope = bottoms[i]->scope;
    auto& to = bottoms[i]->adhesion;  // which a raft may be in
    to.insert(to.begin(), std::make_move_iterator(built.layers[i].begin()),
              std::make_move_iterator(built.layers[i].end()));
  }
  std::move(built.notices.begin(), built.notices.end(), std::back_inserter(notices));
}

}  // namespace

void add_adhesion(const Scopes& scopes, const std::vector<ScopeId>& feet, std::span<travel::LayerInput> layers,
                  const Regions& others, Notices& notices) {
  const auto around = around_of(scopes, feet);
  for (std::size_t begin = 0; begin < layers.size();) {
    std::size_t end = begin + 1;
    while (end < layers.size() && !layers[end].time.comes_down) ++end;
    add_to_rise(scopes[0], around, layers.subspan(begin, end - begin), others, notices);
    begin = end;
  }
}

}  // namespace weft::pipeline
