// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/escape.h"
#include "core/join.h"
#include "core/number.h"
#include "settings/value_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace weft::value {

void refuse(std::string_view text, std::string_view what) {
  throw std::invalid_argument(fmt::format("'{}' is not {}", text, what));
}

namespace {

bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}
char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

bool same_word(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (lower(a[i]) != lower(b[i])) return false;
  return true;
}

}  // namespace

double take_number(std::string_view& text, std::string_view whole, std::string_view what) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  double v = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), v);
  if (error != std::errc{} || !std::isfinite(v)) refuse(whole, what);
  text = trimmed(text.substr(static_cast<std::size_t>(end - text.data())));
  return v;
}

bool names_unit(std::string_view suffix, Unit unit) {
  if (suffix.empty() || suffix == symbol_of(unit)) return true;
  switch (unit) {
    case Unit::mm_s2:
      return suffix == "mm/s2" || suffix == "mm/s^2";
    case Unit::mm3_s:
      return suffix == "mm3/s" || suffix == "mm^3/s";
    case Unit::mm3_s2:
      return suffix == "mm3/s2" || suffix == "mm^3/s^2";
    case Unit::mm2:
      return suffix == "mm2" || suffix == "mm^2";
    case Unit::mm3:
      return suffix == "mm3" || suffix == "mm^3";
    case Unit::degrees:
      return suffix == "deg";
    case Unit::celsius:
      return suffix == "C";
    case Unit::celsius_s:
      return suffix == "C/s";
    case Unit::g_cm3:
      return suffix == "g/cm3";
    case Unit::layers:
      return suffix == "layer";
    default:
      return false;
  }
}

namespace {

std::string what_of(std::string_view noun, Unit unit) {
  return unit == Unit::none ? std::string(noun) : fmt::format("{} in {}", noun, symbol_of(unit));
}

double quantity(std::string_view text, Unit unit, std::string_view noun) {
  const auto whole = text = trimmed(text);
  const double v = take_number(text, whole, what_of(noun, unit));
  if (!names_unit(text, unit)) refuse(whole, what_of(noun, unit));
  return v;
}

}  // namespace

Um length_from(double mm, std::string_view whole) {
  const double um = mm * 1000.0;
  if (std::abs(um) > max_coord) refuse(whole, "a length within 16 m");
  // Refused rather than rounded in silence: the lattice is whole microns. 1e-6 µm lets decimal fractions through.
  if (std::abs(um - std::round(um)) > 1e-6) refuse(whole, "a length in whole microns (at most three decimals)");
  return static_cast<Um>(std::lround(um));
}

namespace {

/// A text within a list: `;` parts its items, and stands in a text as `\s`, beside the escapes that texts have anyway.
std::string without_semicolons(std::string_view text) {
  std::string out;
  for (const char c : text) out += c == ';' ? std::string("\\s") : std::string(1, c);
  return out;
}
std::string with_semicolons(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool pair = text[i] == '\\' && i + 1 < text.size();
    if (pair && text[i + 1] == 's') {
      out += ';', ++i;
    } else {
      out += text[i];
      if (pair) out += text[++i];
    }
  }
  return out;
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

void parse(std::string_view text, Unit unit, Um& out) {
  if (unit != Unit::mm) {  // a whole number; Um and int are one type
    const double v = quantity(text, unit, "a whole number");
    if (v != std::round(v) || std::abs(v) > 1e9) refuse(trimmed(text), "a whole number");
    out = static_cast<int>(v);
    return;
  }
  out = length_from(quantity(text, unit, "a length"), trimmed(text));
}

void parse(std::string_view text, Unit unit, double& out) {
  out = quantity(text, unit, "a number");
}

void parse(std::string_view text, Unit, bool& out) {
  const auto t = trimmed(text);
  for (const auto yes : {"true", "yes", "on", "1"})
    if (same_word(t, yes)) return void(out = true);
  for (const auto no : {"false", "no", "off", "0"})
    if (same_word(t, no)) return void(out = false);
  refuse(t, "true or false");
}

void parse(std::string_view text, Unit, std::string& out) {
  out.clear();
  text = trimmed(text);
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\\' || i + 1 == text.size()) {
      out += text[i];
      continue;
    }
    switch (const char c = text[++i]) {
      case 'n':
        out += '\n';
        break;
      case 'r':
        out += '\r';
        break;
      case 't':
        out += '\t';
        break;
      case '\\':
        out += '\\';
        break;
      default:
        (out += '\\') += c;
    }
  }
}

