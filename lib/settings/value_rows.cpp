// SPDX-License-Identifier: GPL-3.0-or-later
#include "settings/value_text.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

namespace weft::value {
namespace {

std::string band_text(const HeightBand& band) {
  return number(to_mm(band.from)) + "-" + number(to_mm(band.to));
}

}  // namespace

void parse(std::string_view text, Unit, HeightBands& out) {
  out.clear();
  constexpr std::string_view what = "a list of from-to:height in mm such as 0-5:0.1; 5-20:0.3";
  for_each_part(text, ';', [&](std::string_view part) {
    if (part.empty()) return;
    const auto whole = part;
    const auto next = [&](char separator) {
      const double mm = take_number(part, whole, what);
      if (separator != 0 && (part.empty() || part.front() != separator)) refuse(whole, what);
      if (separator != 0) part = trimmed(part.substr(1));
      return length_from(mm, whole);
    };
    HeightBand band;
    band.from = next('-'), band.to = next(':'), band.height = next('\0');
    if (!names_unit(part, Unit::mm) || band.from < 0) refuse(whole, what);
    if (band.to <= band.from) throw std::invalid_argument(fmt::format("{} ends where it begins", band_text(band)));
    constexpr Um least = 20, most = 2000;  // those of layer_height
    if (band.height < least || band.height > most)
      throw std::invalid_argument(fmt::format("{} mm is outside 0.02 … 2 mm", number(to_mm(band.height))));
    out.push_back(band);
  });
  std::stable_sort(out.begin(), out.end(), [](HeightBand a, HeightBand b) { return a.from < b.from; });
  for (std::size_t i = 1; i < out.size(); ++i)
    if (out[i].from < out[i - 1].to)
      throw std::invalid_argument(fmt::format("{} and {} overlap", band_text(out[i - 1]), band_text(out[i])));
}

namespace {

/// The numbers of a row. A comma that was meant as a point makes one too many, of which a part begins with zeros.
std::vector<double> numbers_of(std::string_view row, std::size_t index) {
  std::vector<std::string_view> texts;
  for_each_part(row, ',', [&](std::string_view part) { texts.push_back(part); });
  const auto refuse_row = [&](std::string_view text, const std::string& instead) {
    throw std::invalid_argument(fmt::format("row {}: \"{}\" is no number{}", index, text, instead));
  };
  if (texts.size() > 3)
    for (std::size_t i = 0; i + 1 < texts.size(); ++i)
      if (texts[i] == "0" && texts[i + 1].size() > 1 && texts[i + 1].front() == '0' &&
          texts[i + 1].find('.') == std::string_view::npos)
        refuse_row(fmt::format("{},{}", texts[i], texts[i + 1]), fmt::format("; write {}.{}", texts[i], texts[i + 1]));
  std::vector<double> out;
  for (auto text : texts) {
    const auto whole = text;
    try {
      out.push_back(take_number(text, whole, "a number"));
    } catch (const std::invalid_argument&) {
      refuse_row(whole, "");
    }
    if (!text.empty()) refuse_row(whole, "");
  }
  return out;
}

}  // namespace

void parse(std::string_view text, Unit, PressureRows& out) {
  out.clear();
  std::size_t index = 0;
  for_each_part(text, ';', [&](std::string_view part) {
    if (part.empty()) return;
    const auto v = numbers_of(part, ++index);
    const auto refuse_row = [&](const std::string& why) {
      throw std::invalid_argument(fmt::format("row {}: {}", index, why));
    };
    if (v.size() != 3 && v.size() != 4)
      refuse_row(fmt::format("{} numbers; a row is an advance in s, mm³/s, mm/s², or these and mm", v.size()));
    if (v[0] < 0 || v[0] > 2) refuse_row(fmt::format("{} s is outside 0 … 2 s", number(v[0])));
    if (v[1] <= 0 || v[1] > 500) refuse_row(fmt::format("{} mm³/s is not above 0, up to 500", number(v[1])));
    if (v[2] <= 0 || v[2] > 100000) refuse_row(fmt::format("{} mm/s² is not above 0, up to 100000", number(v[2])));
    PressureRow row{v[0], v[1], v[2], {}};
    if (v.size() == 4) {
      row.height = length_from(v[3], part);
      if (*row.height <= 0) refuse_row("a layer has a height");
    }
    if (!out.empty() && out.front().height.has_value() != row.height.has_value())
      refuse_row("rows with the height of a layer and rows without do not go together");
    out.push_back(row);
  });
}

std::string print(const HeightBands& v, Unit) {
  std::string out;
  for (const auto& band : v)
    out += fmt::format("{}{}:{}", out.empty() ? "" : "; ", band_text(band), number(to_mm(band.height)));
  return out;
}

std::string print(const PressureRows& v, Unit) {
  std::string out;
  for (const auto& row : v)
    out += fmt::format("{}{}, {}, {}{}", out.empty() ? "" : "; ", number(row.advance_s), number(row.mm3_s),
                       number(row.mm_s2), row.height ? ", " + number(to_mm(*row.height)) : "");
  return out;
}

}  // namespace weft::value
