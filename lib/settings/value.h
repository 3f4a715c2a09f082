// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "core/rgb.h"
#include "settings/unit.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// The types a setting may have, and their text: one parser and one printer a type, used by every door settings come
/// through. `parse` throws std::invalid_argument with one clause ("'0.2abc' is not a length in mm"); nothing is
/// guessed.
namespace weft {

/// A length that may be given as a share of another: `0.1 mm` or `25 %`. Resolved where it is read.
struct LengthOrShare {
  Um length = 0;
  double percent = 0;
  bool is_share = false;
  constexpr LengthOrShare() = default;
  constexpr LengthOrShare(Um um, double of_base = 0, bool share = false)  // NOLINT: a length is one
      : length(um), percent(of_base), is_share(share) {}
  Um of(Um base) const { return is_share ? rounded(base * percent / 100.0) : length; }
  friend bool operator==(const LengthOrShare&, const LengthOrShare&) = default;
};
constexpr LengthOrShare share(double percent) {
  return {0, percent, true};
}
constexpr LengthOrShare length(Um um) {
  return um;
}
/// What is set, as a share of `base` where it is one; else what the program chooses.
inline Um length_or(const std::optional<LengthOrShare>& set, Um base, Um automatic) {
  return set ? set->of(base) : automatic;
}

/// A speed that may be given as a share of another.
struct SpeedOrShare {
  double value = 0;  ///< mm/s, or %
  bool is_share = false;
  double of(double base_mm_s) const { return is_share ? base_mm_s * value / 100.0 : value; }
  friend bool operator==(const SpeedOrShare&, const SpeedOrShare&) = default;
};

/// Size of a picture, pixels: `220x124`.
struct PictureSize {
  int width = 0, height = 0;
  friend bool operator==(PictureSize, PictureSize) = default;
};
using PictureSizes = std::vector<PictureSize>;

using Numbers = std::vector<double>;  ///< `0, 60, 120`

/// A value at a place: `2:30`.
struct ValueAt {
  double at = 0, value = 0;
  friend bool operator==(ValueAt, ValueAt) = default;
};
using ValuesAt = std::vector<ValueAt>;  ///< `0:60, 2:30, 8:10`, places ascending; the same place twice is a step

/// How a density follows from the number that is given for it.
enum class Transfer { linear, simp, ramp, heaviside, linear_spacing, exponential_spacing };
struct TransferCurve {
  Transfer kind = Transfer::linear;
  double first = 0;   ///< simp: exponent; ramp: q; heaviside: sharpness
  double second = 0;  ///< heaviside: threshold, 0 … 1
  friend bool operator==(TransferCurve, TransferCurve) = default;
};

/// What happens at a height, or from it on: `2.4 = text`.
struct HeightMark {
  Um z = 0;
  std::string text;  ///< one line; what it says is the setting's matter
  friend bool operator==(const HeightMark&, const HeightMark&) = default;
};
using HeightMarks = std::vector<HeightMark>;

/// Layers of a height of their own between two heights: `0-5:0.1`.
struct HeightBand {
  Um from = 0, to = 0, height = 0;
  friend bool operator==(HeightBand, HeightBand) = default;
};
using HeightBands = std::vector<HeightBand>;  ///< `0-5:0.1; 5-20:0.3`, ascending, none over another

/// A measured advance of the extruder: `0.04, 3.96, 3000`.
struct PressureRow {
  double advance_s = 0, mm3_s = 0, mm_s2 = 0;
  std::optional<Um> height;  ///< of the layer it was measured at
  friend bool operator==(const PressureRow&, const PressureRow&) = default;
};
using PressureRows = std::vector<PressureRow>;  ///< rows separated by `;`

/// A setting of another tool than T0: `1.material_flow = 97`.
struct ToolValue {
  int tool = 0;
  std::string key, text;  ///< one line, as a profile holds it
  friend bool operator==(const ToolValue&, const ToolValue&) = default;
};
using ToolValues = std::vector<ToolValue>;

/// One choice of an enumeration; the enumeration's `choices_of(E)` returns an array of them, row i for value i.
template <class E>
struct Choice {
  E value;
  std::string_view name;
};

namespace value {

void parse(std::string_view text, Unit unit, Um& out);  ///< a length when the unit is mm, else a whole number
void parse(std::string_view text, Unit unit, double& out);
void parse(std::string_view text, Unit unit, bool& out);
void parse(std::string_view text, Unit unit, std::string& out);  ///< `\n`, `\r`, `\t`, `\\` are unescaped
void parse(std::string_view text, Unit unit, LengthOrShare& out);
void parse(std::string_view text, Unit unit, SpeedOrShare& out);
void parse(std::string_view text, Unit unit, Ring& out);               ///< `0x0, 220x0, 220x220, 0x220`, mm
void parse(std::string_view text, Unit unit, std::vector<Ring>& out);  ///< rings separated by `;`
void parse(std::string_view text, Unit unit, PictureSizes& out);       ///< `32x32, 220x124`, 1 … 4096 pixels each way
void parse(std::string_view text, Unit unit, Numbers& out);
void parse(std::string_view text, Unit unit, ValuesAt& out);
void parse(std::string_view text, Unit unit, TransferCurve& out);  ///< `linear`, `simp:3`, `heaviside:16:0.5`
void parse(std::string_view text, Unit unit, Rgb& out);            ///< `#RRGGBB`, or `#RRGGBBAA` without its A
void parse(std::string_view text, Unit unit, HeightMarks& out);    ///< `5.2 = text; 10`, mm, above 0; sorted
void parse(std::string_view text, Unit unit, ToolValues& out);   ///< `1.key = text; 2.key = text`; in texts `\s` is `;`
void parse(std::string_view text, Unit unit, HeightBands& out);  ///< `0-5:0.1; 5-20:0.3`, mm; sorted, apart
void parse(std::string_view text, Unit unit, PressureRows& out);  ///< `0.04, 3, 1000; …`: s, mm³/s, mm/s², or and mm
/// Index of the choice, without regard to case.
std::size_t parse_choice(std::string_view text, const std::vector<std::string_view>& names);

std::string print(Um v, Unit unit);
std::string print(double v, Unit unit);
std::string print(bool v, Unit unit);
std::string print(const std::string& v, Unit unit);
std::string print(const LengthOrShare& v, Unit unit);
std::string print(const SpeedOrShare& v, Unit unit);
std::string print(const Ring& v, Unit unit);
std::string print(const std::vector<Ring>& v, Unit unit);
std::string print(const PictureSizes& v, Unit unit);
std::string print(const ValuesAt& v, Unit unit);
std::string print(const TransferCurve& v, Unit unit);
std::string print(Rgb v, Unit unit);
std::string print(const Numbers& v, Unit unit);
std::string print(const HeightMarks& v, Unit unit);
std::string print(const ToolValues& v, Unit unit);
std::string print(const HeightBands& v, Unit unit);
std::string print(const PressureRows& v, Unit unit);

/// A number as short as it can be, without locale: 0.45, 220, -1.5.
std::string number(double v, int decimals = 6);

std::string_view trimmed(std::string_view text);

}  // namespace value
}  // namespace weft
