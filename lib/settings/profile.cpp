#include "settings/profile.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <stdexcept>

#include "core/error.h"
#include "settings/catalogue.h"
#include "settings/ini.h"
#include "settings/prusaslicer.h"

namespace weft {
namespace {

std::string contents_of(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) throw Error{Error::Kind::file, "is a folder, not a profile", path.string(), "name an ini file in it"};
  std::ifstream in(path, std::ios::binary);
  if (!in) throw Error{Error::Kind::file, "cannot be read", path.string(), "check the path and its permissions"};
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A bundle holds many presets under one key each; which of them is meant cannot be guessed.
void refuse_bundle(const std::vector<IniEntry>& entries, const std::string& path) {
  for (const auto& e : entries)
    if (e.section.find(':') != std::string::npos)
      throw Error{Error::Kind::settings, fmt::format("is a bundle of presets, as [{}] shows", e.section), fmt::format("{}:{}", path, e.line),
                  "export one configuration from PrusaSlicer: File, Export, Export Config"};
}

prusaslicer::Translation apply_prusaslicer(Profile& profile, const std::vector<IniEntry>& entries, const std::string& path) {
  auto translated = prusaslicer::translate(entries, path);
  for (const auto& a : translated.assignments) apply_value(profile, a.key, a.text, fmt::format("{}:{}", path, a.line));
  return translated;
}

void note_losses(Profile& profile, const prusaslicer::Translation& translated, const std::string& path) {
  const auto note = [&](const char* code, const prusaslicer::Remark& r, std::string_view what) {
    profile.notices.push_back({code, fmt::format("{}:{}: {} = {}: {}{}{}", path, r.line, r.key, r.text.substr(0, 40), what, r.why.empty() ? "" : ": ", r.why)});
  };
  for (const auto& r : translated.approximated) note("prusaslicer_key_approximated", r, "is translated to the nearest");
  for (const auto& r : translated.unsupported) note("prusaslicer_key_unsupported", r, "has no effect here");
  for (const auto& r : translated.unknown) note("prusaslicer_key_unknown", r, "is not one of PrusaSlicer's keys and has no effect");
}

void apply_file(Profile& profile, const std::filesystem::path& path, std::vector<std::filesystem::path>& chain) {
  const auto text = contents_of(path);
  const auto entries = parse_ini(text, path.string());
  refuse_bundle(entries, path.string());
  std::map<std::string, int> seen;
  for (const auto& e : entries) {
    const auto [first, is_new] = seen.emplace(e.key, e.line);
    if (!is_new)
      throw Error{Error::Kind::settings, fmt::format("'{}' was already given on line {}", e.key, first->second),
                  fmt::format("{}:{}", path.string(), e.line), "keep one of the two"};
  }
  if (prusaslicer::recognises(text, entries)) return note_losses(profile, apply_prusaslicer(profile, entries, path.string()), path.string());
  chain.push_back(std::filesystem::weakly_canonical(path));
  for (const auto& e : entries) {
    if (e.key != "inherits") continue;
    const auto parent = path.parent_path() / e.value;
    const auto where = fmt::format("{}:{}", path.string(), e.line);
    const auto canonical = std::filesystem::weakly_canonical(parent);
    for (const auto& above : chain)
      if (above == canonical) throw Error{Error::Kind::settings, fmt::format("inherits '{}', which inherits this file", e.value), where, "break the circle"};
    if (!std::filesystem::is_regular_file(parent))
      throw Error{Error::Kind::settings, fmt::format("inherits '{}', which is not there", parent.string()), where, "the path is relative to this file"};
    apply_file(profile, parent, chain);
  }
  for (const auto& e : entries)
    if (e.key != "inherits") apply_value(profile, e.key, e.value, fmt::format("{}:{}", path.string(), e.line));
  chain.pop_back();
}

}  // namespace

void apply_file(Profile& profile, const std::filesystem::path& path) {
  std::vector<std::filesystem::path> chain;
  apply_file(profile, path, chain);
}

prusaslicer::Translation import_prusaslicer(Profile& profile, const std::filesystem::path& path) {
  const auto text = contents_of(path);
  const auto entries = parse_ini(text, path.string());
  refuse_bundle(entries, path.string());
  if (!prusaslicer::recognises(text, entries))
    throw Error{Error::Kind::settings, "is not a PrusaSlicer, SuperSlicer or Slic3r config.ini", path.string(), "weft's own profiles need no import"};
  return apply_prusaslicer(profile, entries, path.string());
}

void apply_value(Profile& profile, const std::string& key, const std::string& text, const std::string& where) {
  const auto* entry = find_setting(key);
  if (!entry) {
    const auto near = nearest_setting(key);
    throw Error{Error::Kind::settings, fmt::format("unknown setting '{}'", key), where,
                near.empty() ? "`weft settings` lists them all" : fmt::format("did you mean '{}'?", near)};
  }
  try {
    entry->parse(profile.settings, text);
  } catch (const std::invalid_argument& problem) {
    throw Error{Error::Kind::settings, fmt::format("{}: {}", entry->key, problem.what()), where,
                entry->least.empty() ? fmt::format("default: {}", entry->default_text)
                                     : fmt::format("range {} … {}{}{}, default {}{}", entry->least, entry->most, entry->unit.empty() ? "" : " ", entry->unit,
                                                   entry->default_text, entry->automatic ? ", or auto" : "")};
  }
  profile.origins[std::string(entry->key)].push_back({where, text});
}

std::string origin_of(const Profile& profile, const std::string& key) {
  const auto at = profile.origins.find(key);
  return at == profile.origins.end() ? "default" : at->second.back().where;
}

namespace {

/// The outlines that the boundary audit measures against must enclose something and not cross themselves.
template <class Refuse>
void check_areas(const MachineSettings& machine, const Refuse& refuse) {
  constexpr auto hint = "give at least three corners, in order around the area";
  const auto sound = [](const Ring& ring) { return ring.size() >= 3 && double_area(ring) != 0 && is_simple(ring); };
  if (machine.bed_shape == BedShape::polygon && !sound(machine.bed_polygon))
    refuse("bed_polygon", "the outline crosses itself or encloses nothing", hint);
  if (machine.bed_shape == BedShape::circle && machine.machine_width != machine.machine_depth)
    refuse("machine_depth", fmt::format("{} mm is not machine_width {} mm", to_mm(machine.machine_depth), to_mm(machine.machine_width)),
           "a bed of shape circle is as deep as it is wide");
  for (std::size_t i = 0; i < machine.bed_exclude_areas.size(); ++i)
    if (!sound(machine.bed_exclude_areas[i]))
      refuse("bed_exclude_areas", fmt::format("area {} crosses itself or encloses nothing", i + 1), hint);
  if (!machine.machine_reach.empty() && !sound(reach_area(machine)))
    refuse("machine_reach", "the outline crosses itself or encloses nothing", "give two opposite corners of a box, or a polygon");
  if (machine.machine_reach_z_min >= reach_z_max(machine))
    refuse("machine_reach_z_min", "is not below the highest Z of the reach", "lower it, or raise machine_reach_z_max");
  if (machine.home_position && machine.home_position->size() != 1)
    refuse("home_position", "is not one point", "give it as 0x0, or auto when it is not known");
}

}  // namespace

void check_consistency(const Profile& profile) {
  const auto& s = profile.settings;
  const auto refuse = [&](const char* key, std::string what, std::string hint) {
    throw Error{Error::Kind::settings, fmt::format("{}: {}", key, what), origin_of(profile, key), std::move(hint)};
  };
  const auto nozzle = s.machine.nozzle_diameter;
  if (s.layers.layer_height > nozzle)
    refuse("layer_height", fmt::format("{} mm is more than nozzle_diameter {} mm", to_mm(s.layers.layer_height), to_mm(nozzle)), "a bead cannot be higher than the nozzle is wide");
  if (s.layers.initial_layer_height.value_or(0) > nozzle)
    refuse("initial_layer_height", fmt::format("{} mm is more than nozzle_diameter {} mm", to_mm(*s.layers.initial_layer_height), to_mm(nozzle)),
           "a bead cannot be higher than the nozzle is wide");
  if (s.machine.bed_shape == BedShape::polygon && s.machine.bed_polygon.size() < 3)
    refuse("bed_polygon", "a bed of shape polygon needs at least three corners", "give them as 0x0, 220x0, 220x220, 0x220");
  check_areas(s.machine, refuse);
}

}  // namespace weft
