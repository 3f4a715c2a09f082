// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/tool_scopes.h"

#include "core/error.h"
#include "settings/first_layer.h"
#include "settings/tools.h"

#include <algorithm>
#include <array>
#include <set>

#include <fmt/format.h>

namespace weft::pipeline {
namespace {

ToolId narrowed(int tool) {
  return static_cast<ToolId>(tool);
}

/// All tools of an area.
std::set<ToolId> tools_of(const ToolSettings& settings) {
  std::set<ToolId> out;
  for (const auto& row : roles)
    if (row.kind == RoleKind::wall || row.kind == RoleKind::skin || row.kind == RoleKind::fill)
      for (const std::uint16_t inset : {std::uint16_t{0}, std::uint16_t{1}})
        out.insert(tool_of(settings, row.role, inset));
  return out;
}

}  // namespace

ToolId tool_of(const ToolSettings& t, Role role, std::uint16_t inset) {
  const auto& row = row_of(role);
  if (row.kind == RoleKind::wall || role == Role::gap_fill) {
    const int walls = t.wall_extruder_nr.value_or(t.extruder_nr);
    const bool outermost = inset == 0 && role != Role::gap_fill && role != Role::inner_wall;
    return narrowed((outermost ? t.wall_0_extruder_nr : t.wall_x_extruder_nr).value_or(walls));
  }
  if (row.kind == RoleKind::skin) {
    const int skins = t.top_bottom_extruder_nr.value_or(t.extruder_nr);
    return narrowed(role == Role::top_skin ? t.roofing_extruder_nr.value_or(skins) : skins);
  }
  if (role == Role::infill) return narrowed(t.infill_extruder_nr.value_or(t.extruder_nr));
  return any_tool;
}

ToolScopes::ToolScopes(const Settings& plate) : overlays_(tool_overlays(plate)), tools_(settings_of_tools(plate)) {
  // What any of them has otherwise every one says, so that it holds also over what another had laid before.
  std::set<std::string_view> keys;
  for (const auto& overlay : overlays_)
    for (const auto& value : overlay.values) keys.insert(value.row->key);
  for (std::size_t i = 0; i < overlays_.size(); ++i)
    for (const auto key : keys) {
      const auto says = [&](const auto& value) { return value.row->key == key; };
      if (std::none_of(overlays_[i].values.begin(), overlays_[i].values.end(), says))
        overlays_[i].add(std::string(key), find_setting(key)->print(tools_[i]), "tool_settings");
    }
}

namespace {

/// The highest tool that anything of an object is printed with.
int highest_tool_of(const Settings& settings) {
  const auto own = tools_of(settings.tools);
  return std::max({int{*own.rbegin()}, settings.support.support_infill_extruder_nr.value_or(0),
                   settings.support.support_interface_extruder_nr.value_or(0)});
}

}  // namespace

ScopeId ToolScopes::area(const Object& object, const std::vector<const Overlay*>& overlays, Scopes& scopes) {
  const ScopeId plain = scopes.with(0, overlays);
  const auto own = tools_of(scopes[plain].tools);
  const int highest = highest_tool_of(scopes[plain]);
  if (highest >= static_cast<int>(count()))
    throw Error{Error::Kind::settings,
                fmt::format("object '{}': there is no tool {}, the printer has {}", object.name, highest,
                            count() == 1 ? "T0 alone" : fmt::format("T0 … T{}", count() - 1)),
                {},
                "extruders_enabled_count says how many there are"};
  if (!several()) return plain;
  const auto scope_with = [&](ToolId tool) {
    std::vector<const Overlay*> all{&overlays_[tool]};
    all.insert(all.end(), overlays.begin(), overlays.end());
    return scopes.with(0, all);
  };
  const ScopeId area = scope_with(tool_of(scopes[plain].tools, Role::inner_wall, 1));
  for (const ToolId tool : own) by_tool_[{area, tool}] = scope_with(tool);
  return area;
}

ScopeId ToolScopes::lowest(ScopeId area, const std::function<ScopeId(ScopeId)>& lowest) {
  const ScopeId first = lowest(area);
  if (!several()) return first;
  for (std::size_t i = 0; i < count(); ++i) {
    const auto tool = static_cast<ToolId>(i);
    if (const auto known = by_tool_.find({area, tool}); known != by_tool_.end())
      by_tool_[{first, tool}] = lowest(known->second);
  }
  return first;
}

std::vector<ToolId> ToolScopes::used() const {
  std::set<ToolId> out;
  for (const auto& [area, scope] : by_tool_) out.insert(area.second);
  return {out.begin(), out.end()};
}

ScopeId ToolScopes::of(ScopeId area, ToolId tool) const {
  const auto known = by_tool_.find({area, tool});
  return known == by_tool_.end() ? area : known->second;
}

ScopeId ToolScopes::infill_of(ScopeId area, const Scopes& scopes) const {
  return several() ? of(area, tool_of(scopes[area].tools, Role::infill, 0)) : area;
}

ScopeId ToolScopes::laid_over(ScopeId scope, ToolId tool, Scopes& scopes) {
  if (!several() || tool >= count()) return scope;
  const auto [known, is_new] = laid_.try_emplace({scope, tool}, scope);
  if (is_new) {
    const ScopeId above = scopes.above_first_layer(scope);
    const std::array<const Overlay*, 1> own{&overlays_[tool]};
    ScopeId out = scopes.with(above, own);
    if (above != scope) out = scopes.on_first_layer(out);
    known->second = out;
  }
  return known->second;
}

void ToolScopes::tell(Beads& beads, const Scopes& scopes) const {
  if (!several()) return;
  for (auto& bead : beads) {
    if (bead.tool != any_tool) continue;
    const ToolId tool = tool_of(scopes[bead.scope].tools, bead.role, bead.inset);
    if (tool == any_tool) continue;
    bead.tool = tool;
    bead.scope = of(bead.scope, tool);
  }
}

}  // namespace weft::pipeline
