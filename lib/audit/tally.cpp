// SPDX-License-Identifier: GPL-3.0-or-later
#include "audit/tally.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <fmt/format.h>

namespace weft::audit {
namespace {

/// Millimetres of a damaged or absurd coordinate may not fit: held at a kilometre.
Um clamped(double mm) {
  return static_cast<Um>(std::lround(std::clamp(mm, -1e6, 1e6) * 1000.0));
}

std::string shown(std::string_view line) {
  constexpr std::size_t most = 120;
  if (line.ends_with('\r')) line.remove_suffix(1);
  std::string out(line.substr(0, most));
  for (char& c : out)
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = c == '\t' ? ' ' : '?';
  if (line.size() > most) out += "...";
  return out;
}

std::string annotation(const Finding& f) {
  if (f.kind == Finding::Kind::damaged) return fmt::format("; WEFT-AUDIT damaged: {}", f.problem);
  const std::string where = f.kind == Finding::Kind::head    ? "the head in what is printed"
                            : f.kind == Finding::Kind::no_go ? fmt::format("inside no-go area {}", f.area)
                                                             : fmt::format("outside {}", name_of(f.side));
  return fmt::format("; WEFT-AUDIT {} {:.3f} mm, {}{}{}", where, to_mm(f.outside), f.feature,
                     f.feature.empty() ? "" : ", ", name_of(f.move));
}

}  // namespace

Tally::Sort& Tally::sort(Finding::Kind kind, Side side, int area, std::string_view feature) {
  for (auto& s : sorts_)
    if (s.kind == kind && s.side == side && s.area == area && s.feature == feature) return s;
  return sorts_.emplace_back(Sort{kind, side, area, std::string(feature), 0, -1, false, {}});
}

Finding Tally::finding(const Violation& v, const Place& place) const {
  Finding f;
  f.kind = v.kind;
  f.move = v.move;
  f.feature = place.feature;
  f.object = place.context.object();
  f.side = v.kind == Finding::Kind::damaged ? Side::none : v.excess.side;
  f.area = v.area;
  f.at = {clamped(v.excess.at.x), clamped(v.excess.at.y), clamped(v.z_mm)};
  f.outside = clamped(std::max(0.0, v.excess.mm));
  f.layer = place.context.layer();
  f.line = place.line;
  f.text = shown(place.text);
  f.problem = v.problem;
  f.above_tip = clamped(v.above_tip_mm);
  f.met = {clamped(v.met.x), clamped(v.met.y)};
  return f;
}

void Tally::add(const Violation& v, const Place& place) {
  ++lines_;
  const bool damaged = v.kind == Finding::Kind::damaged;
  if (damaged)
    ++damaged_;
  else
    worst_mm_ = std::max(worst_mm_, v.excess.mm);
  const std::string_view feature = place.feature;
  const Side lead = damaged ? Side::none : v.excess.side;
  if (lead <= Side::plus_y)
    for (std::size_t i = 0; i < v.excess.by_side.size(); ++i)
      if (const Side side = static_cast<Side>(i); side != lead && v.excess.by_side[i] > tolerance_mm_) {
        Sort& other = sort(v.kind, side, v.area, feature);
        ++other.count;
        other.worst_mm = std::max(other.worst_mm, v.excess.by_side[i]);
      }
  Sort& own = sort(v.kind, lead, v.area, feature);
  ++own.count;
  const bool leads = !own.led || clamped(v.excess.mm) > own.worst.outside;
  own.worst_mm = std::max(own.worst_mm, v.excess.mm);
  if (!leads && first_.size() >= most_findings_ && !keep_marks_) return;
  const Finding f = finding(v, place);
  if (leads) own.worst = f, own.led = true;
  if (first_.size() < most_findings_) first_.push_back(f);
  if (keep_marks_) marks_.push_back({place.offset, place.line, annotation(f)});
}

void Tally::merge(Tally other) {
  lines_ += other.lines_;
  damaged_ += other.damaged_;
  worst_mm_ = std::max(worst_mm_, other.worst_mm_);
  for (auto& s : other.sorts_) {
    Sort& own = sort(s.kind, s.side, s.area, s.feature);
    own.count += s.count;
    own.worst_mm = std::max(own.worst_mm, s.worst_mm);
    if (s.led && (!own.led || s.worst.outside > own.worst.outside)) own.worst = std::move(s.worst), own.led = true;
  }
  const auto by_line = [](const auto& a, const auto& b) { return a.line < b.line; };
  std::move(other.first_.begin(), other.first_.end(), std::back_inserter(first_));
  std::stable_sort(first_.begin(), first_.end(), by_line);
  if (first_.size() > most_findings_) first_.resize(most_findings_);
  std::move(other.marks_.begin(), other.marks_.end(), std::back_inserter(marks_));
  std::stable_sort(marks_.begin(), marks_.end(), by_line);
}

void Tally::report(Report& report) const {
  report.violation_count = lines_;
  report.damaged_count = damaged_;
  report.worst_outside = clamped(worst_mm_);
  std::vector<Finding> kept;
  for (const auto& s : sorts_) {
    report.totals.push_back({s.kind, s.side, s.area, s.feature, s.count, clamped(std::max(0.0, s.worst_mm))});
    if (s.led) kept.push_back(s.worst);
  }
  std::sort(report.totals.begin(), report.totals.end(), [](const Total& a, const Total& b) {
    return std::tie(a.kind, a.area, a.side, a.feature) < std::tie(b.kind, b.area, b.side, b.feature);
  });
  std::stable_sort(kept.begin(), kept.end(), [](const Finding& a, const Finding& b) { return a.outside > b.outside; });
  if (kept.size() > most_findings_) kept.resize(most_findings_);
  const auto worst = kept;
  for (const auto& f : first_) {
    if (kept.size() >= most_findings_) break;
    if (std::none_of(worst.begin(), worst.end(), [&](const Finding& w) { return w.line == f.line; })) kept.push_back(f);
  }
  std::stable_sort(kept.begin(), kept.end(), [](const Finding& a, const Finding& b) { return a.line < b.line; });
  report.findings = std::move(kept);
}

}  // namespace weft::audit
