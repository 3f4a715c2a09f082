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

const Finding* worst_of(const Report& report) {
  const auto at =
      std::max_element(report.findings.begin(), report.findings.end(), [](const Finding& a, const Finding& b) {
        return a.kind == Finding::Kind::damaged || (b.kind != Finding::Kind::damaged && a.outside < b.outside);
      });
  return at == report.findings.end() ? nullptr : &*at;
}

/// "1.200 mm beyond +x of the print surface", "1.200 mm inside no-go area 2".
std::string extent_of(const Finding& f) {
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
  static constexpr std::array<std::string_view, 4> names{"travel", "extrude", "arc", "lift"};
  return names[static_cast<std::size_t>(kind)];
}

std::string_view name_of(Side side) {
  static constexpr std::array<std::string_view, 8> names{"-x", "+x", "-y", "+y", "-z", "+z", "no-go area", ""};
  return names[static_cast<std::size_t>(side)];
}

std::string_view name_of(Verdict verdict) {
  static constexpr std::array<std::string_view, 3> names{"pass", "annotated", "rejected"};
  return names[static_cast<std::size_t>(verdict)];
}

std::string describe(const Finding& f) {
  if (f.kind == Finding::Kind::damaged) return fmt::format("line {}: {}: {}", f.line, f.problem, f.text);
  return fmt::format("line {}: {} at ({:.3f}, {:.3f}, {:.3f}) is {}{}: {}", f.line, who(f), to_mm(f.at.x),
                     to_mm(f.at.y), to_mm(f.at.z), extent_of(f),
                     f.object.empty() ? "" : fmt::format(" (object {})", f.object), f.text);
}

std::string summary(const Report& r) {
  if (r.clean()) return fmt::format("{} moves checked, {} not audited", r.checked_moves, r.unaudited_moves);
  const auto outside = r.violation_count - r.damaged_count;
  std::string out;
  const Finding* const worst = worst_of(r);
  if (outside > 0) {
    out = fmt::format("{} move{} outside", outside, plural(outside));
    if (worst) out += fmt::format(", worst {} ({}, line {})", extent_of(*worst), who(*worst), worst->line);
  }
  if (r.damaged_count > 0) {
    const auto first = std::find_if(r.findings.begin(), r.findings.end(),
                                    [](const Finding& f) { return f.kind == Finding::Kind::damaged; });
    out += fmt::format("{}{} damaged line{}", out.empty() ? "" : "; ", r.damaged_count, plural(r.damaged_count));
    if (first != r.findings.end()) out += fmt::format(", first line {}: {}", first->line, first->problem);
  }
  return out;
}

std::string remedy(const Report& r) {
  const Finding* const f = worst_of(r);
  if (!f) return {};
  switch (f->kind) {
    case Finding::Kind::damaged:
      return "slice it again or copy it again: the file is not as its slicer wrote it";
    case Finding::Kind::no_go:
      return "move the part away from bed_exclude_areas, or give exclude_height if the nozzle may pass above them";
    case Finding::Kind::surface:
      if (f->feature == "skirt") return "use a smaller skirt or brim, adhesion_outside = clip, or move the part";
      if (f->feature == "brim") return "use a narrower brim, adhesion_outside = clip, or move the part";
      return "move or turn the part, or take a larger printer";
    case Finding::Kind::reach:
      break;
  }
  if (f->side == Side::plus_z)
    return "the print or its end G-code is higher than the machine; see machine_height and machine_reach_z_max";
  if (f->side == Side::minus_z) return "if the nozzle may go this low, say so with machine_reach_z_min";
  if (f->feature == "custom")
    return "if the nozzle can go there, say so with machine_reach; if not, mend the start or end G-code";
  return "move the part inwards; if the nozzle can go there, say so with machine_reach";
}

std::string header_value(const Report& r) {
  if (r.clean()) return fmt::format("pass, {}", summary(r));
  const auto outside = r.violation_count - r.damaged_count;
  std::string out = fmt::format("{}: {} move{} outside, worst {:.3f} mm", name_of(r.verdict), outside, plural(outside),
                                to_mm(r.worst_outside));
  if (r.damaged_count > 0) out += fmt::format(", {} damaged line{}", r.damaged_count, plural(r.damaged_count));
  return out;
}

}  // namespace weft::audit
