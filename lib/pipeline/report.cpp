// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/report.h"

#include "core/figures.h"
#include "core/json_text.h"
#include "core/version.h"

#include <nlohmann/json.hpp>
#include <sys/resource.h>

namespace weft {
namespace {

using Json = nlohmann::ordered_json;

std::string_view name_of(Report::Status status) {
  switch (status) {
    case Report::Status::ok:
      return "ok";
    case Report::Status::rejected:
      return "rejected";
    case Report::Status::annotated:
      return "annotated";
    case Report::Status::failed:
      break;
  }
  return "failed";
}

Json models_of(const Report& r) {
  Json out = Json::array();
  for (const auto& m : r.models) {
    out.push_back({{"file", m.file},
                   {"sha256", m.sha256},
                   {"triangles", m.triangles},
                   {"volume_mm3", rounded3(m.volume_mm3)},
                   {"repairs", m.repairs}});
    if (!m.transforms.empty()) out.back()["transforms"] = m.transforms;
    for (const auto& o : m.orientations)
      out.back()["orientations"].push_back({{"down", {rounded3(o.down[0]), rounded3(o.down[1]), rounded3(o.down[2])}},
                                            {"support_mm3", rounded3(o.support_mm3)},
                                            {"contact_mm2", rounded3(o.contact_mm2)},
                                            {"on_part_mm2", rounded3(o.on_part_mm2)},
                                            {"height_mm", rounded3(o.height_mm)},
                                            {"foot_mm2", rounded3(o.foot_mm2)},
                                            {"cost_mm3", rounded3(o.cost_mm3)}});
  }
  return out;
}

Json objects_of(const Report& r) {
  Json out = Json::array();
  for (const auto& o : r.objects) {
    out.push_back({{"name", o.name},
                   {"at", {rounded3(o.at_mm[0]), rounded3(o.at_mm[1])}},
                   {"size", {rounded3(o.size_mm[0]), rounded3(o.size_mm[1])}}});
    for (const auto& [key, text] : o.settings) out.back()["settings"][key] = text;
  }
  return out;
}

Json plates_of(const Report& r) {
  Json out = Json::array();
  for (const auto& plate : r.plates) {
    Json own = Json::array();
    for (const auto& [file, copies] : plate) own.push_back({{"file", file}, {"copies", copies}});
    out.push_back(std::move(own));
  }
  return out;
}

Json features_of(const Report& r) {
  Json out = Json::object();
  for (const auto& row : roles) {
    const auto& f = r.features[static_cast<std::size_t>(row.role)];
    out[std::string(row.key)] = {{"mm", rounded3(f.mm)}, {"mm3", rounded3(f.mm3)}, {"s", rounded3(f.s)}};
  }
  return out;
}

Json walls_of(const Report::Walls& w) {
  Json over_air = Json::object();
  for (std::size_t quarter = 0; quarter < w.over_air_mm.size(); ++quarter)
    over_air["to_" + std::to_string(25 * (quarter + 1)) + "_percent"] = rounded3(w.over_air_mm[quarter]);
  over_air["whole"] = rounded3(w.whole_over_air_mm);
  return {{"beads", w.beads},
          {"variable_width_mm", rounded3(w.variable_width_mm)},
          {"flow_compensated_mm", rounded3(w.flow_compensated_mm)},
          {"min_flow_ratio", rounded3(w.min_flow_ratio)},
          {"min_width_mm", rounded3(w.min_width_mm)},
          {"over_air_mm", std::move(over_air)}};
}

/// What was asked for beside it, into the report and what it says of walls.
void tell_figures(const Figures& f, Json& out) {
  Json seconds = Json::array(), layers = Json::array(), thin = Json::array();
  for (const double s : f.flow_s) seconds.push_back(rounded3(s));
  for (const auto& layer : f.layers)
    layers.push_back({{"z_mm", rounded3(layer.z_mm)},
                      {"s", rounded3(layer.s)},
                      {"ratio", rounded3(layer.ratio)},
                      {"fan_percent", rounded3(layer.fan_percent)},
                      {"unsupported_mm2", rounded3(layer.unsupported_mm2)},
                      {"longest_span_mm", rounded3(layer.longest_span_mm)},
                      {"least_rest_s", rounded3(layer.least_rest_s)}});
  for (const auto& place : f.thin)
    thin.push_back({{"at", {rounded3(place.at_mm[0]), rounded3(place.at_mm[1]), rounded3(place.at_mm[2])}},
                    {"mm", rounded3(place.mm)}});
  out["flow"] = {{"s_by_mm3_s", std::move(seconds)}, {"at_limit_percent", rounded3(f.at_limit_percent)}};
  out["per_layer"] = std::move(layers);
  auto& walls = out["walls"];
  walls["thin_mm"] = rounded3(f.thin_mm);
  walls["thin"] = std::move(thin);
  walls["outer_at_one_speed_percent"] = rounded3(f.even_outer_percent);
  walls["speed_changes_per_m"] = rounded3(f.speed_changes_per_m);
  out["surface"] = {
      {"mean_cusp_um", rounded3(f.mean_cusp_um)}, {"faces", f.faces}, {"faces_missed_um", rounded3(f.faces_missed_um)}};
  if (f.least_ironing_mm3_s > 0)
    out["ironing"] = {{"longest_s", rounded3(f.longest_ironing_s)}, {"least_mm3_s", rounded3(f.least_ironing_mm3_s)}};
  out["time"] = {{"accelerating_percent", rounded3(f.accelerating_percent)}};
}

Json support_of(const Report& r) {
  const auto& s = r.support;
  double mm3 = 0, seconds = 0;  // with a raft, where there is one
  for (const Role role : {Role::support, Role::support_interface}) {
    const auto& f = r.features[static_cast<std::size_t>(role)];
    mm3 += f.mm3, seconds += f.s;
  }
  return {{"needed_mm2", rounded3(s.needed_mm2)},
          {"bridged_mm2", rounded3(s.bridged_mm2)},
          {"covered_mm2", rounded3(s.needed_mm2 - s.left_mm2)},
          {"left_mm2", rounded3(s.left_mm2)},
          {"contact_mm2", rounded3(s.contact_mm2)},
          {"on_part_mm2", rounded3(s.on_part_mm2)},
          {"islands", s.islands},
          {"tips", s.tips},
          {"trunks", s.trunks},
          {"slenderest", rounded3(s.slenderest)},
          {"trapped_mm3", rounded3(s.trapped_mm3)},
          {"mm3", rounded3(mm3)},
          {"s", rounded3(seconds)}};
}

Json infill_of(const Report::Infill& i) {
  return {
      {"pattern", i.pattern},
      {"density_percent", rounded3(i.density_percent)},
      {"density_spread_percent", rounded3(i.density_spread_percent)},
      {"length_spread_percent", rounded3(i.length_spread_percent)},
      {"fabric", {{"h2", rounded3(i.fabric[0])}, {"h4", rounded3(i.fabric[1])}, {"h6", rounded3(i.fabric[2])}}},
      {"over_air_percent", rounded3(i.over_air_percent)},
      {"locality", rounded3(i.locality)},
      {"box_dimension", rounded3(i.box_dimension)},
      {"stiffness_percent", {{"plane", rounded3(i.stiffness_plane_percent)}, {"z", rounded3(i.stiffness_z_percent)}}},
      {"conductivity_percent",
       {{"plane", rounded3(i.conductivity_plane_percent)}, {"z", rounded3(i.conductivity_z_percent)}}}};
}

Json tools_of(const Report& r) {
  Json out = Json::array();
  for (const auto& t : r.tools) {
    Json tool{{"filament",
               {{"mm", rounded3(t.filament_mm)}, {"mm3", rounded3(t.filament_mm3)}, {"g", rounded3(t.filament_g)}}},
              {"s", rounded3(t.s)},
              {"changes", t.changes},
              {"tower_mm3", rounded3(t.tower_mm3)}};
    if (r.cost) tool["cost"] = rounded3(t.cost);
    out.push_back(std::move(tool));
  }
  return out;
}

/// What was to be purged, and what of it went into the tower; the rest went into the print.
Json purge_of(const Report& r) {
  double tower_mm3 = 0;
  for (const auto& t : r.tools) tower_mm3 += t.tower_mm3;
  return {{"wanted_mm3", rounded3(r.purged.wanted_mm3)},
          {"tower_mm3", rounded3(tower_mm3)},
          {"objects_mm3", rounded3(r.purged.objects_mm3)},
          {"support_mm3", rounded3(r.purged.support_mm3)},
          {"infill_mm3", rounded3(r.purged.infill_mm3)}};
}

Json audit_of(const Report::Audit& a) {
  Json violations = Json::array();
  for (const auto& v : a.violations)
    violations.push_back({{"move", v.move},
                          {"feature", v.feature},
                          {"object", v.object},
                          {"side", v.side},
                          {"at", {rounded3(v.at_mm[0]), rounded3(v.at_mm[1]), rounded3(v.at_mm[2])}},
                          {"outside_mm", rounded3(v.outside_mm)},
                          {"layer", v.layer},
                          {"line", v.line},
                          {"text", v.line_text}});
  for (std::size_t i = 0; i < a.violations.size(); ++i)
    if (!a.violations[i].setting.empty()) violations[i]["setting"] = a.violations[i].setting;
  Json beyond = Json::object();
  for (const auto& [side, mm] : a.reach_beyond_mm) beyond[side] = rounded3(mm);
  Json gaps = Json::array();
  for (const auto& g : a.gaps)
    gaps.push_back({{"command", g.command}, {"line", g.line}, {"why", g.why}, {"moves", g.moves}});
  return {{"verdict", a.verdict},
          {"summary", a.summary},
          {"checked_moves", a.checked_moves},
          {"not_audited", a.not_audited},
          {"not_audited_because", std::move(gaps)},
          {"opaque", a.opaque},
          {"reach_beyond_surface_mm", std::move(beyond)},
          {"violations", std::move(violations)},
          {"violation_count", a.violation_count}};
}

Json warnings_of(const Notices& notices) {
  Json out = Json::array();
  for (const auto& n : notices) out.push_back({{"code", n.code}, {"message", n.message}});
  return out;
}

}  // namespace

std::string to_json(const Report& r) {
  Json out{{"weft", version}, {"status", name_of(r.status)}};
  if (!r.error.empty()) out["error"] = r.error;
  out["models"] = models_of(r);
  if (!r.plates.empty()) out["plate"] = r.plate, out["plates"] = plates_of(r);
  if (!r.objects.empty()) out["objects"] = objects_of(r);
  out["settings_sha256"] = r.settings_sha256;
  out["gcode_sha256"] = r.gcode_sha256;
  out["layers"] = r.layers;
  out["height_mm"] = rounded3(r.height_mm);
  out["print_time_s"] = rounded3(r.print_time_s);
  out["filament"] = {{"mm", rounded3(r.filament_mm)}, {"mm3", rounded3(r.filament_mm3)}, {"g", rounded3(r.filament_g)}};
  if (!r.tools.empty()) out["tools"] = tools_of(r);
  if (r.purged.wanted_mm3 > 0) out["purge"] = purge_of(r);
  if (r.cost)
    out["cost"] = {{"filament", rounded3(r.cost->filament)},
                   {"machine", rounded3(r.cost->machine)},
                   {"total", rounded3(r.cost->total())},
                   {"currency", r.currency}};
  out["features"] = features_of(r);
  out["walls"] = walls_of(r.walls);
  if (r.infill.mm3 > 0) out["infill"] = infill_of(r.infill);
  for (const auto& file : r.infill_files)
    out["infill_files"].push_back({{"key", file.key}, {"file", file.file}, {"sha256", file.sha256}});
  if (r.support.needed_mm2 > 0 || r.support.bridged_mm2 > 0 || r.support.layers > 0) out["support"] = support_of(r);
  if (r.arcs.count > 0)
    out["arcs"] = {{"count", r.arcs.count}, {"moves", r.arcs.pieces}, {"worst_um", rounded3(r.arcs.worst_um)}};
  out["travel"] = {{"mm", rounded3(r.travel.mm)},
                   {"moves", r.travel.moves},
                   {"retractions", r.travel.retractions},
                   {"wall_crossings", r.travel.wall_crossings}};
  if (r.figures) tell_figures(*r.figures, out);
  out["audit"] = audit_of(r.audit);
  out["warnings"] = warnings_of(r.warnings);
  auto& times = out["timings_ms"];
  pipeline::for_each_stage([&](const auto& row) { times[row.name] = rounded3(r.timings_ms[row.stage]); });
  times["total"] = rounded3(r.timings_ms.total);
  out["peak_memory_mb"] = rounded3(r.peak_memory_mb);
  return json_text(std::move(out), 2) + "\n";
}

double peak_memory_mb() {
  struct rusage usage {};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

}  // namespace weft