void parse(std::string_view text, Unit, LengthOrShare& out) {
  const auto whole = text = trimmed(text);
  const double v = take_number(text, whole, "a length in mm or a share in %");
  if (text == "%") return void(out = share(v));
  if (!names_unit(text, Unit::mm)) refuse(whole, "a length in mm or a share in %");
  out = length(length_from(v, whole));
}

void parse(std::string_view text, Unit, SpeedOrShare& out) {
  const auto whole = text = trimmed(text);
  const double v = take_number(text, whole, "a speed in mm/s or a share in %");
  if (text != "%" && !names_unit(text, Unit::mm_s)) refuse(whole, "a speed in mm/s or a share in %");
  out = {v, text == "%"};
}

void parse(std::string_view text, Unit, Ring& out) {
  out.clear();
  const auto whole = trimmed(text);
  if (whole.empty()) return;
  constexpr std::string_view what = "a list of points in mm such as 0x0, 220x0, 220x220, 0x220";
  for_each_part(whole, ',', [&](std::string_view part) {
    const auto x = part.find('x');
    if (x == std::string_view::npos) refuse(whole, what);
    auto number_of = [&](std::string_view t) {
      t = trimmed(t);
      const double v = take_number(t, whole, what);
      if (!t.empty()) refuse(whole, what);
      if (std::abs(v) * 1000.0 > max_coord) refuse(whole, "within 16 m");
      return from_mm(v);
    };
    out.push_back({number_of(part.substr(0, x)), number_of(part.substr(x + 1))});
  });
}

void parse(std::string_view text, Unit unit, std::vector<Ring>& out) {
  out.clear();
  if (trimmed(text).empty()) return;
  for_each_part(text, ';', [&](std::string_view part) {
    if (!part.empty()) parse(part, unit, out.emplace_back());
  });
}

void parse(std::string_view text, Unit, PictureSizes& out) {
  out.clear();
  const auto whole = trimmed(text);
  if (whole.empty()) return;
  constexpr std::string_view what = "a list of picture sizes such as 32x32, 220x124 (1 … 4096 pixels)";
  for_each_part(whole, ',', [&](std::string_view part) {
    const auto x = part.find('x');
    if (x == std::string_view::npos) refuse(whole, what);
    const auto pixels = [&](std::string_view t) {
      t = trimmed(t);
      const auto n = as_number<int>(t);
      if (!n || *n < 1 || *n > 4096) refuse(whole, what);
      return *n;
    };
    out.push_back({pixels(part.substr(0, x)), pixels(part.substr(x + 1))});
  });
}

void parse(std::string_view text, Unit unit, Numbers& out) {
  out.clear();
  const auto whole = trimmed(text);
  if (whole.empty()) return;
  const std::string what = what_of("a list of numbers", unit) + " such as 0, 60, 120";
  for_each_part(whole, ',', [&](std::string_view part) {
    const double v = take_number(part, whole, what);
    if (!names_unit(part, unit)) refuse(whole, what);
    out.push_back(v);
  });
}

void parse(std::string_view text, Unit, ValuesAt& out) {
  out.clear();
  const auto whole = trimmed(text);
  if (whole.empty()) return;
  constexpr std::string_view what = "a list of mm:% such as 0:60, 2:30, 8:10";
  for_each_part(whole, ',', [&](std::string_view part) {
    ValueAt step;
    step.at = take_number(part, whole, what);
    if (part.empty() || part.front() != ':') refuse(whole, what);
    part = trimmed(part.substr(1));
    step.value = take_number(part, whole, what);
    if (!names_unit(part, Unit::percent)) refuse(whole, what);
    if (!out.empty() && step.at < out.back().at) refuse(whole, "in ascending order");
    out.push_back(step);
  });
}

