// SPDX-License-Identifier: GPL-3.0-or-later
// The audit's findings in words.
#include "audit/audit.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace weft::audit {
namespace {

std::string_view volume_of(Finding::Kind kind) {
  return kind == Finding::Kind::surface ? "the print surface" : "the reach";
}

/// Of those of the head, or of the others that are no damage.
const Finding* worst_of(const Report& report, bool head) {
  const Finding* out = nullptr;
  for (const auto& f : report.findings)
    if (f.kind != Finding::Kind::damaged && (f.kind == Finding::Kind::head) == head &&
        (out == nullptr || f.outside > out->outside))
      out = &f;
  return out;
}

const Finding* worst_of(const Report& report) {
  const auto at =
      std::max_element(report.findings.begin(), report.findings.end(), [](const Finding& a, const Finding& b) {
        return a.kind == Finding::Kind::damaged || (b.kind != Finding::Kind::damaged && a.outside < b.outside);
      });
  return at == report.findings.end() ? nullptr : &*at;
}

/// "1.200 mm beyond +x of the print surface", "1.200 mm inside no-go area 2".
std::string extent_of(const Finding& f) {
  if (f.kind == Finding::Kind::head)
    return fmt::format(
        "{:.3f} mm deep in what stands at ({:.3f}, {:.3f}), with what of the head is {:g} mm above its tip",
        to_mm(f.outside), to_mm(f.met.x), to_mm(f.met.y), to_mm(f.above_tip));
  if (f.kind == Finding::Kind::no_go) return fmt::format("{:.3f} mm inside no-go area {}", to_mm(f.outside), f.area);
  return fmt::format("{:.3f} mm beyond {} of {}", to_mm(f.outside), name_of(f.side), volume_of(f.kind));
}

constexpr const char* plural(std::int64_t n) {
  return n == 1 ? "" : "s";
}

std::string who(const Finding& f) {
  std::string out = f.feature;
  if (!out.empty()) out += ", ";
  return out += name_of(f.move);
}

}  // namespace

std::string_view name_of(Motion::Kind kind) {
  static constexpr std::array<std::string_view, 6> names{"travel", "extrude",     "arc",
                                                         "lift",   "sloped lift", "spiral lift"};
  return names[static_cast<std::size_t>(kind)];
}

std::string_view name_of(Side side) {
  static constexpr std::array<std::string_view, 8> names{"-x", "+x", "-y", "+y", "-z", "+z", "no-go area", ""};
  return names[static_cast<std::size_t>(side)];
}

std::string_view name_of(Verdict verdict) {
  static constexpr std::array<std::string_view, 4> names{"pass", "annotated", "rejected", "unaudited"};
  return names[static_cast<std::size_t>(verdict)];
}

std::string describe(const Finding& f) {
  const std::string from = f.setting.empty() ? "" : fmt::format(" (from {})", f.setting);
  if (f.kind == Finding::Kind::damaged) return fmt::format("line {}: {}{}: {}", f.line, f.problem, from, f.text);
  return fmt::format("line {}: {} at ({:.3f}, {:.3f}, {:.3f}) is {}{}{}: {}", f.line, who(f), to_mm(f.at.x),
                     to_mm(f.at.y), to_mm(f.at.z), extent_of(f),
                     f.object.empty() ? "" : fmt::format(" (object {})", f.object), from, f.text);
}

std::string describe(const Conflict& c) {
  const auto named = [](const std::string& name, bool support) {
    const bool of_none = name == "skirt" || name == "brim" || name == "wipe_tower";
    return (support ? "the support of " : "") + (of_none ? name : fmt::format("'{}'", name));
  };
  return fmt::format("{} and {} overlap at layer {}, z {:.3f}, ({:.3f}, {:.3f}), {:.3f} mm deep ({}, {})",
                     named(c.a, c.support_a), named(c.b, c.support_b), c.layer, to_mm(c.at.z), to_mm(c.at.x),
                     to_mm(c.at.y), to_mm(c.depth), c.feature_a, c.feature_b);
}

std::string describe(const Cause& cause) {
  if (cause.command.empty()) return std::string(cause.why);
  return fmt::format("{} on line {}: {}", cause.command, cause.line, cause.why);
}

namespace {

/// "PRINT_START, G29", cut after some.
std::string names_of(const std::vector<Opaque>& opaque) {
  constexpr std::size_t most = 12;
  std::string out;
  for (std::size_t i = 0; i < opaque.size() && i < most; ++i) out += (i == 0 ? "" : ", ") + opaque[i].name;
  if (opaque.size() > most) out += fmt::format(" and {} more", opaque.size() - most);
  return out;
}

/// "1553 moves not audited (G68 on line 3: it turns the coordinates)".
std::string unaudited_of(const Report& r) {
  std::string out = fmt::format("{} move{} not audited", r.unaudited_moves, plural(r.unaudited_moves));
  if (r.unaudited.empty()) return out;
  const auto most = std::max_element(r.unaudited.begin(), r.unaudited.end(),
                                     [](const Unaudited& a, const Unaudited& b) { return a.count < b.count; });
  out += " (" + describe(most->cause);
  if (r.unaudited.size() > 1)
    out += fmt::format("; {} more cause{}", r.unaudited.size() - 1,
                       plural(static_cast<std::int64_t>(r.unaudited.size()) - 1));
  return out + ")";
}

std::string damage_of(const Report& r) {
  const auto first = std::find_if(r.findings.begin(), r.findings.end(),
                                  [](const Finding& f) { return f.kind == Finding::Kind::damaged; });
  std::string out = fmt::format("{} damaged line{}", r.damaged_count, plural(r.damaged_count));
  if (first != r.findings.end()) {
    out += fmt::format(", first line {}: {}", first->line, first->problem);
    if (!first->setting.empty()) out += fmt::format(", from {}: {}", first->setting, first->text);
  }
  return out;
}

}  // namespace

