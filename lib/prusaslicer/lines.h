// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "settings/ini.h"

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace weft::prusaslicer {

/// A number, or a share in percent.
struct Figure {
  double v = 0;
  bool percent = false;
  /// In the unit of what it may be a share of.
  double of(double base) const { return percent ? v / 100 * base : v; }
};

/// The first of a list of texts; of a text that is no list, all of it.
std::string first_text(const IniEntry& e);

/// The lines of a config.ini by key, in today's spelling, and which of them have been asked for.
class Lines {
 public:
  /// Old names and old spellings become today's; what a filament overrides takes the place of the printer's.
  Lines(std::vector<IniEntry> entries, const std::string& path);

  /// The line of a key, or null; it counts as read from now on.
  const IniEntry* find(std::string_view key);
  /// The same without counting as read.
  const IniEntry* look(std::string_view key) const;

  /// From now on the line of that key, where there is one, says something else.
  void replace(std::string_view key, std::string value);

  std::optional<Figure> figure(std::string_view key);
  double number(std::string_view key, double otherwise);
  bool flag(std::string_view key, bool otherwise);

  /// The first element: weft prints with one extruder, and of pairs for normal and silent mode the first is the normal
  /// one.
  /// @throws Error{settings} with path:line when it does not parse whole
  Figure figure(const IniEntry& e) const;
  bool flag(const IniEntry& e) const;
  [[noreturn]] void refuse(const IniEntry& e, std::string_view what) const;

  /// Lines that nothing has asked for, in order of key.
  std::vector<const IniEntry*> unread() const;

  /// Lines of numbers with a comment behind them, which the ini does not have and PrusaSlicer skips unseen.
  const std::vector<IniEntry>& commented() const { return commented_; }

 private:
  void cut_comment(IniEntry& e);

  const std::string& path_;
  std::vector<IniEntry> commented_;
  std::map<std::string, IniEntry, std::less<>> by_key_;
  std::set<std::string, std::less<>> seen_;
};

}  // namespace weft::prusaslicer
