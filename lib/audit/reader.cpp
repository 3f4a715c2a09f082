#include "audit/reader.h"

#include "audit/scan.h"

#include <cmath>
#include <cstring>
#include <utility>

namespace weft::audit {
namespace {

using scan::is_blank;
using scan::is_digit;
using scan::is_letter;

/// Firmwares hold 96 to 256 bytes of a command; the rest of a longer one is lost or read as another command.
constexpr std::ptrdiff_t longest_command = 4096;

constexpr bool starts_number(char c) {
  return is_digit(c) || c == '.' || c == '-' || c == '+';
}

/// Is the checksum behind the star (`*97`) the exclusive or of all bytes before it?
bool checksum_holds(const char* begin, const char* star) {
  unsigned char sum = 0;
  for (const char* p = begin; p < star; ++p) sum = static_cast<unsigned char>(sum ^ static_cast<unsigned char>(*p));
  double stated = -1;
  return scan::number(star + 1, stated) && stated == sum;
}

}  // namespace

Reader::Reader(std::optional<Vec> home) : home_(home) {}

void Reader::line(const char* p, const char* end) {
  ++line_number_;
  motions_.clear();
  problems_.clear();
  if (line_number_ == 1 && end - p >= 3 && std::memcmp(p, "\xEF\xBB\xBF", 3) == 0) p += 3;  // UTF-8's mark
  for (;;) {
    machine_coordinates_ = line_is_numbered_ = false;
    line_begin_ = p;
    while (p < end && is_blank(*p)) ++p;
    if (p < end && scan::upper(*p) == 'N' && is_digit(p[1])) {
      double line_number = 0;
      line_is_numbered_ = true;
      p = scan::number(p + 1, line_number);
      while (p < end && is_blank(*p)) ++p;
    }
    while (p < end && *p != '\r' && *p != ';') p = command(p, end);
    if (p < end && *p == ';') {
      const void* cut = std::memchr(p, '\r', static_cast<std::size_t>(end - p));
      const char* const comment_end = cut ? static_cast<const char*>(cut) : end;
      comment(p + 1, comment_end, p == line_begin_ || motions_.empty());
      p = comment_end;
    }
    if (p >= end || ++p >= end) return;  // past a carriage return: firmwares end the line there
  }
}

void Reader::comment(const char* p, const char* end, bool alone) {
  if (std::memchr(p, '\0', static_cast<std::size_t>(end - p))) problem("a NUL byte");
  if (alone) context_.read({p, static_cast<std::size_t>(end - p)});
}

/// Reads the words behind a command up to the next command, comment or end.
/// @param strict everything must be a letter and a number; otherwise what is not is passed over
const char* Reader::words(const char* p, const char* end, bool strict, Words& out) {
  const char* const begin = p;
  while (p < end) {
    const char c = *p;
    if (is_blank(c)) {
      ++p;
      continue;
    }
    if (c == ';' || c == '\r') break;
    if (is_letter(c)) {
      const unsigned letter = static_cast<unsigned>((c | 0x20) - 'a');
      const char* behind = p + 1;
      while (is_blank(*behind)) ++behind;
      if ((letter == 'G' - 'A' || letter == 'M' - 'A') && is_digit(*behind)) break;  // the next command
      double v = 0;
      const char* const number_end = starts_number(*behind) ? scan::number(behind, v) : nullptr;
      const std::uint32_t bit = 1U << letter;
      if (strict && (out.seen & bit)) problem("a word given twice"), out.sound = false;
      out.seen |= bit;
      if (number_end) {
        out.valued |= bit;
        out.value[letter] = v;
        p = number_end;
        if (!(std::abs(v) <= scan::limit_of(letter))) problem("a number beyond any machine"), out.sound = false;
        if (strict && starts_number(*p)) problem("a malformed number"), out.sound = false;
      } else {
        p = behind;
        if (strict) problem("a malformed number"), out.sound = false;
      }
      if (!out.sound) return skip_words(p, end);
    } else if (c == '(') {
      while (p < end && *p != ')' && *p != '\r') ++p;
      if (p < end && *p == ')') ++p;
    } else if (c == '*') {
      if (!checksum_holds(line_begin_, p)) problem("a checksum that does not match its line"), out.sound = !strict;
      while (p < end && *p != ';' && *p != '\r') ++p;
    } else if (strict) {
      problem(c == '\0'                ? "a NUL byte"
              : (c == '{' || c == '[') ? "a placeholder that was not filled in"
                                       : "a malformed word");
      out.sound = false;
      return skip_words(p, end);
    } else {
      ++p;
    }
  }
  if (p - begin > longest_command) problem("a command longer than any firmware reads");
  return p;
}

const char* Reader::skip_words(const char* p, const char* end) {
  while (p < end && *p != ';' && *p != '\r') ++p;
  return p;
}

/// Reads one command; several may stand on a line.
const char* Reader::command(const char* p, const char* end) {
  if (is_blank(*p)) return p + 1;
  const char letter = scan::upper(*p);
  if (is_letter(letter) &&
      (is_digit(p[1]) || (letter != 'G' && letter != 'M' && letter != 'T' && starts_number(p[1])))) {
    if (letter == 'G' || letter == 'M' || letter == 'T') {
      double number = 0;
      const char* const behind = scan::number(p + 1, number);
      if (number > 1e6) return problem("a malformed number"), skip_words(p, end);
      const int whole = static_cast<int>(number);
      if (letter == 'G') return g_command(whole, number != whole, behind, end);
      if (letter == 'M') return m_command(whole, behind, end);
      tool_ = whole;
      return skip_words(behind, end);
    }
    if (motion_mode_ >= 0 || letter == 'F' || letter == 'S')
      return motion_line(p, end);  // only words: the last motion again
    problem("words without a command");
    return skip_words(p, end);
  }
  if (letter == '(') {
    while (p < end && *p != ')' && *p != '\r') ++p;
    return p < end && *p == ')' ? p + 1 : p;
  }
  if (is_letter(letter) && is_blank(p[1]) && (letter == 'G' || letter == 'M' || letter == 'T' || letter == 'N')) {
    const char* q = p + 1;
    while (is_blank(*q)) ++q;
    // Marlin obeys "G 1", Klipper does not know it.
    if (is_digit(*q)) problem("a blank within a command"), forget_position(), lose_offsets({});
  }
  if (is_letter(letter) || letter == '_') return extended_command(p, end);
  const char* const behind = skip_words(p, end);
  if (letter == '{' || letter == '[') {
    problem("a placeholder that was not filled in");
  } else if (letter == '@') {  // for the host, which may do anything: @pause
    const auto line = std::string_view(p, static_cast<std::size_t>(behind - p));
    opaque_command(line.substr(0, line.find_first_of(" \t")));
  } else if (letter == '*') {
    if (!checksum_holds(line_begin_, p)) problem("a checksum that does not match its line");
  } else if (letter != '%' && letter != ')' && letter != '/') {  // % and / are marks of older controls
    problem(letter == '\0' ? "a NUL byte" : "not a command");
  }
  return behind;
}

const char* Reader::motion_line(const char* p, const char* end) {
  Words w;
  p = words(p, end, true, w);
  if (w.sound) {
    if (motion_mode_ >= 0) move(w);
  } else {
    forget_position();
  }
  return p;
}

/// Where the words lead; false for axes that are not known before or behind it.
bool Reader::target(const Words& w, std::array<double, 3>& to, std::array<bool, 3>& known) {
  static constexpr char letters[] = {'X', 'Y', 'Z'};
  const double unit_mm = state_.inches ? 25.4 : 1.0;
  bool named = false;
  to = state_.position;
  known = state_.known;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!w.has(letters[i])) continue;
    named = true;
    const double v = w[letters[i]] * unit_mm;
    if (machine_coordinates_) {
      to[i] = v;
      known[i] = true;
    } else if (state_.relative) {
      to[i] += v;
    } else {
      to[i] = v + state_.offset[i];
      known[i] = state_.offset_known[i];
    }
  }
  return named;
}

