// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/copies.h"

#include "settings/exact.h"

#include <string>
#include <utility>

namespace weft::pipeline {

bool tell_copies_apart(const Scopes& scopes, std::vector<ObjectScopes>& of_object, Plate& plate) {
  const auto on_plate = [&](const ObjectScopes& own) {
    return scopes[own.back().of_mix.front()].infill.infill_phase_frame == InfillFrame::plate;
  };
  std::vector<Object> objects;
  std::vector<ObjectScopes> own;
  for (std::size_t o = 0; o < plate.objects.size(); ++o) {
    Object& object = plate.objects[o];
    const auto copies = object.copies;
    const std::size_t apart = on_plate(of_object[o]) ? copies.size() : 1;
    for (std::size_t c = 0; c < apart; ++c) {
      objects.push_back(c + 1 < apart ? object : std::move(object));
      if (apart > 1) objects.back().copies = {copies[c]};
      own.push_back(of_object[o]);
    }
  }
  const bool any = objects.size() > plate.objects.size();
  plate.objects = std::move(objects), of_object = std::move(own);
  return any;
}

std::vector<Copy> copies_of(const Plate& plate) {
  std::vector<Copy> out;
  for (std::size_t o = 0; o < plate.objects.size(); ++o) {
    for (const Point by : plate.objects[o].copies) out.push_back({o, by, false, static_cast<ObjectId>(out.size())});
    if (!plate.objects[o].copies.empty()) out.back().last = true;
  }
  return out;
}

void give_seams(const Scopes& scopes, const std::vector<ScopeId>& feet, std::vector<Copy>& copies) {
  const auto bytes_of = [](const TravelSettings& settings) {
    std::string out;
    exact::add_group(out, settings, travel_schema);
    return out;
  };
  const auto usual = bytes_of(scopes[0].travel);
  for (auto& copy : copies) {
    if (copy.of >= feet.size()) continue;
    const auto& own = scopes[scopes.above_first_layer(feet[copy.of])].travel;
    if (bytes_of(own) != usual) copy.seams = &own;
  }
}

std::vector<ScopeId> by_copy(const std::vector<ScopeId>& feet, const std::vector<Copy>& copies, std::size_t count) {
  std::vector<ScopeId> out;
  for (std::size_t c = 0; c < count && !feet.empty(); ++c) out.push_back(feet[copies[c].of]);
  return out;
}

Sequence with_supports(Sequence sequence, std::vector<SupportOf> supports, std::vector<Copy>& copies,
                       std::vector<PrintedLayers>& layers) {
  const std::size_t own = copies.size();
  std::vector<ObjectId> below(own, any_object);
  for (std::size_t o = 0; o < supports.size(); ++o) {
    if (supports[o].layers.empty()) continue;
    layers.push_back(std::move(supports[o].layers));
    for (ObjectId c = 0; c < own; ++c) {
      if (copies[c].of != o) continue;
      below[c] = static_cast<ObjectId>(copies.size());
      copies.push_back({layers.size() - 1, copies[c].by, false, c, true});
    }
    copies.back().last = true;
  }
  for (auto& pass : sequence)
    for (std::size_t i = 0, count = pass.objects.size(); i < count; ++i)
      if (const auto under = below[pass.objects[i]]; under != any_object) pass.objects.push_back(under);
  return sequence;
}

}  // namespace weft::pipeline
