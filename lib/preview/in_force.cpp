// SPDX-License-Identifier: GPL-3.0-or-later
#include "preview/in_force.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

namespace weft::preview {
namespace {

std::optional<double> number(std::string_view text) {
  double v = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), v);
  if (error != std::errc{} || !std::isfinite(v)) return std::nullopt;
  return v;
}

/// The number behind that letter among words separated by blanks.
std::optional<double> word(std::string_view words, char letter) {
  for (std::size_t at = 0; at < words.size(); ++at) {
    const bool begins = at == 0 || words[at - 1] == ' ' || words[at - 1] == '\t';
    if (begins && words[at] == letter) return number(words.substr(at + 1));
  }
  return std::nullopt;
}

/// The number behind NAME=.
std::optional<double> named_value(std::string_view text, std::string_view name) {
  const auto at = text.find(name);
  return at == std::string_view::npos ? std::nullopt : number(text.substr(at + name.size()));
}

template <class T>
T within(double v, double most) {
  return static_cast<T>(std::lround(std::clamp(v, 0.0, most)));
}

constexpr double most_acceleration = 65'535, most_heat_c = 1000;

}  // namespace

void InForce::line(std::string_view text) {
  const auto begin = text.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return;
  text = text.substr(begin);
  if (text[0] == 'M') {
    int code = 0;
    const auto [end, error] = std::from_chars(text.data() + 1, text.data() + text.size(), code);
    if (error == std::errc{}) {
      text = text.substr(static_cast<std::size_t>(end - text.data()));
      return numbered(code, text.substr(0, text.find(';')));
    }
  }
  if (text[0] == 'S' || text[0] == 'P') named(text.substr(0, text.find(';')));
}

void InForce::numbered(int code, std::string_view words) {
  constexpr double full_fan = 255;  // S of M106; RepRapFirmware also takes 0 … 1
  const auto s = word(words, 'S');
  switch (code) {
    case 104:
    case 109:
      if (const auto heat = s ? s : word(words, 'R')) nozzle_c_ = within<std::int16_t>(*heat, most_heat_c);
      break;
    case 106: {
      if (word(words, 'P').value_or(0) != 0) break;  // another fan than the one of the part
      const double share = !s ? 1 : *s <= 1 ? *s : *s / full_fan;
      fan_percent_ = within<std::uint8_t>(100 * share, 100);
      break;
    }
    case 107:
      fan_percent_ = 0;
      break;
    case 204: {
      if (s) printing_ = travelling_ = within<std::uint16_t>(*s, most_acceleration);
      if (const auto p = word(words, 'P')) printing_ = within<std::uint16_t>(*p, most_acceleration);
      if (const auto t = word(words, 'T')) travelling_ = within<std::uint16_t>(*t, most_acceleration);
      break;
    }
    case 0:
    case 1:
    case 25:
    case 226:
    case 600:
    case 601:
      ++pauses_;
      break;
    default:
      break;
  }
}

void InForce::named(std::string_view text) {
  if (text.starts_with("SET_VELOCITY_LIMIT")) {
    if (const auto a = named_value(text, "ACCEL="))
      printing_ = travelling_ = within<std::uint16_t>(*a, most_acceleration);
  } else if (text.starts_with("SET_HEATER_TEMPERATURE")) {
    if (text.find("HEATER=extruder") == std::string_view::npos) return;
    if (const auto heat = named_value(text, "TARGET=")) nozzle_c_ = within<std::int16_t>(*heat, most_heat_c);
  } else if (text == "PAUSE" || text.starts_with("PAUSE ")) {
    ++pauses_;
  }
}

}  // namespace weft::preview