void Reader::move(const Words& w) {
  const bool is_arc = motion_mode_ >= 2;
  std::array<double, 3> to;
  std::array<bool, 3> known;
  const bool named = target(w, to, known);
  if (w.has('F')) speed_mm_s_ = w['F'] * (state_.inches ? 25.4 : 1.0) / 60;
  double e_mm = 0;
  if (w.has('E')) {
    const double e = w['E'] * (state_.inches ? 25.4 : 1.0);
    const bool relative = state_.e_relative || state_.relative;
    e_mm = relative ? e : e - state_.e;
    state_.e = relative ? state_.e + e : e;
  }
  if (!named && !(is_arc && (w.has('I') || w.has('J')))) {
    if (is_arc && w.valued != 1U << ('F' - 'A')) problem("an arc without an end, centre or radius");
    return;
  }
  const Vec from{state_.position[x], state_.position[y]}, end{to[x], to[y]};
  Motion& m = begin_motion(to, known);
  const bool ends_known = m.from_known && known[x] && known[y];
  m.e_mm = e_mm;
  m.volumetric = volumetric_;
  if (is_arc) arc(w, m, from, end, ends_known);
  const bool across = m.path.arc || !ends_known || from.x != end.x || from.y != end.y;
  m.extrudes = e_mm > 0 && across && (w.has('X') || w.has('Y') || is_arc);
  m.kind = is_arc                           ? Motion::Kind::arc
           : m.extrudes                     ? Motion::Kind::extrude
           : m.z_known && m.z_to > m.z_from ? Motion::Kind::lift
                                            : Motion::Kind::travel;
  state_.position = to;
  state_.known = known;
}

