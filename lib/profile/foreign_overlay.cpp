// SPDX-License-Identifier: GPL-3.0-or-later
#include "profile/foreign_overlay.h"

#include "core/error.h"
#include "prusaslicer/export.h"
#include "prusaslicer/import.h"
#include "prusaslicer/orca.h"
#include "settings/catalogue.h"
#include "settings/ini.h"
#include "settings/tools.h"
#include "settings/value.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <stdexcept>

#include <fmt/format.h>

namespace weft {
namespace {

/// PrusaSlicer's keys that name an extruder, counted from 1; 0 is that of the object.
struct ExtruderKey {
  std::string_view theirs, ours;
};
constexpr std::array extruder_keys{ExtruderKey{"extruder", "extruder_nr"},
                                   ExtruderKey{"perimeter_extruder", "wall_extruder_nr"},
                                   ExtruderKey{"infill_extruder", "infill_extruder_nr"},
                                   ExtruderKey{"solid_infill_extruder", "top_bottom_extruder_nr"}};

/// Words of Cura's that mean a value of another setting here. Where that one holds for more than an object, what is
/// told of it names it.
struct CuraWord {
  std::string_view theirs, value, ours, text;
};
constexpr std::array cura_words{
    CuraWord{"travel_retract_before_outer_wall", "True", "retraction_combing_max_distance_wall_0", "0"},
    CuraWord{"travel_retract_before_outer_wall", "False", "retraction_combing_max_distance_wall_0", "auto"}};

class Layer {
 public:
  Layer(const Settings& plate, const std::string& where, Overlay& to, Notices& notices)
      : plate_(plate), where_(where), to_(to), notices_(notices) {}

  void cura(const std::string& key, const std::string& value) {
    const auto* word = std::find_if(cura_words.begin(), cura_words.end(),
                                    [&](const CuraWord& w) { return w.theirs == key && w.value == value; });
    if (word != cura_words.end()) return add(std::string(word->ours), std::string(word->text), key);
    const auto* row = find_setting(key);
    if (!row) return left_out(key, value, "weft has no such setting");
    if (std::find(infill_files.begin(), infill_files.end(), row->key) != infill_files.end())
      return left_out(key, value, "a project does not say which files of this machine are read");
    add(key, value, key);
  }

  /// In weft's words already. @param theirs the key it came from
  void ours(const std::string& key, const std::string& value, const std::string& theirs) { add(key, value, theirs); }

  void prusaslicer(std::vector<IniEntry> own) {
    std::erase_if(own, [&](const IniEntry& entry) { return is_extruder(entry); });
    if (own.empty()) return;
    auto lines = parse_ini(prusaslicer::exported(plate_).text, where_);
    for (auto& line : lines) line.line = 0;
    std::map<std::string, std::string> before;
    for (const auto& a : prusaslicer::translate(lines, where_).assignments) before[a.key] = a.text;
    lines.insert(lines.end(), own.begin(), own.end());
    const auto translated = prusaslicer::translate(lines, where_);
    for (const auto& a : translated.assignments)
      if (a.line > 0)
        add(a.key, a.text, a.theirs.empty() ? a.key : a.theirs);
      else if (before.count(a.key) == 0 || before[a.key] != a.text)
        follow(a.key, a.text);
    for (const auto& r : translated.unsupported) left_out(r.key, r.text, "is not supported and has no effect");
    for (const auto& r : translated.unknown) left_out(r.key, r.text, "weft does not know it");
    for (const auto& r : translated.approximated)
      notices_.push_back(
          {"project_setting_approximated", fmt::format("{}: {}: {} = {}: {}", where_, to_.what, r.key, r.text, r.why)});
  }

  void left_out(const std::string& key, const std::string& value, const std::string& why) {
    notices_.push_back({"project_setting_left_out",
                        fmt::format("{}: {}: {} = {} is left out: {}", where_, to_.what, key, value, why)});
  }

 private:
  void add(const std::string& key, const std::string& text, const std::string& theirs) {
    try {
      to_.add(key, text, where_);
    } catch (const Error& problem) {
      left_out(theirs, text, problem.problem());
    }
  }
  /// What another value brings with it, where it may differ.
  void follow(const std::string& key, const std::string& text) {
    try {
      to_.add(key, text, where_);
    } catch (const Error&) {  // holds for the whole plate as the plate has it
    }
  }
  bool is_extruder(const IniEntry& entry) {
    const auto row = std::find_if(extruder_keys.begin(), extruder_keys.end(),
                                  [&](const ExtruderKey& r) { return r.theirs == entry.key; });
    if (row == extruder_keys.end()) return false;
    int number = 0;
    try {
      value::parse(entry.value, Unit::none, number);
    } catch (const std::invalid_argument&) {
      left_out(entry.key, entry.value, "is no number");
      return true;
    }
    const auto tools = static_cast<int>(tool_count(plate_));
    if (number > tools || number < 0)
      left_out(entry.key, entry.value,
               tools == 1 ? "the printer has T0 alone" : fmt::format("the printer has T0 … T{}", tools - 1));
    else if (number > 0)
      add(std::string(row->ours), std::to_string(number - 1), entry.key);
    return true;
  }

  const Settings& plate_;
  const std::string& where_;
  Overlay& to_;
  Notices& notices_;
};

}  // namespace

void lay_foreign(const ForeignSettings& said, const Settings& plate, const std::string& where, Overlay& to,
                 Notices& notices) {
  Layer layer(plate, where, to, notices);
  std::vector<IniEntry> lines;
  for (const auto& [key, value] : said.values) {
    if (said.dialect == Dialect::cura) {
      layer.cura(key, value);
      continue;
    }
    IniEntry line{{}, key, value, static_cast<int>(lines.size()) + 1};
    if (said.dialect == Dialect::orca && key != "extruder") {
      const auto own = prusaslicer::ours_of_orca(key, value);
      for (const auto& [our_key, text] : own) layer.ours(our_key, text, key);
      if (!own.empty()) continue;
      const auto theirs = prusaslicer::from_orca(key, value);
      if (!theirs) {
        layer.left_out(key, value, "weft does not know it");
        continue;
      }
      line.key = theirs->first, line.value = theirs->second;
    }
    lines.push_back(std::move(line));
  }
  if (said.dialect != Dialect::cura) layer.prusaslicer(std::move(lines));
}

}  // namespace weft
