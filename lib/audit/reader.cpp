// SPDX-License-Identifier: GPL-3.0-or-later
#include "audit/reader.h"

#include "audit/scan.h"

#include <cmath>
#include <cstring>

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

Reader::Reader(Machine machine) : machine_(machine), tool_taken_(machine.firmware != Firmware::reprapfirmware) {
  for (auto& axes : lost_) axes.fill(-1);
  workspace_known_[1].fill(true);
  cause_of({}, "the file does not say where the nozzle is when it starts", false);
}

void Reader::line(const char* p, const char* end) {
  ++line_number_;
  motions_.clear();
  problems_.clear();
  if (line_number_ == 1 && end - p >= 3 && std::memcmp(p, "\xEF\xBB\xBF", 3) == 0) p += 3;  // UTF-8's mark
  for (;;) {
    machine_coordinates_ = line_is_numbered_ = line_has_frame_ = false;
    line_commands_ = 0;
    line_begin_ = p;
    line_end_ = end;
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
    if (is_klipper()) problem("a carriage return within a line, which this firmware reads on");
  }
}

void Reader::comment(const char* p, const char* end, bool alone) {
  if (std::memchr(p, '\0', static_cast<std::size_t>(end - p))) problem("a NUL byte");
  if (alone) context_.read({p, static_cast<std::size_t>(end - p)});
}

/// Only controls of machine tools and what descends from them obey several commands on one line.
bool Reader::obeys_first_only() const {
  return !has_workspaces();
}

/// Another command on the line. @param frame it moves, or changes what coordinates mean
void Reader::begin_command(bool frame) {
  if (line_commands_++ > 0 && (frame || line_has_frame_) && obeys_first_only())
    problem("several commands on one line, of which this firmware obeys the first");
  line_has_frame_ |= frame;
}

/// Reads the word at p, a letter: its number, if there is one.
const char* Reader::take_word(const char* p, bool strict, Words& out) {
  const unsigned letter = static_cast<unsigned>((*p | 0x20) - 'a');
  const char* behind = p + 1;
  while (is_blank(*behind)) ++behind;
  double v = 0;
  const char* const number_end = starts_number(*behind) ? scan::number(behind, v) : nullptr;
  const std::uint32_t bit = 1U << letter;
  const auto refuse = [&](std::string_view why) {
    problem(why);
    out.sound = false;
  };
  if (strict && (out.seen & bit)) refuse("a word given twice");
  out.seen |= bit;
  if (!number_end) {
    if (strict) refuse("a malformed number");
    return behind;
  }
  out.valued |= bit;
  out.value[letter] = v;
  if (!(std::abs(v) <= scan::limit_of(letter))) refuse("a number beyond any machine");
  if (strict && starts_number(*number_end)) refuse("a malformed number");
  return number_end;
}

