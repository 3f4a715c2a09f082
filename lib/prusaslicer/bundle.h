// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/notice.h"
#include "settings/ini.h"

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// A bundle of presets, as vendors ship them and as PrusaSlicer exports them: `[print:NAME]`, `[filament:NAME]` and
/// `[printer:NAME]`, one of each makes a configuration.
namespace weft::prusaslicer {

enum class PresetKind { print, filament, printer };
std::string_view name_of(PresetKind kind);

/// Which presets are meant, by name; empty: the one that follows from the others.
struct PresetChoice {
  std::string print, filament, printer;
  bool empty() const { return print.empty() && filament.empty() && printer.empty(); }
};

/// Values that presets give, by key. A key's history is oldest first: what it was in the ancestors, then its value.
using PresetValues = std::map<std::string, std::vector<IniEntry>, std::less<>>;

struct Preset {
  PresetKind kind = PresetKind::print;
  std::string name;
  int line = 0;
  bool abstract = false;                  ///< `*like this*`: only to be inherited
  std::vector<std::string> former_names;  ///< renamed_from
  PresetValues values;                    ///< with what it inherits
};

struct Bundle {
  std::string path, vendor;
  std::vector<Preset> presets;  ///< in the order of the file
  PresetChoice active;          ///< of an exported bundle: what was selected in the window
};

bool is_bundle(const std::vector<IniEntry>& entries);

/// @throws Error{settings} with path:line: a preset or key given twice, inheritance from what is not there or in a
/// circle
Bundle read_bundle(const std::vector<IniEntry>& entries, const std::string& path);

/// The preset of that name, or formerly of that name; null when there is none.
const Preset* find_preset(const Bundle& bundle, PresetKind kind, std::string_view name);

/// May `preset` (of a print or filament) be used on that printer: compatible_printers, compatible_printers_condition.
/// @throws Error{settings} with path:line and column when the condition cannot be evaluated
bool fits_printer(const Bundle& bundle, const Preset& preset, const Preset& printer);

/// May that filament be used with that print: compatible_prints, compatible_prints_condition.
/// @throws as fits_printer
bool fits_print(const Bundle& bundle, const Preset& filament, const Preset& print);

/// Presets of a kind that are not abstract and are for this technology, in the order of the file; for a printer, those
/// that fit it, and for a print as well, filaments that fit that.
std::vector<const Preset*> presets_of(const Bundle& bundle, PresetKind kind, const Preset* printer = nullptr,
                                      const Preset* print = nullptr);

/// The configuration that a choice stands for: what the choice leaves open is what was active, the printer's default,
/// or the only one there is.
struct Selection {
  const Preset* print = nullptr;
  const Preset* filament = nullptr;
  const Preset* printer = nullptr;
  Notices notices;  ///< what was filled in
};
/// @throws Error{settings}: no such preset (with the nearest names), nothing follows (with the names to choose from),
/// or
///         presets that do not fit each other
Selection select(const Bundle& bundle, const PresetChoice& choice);

/// The selection as a flat config.ini: of each key the value, and its history.
PresetValues flattened(const Selection& selection);

}  // namespace weft::prusaslicer
