#include "audit/audit.h"

#include "audit/auditor.h"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
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
  for (Finding& f : report.findings) {
    std::int64_t before = 0;
    for (const Mark& m : marks) before += m.line <= f.line ? 1 : 0;
    if (place.replaced == 0 && f.line > 1) ++before;
    f.line += before;
  }
  return out;
}

struct Closer {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

/// Formats that hold G-code but are no text.
std::string_view not_text(std::string_view front) {
  if (front.starts_with("GCDE")) return "binary G-code; export it as plain text";
  if (front.starts_with("PK\x03\x04")) return "a zip archive; take the .gcode file out of it";
  if (front.starts_with("\x1f\x8b")) return "compressed; unpack it";
  return {};
}

}  // namespace

Check::Check(const MachineSettings& machine, const MaterialSettings& material, const AuditSettings& audit, Mode mode)
    : auditor_(std::make_unique<Auditor>(machine, material, audit, mode == Mode::annotate)), mode_(mode) {}
Check::~Check() = default;

void Check::reserve(std::size_t bytes) {
  gcode_.reserve(bytes);
}

void Check::add(std::string_view piece) {
  const std::size_t before = gcode_.size();
  gcode_ += piece;
  auditor_->feed(std::string_view(gcode_).substr(before));  // the bytes that stand there
}

Passed Check::passed() {
  auto gcode = std::move(gcode_);
  Report report = auditor_->finish();
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
             std::string gcode, Mode mode) {
  Check all(machine, material, audit, mode);
  all.gcode_ = std::move(gcode);
  all.auditor_->feed(all.gcode_);
  return all.passed();
}

Report examine_text(const MachineSettings& machine, const MaterialSettings& material, const AuditSettings& audit,
                    std::string_view gcode) {
  Auditor auditor(machine, material, audit, false);
  auditor.feed(gcode);
  return auditor.finish();
}

Report examine(const MachineSettings& machine, const MaterialSettings& material, const AuditSettings& audit,
               const std::filesystem::path& path) {
  const auto refuse = [&](std::string what, std::string hint = {}) {
    throw Error{Error::Kind::file, std::move(what), path.string(), std::move(hint)};
  };
  const std::unique_ptr<std::FILE, Closer> file(std::fopen(path.c_str(), "rb"));
  if (!file) refuse(fmt::format("cannot be read: {}", std::strerror(errno)));
  std::setvbuf(file.get(), nullptr, _IONBF, 0);
  Auditor auditor(machine, material, audit, false);
  constexpr std::size_t piece = 1U << 18;
  const auto buffer = std::make_unique<char[]>(piece);
  bool first = true;
  while (const std::size_t n = std::fread(buffer.get(), 1, piece, file.get())) {
    const std::string_view bytes(buffer.get(), n);
    if (std::exchange(first, false))
      if (const auto reason = not_text(bytes); !reason.empty()) refuse("is not G-code as text", std::string(reason));
    auditor.feed(bytes);
  }
  if (std::ferror(file.get())) refuse(fmt::format("cannot be read: {}", std::strerror(errno)));
  return auditor.finish();
}

double Report::coverage() const {
  const auto all = checked_moves + unaudited_moves;
  return all == 0 ? 1.0 : static_cast<double>(checked_moves) / static_cast<double>(all);
}

Rejected::Rejected(Report report, std::string where)
    : Error(Kind::audit, "the boundary audit found " + summary(report), std::move(where), remedy(report)),
      report_(std::move(report)) {}

}  // namespace weft::audit
