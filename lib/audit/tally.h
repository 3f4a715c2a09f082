// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "audit/audit.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace weft::audit {

/// What is wrong with one line, before anything is turned into text.
struct Violation {
  Finding::Kind kind = Finding::Kind::reach;
  Motion::Kind move = Motion::Kind::travel;
  Excess excess;
  double z_mm = 0;
  int area = 0;
  std::string_view problem{};  ///< of a damaged line
  double above_tip_mm = 0;     ///< of the head: what of it meets what is printed
  Vec met{};                   ///< and where that is
};

/// Where a line stands and what surrounds it.
struct Place {
  const Context& context;
  std::string_view feature;
  std::int64_t line;
  std::int64_t offset;  ///< of the line's first byte
  std::string_view text;
};

/// Where an annotation belongs and what it says.
struct Mark {
  std::int64_t offset;
  std::int64_t line;
  std::string text;
};

/// Counts violations and keeps the first ones and the worst of each sort. Memory: bounded by audit_max_findings and the
/// sorts, but for the marks.
class Tally {
 public:
  Tally(int most_findings, double tolerance_mm, bool keep_marks)
      : most_findings_(static_cast<std::size_t>(most_findings)), tolerance_mm_(tolerance_mm), keep_marks_(keep_marks) {}

  void add(const Violation& violation, const Place& place);
  /// Takes over what another tally of the same file counted.
  void merge(Tally other);
  /// Fills the counts, findings and totals of the report.
  void report(Report& report) const;
  /// An annotation that is no finding.
  void mark(Mark mark) {
    if (keep_marks_) marks_.push_back(std::move(mark));
  }
  const std::vector<Mark>& marks() const { return marks_; }
  bool empty() const { return lines_ == 0; }

 private:
  struct Sort {
    Finding::Kind kind;
    Side side;
    int area;
    std::string feature;
    std::int64_t count = 0;
    double worst_mm = -1;
    bool led = false;  ///< some violation had its worst side here, and `worst` is set
    Finding worst;
  };
  Sort& sort(Finding::Kind kind, Side side, int area, std::string_view feature);
  Finding finding(const Violation& violation, const Place& place) const;

  std::size_t most_findings_;
  double tolerance_mm_;
  bool keep_marks_;
  std::int64_t lines_ = 0, damaged_ = 0;
  double worst_mm_ = 0;
  std::vector<Finding> first_;
  std::vector<Sort> sorts_;
  std::vector<Mark> marks_;
};

}  // namespace weft::audit
