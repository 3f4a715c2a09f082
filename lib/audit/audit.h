// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "audit/reader.h"
#include "audit/shape.h"
#include "core/error.h"
#include "core/notice.h"
#include "core/point.h"
#include "settings/groups/audit.h"
#include "settings/groups/machine.h"
#include "settings/groups/material.h"
#include "settings/groups/plate.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// The boundary audit: finished G-code is read back by a reader that shares nothing with the writer, and every motion
/// in it is checked against the machine. `Check` is the door that all G-code of weft leaves through; `examine` looks at
/// a file of any slicer.
namespace weft::audit {

class Auditor;

/// Names of Motion::Kind and Side in reports.
std::string_view name_of(Motion::Kind kind);
std::string_view name_of(Side side);

/// A place where the file would take the machine where it must not go, or that cannot be read.
struct Finding {
  enum class Kind {
    surface,  ///< an extrusion of the print, with half its bead, beyond the print surface
    reach,    ///< a motion beyond what the nozzle can go to
    no_go,    ///< a motion through one of bed_exclude_areas
    damaged,  ///< the line is not what a slicer writes
    head,     ///< the head, or the bar that carries it, in what is printed
  };
  Kind kind = Kind::reach;
  Motion::Kind move = Motion::Kind::travel;
  std::string feature;     ///< "skirt", "custom" …; "" when the file does not say
  std::string object;      ///< "" when the file does not say
  Side side = Side::none;  ///< of the volume; Side::no_go: see `area`
  int area = 0;            ///< number of the no-go area, from 1
  Point3 at;               ///< the worst place of the nozzle's way
  Um outside = 0;          ///< how far, half the bead included
  int layer = -1;          ///< from 0; −1: before the first
  std::int64_t line = 0;   ///< from 1, in the bytes that were audited; in annotated G-code, of the annotated text
  std::string text;        ///< the line, cut to 120 characters
  std::string problem;     ///< of a damaged line
  std::string setting;     ///< the custom G-code that it came from; "" when it is the slicer's own, or not known
  Um above_tip = 0;        ///< of what of the head meets what is printed
  Point met;               ///< and where that is
};

/// Two owners of beads that lie in each other: copies, supports, and what belongs to none.
struct Conflict {
  std::string a, b;                           ///< labels of objects, or "skirt", "brim", "wipe_tower"
  bool support_a = false, support_b = false;  ///< it is the object's support
  std::string feature_a, feature_b;           ///< where it is deepest, on the lowest layer with any
  Point3 at;
  Um depth = 0;
  int layer = -1;
  std::int64_t layers = 0;  ///< on how many
  bool blocks = true;       ///< supports may meet, and lie in skirts; a brim lies at its part
};
/// "'body' and 'lid' overlap at layer 12, z 2.400, (112.500, 100.200), 0.420 mm deep (outer_wall, skin)"
std::string describe(const Conflict& conflict);

/// Moves whose way is not known, by what made it so.
struct Unaudited {
  Cause cause;
  std::int64_t count = 0;
};
/// "G68 on line 12: it turns the coordinates".
std::string describe(const Cause& cause);

/// How many findings of one sort there are, and how far the worst of them is outside.
struct Total {
  Finding::Kind kind;
  Side side;  ///< every side that a motion leaves counts
  int area;
  std::string feature;
  std::int64_t count;
  Um worst;
};

/// Verdict::unaudited: nothing was found, but not every motion could be judged, or there is none.
enum class Verdict { pass, annotated, rejected, unaudited };
std::string_view name_of(Verdict verdict);

struct Report {
  Verdict verdict = Verdict::pass;
  std::int64_t checked_moves = 0;    ///< of which the whole extent was judged
  std::int64_t unaudited_moves = 0;  ///< from or to a place that is not known, or curves of unknown extent
  std::int64_t violation_count = 0;  ///< lines with a motion outside, and damaged lines
  std::int64_t damaged_count = 0;    ///< of these, the damaged lines
  Um worst_outside = 0;
  std::vector<Finding> findings;  ///< by line; the first audit_max_findings, the worst of each sort always among them
  std::vector<Total> totals;      ///< by kind, side and feature
  std::vector<Unaudited> unaudited;  ///< why, by line
  std::vector<Opaque> opaque;        ///< what only the printer knows: macros, calibrations, tool changes
  std::int64_t opaque_count = 0;
  std::int64_t lines = 0, bytes = 0;
  std::vector<Conflict> conflicts;  ///< all pairs of owners, by where they begin
  bool labelled = false;            ///< the file says whose its beads are: without that conflicts are not audited
  /// How far the reach goes beyond the print surface and beyond 0 … machine_height: −x, +x, −y, +y, −z, +z. What is
  /// printed stays on the surface; custom G-code and travels may use all of it.
  std::array<Um, 6> reach_beyond{};
  Um tolerance = 0;
  Notices notices;

