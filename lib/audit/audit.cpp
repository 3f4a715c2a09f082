// SPDX-License-Identifier: GPL-3.0-or-later
#include "audit/audit.h"

#include "audit/auditor.h"
#include "core/file_bytes.h"

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

#include <fmt/format.h>

namespace weft::audit {
namespace {

constexpr std::string_view header_key = "; weft_audit = ";

/// Where the verdict is written: over the old one among the first lines, or behind the first line.
struct HeaderPlace {
  std::size_t at = 0, replaced = 0;
  bool needs_line_feed_before = false;  ///< the text is one line that does not end
};

HeaderPlace header_place(std::string_view gcode) {
  constexpr std::size_t header_size = 1U << 16;
  const auto front = gcode.substr(0, header_size);
  for (auto at = front.find(header_key); at != std::string_view::npos; at = front.find(header_key, at + 1)) {
    if (at > 0 && front[at - 1] != '\n') continue;
    const auto end = gcode.find('\n', at);
    return {at, (end == std::string_view::npos ? gcode.size() : end + 1) - at};
  }
  const auto end = gcode.find('\n');
  if (end == std::string_view::npos) return {gcode.size(), 0, !gcode.empty()};
  return {end + 1, 0};
}

std::string_view line_end_of(std::string_view gcode) {
  return gcode.substr(0, gcode.find('\n')).ends_with('\r') ? "\r\n" : "\n";
}

std::string header_line(std::string_view gcode, const HeaderPlace& place, const Report& report) {
  const auto line_end = line_end_of(gcode);
  return fmt::format("{}{}{}{}", place.needs_line_feed_before ? line_end : "", header_key, header_value(report),
                     line_end);
}

/// The text with the verdict in its header and the marks before their lines. Findings are renumbered to its lines.
std::string stated(std::string_view gcode, const std::vector<Mark>& marks, Report& report) {
  const auto place = header_place(gcode);
  const auto line_end = line_end_of(gcode);
  const auto header = header_line(gcode, place, report);
  std::string out;
  std::size_t size = gcode.size() + header.size();
  for (const Mark& m : marks) size += m.text.size() + line_end.size();
  out.reserve(size);
  std::size_t done = 0;
  const auto copy_to = [&](std::size_t to) {
    out.append(gcode.substr(done, to - done));
    done = to;
  };
  const auto state = [&] {
    copy_to(place.at);
    out += header;
    done += place.replaced;
  };
  bool is_stated = false;
  for (const Mark& m : marks) {
    const auto at = static_cast<std::size_t>(m.offset);
    if (!is_stated && at >= place.at) state(), is_stated = true;
    copy_to(at);
    (out += m.text) += line_end;
  }
  if (!is_stated) state();
  copy_to(gcode.size());
  const auto renumber = [&](std::int64_t& line) {
    std::int64_t before = 0;
    for (const Mark& m : marks) before += m.line <= line ? 1 : 0;
    if (place.replaced == 0 && line > 1) ++before;
    line += before;
  };
  for (Finding& f : report.findings) renumber(f.line);
  for (Unaudited& u : report.unaudited)
    if (u.cause.line > 0) renumber(u.cause.line);
  return out;
}

/// May the line come from this line of custom G-code, whose placeholders stand for anything?
bool may_be(std::string_view line, std::string_view written) {
  std::size_t at = 0;
  for (bool first = true; !written.empty(); first = false) {
    const auto open = written.find_first_of("{[");
    const auto piece = written.substr(0, open);
    const auto found = line.find(piece, at);
    if (found == std::string_view::npos || (first && found != 0)) return false;
    at = found + piece.size();
    if (open == std::string_view::npos) return at == line.size() || line.ends_with(piece);
    const auto close = written.find_first_of("}]", open);
    written.remove_prefix(close == std::string_view::npos ? written.size() : close + 1);
  }
  return true;
}

/// Does the finding's line stand in this custom G-code?
bool stands_in(const Finding& f, std::string_view text) {
  if (f.feature != "custom" && f.kind != Finding::Kind::damaged) return false;
  const auto bare = [](std::string_view line) {
    line = line.substr(0, line.find(';'));
    while (!line.empty() && (line.back() == ' ' || line.back() == '\t' || line.back() == '\r' || line.back() == '\n'))
      line.remove_suffix(1);
    while (!line.empty() && (line.front() == ' ' || line.front() == '\t')) line.remove_prefix(1);
    return line;
  };
  const auto wanted = bare(f.text);
  while (!wanted.empty() && !text.empty()) {
    const auto end = std::min(text.find('\n'), text.size() - 1) + 1;
    const auto line = bare(text.substr(0, end));
    text.remove_prefix(end);
    // A line that is only a placeholder may be anything.
    if (line.find_first_of("{[") != 0 && !line.empty() && may_be(wanted, line)) return true;
  }
  return false;
}

/// Formats that hold G-code but are no text that a printer reads.
std::string_view not_text(std::string_view front) {
  if (front.starts_with("\xFF\xFE") || front.starts_with("\xFE\xFF")) return "UTF-16; save it as UTF-8 or plain text";
  if (front.size() >= 4 && front[0] != '\0' && front[1] == '\0' && front[2] != '\0' && front[3] == '\0')
    return "UTF-16; save it as UTF-8 or plain text";
  if (front.size() >= 4 && front[0] == '\0' && front[1] != '\0' && front[2] == '\0' && front[3] != '\0')
    return "UTF-16; save it as UTF-8 or plain text";
  if (front.starts_with("GCDE")) return "binary G-code; export it as plain text";
  if (front.starts_with("PK\x03\x04")) return "a zip archive; take the .gcode file out of it";
  if (front.starts_with("\x1f\x8b")) return "compressed by gzip; unpack it with gunzip";
  if (front.starts_with("BZh")) return "compressed by bzip2; unpack it with bunzip2";
  if (front.starts_with("\xFD\x37zXZ")) return "compressed by xz; unpack it with unxz";
  if (front.starts_with("\x28\xB5\x2F\xFD")) return "compressed by zstd; unpack it with unzstd";
  return {};
}

}  // namespace

Check::Check(const MachineSettings& machine, const MaterialSettings& material, const AuditSettings& audit, Mode mode,
             const PlateSettings& plate)
    : auditor_(std::make_unique<Auditor>(machine, material, audit, plate, mode == Mode::annotate)), mode_(mode) {}
Check::~Check() = default;

void Check::reserve(std::size_t bytes) {
  gcode_.reserve(bytes);
}

void Check::add(std::string_view piece) {
  const std::size_t before = gcode_.size();
  gcode_ += piece;
  auditor_->feed(std::string_view(gcode_).substr(before));  // the bytes that stand there
}

void Check::custom_code(std::string_view setting, std::string_view text) {
  custom_.emplace_back(setting, text);
}

Passed Check::passed() {
  auto gcode = std::move(gcode_);
  Report report = auditor_->finish();
  for (Finding& f : report.findings)
    for (const auto& [setting, text] : custom_)
      if (f.setting.empty() && stands_in(f, text)) f.setting = setting;
  if (!report.clean()) {
    if (mode_ == Mode::reject) throw Rejected(std::move(report));
    report.verdict = Verdict::annotated;
  }
  if (auditor_->marks().empty() && report.findings.empty()) {  // the usual case: a copy would be as large again
    const auto place = header_place(gcode);
    gcode.replace(place.at, place.replaced, header_line(gcode, place, report));
    return {std::move(gcode), std::move(report)};
  }
  auto text = stated(gcode, auditor_->marks(), report);
  return {std::move(text), std::move(report)};
}

Passed check(const MachineSettings& machine, const MaterialSettings& material, const AuditSettings& audit,
             std::string gcode, Mode mode, const PlateSettings& plate) {
  Check all(machine, material, audit, mode, plate);
  all.gcode_ = std::move(gcode);
  all.auditor_->feed(all.gcode_);
  return all.passed();
}

Report examine_text(const MachineSettings& machine, const MaterialSettings& material, const AuditSettings& audit,
                    std::string_view gcode, const PlateSettings& plate) {
  Auditor auditor(machine, material, audit, plate, false);
  auditor.feed(gcode);
  return auditor.finish();
}

Report examine(const MachineSettings& machine, const MaterialSettings& material, const AuditSettings& audit,
               const std::filesystem::path& path, const PlateSettings& plate) {
  const auto refuse = [&](std::string what, std::string hint = {}) {
    throw Error{Error::Kind::file, std::move(what), path.string(), std::move(hint)};
  };
  InputFile file(path.string());
  Auditor auditor(machine, material, audit, plate, false);
  constexpr std::size_t piece = 1U << 18;
  const auto buffer = std::make_unique<char[]>(piece);
  bool first = true;
  while (const std::size_t n = file.read(buffer.get(), piece)) {
    const std::string_view bytes(buffer.get(), n);
    if (std::exchange(first, false))
      if (const auto reason = not_text(bytes); !reason.empty())
        refuse(fmt::format("is not G-code as text but {}", reason.substr(0, reason.find(';'))),
               std::string(reason.substr(reason.find(';') + 2)));
    auditor.feed(bytes);
  }
  file.check_whole();
  return auditor.finish();
}

double Report::coverage() const {
  const auto all = checked_moves + unaudited_moves;
  return all == 0 ? 1.0 : static_cast<double>(checked_moves) / static_cast<double>(all);
}

const Conflict* Report::blocking() const {
  const auto at = std::find_if(conflicts.begin(), conflicts.end(), [](const Conflict& c) { return c.blocks; });
  return at == conflicts.end() ? nullptr : &*at;
}

std::int64_t Report::count_of(Finding::Kind kind) const {
  std::int64_t out = 0;
  for (const auto& total : totals) out += total.kind == kind ? total.count : 0;
  return out;
}

Rejected::Rejected(Report report, std::string where)
    : Error(Kind::audit, "the boundary audit found " + summary(report), std::move(where), remedy(report)),
      report_(std::move(report)) {}

}  // namespace weft::audit