namespace {
/// What a transfer curve is called and how many numbers it takes, with the least and the most that each may be.
struct TransferRow {
  std::string_view name;
  int numbers = 0;
  double least = 0, most = 0;
};
constexpr TransferRow transfer_rows[]{{"linear"},           {"simp", 1, 1, 10},
                                      {"ramp", 1, 0, 1000}, {"heaviside", 2, 0.1, 1000},
                                      {"linear_spacing"},   {"exponential_spacing"}};
}  // namespace

void parse(std::string_view text, Unit, TransferCurve& out) {
  constexpr std::string_view what =
      "linear, simp:1 … 10, ramp:0 … 1000, heaviside:0.1 … 1000:0 … 1, linear_spacing or exponential_spacing";
  const auto whole = trimmed(text);
  std::vector<std::string_view> parts;
  for_each_part(whole, ':', [&](std::string_view part) { parts.push_back(part); });
  for (std::size_t i = 0; i < std::size(transfer_rows); ++i) {
    const TransferRow& row = transfer_rows[i];
    if (parts.empty() || !same_word(parts.front(), row.name)) continue;
    if (parts.size() != static_cast<std::size_t>(row.numbers) + 1) refuse(whole, what);
    out = {static_cast<Transfer>(i), 0, 0};
    const auto number_of = [&](std::string_view part, double least, double most) {
      const double v = take_number(part, whole, what);
      if (!part.empty() || v < least || v > most) refuse(whole, what);
      return v;
    };
    if (row.numbers > 0) out.first = number_of(parts[1], row.least, row.most);
    if (row.numbers > 1) out.second = number_of(parts[2], 0, 1);
    return;
  }
  refuse(whole, what);
}

void parse(std::string_view text, Unit, Rgb& out) {
  const auto t = trimmed(text);
  constexpr std::string_view what = "a colour such as #FF8000";
  if ((t.size() != 7 && t.size() != 9) || t.front() != '#') refuse(t, what);
  const auto digits = as_number<std::uint32_t>(t.substr(1), 16);
  if (!digits) refuse(t, what);
  const std::uint32_t v = t.size() == 9 ? *digits >> 8 : *digits;
  out = {static_cast<std::uint8_t>(v >> 16), static_cast<std::uint8_t>(v >> 8), static_cast<std::uint8_t>(v)};
}

void parse(std::string_view text, Unit, HeightMarks& out) {
  out.clear();
  const auto whole = trimmed(text);
  if (whole.empty()) return;
  constexpr std::string_view what = "a list of heights in mm above 0 such as 5.2 = text; 10";
  for_each_part(whole, ';', [&](std::string_view part) {
    if (part.empty()) return;
    const auto equals = part.find('=');
    auto height = trimmed(part.substr(0, equals));
    const double mm = take_number(height, whole, what);
    if (!names_unit(height, Unit::mm) || mm <= 0) refuse(whole, what);
    const auto says = equals == std::string_view::npos ? std::string_view() : trimmed(part.substr(equals + 1));
    out.push_back({length_from(mm, whole), with_semicolons(escape::one_line(says))});
  });
  std::stable_sort(out.begin(), out.end(), [](const HeightMark& a, const HeightMark& b) { return a.z < b.z; });
}

void parse(std::string_view text, Unit, ToolValues& out) {
  out.clear();
  const auto whole = trimmed(text);
  if (whole.empty()) return;
  constexpr std::string_view what = "a list of settings of tools such as 1.material_flow = 97; 2.material_flow = 99";
  for_each_part(whole, ';', [&](std::string_view part) {
    if (part.empty()) return;
    const auto dot = part.find('.'), equals = part.find('=');
    if (equals == std::string_view::npos || dot > equals) refuse(part, what);
    const auto tool = as_number<int>(part.substr(0, dot));
    if (!tool || *tool < 1 || *tool > 31) refuse(part, what);
    out.push_back({*tool, std::string(trimmed(part.substr(dot + 1, equals - dot - 1))),
                   with_semicolons(trimmed(part.substr(equals + 1)))});
  });
}