std::string summary(const Report& r) {
  if (r.empty()) return "nothing to audit: did the upload break off?";
  const auto met = r.count_of(Finding::Kind::head), outside = r.violation_count - r.damaged_count - met;
  std::string out;
  const auto add = [&](const std::string& part) { out += (out.empty() ? "" : "; ") + part; };
  const auto add_worst = [&](const std::string& part, bool head) {
    add(part);
    const Finding* const worst = worst_of(r, head);
    if (!worst) return;
    out += fmt::format(", worst {} ({}, line {})", extent_of(*worst), who(*worst), worst->line);
    if (!worst->setting.empty()) out += fmt::format(", from {}: {}", worst->setting, worst->text);
  };
  if (outside > 0) add_worst(fmt::format("{} move{} outside", outside, plural(outside)), false);
  if (met > 0) add_worst(fmt::format("{} move{} into what is printed", met, plural(met)), true);
  if (const Conflict* const conflict = r.blocking()) add(describe(*conflict));
  if (r.damaged_count > 0) add(damage_of(r));
  if (r.unaudited_moves > 0) add(unaudited_of(r));
  if (r.clean()) add(fmt::format("{} move{} checked", r.checked_moves, plural(r.checked_moves)));
  if (!r.opaque.empty()) add("opaque: " + names_of(r.opaque));
  return out;
}

namespace {

/// How to have moves audited that could not be.
std::string remedy_for(const Cause& cause) {
  if (cause.frame)
    return fmt::format("take {} out, or use --audit annotate if the printer is known to stay inside", cause.command);
  if (cause.command == "G28") return "say with home_position and home_z where G28 leaves the nozzle";
  if (cause.command.empty())
    return "home first (G28), and say with home_position and home_z where that leaves the nozzle";
  return "say with macro_position and macro_z where macros leave the nozzle";
}

}  // namespace

std::string remedy(const Report& r) {
  const Finding* const f = worst_of(r);
  if (!f && r.blocking() != nullptr) return "move them apart, or make them parts of one object";
  if (!f) return r.unaudited.empty() ? std::string{} : remedy_for(r.unaudited.front().cause);
  switch (f->kind) {
    case Finding::Kind::damaged:
      return f->setting.empty() ? "slice it again or copy it again: the file is not as its slicer wrote it"
                                : "mend " + f->setting;
    case Finding::Kind::no_go:
      if (f->feature.starts_with("support"))
        return "support_outside = route, or move the part away from bed_exclude_areas";
      return "move the part away from bed_exclude_areas, or give exclude_height if the nozzle may pass above them";
    case Finding::Kind::surface:
      if (f->feature == "skirt") return "use a smaller skirt or brim, adhesion_outside = clip, or move the part";
      if (f->feature == "brim") return "use a narrower brim, adhesion_outside = clip, or move the part";
      if (f->feature.starts_with("support")) return "support_outside = route, or move the part";
      return "move or turn the part, or take a larger printer";
    case Finding::Kind::head:
      return f->feature == "custom" ? fmt::format("raise the nozzle first in {}",
                                                  f->setting.empty() ? "the start or end G-code" : f->setting)
                                    : "print all at once, or move the objects apart";
    case Finding::Kind::reach:
      break;
  }
  if (f->side == Side::plus_z)
    return "the print or its end G-code is higher than the machine; see machine_height and machine_reach_z_max";
  if (f->side == Side::minus_z) return "if the nozzle may go this low, say so with machine_reach_z_min";
  if (f->feature == "custom")
    return fmt::format("if the nozzle can go there, say so with machine_reach; if not, mend {}",
                       f->setting.empty() ? "the start or end G-code" : f->setting);
  return "move the part inwards; if the nozzle can go there, say so with machine_reach";
}

std::string header_value(const Report& r) {
  if (r.clean()) return fmt::format("pass, {}", summary(r));
  const auto met = r.count_of(Finding::Kind::head), outside = r.violation_count - r.damaged_count - met;
  std::string out;
  const auto add = [&](const std::string& part) { out += (out.empty() ? ": " : ", ") + part; };
  const auto add_worst = [&](std::int64_t count, const char* what, bool head) {
    const Finding* const worst = worst_of(r, head);
    add(fmt::format("{} move{} {}, worst {:.3f} mm", count, plural(count), what, worst ? to_mm(worst->outside) : 0.0));
  };
  if (outside > 0) add_worst(outside, "outside", false);
  if (met > 0) add_worst(met, "into what is printed", true);
  if (r.blocking() != nullptr) add("objects overlap");
  if (r.damaged_count > 0) add(fmt::format("{} damaged line{}", r.damaged_count, plural(r.damaged_count)));
  if (r.unaudited_moves > 0) add(fmt::format("{} move{} not audited", r.unaudited_moves, plural(r.unaudited_moves)));
  if (r.empty()) add("nothing to audit");
  return std::string(name_of(r.verdict)) + out;
}

}  // namespace weft::audit
