// SPDX-License-Identifier: GPL-3.0-or-later
#include "gcode/left_by.h"

#include <algorithm>
#include <array>
#include <charconv>

namespace weft::gcode {
namespace {

char upper(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

/// The words of a line: each letter with its number.
class Words {
 public:
  explicit Words(std::string_view line) {
    line = line.substr(0, line.find(';'));
    while (!line.empty()) {
      const char letter = upper(line.front());
      line.remove_prefix(1);
      if (letter < 'A' || letter > 'Z') continue;
      const auto text = line.substr(0, line.find_first_not_of("+-.0123456789"));
      line.remove_prefix(text.size());
      if (command_ == 0) {
        command_ = letter, number_ = number(text);
        if (!number_) return;  // a macro
      } else {
        values_[static_cast<std::size_t>(letter - 'A')] = number(text).value_or(0);
      }
    }
  }
  bool empty() const { return command_ == 0; }
  bool is(char letter, double code) const { return command_ == letter && number_ == code; }
  bool is_m() const { return command_ == 'M' && number_; }
  std::optional<double> operator[](char letter) const { return values_[static_cast<std::size_t>(letter - 'A')]; }

 private:
  static std::optional<double> number(std::string_view text) {
    if (text.starts_with('+')) text.remove_prefix(1);
    double v = 0;
    const auto end = std::from_chars(text.data(), text.data() + text.size(), v);
    return end.ec == std::errc{} ? std::optional(v) : std::nullopt;
  }

  char command_ = 0;
  std::optional<double> number_;
  std::array<std::optional<double>, 26> values_{};
};

/// What is known while the code is read; mm.
class Following {
 public:
  void line(const Words& w) {
    if (w.empty()) return;
    if (w.is('G', 0) || w.is('G', 1) || w.is('G', 2) || w.is('G', 3)) return move(w);
    if (w.is('G', 10) || w.is('G', 11)) {
      if (!w['P'] && !w['L']) by_firmware_ = w.is('G', 10);  // else offsets and temperatures of RepRapFirmware
    } else if (w.is('G', 28)) {
      if (w['Z'] || (!w['X'] && !w['Y'])) z_ = 0, z_known_ = true;
    } else if (w.is('G', 90) || w.is('G', 91)) {
      relative_ = e_relative_ = w.is('G', 91);
    } else if (w.is('M', 82) || w.is('M', 83)) {
      e_relative_ = w.is('M', 83);
    } else if (w.is('G', 92)) {
      if (w['E']) e_ = *w['E'];
      if (w['Z']) z_ = *w['Z'], z_known_ = true;
    } else if (!w.is_m() && !w.is('G', 4) && !w.is('G', 21)) {
      z_known_ = false;
    }
  }
  LeftBehind now() const { return {z_known_ ? std::optional(from_mm(z_)) : std::nullopt, drawn_, by_firmware_}; }

 private:
  void move(const Words& w) {
    if (const auto z = w['Z']) {
      z_ = relative_ ? z_ + *z : *z;
      z_known_ = z_known_ || !relative_;
    }
    if (const auto e = w['E']) {
      const double by = e_relative_ ? *e : *e - e_;
      e_ += by;
      drawn_ = std::max(0.0, drawn_ - by);
      if (by > 0) by_firmware_ = false;
    }
  }

  double z_ = 0, e_ = 0, drawn_ = 0;
  bool z_known_ = false, relative_ = false, e_relative_ = false, by_firmware_ = false;
};

}  // namespace

LeftBehind left_by(std::string_view code) {
  Following following;
  while (!code.empty()) {
    const auto end = std::min(code.find('\n'), code.size());
    following.line(Words(code.substr(0, end)));
    code.remove_prefix(std::min(end + 1, code.size()));
  }
  return following.now();
}

}  // namespace weft::gcode
