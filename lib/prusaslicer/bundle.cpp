// SPDX-License-Identifier: GPL-3.0-or-later
#include "prusaslicer/bundle.h"

#include "core/error.h"
#include "macro/macro.h"
#include "prusaslicer/keys.h"
#include "prusaslicer/text.h"
#include "settings/near.h"
#include "settings/value.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

namespace weft::prusaslicer {
namespace {

std::optional<PresetKind> kind_of(std::string_view section) {
  for (const auto kind : {PresetKind::print, PresetKind::filament, PresetKind::printer})
    if (section.starts_with(fmt::format("{}:", name_of(kind)))) return kind;
  return std::nullopt;
}

std::string at(const std::string& path, int line) {
  return fmt::format("{}:{}", path, line);
}

/// What a preset itself says, before its ancestors are laid below it.
struct Own {
  Preset preset;
  std::map<std::string, IniEntry> values;
  std::vector<std::string> parents;
  int inherits_line = 0;
  enum class State { untouched, on_the_way, done } state = State::untouched;
};
using PresetKey = std::pair<PresetKind, std::string>;
constexpr int deepest = 100;  // generations: each costs a call on the stack

void take_line(Own& own, const IniEntry& e, const std::string& path) {
  const auto [first, is_new] = own.values.emplace(e.key, e);
  if (!is_new)
    throw Error{Error::Kind::settings,
                fmt::format("'{}' of [{}] was already given on line {}", e.key, e.section, first->second.line),
                at(path, e.line), "keep one of the two"};
  if (e.key == "inherits") own.parents = texts_of(e.value), own.inherits_line = e.line;
  if (e.key == "renamed_from") own.preset.former_names = texts_of(e.value);
}

/// Lays the parents' values below the preset's own, in their order: a later one wins.
void inherit(std::map<PresetKey, Own>& all, Own& own, Bundle& bundle, int depth) {
  if (own.state == Own::State::done) return;
  if (own.state == Own::State::on_the_way)
    throw Error{Error::Kind::settings,
                fmt::format("[{}:{}] inherits itself", name_of(own.preset.kind), own.preset.name),
                at(bundle.path, own.inherits_line), "break the circle"};
  if (depth > deepest)
    throw Error{Error::Kind::settings,
                fmt::format("[{}:{}] has more than {} generations of ancestors", name_of(own.preset.kind),
                            own.preset.name, deepest),
                at(bundle.path, own.inherits_line),
                {}};
  own.state = Own::State::on_the_way;
  for (const auto& name : own.parents) {
    const auto parent = all.find({own.preset.kind, name});
    if (parent == all.end()) {
      // Exported presets are complete and only remember whose children they are.
      if (bundle.vendor.empty() && own.values.size() > 20) continue;
      throw Error{
          Error::Kind::settings,
          fmt::format("[{}:{}] inherits '{}', which is not there", name_of(own.preset.kind), own.preset.name, name),
          at(bundle.path, own.inherits_line), "is it a preset of another bundle?"};
    }
    inherit(all, parent->second, bundle, depth + 1);
    for (const auto& [key, history] : parent->second.preset.values) {
      auto& mine = own.preset.values[key];
      for (const auto& entry : history) {  // an ancestor on two ways counts once, where it comes last
        std::erase_if(mine, [&](const IniEntry& m) { return m.line == entry.line; });
        mine.push_back(entry);
      }
    }
  }
  for (const auto& [key, entry] : own.values) own.preset.values[key].push_back(entry);
  own.state = Own::State::done;
}

std::optional<std::string> value_in(const Preset& preset, std::string_view key) {
  const auto found = preset.values.find(key);
  if (found != preset.values.end()) return found->second.back().value;
  return std::nullopt;
}

/// What a condition may name: the keys of the preset that it is asked of, PrusaSlicer's defaults for the rest.
macro::Variables variables_of(const Preset& preset) {
  macro::Variables out;
  const auto add = [&](const std::string& key, std::string_view text) {
    out[key] = macro::variable_of(in_macro_words(key, text));
  };
  for (const auto& row : keys())
    if (row.initial) add(std::string(row.name), *row.initial);
  for (const auto& [key, history] : preset.values) add(key, history.back().value);
  for (const auto* key : {"printer_notes", "printer_model", "printer_variant"})
    if (out.find(key) == out.end()) add(key, "");
  out["num_extruders"] = macro::variable(static_cast<std::int64_t>(out["nozzle_diameter"].values.size()));
  out["printer_preset"] = out["print_preset"] = macro::variable(preset.name);
  return out;
}

/// A preset that others are held against. What their conditions may name of it is gathered when one first asks.
class Held {
 public:
  explicit Held(const Preset& preset) : preset_(&preset) {}
  const Preset& preset() const { return *preset_; }
  const macro::Variables& variables() {
    if (!variables_) variables_ = variables_of(*preset_);
    return *variables_;
  }