/// Reads the words behind a command up to the next command, comment or end.
/// @param strict everything must be a letter and a number; otherwise what is not is passed over
const char* Reader::words(const char* p, const char* end, bool strict, Words& out) {
  const char* const begin = p;
  while (p < end) {
    const char c = *p;
    if (is_blank(c)) {
      ++p;
    } else if (c == ';' || c == '\r') {
      break;
    } else if (is_letter(c)) {
      if ((c | 0x20) == 'g' || (c | 0x20) == 'm') {
        const char* behind = p + 1;
        while (is_blank(*behind)) ++behind;
        if (is_digit(*behind)) break;  // the next command
      }
      p = take_word(p, strict, out);
      if (!out.sound) return skip_words(p, end);
    } else if (c == '(') {
      if (strict && obeys_first_only()) problem("a comment in parentheses, which this firmware reads as words");
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
  if (!is_letter(letter)) return odd_command(p, end);
  const bool starts_command = letter == 'G' || letter == 'M' || letter == 'T';
  if (starts_command && is_digit(p[1])) return numbered_command(letter, p, end);
  // Prusa's tool changers park a tool by a command of its own letter.
  if (letter == 'P' && is_digit(p[1]) && !is_klipper()) return numbered_command(letter, p, end);
  if (!starts_command && starts_number(p[1])) {  // only words: the last motion again
    const bool plain = letter == 'F' || letter == 'S' || letter == 'E';
    if (!plain && obeys_first_only())
      problem("words without a command");
    else if (motion_mode_ >= 0 || plain)
      return motion_line(p, end);
    else
      problem("words without a command");
    return skip_words(p, end);
  }
  if (starts_command || letter == 'N') {
    const char* q = p + 1;
    while (is_blank(*q)) ++q;
    // Marlin obeys "G 1", Klipper does not know it; "N G1" Klipper obeys.
    if (is_blank(p[1]) && is_digit(*q))
      problem("a blank within a command"), damaged_position();
    else if (letter != 'T' && !is_letter(p[1]) && p[1] != '_') {
      problem("a letter without its number");
      damaged_position();
      return skip_words(p, end);
    }
  }
  begin_command(false);
  return extended_command(p, end);
}

/// What does not start with a letter: comments in parentheses, marks of older controls, commands to the host.
const char* Reader::odd_command(const char* p, const char* end) {
  const char* const behind = skip_words(p, end);
  switch (*p) {
    case '(': {
      const char* q = p;
      while (q < end && *q != ')' && *q != '\r') ++q;
      return q < end && *q == ')' ? q + 1 : q;
    }
    case '@': {  // OctoPrint
      const char* name_end = p + 1;
      while (name_end < behind && !is_blank(*name_end)) ++name_end;
      list_opaque({p, std::min<std::size_t>(static_cast<std::size_t>(name_end - p), 48)});
      break;
    }
    case '*':
      if (!checksum_holds(line_begin_, p)) problem("a checksum that does not match its line");
      break;
    case '%':
    case ')':
    case '/':  // marks of older controls: the line is passed over
      break;
    default:
      problem(*p == '\0'                 ? "a NUL byte"
              : (*p == '{' || *p == '[') ? "a placeholder that was not filled in"
                                         : "not a command");
  }
  return behind;
}

/// Klipper takes for the command's name all that stands before the next word, and knows none with a leading zero.
bool Reader::klipper_knows(const char* digits, const char* behind, const char* end) const {
  if (*digits == '0' && is_digit(digits[1])) return false;
  while (behind < end && is_blank(*behind)) ++behind;
  return behind == end || is_letter(*behind) || *behind == '_' || *behind == '*' || *behind == ';' || *behind == '\r';
}

/// A letter and a number: looked up in the table of commands.
const char* Reader::numbered_command(char letter, const char* p, const char* end) {
  double whole = 0;
  const char* number_end = p + 1;
  while (is_digit(*number_end)) whole = whole * 10 + (*number_end++ - '0');
  int sub = -1;
  const char* behind = number_end;
  if (*behind == '.') {
    sub = 0;
    for (++behind; is_digit(*behind); ++behind) sub = std::min(sub * 10 + (*behind - '0'), 9999);
  }
  if (whole > 1e6) return problem("a malformed number"), skip_words(behind, end);
  const int number = static_cast<int>(whole);
  if (letter == 'G' && number <= 3 && sub < 0) {
    begin_command(true);
    if (is_klipper() && number_end - p > 2) problem("a command with a leading zero, which this firmware does not know");
    motion_mode_ = number;
    return motion_line(behind, end);
  }
  const Command* const known = find_command(letter, number, sub);
  if (is_klipper() && known && known->handler && known->reading != Reading::text &&
      !klipper_knows(p + 1, behind, end)) {
    problem("a command that this firmware does not know as it is written");
    damaged_position();
    return skip_words(behind, end);
  }
  if (letter != 'G' || number != 53 || is_klipper())  // G53 is a word before a move
    begin_command(known && known->handler && known->frame);
  Words w;
  const Reading reading = known ? known->reading : Reading::lenient;
  const char* const stop =
      reading == Reading::text ? skip_words(behind, end) : words(behind, end, reading == Reading::strict, w);
  const std::string_view text(behind, static_cast<std::size_t>(stop - behind));
  if (letter == 'M' && reading != Reading::text && text.find_first_of("{[") != std::string_view::npos)
    problem("a placeholder that was not filled in");
  const Call call{letter, number, sub, w, text};
  if (!w.sound)
    damaged_position();
  else if (!known)
    opaque_code(call);
  else if (known->handler)
    (this->*known->handler)(call);
  return stop;
}

const char* Reader::motion_line(const char* p, const char* end) {
  Words w;
  p = words(p, end, true, w);
  if (!w.sound)
    forget_position(cause_of("a damaged line", "a line could not be read", false), Known::no);
  else if (motion_mode_ >= 0)
    move(w);
  return p;
}

/// A line that may have moved the nozzle and changed the coordinates cannot be read.
void Reader::damaged_position() {
  const auto cause = cause_of("a damaged line", "a line could not be read", true);
  forget_position(cause, Known::no);
  lose(stored, nullptr, cause);
}

}  // namespace weft::audit
