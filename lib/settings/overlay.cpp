// SPDX-License-Identifier: GPL-3.0-or-later
#include "settings/overlay.h"

#include "core/error.h"
#include "settings/tools.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace weft {
namespace {

/// What a value holds for, in messages.
struct Holder {
  Scope scope;
  std::string_view what;
};
constexpr std::array holders{
    Holder{Scope::machine, "the whole machine"}, Holder{Scope::plate, "the whole plate"},
    Holder{Scope::tool, "a whole tool"},         Holder{Scope::object, "a whole object"},
    Holder{Scope::region, "an area of a layer"}, Holder{Scope::layer, "a whole layer"},
};
std::string_view holder_of(Scope scope) {
  return std::find_if(holders.begin(), holders.end(), [&](const Holder& h) { return h.scope == scope; })->what;
}

/// Groups that their stage takes once for all that is printed together, wherever their rows would let them differ.
constexpr std::array<std::string_view, 3> taken_once{"travel", "cooling", "audit"};

/// Where a value may differ in truth. Of what holds for layers as a whole an object has its own heights alone: its
/// travels and its fan are shared with what is printed beside it.
Scope scope_of(const CatalogueEntry& row) {
  if (row.key == "layer_height") return Scope::layer;
  if (row.key.starts_with("z_seam_")) return row.scope;  // of the travels an object has its seams alone
  const bool once = std::find(taken_once.begin(), taken_once.end(), row.section) != taken_once.end();
  if (row.scope > Scope::tool && (once || row.scope == Scope::layer)) return Scope::plate;
  return row.scope;
}

bool may_differ(Scope row, Scope place) {
  if (place == Scope::region) return row == Scope::region;
  if (place == Scope::layer) return row == Scope::region || row == Scope::layer;
  return row >= place;
}

/// Layers are cut through all parts of an object, whatever tools print them: their heights are no tool's own.
bool may_hold_for(const CatalogueEntry& row, Scope place) {
  const Scope scope = scope_of(row);
  if (place == Scope::tool && row.section == "layers" && scope != Scope::region) return false;
  return may_differ(scope, place);
}

/// What is meant where somebody asks one place for what only the machine has.
struct Meant {
  std::string_view key, hint;
};
constexpr std::string_view tool_of_a_place = "extruder_nr says which tool prints it";
constexpr std::array meant_there{Meant{"tool_select", tool_of_a_place}, Meant{"tool_nozzles", tool_of_a_place},
                                 Meant{"extruders_enabled_count", tool_of_a_place}};
std::string_view hint_of(std::string_view key) {
  const auto meant = std::find_if(meant_there.begin(), meant_there.end(), [&](const Meant& m) { return m.key == key; });
  return meant == meant_there.end() ? "set it there" : meant->hint;
}

const CatalogueEntry& known(const std::string& key, const std::string& where) {
  if (const auto* entry = find_setting(key)) return *entry;
  const auto near = nearest_setting(key, [](std::string_view) { return std::string_view(); });
  throw Error{Error::Kind::settings, fmt::format("unknown setting '{}'", key), where,
              near.empty() ? "`weft settings` lists them all" : fmt::format("did you mean '{}'?", near)};
}

}  // namespace

bool differs_by_tool(const CatalogueEntry& entry) {
  return may_hold_for(entry, Scope::tool);
}

void Overlay::add(const std::string& key, const std::string& text, const std::string& where) {
  const auto& row = known(key, where);
  if (!may_hold_for(row, scope))
    throw Error{Error::Kind::settings, fmt::format("{}: {} holds for {}", what, row.key, holder_of(scope_of(row))),
                where, std::string(hint_of(row.key))};
  values.push_back({&row, read_value(row, text, where), {where, text, {}}});
}

void lay(Settings& settings, const Overlay& overlay) {
  for (const auto& laid : overlay.values) laid.row->lay(settings, laid.value);
}

const Origin* origin_of(std::string_view key, const std::vector<const Overlay*>& overlays) {
  for (auto overlay = overlays.rbegin(); overlay != overlays.rend(); ++overlay) {
    const auto& values = (*overlay)->values;
    const auto found =
        std::find_if(values.rbegin(), values.rend(), [&](const Laid& laid) { return laid.row->key == key; });
    if (found != values.rend()) return &found->origin;
  }
  return nullptr;
}

}  // namespace weft