/// A motion from where the nozzle is, straight.
Motion& Reader::begin_motion(const std::array<double, 3>& to, const std::array<bool, 3>& known) {
  Motion& m = motions_.emplace_back();
  const Vec end{to[x], to[y]};
  m.from_known = state_.known[x] && state_.known[y];
  m.from_home = std::exchange(state_.homed, false);
  m.x_known = known[x], m.y_known = known[y], m.z_known = known[z];
  m.path = {.from = m.from_known && known[x] && known[y] ? Vec{state_.position[x], state_.position[y]} : end,
            .to = end};
  m.z_to = to[z];
  m.z_from = state_.known[z] ? state_.position[z] : to[z];
  m.tool = tool_;
  return m;
}

/// Turns the motion's path into the arc that G2 or G3 means.
void Reader::arc(const Words& w, Motion& m, Vec from, Vec to, bool ends_known) {
  // Ends that differ from the radius by more than rounding explains: firmwares draw something else than was meant.
  constexpr double radius_slack_mm = 0.5, radius_noise_mm = 0.05, radius_slack_share = 0.01;
  if (plane_ != 17) m.judgeable = false;
  if (!ends_known || !m.judgeable) return;
  const double unit_mm = state_.inches ? 25.4 : 1.0;
  const bool left = motion_mode_ == 3;
  const int turns = w.has('P') && w['P'] >= 1 ? static_cast<int>(std::min(w['P'], 1000.0)) : 0;
  Vec centre = from;
  if (w.has('R')) {
    const double radius = w['R'] * unit_mm;
    const Vec chord = to - from;
    const double length = norm(chord), half = length / 2;
    if (length == 0 || half > std::abs(radius) + radius_noise_mm) {
      problem(length == 0 ? "an arc by radius that ends where it starts"
                          : "an arc whose radius does not span its ends");
      m.judgeable = false;
      return;
    }
    // The centre lies left of the chord for the shorter arc to the left, right of it otherwise; R < 0 takes the longer
    // one.
    const double height = std::sqrt(std::max(0.0, radius * radius - half * half)) * (left == (radius > 0) ? 1 : -1);
    centre = 0.5 * (from + to) + (height / length) * Vec{-chord.y, chord.x};
  } else if (w.has('I') || w.has('J')) {
    const Vec ij{w.has('I') ? w['I'] * unit_mm : 0.0, w.has('J') ? w['J'] * unit_mm : 0.0};
    centre = state_.absolute_centre
                 ? Vec{w.has('I') ? ij.x + state_.offset[x] : from.x, w.has('J') ? ij.y + state_.offset[y] : from.y}
                 : from + ij;
    const double r_from = norm(from - centre), r_to = norm(to - centre), apart = std::abs(r_from - r_to);
    if (r_from == 0)
      problem("an arc of no radius");
    else if (apart > radius_slack_mm || (apart > radius_noise_mm && apart > radius_slack_share * r_from))
      problem("an arc that ends at another radius than it starts");
  } else {
    problem("an arc without centre or radius");
    m.judgeable = false;
    return;
  }
  m.path = arc_about(from, to, centre, left, turns);
}

void Reader::bezier(const Words& w) {
  motion_mode_ = 0;
  const std::size_t before = motions_.size();
  move(w);
  if (motions_.size() > before) motions_.back().judgeable = false;
}

void Reader::forget_position() {
  state_.known = {};
}

void Reader::opaque_command(std::string_view name) {
  constexpr std::size_t most_names = 64;
  forget_position();
  ++opaque_count_;
  for (auto& o : opaque_)
    if (o.name == name) return void(++o.count);
  if (opaque_.size() < most_names) opaque_.push_back({std::string(name), 1, line_number_});
}

}  // namespace weft::audit
