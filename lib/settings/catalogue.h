// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "settings/settings.h"

#include <any>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace weft {

/// One setting as text: what `weft settings` prints, and the way in and out for every file and option.
struct CatalogueEntry {
  std::string_view section, key, type, unit, meaning;
  Scope scope = Scope::plate;             ///< where its value may differ
  std::string default_text, least, most;  ///< least and most are empty where there is no range
  std::vector<std::string_view> choices;  ///< of an enumeration
  bool automatic = false;                 ///< `auto` is a value
  std::function<std::string(const Settings&)> print;
  /// The value of a text, of the field's type. @throws std::invalid_argument with one clause: wrong type, or out of
  /// range
  std::function<std::any(std::string_view)> read;
  /// Pre: the value is of the field's type.
  std::function<void(Settings&, const std::any&)> lay;
  /// Reads and lays. @throws as read
  void parse(Settings& settings, std::string_view text) const { lay(settings, read(text)); }
};

/// Every setting, in the order of `sections`.
const std::vector<CatalogueEntry>& catalogue();

/// The entry of a key, or null. Keys are compared exactly, but '-' counts as '_'.
const CatalogueEntry* find_setting(std::string_view key);

/// The value of a text. @throws Error{settings} for what is of the wrong type or out of range, with range and default
/// @param where what to name in messages
std::any read_value(const CatalogueEntry& entry, const std::string& text, const std::string& where);

/// The known key nearest to a wrong one by edit distance, else the switch that it names; empty when there is none.
/// @param also_called another name of a key, which counts like the key itself; empty when it has none
std::string_view nearest_setting(std::string_view wrong, std::string_view (*also_called)(std::string_view key));

/// `key = value` of every setting of a section (all of them when empty), a line each: the block in the G-code and what
/// cache keys are made of.
std::string as_text(const Settings& settings, std::string_view section = {});

}  // namespace weft
