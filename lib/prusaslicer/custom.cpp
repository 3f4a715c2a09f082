// SPDX-License-Identifier: GPL-3.0-or-later
#include "prusaslicer/custom.h"

#include "prusaslicer/keys.h"
#include "prusaslicer/text.h"
#include "settings/catalogue.h"
#include "settings/value.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <set>
#include <stdexcept>
#include <tuple>

#include <fmt/format.h>

namespace weft::prusaslicer {
namespace {

// Beyond these a coordinate is more likely a slip than a purge bucket, a parking place or a wiping pad.
constexpr Um farthest = 60'000, highest = 20'000, deepest = 5'000;
constexpr std::array<std::string_view, 8> custom_keys{
    "start_gcode",      "start_filament_gcode",  "before_layer_gcode", "layer_gcode",
    "toolchange_gcode", "between_objects_gcode", "end_filament_gcode", "end_gcode"};

/// The custom G-code of that key with its line ends.
std::string text_of(const Lines& lines, std::string_view key) {
  const auto* e = lines.look(key);
  if (!e) return {};
  const auto elements = elements_of(key, e->value);
  std::string out;
  if (!elements.empty()) value::parse(elements.front(), Unit::none, out);
  return out;
}

/// Calls f(piece, is_placeholder) for what stands in braces or brackets and what stands between.
template <class F>
void for_each_piece(std::string_view text, F f) {
  while (!text.empty()) {
    const auto open = text.find_first_of("{[");
    if (open > 0) f(text.substr(0, open), false);
    if (open == std::string_view::npos) return;
    const auto close = text.find(text[open] == '{' ? '}' : ']', open);
    if (close == std::string_view::npos) return;
    f(text.substr(open + 1, close - open - 1), true);
    text.remove_prefix(close + 1);
  }
}

/// The number of an axis word with plain digits, such as the -3 of `G1 Y-3.0 F1000`.
std::optional<Um> coordinate(std::string_view command, char axis) {
  for (std::size_t i = 1; i < command.size() && command[i] != ';'; ++i) {
    if (command[i] != axis || (command[i - 1] != ' ' && command[i - 1] != '\t')) continue;
    double v = 0;
    const auto [end, error] = std::from_chars(command.data() + i + 1, command.data() + command.size(), v);
    if (error != std::errc{} || !(std::abs(v) < 10'000)) return std::nullopt;
    if (end != command.data() + command.size() && *end == '\1')
      return std::nullopt;  // a number that goes on with a placeholder
    return from_mm(v);
  }
  return std::nullopt;
}

/// What encloses the moves on one axis, and the move that goes farthest.
struct Span {
  Um least = 0, most = 0;   ///< where the bed, or the print, ends
  Um below = 0, above = 0;  ///< how far beyond that may be believed
  Um low = 0, high = 0;     ///< with the moves seen
  std::string why_low, why_high;
};
struct Found {
  Span x, y, z;
};

std::string farther(Um um, std::string_view side) {
  return fmt::format("{} mm {}", to_mm(um), side);
}

/// Widens a span by one coordinate.
void widen(Span& span, Um at, std::string_view key, std::string_view line) {
  const auto shown = [&] {
    std::string text(value::trimmed(line.substr(0, line.find(';'))));
    std::replace(text.begin(), text.end(), '\1', '_');
    return fmt::format("{} goes there: {}", key, text);
  };
  if (at < span.low && span.least - at <= span.below) span.low = at, span.why_low = shown();
  if (at > span.high && at - span.most <= span.above) span.high = at, span.why_high = shown();
}

/// Widens `found` by the moves of one piece of custom G-code.
void look_at(std::string_view key, std::string_view text, Found& found) {
  std::string plain;  // conditions vanish, values become a mark that is no number
  for_each_piece(text, [&](std::string_view piece, bool placeholder) {
    if (!placeholder)
      plain += piece;
    else if (!piece.starts_with("if ") && !piece.starts_with("elsif ") && piece != "else" && piece != "endif")
      plain += '\1';
  });
  bool absolute = true;
  for (std::string_view rest = plain; !rest.empty();) {
    const auto end = rest.find('\n');
    const auto line = value::trimmed(rest.substr(0, end));
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    const auto word = line.substr(0, line.find_first_of(" \t;"));
    if (word == "G90") absolute = true;
    if (word == "G91") absolute = false;
    if (!absolute || (word != "G0" && word != "G1" && word != "G00" && word != "G01")) continue;
    for (const auto& [axis, span] : {std::pair{'X', &found.x}, {'Y', &found.y}, {'Z', &found.z}})
      if (const auto at = coordinate(line, axis)) widen(*span, *at, key, line);
  }
}

}  // namespace

std::vector<CustomReach> reach_of(const Lines& lines) {
  const auto* e = lines.look("bed_shape");
  if (!e) return {};
  Ring bed;
  try {
    value::parse(e->value, Unit::mm, bed);
  } catch (const std::invalid_argument&) {
    return {};  // told where the bed is read
  }
  if (bed.size() < 3) return {};
  const Box box = box_of(bed);
  const auto* height = lines.look("max_print_height");
  const double height_mm = height ? lines.figure(*height).v : 0;
  const Um top = height_mm > 0 && height_mm <= 10'000 ? from_mm(height_mm) : 10'000'000;
  Found found{{box.min.x, box.max.x, farthest, farthest, box.min.x, box.max.x, {}, {}},
              {box.min.y, box.max.y, farthest, farthest, box.min.y, box.max.y, {}, {}},
              {0, top, deepest, highest, 0, top, {}, {}}};
  for (const auto key : custom_keys) look_at(key, text_of(lines, key), found);
  std::vector<CustomReach> out;
  std::string why, beyond;
  for (const auto& [text, um, side] : {std::tuple{&found.y.why_low, found.y.least - found.y.low, "in front of the bed"},
                                       {&found.y.why_high, found.y.high - found.y.most, "behind it"},
                                       {&found.x.why_low, found.x.least - found.x.low, "on its left"},
                                       {&found.x.why_high, found.x.high - found.x.most, "on its right"}}) {
    if (text->empty()) continue;
    if (why.empty()) why = *text;
    beyond += (beyond.empty() ? "" : ", ") + farther(um, side);
  }
  if (!why.empty())
    out.push_back({"machine_reach",
                   value::print(Ring{{found.x.low, found.y.low}, {found.x.high, found.y.high}}, Unit::mm), why,
                   beyond});
  if (!found.z.why_low.empty())
    out.push_back({"machine_reach_z_min", value::print(found.z.low, Unit::mm), found.z.why_low,
                   farther(-found.z.low, "below the bed's surface")});
  if (!found.z.why_high.empty())
    out.push_back({"machine_reach_z_max", value::print(found.z.high, Unit::mm), found.z.why_high,
                   farther(found.z.high - found.z.most, "above the highest print")});
  return out;
}

std::string variables_of(const Lines& lines) {
  std::set<std::string_view> own;
  for (const auto& entry : catalogue()) own.insert({entry.key, name_of(entry.key)});
  std::set<std::string> named;
  for (const auto key : custom_keys) {
    const auto text = text_of(lines, key);
    for_each_piece(text, [&](std::string_view piece, bool placeholder) {
      if (!placeholder) return;
      for (std::size_t i = 0; i < piece.size();) {
        const auto end = std::min(piece.find_first_not_of("abcdefghijklmnopqrstuvwxyz_0123456789", i), piece.size());
        auto name = piece.substr(i, end - i);
        i = end + (end == i ? 1 : 0);
        if (name.empty()) continue;
        if (!lines.look(name))  // `temperature_0` is an element of a list
          if (const auto bar = name.rfind('_'); bar != std::string_view::npos && bar + 1 < name.size() &&
                                                name.find_first_not_of("0123456789", bar + 1) == std::string_view::npos)
            name = name.substr(0, bar);
        if (lines.look(name) && own.find(name) == own.end()) named.insert(std::string(name));
      }
    });
  }
  std::string out;
  for (const auto& name : named)
    out += fmt::format("{}{} = {}", out.empty() ? "" : "\n", name, in_macro_words(name, lines.look(name)->value));
  return value::print(out, Unit::none);
}

}  // namespace weft::prusaslicer