 private:
  const Preset* preset_;
  std::optional<macro::Variables> variables_;
};

/// The answer of the list of names, or of the condition where there is no list; true where there is neither.
bool fits(const Bundle& bundle, const Preset& preset, const char* list, const char* condition, Held& other) {
  const auto names = texts_of(value_in(preset, list).value_or(""));
  if (!names.empty()) {
    const auto known = [&](const std::string& n) { return std::find(names.begin(), names.end(), n) != names.end(); };
    return known(other.preset().name) || known(value_in(other.preset(), "inherits").value_or(""));
  }
  const auto found = preset.values.find(condition);
  if (found == preset.values.end() || value::trimmed(found->second.back().value).empty()) return true;
  return macro::holds(found->second.back().value, other.variables(),
                      fmt::format("{}, {} of [{}:{}]", at(bundle.path, found->second.back().line), condition,
                                  name_of(preset.kind), preset.name));
}
bool fits_printer(const Bundle& bundle, const Preset& preset, Held& printer) {
  return fits(bundle, preset, "compatible_printers", "compatible_printers_condition", printer);
}
bool fits_print(const Bundle& bundle, const Preset& filament, Held& print) {
  return fits(bundle, filament, "compatible_prints", "compatible_prints_condition", print);
}

const Preset& chosen(const Bundle& bundle, PresetKind kind, const std::string& name) {
  if (const auto* p = find_preset(bundle, kind, name); p && !p->abstract) return *p;
  std::vector<std::string> names;
  for (const auto* p : presets_of(bundle, kind)) names.push_back(p->name);
  throw Error{Error::Kind::settings, fmt::format("holds no {} preset '{}'", name_of(kind), name), bundle.path,
              fmt::format("{}; `weft profile list` names all {}", did_you_mean(name, names), names.size())};
}

/// One of the presets that fit: the one named by `wish`, else the only one. Adds a notice when that was not said.
const Preset* follow(const Bundle& bundle, PresetKind kind, const std::vector<const Preset*>& fitting,
                     const std::string& wish, const char* why, Notices& notices) {
  const auto take = [&](const Preset* p, const char* reason) {
    notices.push_back(
        {"preset_chosen", fmt::format("{}: {} preset '{}': {}", bundle.path, name_of(kind), p->name, reason)});
    return p;
  };
  if (!wish.empty())
    if (const auto* p = find_preset(bundle, kind, wish);
        p && std::find(fitting.begin(), fitting.end(), p) != fitting.end())
      return take(p, why);
  if (fitting.size() == 1) return take(fitting.front(), "the only one that there is");
  if (fitting.empty())
    throw Error{Error::Kind::settings, fmt::format("holds no {} preset that fits", name_of(kind)), bundle.path,
                "choose another printer"};
  std::string names;
  for (std::size_t i = 0; i < fitting.size() && i < 6; ++i)
    names += fmt::format("{}'{}'", i == 0 ? "" : ", ", fitting[i]->name);
  throw Error{Error::Kind::settings, fmt::format("is a bundle with {} {} presets", fitting.size(), name_of(kind)),
              bundle.path,
              fmt::format("choose with --preset {}=NAME: {}{}", name_of(kind), names,
                          fitting.size() > 6 ? " …; `weft profile list` names them all" : "")};
}

}  // namespace

std::string_view name_of(PresetKind kind) {
  return kind == PresetKind::print ? "print" : kind == PresetKind::filament ? "filament" : "printer";
}

bool is_bundle(const std::vector<IniEntry>& entries) {
  return std::any_of(entries.begin(), entries.end(), [](const IniEntry& e) {
    return kind_of(e.section).has_value() || e.section.starts_with("printer_model:");
  });
}

Bundle read_bundle(const std::vector<IniEntry>& entries, const std::string& path) {
  Bundle bundle;
  bundle.path = path;
  std::map<PresetKey, Own> all;
  std::vector<PresetKey> order;
  for (const auto& e : entries) {
    if (e.section == "vendor" && e.key == "name") bundle.vendor = e.value;
    if (e.section == "presets") {
      if (e.key == "print") bundle.active.print = e.value;
      if (e.key == "printer") bundle.active.printer = e.value;
      if (e.key == "filament" || e.key == "filaments")
        bundle.active.filament = texts_of(e.value).empty() ? "" : texts_of(e.value).front();
    }
    const auto kind = kind_of(e.section);
    if (!kind) continue;
    const PresetKey key{*kind,
                        std::string(value::trimmed(std::string_view(e.section).substr(name_of(*kind).size() + 1)))};
    auto [own, is_new] = all.try_emplace(key);
    if (is_new) {
      order.push_back(key);
      own->second.preset = {*kind,  key.second,
                            e.line, key.second.size() > 1 && key.second.front() == '*' && key.second.back() == '*',
                            {},     {}};
    }
    take_line(own->second, e, path);
  }
  for (const auto& key : order) inherit(all, all.at(key), bundle, 0);
  for (const auto& key : order) bundle.presets.push_back(std::move(all.at(key).preset));
  return bundle;
}

const Preset* find_preset(const Bundle& bundle, PresetKind kind, std::string_view name) {
  for (const auto& p : bundle.presets)
    if (p.kind == kind && p.name == name) return &p;
  for (const auto& p : bundle.presets)
    if (p.kind == kind && std::find(p.former_names.begin(), p.former_names.end(), name) != p.former_names.end())
      return &p;
  return nullptr;
}

bool fits_printer(const Bundle& bundle, const Preset& preset, const Preset& printer) {
  Held held(printer);
  return fits_printer(bundle, preset, held);
}
bool fits_print(const Bundle& bundle, const Preset& filament, const Preset& print) {
  Held held(print);
  return fits_print(bundle, filament, held);
}

std::vector<const Preset*> presets_of(const Bundle& bundle, PresetKind kind, const Preset* printer,
                                      const Preset* print) {
  std::vector<const Preset*> out;
  std::optional<Held> held_printer, held_print;
  if (printer) held_printer.emplace(*printer);
  if (print) held_print.emplace(*print);
  for (const auto& p : bundle.presets)
    if (p.kind == kind && !p.abstract && value_in(p, "printer_technology").value_or("FFF") == "FFF" &&
        (!printer || kind == PresetKind::printer || fits_printer(bundle, p, *held_printer)) &&
        (!print || kind != PresetKind::filament || fits_print(bundle, p, *held_print)))
      out.push_back(&p);
  return out;
}

Selection select(const Bundle& bundle, const PresetChoice& choice) {
  Selection s;
  const auto any = [&](const std::string& said, PresetKind kind, const std::string& wish, const char* why) {
    return said.empty() ? follow(bundle, kind, presets_of(bundle, kind, s.printer, s.print), wish, why, s.notices)
                        : &chosen(bundle, kind, said);
  };
  s.printer = any(choice.printer, PresetKind::printer, bundle.active.printer, "selected in the export");
  if (value_in(*s.printer, "printer_technology").value_or("FFF") != "FFF")
    throw Error{Error::Kind::settings, fmt::format("the printer '{}' hardens resin", s.printer->name),
                at(bundle.path, s.printer->line), "weft is for printers that melt filament"};
  const auto wish = [&](const std::string& active, const char* key) {
    return active.empty() ? texts_of(value_in(*s.printer, key).value_or("")) : std::vector{active};
  };
  const auto prints = wish(bundle.active.print, "default_print_profile");
  s.print = any(choice.print, PresetKind::print, prints.empty() ? "" : prints.front(), "the printer's default");
  const auto filaments = wish(bundle.active.filament, "default_filament_profile");
  s.filament =
      any(choice.filament, PresetKind::filament, filaments.empty() ? "" : filaments.front(), "the printer's default");
  for (const auto* p : {s.print, s.filament})
    if (!fits_printer(bundle, *p, *s.printer))
      throw Error{Error::Kind::settings,
                  fmt::format("the {} preset '{}' is not made for the printer '{}'", name_of(p->kind), p->name,
                              s.printer->name),
                  at(bundle.path, p->line), "`weft profile list FILE --preset printer=NAME` names those that are"};
  if (!fits_print(bundle, *s.filament, *s.print))
    throw Error{
        Error::Kind::settings,
        fmt::format("the filament preset '{}' is not made for the print preset '{}'", s.filament->name, s.print->name),
        at(bundle.path, s.filament->line),
        {}};
  return s;
}

PresetValues flattened(const Selection& selection) {
  PresetValues out;
  for (const auto* p : {selection.printer, selection.filament, selection.print})
    for (const auto& [key, history] : p->values) {
      auto& mine = out[key];
      mine.insert(mine.end(), history.begin(), history.end());
    }
  // The window fills these in when it loads a preset.
  const auto named = [&](const char* key, const Preset& p, std::string value) {
    out[key].push_back({fmt::format("{}:{}", name_of(p.kind), p.name), key, std::move(value), p.line});
  };
  named("print_settings_id", *selection.print, selection.print->name);
  named("filament_settings_id", *selection.filament, '"' + selection.filament->name + '"');
  named("printer_settings_id", *selection.printer, selection.printer->name);
  return out;
}

}  // namespace weft::prusaslicer