  /// Share of the moves that were judged in full, 0 … 1; 1 when there are none.
  double coverage() const;
  /// Does the file hold no move at all?
  bool empty() const { return checked_moves + unaudited_moves == 0 && violation_count == 0; }
  /// Was every motion judged, and none found outside?
  bool clean() const { return violation_count == 0 && unaudited_moves == 0 && !empty() && blocking() == nullptr; }
  /// The first conflict that blocks; null: none does.
  const Conflict* blocking() const;
  /// How many findings of a kind there are.
  std::int64_t count_of(Finding::Kind kind) const;
};

enum class Mode { reject, annotate };

/// The audit refused the job.
class Rejected : public Error {
 public:
  explicit Rejected(Report report, std::string where = {});
  const Report& report() const { return report_; }

 private:
  Report report_;
};

/// G-code that went through the audit. Only `Check` makes one, and the file writer takes nothing else.
class Passed {
 public:
  std::string_view gcode() const { return gcode_; }
  const Report& report() const { return report_; }

 private:
  friend class Check;
  Passed(std::string gcode, Report report) : gcode_(std::move(gcode)), report_(std::move(report)) {}
  std::string gcode_;
  Report report_;
};

/// Audits G-code while it grows: the text is the audit's from its first byte, so that nothing stands in it unread.
class Check {
 public:
  /// @param plate the head, and how deep beads of two objects may lie in each other
  Check(const MachineSettings& machine, const MaterialSettings& material, const AuditSettings& audit, Mode mode,
        const PlateSettings& plate = {});
  ~Check();
  Check(const Check&) = delete;
  Check& operator=(const Check&) = delete;

  /// Room for a text of so many bytes, which then grows without a copy.
  void reserve(std::size_t bytes);
  /// What the text goes on with. Cost: one pass.
  void add(std::string_view piece);
  /// Custom G-code of the profile: findings in it name their setting. `text` may hold placeholders.
  void custom_code(std::string_view setting, std::string_view text);
  /// States the verdict in the text's header: the line that starts with `; weft_audit = ` is rewritten, or one is put
  /// behind the first line. With Mode::annotate a comment stands before every offending line; else the bytes are kept.
  /// Memory: when annotating, one copy of the text. Post: there is no text.
  /// @throws Rejected when something was found and the mode is Mode::reject
  Passed passed();

 private:
  friend Passed check(const MachineSettings&, const MaterialSettings&, const AuditSettings&, std::string, Mode,
                      const PlateSettings&);
  std::unique_ptr<Auditor> auditor_;
  Mode mode_;
  std::string gcode_;
  std::vector<std::pair<std::string, std::string>> custom_;
};

/// Audits finished G-code, as Check does. @throws Rejected
Passed check(const MachineSettings& machine, const MaterialSettings& material, const AuditSettings& audit,
             std::string gcode, Mode mode, const PlateSettings& plate = {});

/// Audits a file of any slicer. Cost: one pass, constant memory.
/// @throws Error{file} when it cannot be read or is no text
Report examine(const MachineSettings& machine, const MaterialSettings& material, const AuditSettings& audit,
               const std::filesystem::path& file, const PlateSettings& plate = {});

/// The same for text in memory.
Report examine_text(const MachineSettings& machine, const MaterialSettings& material, const AuditSettings& audit,
                    std::string_view gcode, const PlateSettings& plate = {});

/// Where G-code leaves the nozzle, from above; nullopt when that is not known, as where placeholders decide it.
std::optional<Point> place_after(const MachineSettings& machine, std::string_view gcode);

/// "line 120: skirt, extrude at (201.200, 10.000, 0.200) is 1.200 mm outside +x of the print surface: G1 X201.2 …"
std::string describe(const Finding& finding);

/// "12 moves outside, worst 1.200 mm beyond +x of the print surface (skirt, extrude, line 120)"; of a clean report
/// "18231 moves checked; opaque: PRINT_START".
std::string summary(const Report& report);

/// What the user can do about the worst finding; "" when there is none.
std::string remedy(const Report& report);

/// "pass, 18231 moves checked; opaque: PRINT_START", as it stands behind `; weft_audit = `.
std::string header_value(const Report& report);

}  // namespace weft::audit