std::size_t parse_choice(std::string_view text, const std::vector<std::string_view>& names) {
  const auto t = trimmed(text);
  for (std::size_t i = 0; i < names.size(); ++i)
    if (same_word(t, names[i])) return i;
  refuse(t, "one of " + joined(names));
}

std::string number(double v, int decimals) {
  // The shortest text that is read as v, which most values of settings have, is found in a tenth of the time that
  // rounding takes. Below 1e9 it is what rounding to its digits gives: the nearest number of so many.
  if (std::abs(v) < 1e9) {
    std::string out = fmt::format("{}", v);
    const auto dot = out.find('.');
    if (out.find('e') == std::string::npos &&
        (dot == std::string::npos || out.size() - dot - 1 <= static_cast<std::size_t>(std::clamp(decimals, 0, 6))))
      return out == "-0" ? "0" : out;
  }
  std::string out = fmt::format("{:.{}f}", v, decimals);
  if (out.find('.') != std::string::npos) {
    while (out.back() == '0') out.pop_back();
    if (out.back() == '.') out.pop_back();
  }
  return out == "-0" ? "0" : out;
}

std::string print(Um v, Unit unit) {
  return unit == Unit::mm ? number(to_mm(v)) : fmt::format("{}", v);
}
std::string print(double v, Unit unit) {
  return number(v) + (unit == Unit::percent ? "%" : "");
}
std::string print(bool v, Unit) {
  return v ? "true" : "false";
}

std::string print(const std::string& v, Unit) {
  return escape::gcode_comment(v);
}

std::string print(const LengthOrShare& v, Unit) {
  return v.is_share ? number(v.percent) + "%" : number(to_mm(v.length));
}
std::string print(const SpeedOrShare& v, Unit) {
  return number(v.value) + (v.is_share ? "%" : "");
}

std::string print(const Ring& v, Unit) {
  std::string out;
  for (const Point p : v) {
    if (!out.empty()) out += ", ";
    out += number(to_mm(p.x)) + "x" + number(to_mm(p.y));
  }
  return out;
}

std::string print(const std::vector<Ring>& v, Unit unit) {
  std::string out;
  for (const auto& ring : v) {
    if (!out.empty()) out += "; ";
    out += print(ring, unit);
  }
  return out;
}

std::string print(const PictureSizes& v, Unit) {
  std::string out;
  for (const auto size : v) out += fmt::format("{}{}x{}", out.empty() ? "" : ", ", size.width, size.height);
  return out;
}

std::string print(const Numbers& v, Unit) {
  std::string out;
  for (const double each : v) out += (out.empty() ? "" : ", ") + number(each);
  return out;
}

std::string print(const ValuesAt& v, Unit) {
  std::string out;
  for (const ValueAt& each : v)
    out += fmt::format("{}{}:{}", out.empty() ? "" : ", ", number(each.at), number(each.value));
  return out;
}

std::string print(const TransferCurve& v, Unit) {
  const TransferRow& row = transfer_rows[static_cast<std::size_t>(v.kind)];
  std::string out(row.name);
  if (row.numbers > 0) out += ":" + number(v.first);
  if (row.numbers > 1) out += ":" + number(v.second);
  return out;
}

std::string print(Rgb v, Unit) {
  return fmt::format("#{:02X}{:02X}{:02X}", v.r, v.g, v.b);
}

std::string print(const HeightMarks& v, Unit) {
  std::string out;
  for (const auto& mark : v)
    out += (out.empty() ? "" : "; ") + number(to_mm(mark.z)) +
           (mark.text.empty() ? "" : " = " + without_semicolons(mark.text));
  return out;
}

std::string print(const ToolValues& v, Unit) {
  std::string out;
  for (const auto& value : v) {
    out += fmt::format("{}{}.{} = {}", out.empty() ? "" : "; ", value.tool, value.key, without_semicolons(value.text));
  }
  return out;
}

}  // namespace weft::value
