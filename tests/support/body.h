// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "geometry/boolean.h"
#include "geometry/offset.h"
#include "picture.h"
#include "rectangle.h"
#include "support/support.h"

#include <vector>

/// Bodies by hand, and what support makes of them.
namespace weft::test {

/// Layers of 0.2 mm of a body that grows from outline to outline.
struct Body {
  std::vector<SlicedLayer> layers;
  std::vector<const SlicedLayer*> pointers;

  void add(int count, const Regions& outline, Um height = 200) {
    for (int i = 0; i < count; ++i) {
      const Um z = (layers.empty() ? 0 : layers.back().z) + height;
      layers.push_back({z, height, outline});
    }
  }
  support::Object object() {
    pointers.clear();
    for (const auto& layer : layers) pointers.push_back(&layer);
    support::Object out;
    out.layers = pointers;
    return out;
  }
};

/// A plate of 40 × 20 mm on a post of 4 × 4 mm.
inline Body tee(int post = 50) {
  Body out;
  out.add(post, {rectangle(-2000, -2000, 2000, 2000)});
  out.add(10, {rectangle(-20000, -10000, 20000, 10000)});
  return out;
}

inline SupportSettings on(SupportStructure structure = SupportStructure::normal) {
  SupportSettings s;
  s.support_enable = true;
  s.support_structure = structure;
  return s;
}

inline Regions all_of(const support::SupportLayer& layer) {
  Regions out;
  for (const auto* regions : {&layer.columns, &layer.branches, &layer.roof, &layer.under_roof, &layer.bottom})
    out.insert(out.end(), regions->begin(), regions->end());
  out.insert(out.end(), layer.joists.area.begin(), layer.joists.area.end());
  return geometry::unite(out);
}

inline Regions grown(const Regions& regions, Um by) {
  return geometry::offset(regions, {.by = by, .corner = geometry::Corner::round, .arc_tolerance = 5});
}

inline support::Plan planned(const SupportSettings& s, Body& body) {
  const auto object = body.object();
  auto out = support::plan(s, object, support::demand(s, object));
  if (!body.layers.empty())  // seen from above: what is to be held, and what stands on the bed
    tests::look_at(body.layers.back().regions, out.layers.empty() ? Regions{} : all_of(out.layers.front()));
  return out;
}

}  // namespace weft::test
