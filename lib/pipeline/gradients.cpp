// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/gradients.h"

#include "pipeline/stripes.h"
#include "settings/tools.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace weft::pipeline {
namespace {

/// A gradient is made of so many even shares.
constexpr int shares = 20;
/// A change of filament is not worth less.
constexpr double least_bead_mm = 5;

double place_of(Point at, GradientAxis axis, Um z) {
  return to_mm(axis == GradientAxis::x ? at.x : axis == GradientAxis::y ? at.y : z);
}
double place_of(const Bead& bead, GradientAxis axis, Um z) {
  return place_of(box_of(bead).centre(), axis, z);
}

/// Pieces of equal length, none of them shorter than 5 mm. What is shorter than two of those stays whole.
Beads pieces_of(Bead bead) {
  const auto count = static_cast<int>(length_mm(bead) / least_bead_mm);
  if (count < 2) return {std::move(bead)};
  const double each_um = 1000 * length_mm(bead) / count;
  auto path = bead.path;
  if (bead.closed) path.push_back(path.front());
  bead.closed = false;
  bead.path = {path.front()};
  Beads out;
  double left = each_um;
  for (std::size_t i = 1; i < path.size(); ++i) {
    Junction from = path[i - 1];
    for (double um = distance(from.at, path[i].at); um > left && static_cast<int>(out.size()) + 1 < count;) {
      from = between(from, path[i], left / um);
      bead.path.push_back(from);
      out.push_back(bead);
      bead.path = {from};
      um = distance(from.at, path[i].at), left = each_um;
    }
    left -= distance(from.at, path[i].at);
    bead.path.push_back(path[i]);
  }
  out.push_back(std::move(bead));
  return out;
}

bool has_gradient(const ToolSettings& t) {
  return t.gradient_tools && t.gradient_mode != GradientMode::mix;
}

/// What the second tool is short of, mm³, and what was chosen last.
struct Debt {
  double mm3 = 0;
  bool second = false;
};

class Gradients {
 public:
  /// @param room what beads lie in, over all layers
  Gradients(ToolScopes& tools, Scopes& scopes, const Box3& room) : tools_(tools), scopes_(scopes), room_(room) {}

  void apply(Um z, Um height, travel::ObjectLayer& object) {
    cut(z, object);
    std::map<ScopeId, bool> of_layer;  // what whole layers have chosen
    for (auto& bead : object.beads) {
      const auto& t = scopes_[bead.scope].tools;
      if (bead.tool == any_tool || !has_gradient(t)) continue;
      const double share = share_at(t.gradient_stops, place_of(bead, t.gradient_axis, z));
      bool second = false;
      if (t.gradient_mode == GradientMode::stripes) {
        second = stripes_of(bead.scope).second(place_of(bead, t.gradient_axis, z));
      } else if (t.gradient_mode == GradientMode::layers) {
        const auto known = of_layer.find(bead.scope);
        second = known != of_layer.end()
                     ? known->second
                     : of_layer.emplace(bead.scope, choose_layer(object, bead.scope, z, height)).first->second;
      } else {
        auto& debt = debts_[{object.object, std::min(static_cast<int>(share * shares), shares - 1), bead.scope}];
        const double mm3 = volume_mm3(bead, height);
        debt.mm3 += share * mm3;
        if (length_mm(bead) >= least_bead_mm) debt.second = debt.mm3 >= mm3 / 2;
        second = debt.second;
        if (second) debt.mm3 -= mm3;
      }
      const auto tool = static_cast<ToolId>((*t.gradient_tools)[second ? 1 : 0]);
      bead.tool = tool;
      bead.scope = tools_.laid_over(bead.scope, tool, scopes_);
    }
  }

 private:
  /// Across the layer a share changes along beads.
  void cut(Um z, travel::ObjectLayer& object) {
    Beads out;
    for (auto& bead : object.beads) {
      const auto& t = scopes_[bead.scope].tools;
      const bool along =
          has_gradient(t) && t.gradient_mode != GradientMode::layers && t.gradient_axis != GradientAxis::z;
      if (!along || bead.tool == any_tool) {
        out.push_back(std::move(bead));
        continue;
      }
      const auto place = [&](Point at) { return place_of(at, t.gradient_axis, z); };
      auto pieces = t.gradient_mode == GradientMode::stripes ? stripes_of(bead.scope).cut(std::move(bead), place)
                                                             : pieces_of(std::move(bead));
      for (auto& piece : pieces) out.push_back(std::move(piece));
    }
    object.beads = std::move(out);
  }

  const Stripes& stripes_of(ScopeId scope) {
    const auto known = stripes_.find(scope);
    if (known != stripes_.end()) return known->second;
    const auto& t = scopes_[scope].tools;
    const auto end = [&](Point3 p) { return place_of(flat(p), t.gradient_axis, p.z); };
    const double least = t.gradient_axis == GradientAxis::z ? 0 : to_mm(scopes_[scope].machine.nozzle_diameter);
    return stripes_
        .emplace(scope,
                 Stripes(t.gradient_stops, to_mm(t.gradient_stripe_period), least, end(room_.min), end(room_.max)))
        .first->second;
  }

  bool choose_layer(const travel::ObjectLayer& object, ScopeId scope, Um z, Um height) {
    double all = 0, wanted = 0;
    const auto& t = scopes_[scope].tools;
    for (const auto& bead : object.beads) {
      if (bead.scope != scope || bead.tool == any_tool) continue;
      const double mm3 = volume_mm3(bead, height);
      all += mm3, wanted += mm3 * share_at(t.gradient_stops, place_of(bead, t.gradient_axis, z));
    }
    auto& debt = debts_[{object.object, -1, scope}];
    debt.mm3 += wanted;
    const bool second = debt.mm3 >= all / 2;
    if (second) debt.mm3 -= all;
    return second;
  }

  ToolScopes& tools_;
  Scopes& scopes_;
  Box3 room_;
  std::map<ScopeId, Stripes> stripes_;
  std::map<std::tuple<ObjectId, int, ScopeId>, Debt> debts_;
};

}  // namespace

void apply_gradients(ToolScopes& tools, Scopes& scopes, std::span<travel::LayerInput> layers) {
  bool any = false;
  for (std::size_t i = 0; i < scopes.size(); ++i) any = any || has_gradient(scopes[static_cast<ScopeId>(i)].tools);
  if (!any) return;
  Box3 room;
  for (const auto& layer : layers)
    for (const auto& object : layer.objects)
      for (const auto& region : object.outline)
        for (const Point p : region.outer) room.add(Point3{p.x, p.y, layer.z});
  Gradients gradients(tools, scopes, room);
  for (auto& layer : layers)
    for (auto& object : layer.objects)
      if (!object.support) gradients.apply(layer.z, object.height != 0 ? object.height : layer.height, object);
}

}  // namespace weft::pipeline
