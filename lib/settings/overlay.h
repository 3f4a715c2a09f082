// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "settings/catalogue.h"
#include "settings/origin.h"

#include <any>
#include <string>
#include <string_view>
#include <vector>

/// Values that hold somewhere: on the first layer, for a tool, an object, a range of heights, a modifier. All of them
/// are overlays of one kind, and what holds at a place is the plate's settings with the overlays of that place laid
/// over them, the narrowest last.
namespace weft {

/// One value of an overlay.
struct Laid {
  const CatalogueEntry* row = nullptr;
  std::any value;  ///< of the row's type
  Origin origin;
};

struct Overlay {
  std::string what{};           ///< "object 'lid'", "height range 5 … 10", "modifier 'grip'": for messages
  Scope scope = Scope::region;  ///< what kind of place it is laid over
  std::vector<Laid> values{};   ///< later ones win

  bool empty() const { return values.empty(); }

  /// Adds a value as a user writes it.
  /// @param where what to name in messages: "lid.3mf", "jobs.jsonl:12"
  /// @throws Error{settings} for unknown keys (with the nearest known one), wrong types and values out of range, and
  ///         for what may not differ in so narrow a place: "lid.3mf: object 'lid': material_bed_temperature holds for
  ///         the whole plate; set it there"
  void add(const std::string& key, const std::string& text, const std::string& where);

  /// Adds a value that follows from others. Pre: `value` is of the row's type.
  template <class T>
  void follow(std::string_view key, T value, std::string because) {
    values.push_back({find_setting(key), std::any(std::move(value)), {what, {}, std::move(because)}});
  }
};

/// Lays it over the settings.
void lay(Settings& settings, const Overlay& overlay);

/// Where the value of a key came from, of overlays in the order they are laid; null: from below them.
const Origin* origin_of(std::string_view key, const std::vector<const Overlay*>& overlays);

}  // namespace weft
