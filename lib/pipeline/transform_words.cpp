// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/transform_words.h"

#include "settings/value.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

namespace weft::pipeline {
namespace {

using Three = std::array<double, 3>;

double number(std::string_view text, double least, double most) {
  double v = 0;
  value::parse(value::trimmed(text), Unit::none, v);
  if (!(v >= least && v <= most)) throw std::invalid_argument(fmt::format("{} is outside {} … {}", text, least, most));
  return v;
}

std::vector<std::string_view> items(std::string_view text) {
  std::vector<std::string_view> out;
  for (bool more = true; more;) {
    const auto end = std::min(text.find(','), text.size());
    out.push_back(value::trimmed(text.substr(0, end)));
    more = end < text.size();
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return out;
}

Three three(std::string_view text, double least, double most) {
  const auto parts = items(text);
  if (parts.size() != 3) throw std::invalid_argument(fmt::format("'{}' is not three numbers", text));
  Three out{};
  for (std::size_t i = 0; i < 3; ++i) out[i] = number(parts[i], least, most);
  return out;
}
std::string text_of(const Three& v) {
  return fmt::format("{},{},{}", v[0], v[1], v[2]);
}

double factor(std::string_view text) {
  const bool percent = !text.empty() && text.back() == '%';
  if (percent) text.remove_suffix(1);
  double v = 0;
  try {
    value::parse(value::trimmed(text), Unit::none, v);
  } catch (const std::invalid_argument&) {
    v = 0;
  }
  if (percent) v /= 100;
  if (!(v >= 1e-6 && v <= 1e6)) throw std::invalid_argument(fmt::format("'{}' is not a factor above 0", text));
  return v;
}
void set_scale(Placement& p, std::string_view text) {
  const auto parts = items(text);
  p.transform.stretch = {1, 1, 1};
  if (parts.size() == 1) {
    p.scale = factor(parts[0]);
    return;
  }
  if (parts.size() != 3) throw std::invalid_argument(fmt::format("'{}' is not one factor or three", text));
  Three by{};
  for (std::size_t i = 0; i < 3; ++i) by[i] = factor(parts[i]);
  p.scale = std::max({by[0], by[1], by[2]});  // read so large, then less: no detail gets lost
  for (std::size_t i = 0; i < 3; ++i) p.transform.stretch[i] = by[i] / p.scale;
}
std::string scale_text(const Placement& p) {
  const auto& s = p.transform.stretch;
  if (s != Three{1, 1, 1}) return text_of({s[0] * p.scale, s[1] * p.scale, s[2] * p.scale});
  return p.scale == 1 ? std::string() : fmt::format("{}", p.scale);
}

struct UnitRow {
  std::string_view name;
  double mm;
};
constexpr std::array units{UnitRow{"mm", 1}, UnitRow{"cm", 10}, UnitRow{"m", 1000}, UnitRow{"inch", 25.4},
                           UnitRow{"ft", 304.8}};
void set_unit(Placement& p, std::string_view text) {
  const auto row = std::find_if(units.begin(), units.end(), [&](const UnitRow& r) { return r.name == text; });
  if (row == units.end()) throw std::invalid_argument(fmt::format("'{}' is not one of mm, cm, m, inch, ft", text));
  p.transform.mm_per_unit = row->mm;
}
std::string unit_text(const Placement& p) {
  if (p.transform.mm_per_unit == 1) return {};
  const auto row =
      std::find_if(units.begin(), units.end(), [&](const UnitRow& r) { return r.mm == p.transform.mm_per_unit; });
  return row == units.end() ? std::string() : std::string(row->name);
}

constexpr std::string_view axes = "xyz";
void set_mirror(Placement& p, std::string_view text) {
  p.transform.mirror = {};
  for (const auto item : items(text)) {
    const auto axis = item.size() == 1 ? axes.find(item) : std::string_view::npos;
    if (axis == std::string_view::npos) throw std::invalid_argument(fmt::format("'{}' is not one of x, y, z", item));
    p.transform.mirror[axis] = !p.transform.mirror[axis];
  }
}
std::string mirror_text(const Placement& p) {
  std::string out;
  for (std::size_t i = 0; i < 3; ++i)
    if (p.transform.mirror[i]) out += std::string(out.empty() ? "" : ",") + axes[i];
  return out;
}

void set_orient(Placement& p, std::string_view text) {
  if (text == "auto") {
    p.transform.orient = Orientation{};
    return;
  }
  if (!text.starts_with("face:")) throw std::invalid_argument(fmt::format("'{}' is neither auto nor face:x,y,z", text));
  const auto face = three(text.substr(5), -1e9, 1e9);
  if (face == Three{0, 0, 0}) throw std::invalid_argument("0,0,0 is no direction");
  p.transform.orient = Orientation{false, face};
}
std::string orient_text(const Placement& p) {
  const auto& o = p.transform.orient;
  return !o ? std::string() : o->automatic ? "auto" : "face:" + text_of(o->face);
}

void set_keep(Placement& p, std::string_view text) {
  constexpr std::array<std::string_view, 3> names{"both", "lower", "upper"};
  const auto at = std::find(names.begin(), names.end(), text);
  if (at == names.end()) throw std::invalid_argument(fmt::format("'{}' is not one of both, lower, upper", text));
  p.transform.keep = static_cast<CutKeep>(at - names.begin());
}
std::string keep_text(const Placement& p) {
  return p.transform.keep == CutKeep::lower ? "lower" : p.transform.keep == CutKeep::upper ? "upper" : "";
}

template <bool Transform::*flag>
void set_flag(Placement& p, std::string_view text) {
  value::parse(text, Unit::none, p.transform.*flag);
}
template <bool Transform::*flag>
std::string flag_text(const Placement& p) {
  return p.transform.*flag ? "true" : "";
}
template <double Transform::*angle>
void set_angle(Placement& p, std::string_view text) {
  p.transform.*angle = number(text, -36000, 36000);
}
template <double Transform::*angle>
std::string angle_text(const Placement& p) {
  return p.transform.*angle == 0 ? std::string() : fmt::format("{}", p.transform.*angle);
}

constexpr std::array words{
    TransformWord{"unit", "mm|cm|m|inch|ft", "unit of STL and OBJ files, which do not say; others do", "inch", set_unit,
                  unit_text},
    TransformWord{"scale", "F|X,Y,Z", "scale: 2, 0.5, 25.4 or 50%; or one factor along each axis of the file",
                  "2, 50% or 1,1,0.5", set_scale, scale_text},
    TransformWord{"mirror", "x|y|z", "mirror along an axis, or several: x,y", "x", set_mirror, mirror_text},
    TransformWord{"rotate_x", "DEG", "rotation about X, before any other", "90", set_angle<&Transform::rotate_x_deg>,
                  angle_text<&Transform::rotate_x_deg>},
    TransformWord{"rotate_y", "DEG", "rotation about Y, behind that about X", "90", set_angle<&Transform::rotate_y_deg>,
                  angle_text<&Transform::rotate_y_deg>},
    TransformWord{"orient", "auto|face:X,Y,Z",
                  "lay it so that it wants least support, or so that this direction points down", "auto or face:0,1,0",
                  set_orient, orient_text},
    TransformWord{"scale_to_fit", "X,Y,Z", "as large as it can be in a box of so many mm, behind all rotations",
                  "200,200,100",
                  [](Placement& p, std::string_view text) { p.transform.fit_mm = three(text, 0.001, 16000); },
                  [](const Placement& p) { return p.transform.fit_mm ? text_of(*p.transform.fit_mm) : std::string(); }},
    TransformWord{"cut", "Z",
                  "cut at so many mm above its lowest point; both halves are printed, each on its cut or foot", "12.5",
                  [](Placement& p, std::string_view text) { p.transform.cut = from_mm(number(text, 0.001, 16000)); },
                  [](const Placement& p) {
                    return p.transform.cut ? fmt::format("{}", to_mm(*p.transform.cut)) : std::string();
                  }},
    TransformWord{"cut_keep", "both|lower|upper", "which half of a cut is printed", "lower", set_keep, keep_text},
    TransformWord{"split", "", "bodies of a file that share no edge become objects of their own, each placed by itself",
                  "", set_flag<&Transform::split>, flag_text<&Transform::split>},
    TransformWord{"merge", "", "all models become parts of one object, in their files' coordinates", "",
                  set_flag<&Transform::merge>, flag_text<&Transform::merge>},
};

}  // namespace

std::span<const TransformWord> transform_words() {
  return words;
}

const TransformWord* find_transform_word(std::string_view key) {
  const auto at = std::find_if(words.begin(), words.end(), [&](const TransformWord& w) { return w.key == key; });
  return at == words.end() ? nullptr : &*at;
}

bool transforms(const Transform& transform) {
  Transform read = transform;
  read.mm_per_unit = 1;
  return read != Transform{};
}

void check_transform(const Placement& p) {
  const auto& t = p.transform;
  if (t.keep != CutKeep::both && !t.cut) throw std::invalid_argument("cut_keep: nothing is cut; give cut as well");
  if (t.cut && t.keep == CutKeep::both && p.keep_position)
    throw std::invalid_argument("cut: both halves cannot keep their place; cut_keep = lower or upper");
  if (t.split && t.merge) throw std::invalid_argument("merge: contradicts split");
}

}  // namespace weft::pipeline
