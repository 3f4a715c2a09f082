// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "gcode/dialect.h"
#include "gcode/digest.h"
#include "gcode/progress.h"
#include "gcode/substitutions.h"
#include "macro/macro.h"
#include "model/plan.h"
#include "model/statistics.h"
#include "settings/settings.h"

#include <optional>
#include <string>
#include <vector>

namespace weft::gcode {

struct Thumbnail {
  int width = 0, height = 0;  ///< pixels
  std::string png;            ///< the file's bytes
};

/// Everything that goes into a file.
struct Job {
  const Settings& settings;
  const PrintPlan& plan;         ///< with speeds (motion)
  const Statistics& statistics;  ///< of the whole plan
  std::string input_name;        ///< file name of the first model, without folder and extension; for placeholders
  std::vector<Thumbnail> thumbnails;
  std::string provenance{};  ///< comment lines for the end of the file: what it was made of
  /// Of the plan's layers, whose steps then may be missing but while `Writer::layer` writes them. Empty: they are made.
  std::vector<LayerDigest> digests{};
  std::vector<Settings> tools{};        ///< of each; empty: there is one
  std::vector<ToolId> cold_at_start{};  ///< their nozzles are heated later
  std::vector<double> purge_volumes{};  ///< mm³ from each tool to each, a row for each that is unloaded; empty: none
};

/// The file in pieces, which put together in order are the whole: head, each layer, tail. Layers do not depend on each
/// other and may be written in any order and on any thread. With absolute E each begins with G92 E0.
/// E is rounded to 10⁻⁵ mm and the rounding error is carried along: the sum over a layer is right to half of that.
/// Cost: 1 s for some hundred MB.
class Writer {
 public:
  /// Expands all custom G-code and finds what is in force when each layer begins. The job must outlive the writer.
  /// @throws Error{settings} naming setting, line and column: what is wrong with custom G-code (macro/macro.h)
  /// or with gcode_substitutions
  explicit Writer(const Job& job) : Writer(job, false) {}

  std::string head() const;
  std::string layer(std::size_t index) const;
  std::string tail() const;

 private:
  friend void check_custom_code(const Settings& settings);
  Writer(const Job& job, bool lenient);
  void expand_custom_code();
  std::string code_at_heights(std::size_t index, const macro::Variables& variables, macro::Scope& scope) const;
  void begin_where_start_ends();
  void heat_at_start(Text& out, bool wait) const;
  std::string mixing(std::size_t index) const;
  std::string heat_after_first_layer(std::size_t index, bool first) const;

  const Job& job_;
  bool lenient_;            // a trial: the figures of the print are not the real ones
  MaterialSettings first_;  // on the first layer; of the bed that of the first tool
  Dialect dialect_;
  Substitutions substitutions_;
  std::vector<MachineState> entries_;                    // when each layer begins
  ProgressText progress_;                                // of its layers
  std::vector<std::string> before_layer_, after_layer_;  // custom G-code, expanded; empty where there is none
  std::vector<std::vector<std::string>> tool_changes_;   // of each layer; likewise, and empty where there is no code
  std::vector<std::vector<std::string>> loaded_;         // likewise, after the tool was chosen
  std::vector<std::vector<std::string>> pauses_;         // likewise
  std::vector<std::string> names_;                       // of the objects
  std::string start_, end_;
  std::vector<ToolId> used_;    // in the order that they are loaded; empty where there is one tool
  bool start_selects_ = false;  // the first tool
  bool head_selects_ = false;   // it, before its nozzle is waited for
  bool start_sets_nozzle_ = false, start_sets_bed_ = false, start_sets_chamber_ = false;
};

/// The whole file.
std::string write(const Job& job);

/// Checks all custom G-code, and expands it for a print that there might be: what is wrong with it is known before the
/// first model is read, but for what hangs on the numbers of the print (a division by zero).
/// @throws Error{settings} as Writer does
void check_custom_code(const Settings& settings);

/// The header line that the audit replaces by its verdict.
inline constexpr std::string_view audit_pending = "; weft_audit = pending\n";

}  // namespace weft::gcode
