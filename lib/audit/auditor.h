// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "audit/audit.h"
#include "audit/heights.h"
#include "audit/lines.h"
#include "audit/owners.h"
#include "audit/tally.h"

#include <vector>

namespace weft::audit {

/// The machine as the audit measures it, mm. Built from the settings, and nothing else of the program.
struct Volumes {
  Volumes(const MachineSettings& machine, const AuditSettings& audit);
  Shape surface, reach;
  std::vector<Shape> no_go;
  bool reach_is_box, reach_is_convex;
  double reach_z_min_mm, reach_z_max_mm, no_go_below_mm, tolerance_mm;
  std::array<Um, 6> reach_beyond;       ///< Report::reach_beyond
  Bounds surface_inside, reach_inside;  ///< boxes wholly inside: most motions need no more than these
  std::vector<Vec> nozzle_offsets;
  Vec nozzle_offset(int tool) const {
    const auto i = static_cast<std::size_t>(tool);
    return i < nozzle_offsets.size() ? nozzle_offsets[i] : Vec{};
  }
};

/// One pass over G-code. Feed it bytes in pieces of any size, then finish.
class Auditor {
 public:
  Auditor(const MachineSettings& machine, const MaterialSettings& material, const AuditSettings& audit,
          const PlateSettings& plate, bool keep_marks);
  void feed(std::string_view bytes);
  Report finish();
  /// Where annotations belong; empty unless keep_marks. After finish().
  const std::vector<Mark>& marks() const { return tally_.marks(); }

 private:
  void line(const Lines::Line& line);
  void judge(const Motion& motion);
  void judge_reach(const Motion& motion);
  void judge_surface(const Motion& motion, double margin_mm);
  void judge_no_go(const Motion& motion, double margin_mm);
  void judge_height(const Motion& motion);
  void judge_half_known(const Motion& motion);
  void judge_head(const Motion& motion);
  void lay(const Motion& motion, double half_width_mm);
  bool can_be_judged(const Motion& motion, bool printing) const;
  bool below_no_go(const Motion& motion) const;
  void count(const Motion& motion);
  void report_unaudited(Report& report) const;
  double half_bead_mm(const Motion& motion);
  double bead_height_mm() const;
  void offer(Violation& worst, Finding::Kind kind, const Motion& motion, const Excess& excess, int area = 0);

  Volumes volumes_;
  double filament_area_mm2_;
  Lines lines_;
  Reader reader_;
  Tally tally_;
  std::optional<HeadWatch> head_;  ///< absent: nothing is known of it
  int head_layer_ = -1;
  double highest_bead_mm_ = 0;  ///< of that layer so far
  Owners owners_;
  Tally unmarked_;  ///< what counts only if no comment ever tells print from custom G-code
  std::int64_t checked_ = 0, unaudited_ = 0;
  std::vector<std::int64_t> unaudited_by_cause_;  ///< by the reader's number of the cause
  /// Beads from a place that is not known, by cause: they count if no comment ever tells print from custom G-code.
  std::vector<std::int64_t> unmarked_by_cause_;
  double layer_z_mm_ = 0, layer_height_mm_ = 0;  ///< of the last extrusion, for files that do not state a height
  // Of the line at hand:
  std::int64_t line_offset_ = 0;
  Violation violation_, surface_violation_;  ///< the worst; its excess is 0 when there is none
};

}  // namespace weft::audit
