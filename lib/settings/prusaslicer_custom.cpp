#include "settings/prusaslicer_custom.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <set>
#include <stdexcept>

#include "settings/catalogue.h"
#include "settings/prusaslicer_text.h"
#include "settings/value.h"

namespace weft::prusaslicer {
namespace {

constexpr Um farthest = 60'000;  // off the bed: beyond that a coordinate is more likely a slip than a purge bucket
constexpr std::array<std::string_view, 8> custom_keys{"start_gcode", "start_filament_gcode", "before_layer_gcode", "layer_gcode",
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
    if (end != command.data() + command.size() && *end == '\1') return std::nullopt;  // a number that goes on with a placeholder
    return from_mm(v);
  }
  return std::nullopt;
}

struct Found {
  Box box;
  Um excess = 0;
  std::string why;
};

/// Widens `found` by the moves of one piece of custom G-code.
void look_at(std::string_view key, std::string_view text, const Box& bed, Found& found) {
  std::string plain;  // conditions vanish, values become a mark that is no number
  for_each_piece(text, [&](std::string_view piece, bool placeholder) {
    if (!placeholder) plain += piece;
    else if (!piece.starts_with("if ") && !piece.starts_with("elsif ") && piece != "else" && piece != "endif") plain += '\1';
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
    for (const char axis : {'X', 'Y'}) {
      const auto at = coordinate(line, axis);
      if (!at) continue;
      const Um least = axis == 'X' ? bed.min.x : bed.min.y, most = axis == 'X' ? bed.max.x : bed.max.y;
      const Um excess = std::max(least - *at, *at - most);
      if (excess <= 0 || excess > farthest) continue;
      auto& low = axis == 'X' ? found.box.min.x : found.box.min.y;
      auto& high = axis == 'X' ? found.box.max.x : found.box.max.y;
      low = std::min(low, *at), high = std::max(high, *at);
      if (excess > found.excess) {
        found.excess = excess;
        std::string shown(line.substr(0, line.find(';')));
        std::replace(shown.begin(), shown.end(), '\1', '_');
        found.why = fmt::format("{} goes there: {}", key, value::trimmed(shown));
      }
    }
  }
}

}  // namespace

std::optional<CustomReach> reach_of(const Lines& lines) {
  const auto* e = lines.look("bed_shape");
  if (!e) return std::nullopt;
  Ring bed;
  try {
    value::parse(e->value, Unit::mm, bed);
  } catch (const std::invalid_argument&) {
    return std::nullopt;  // told where the bed is read
  }
  if (bed.size() < 3) return std::nullopt;
  const Box box = box_of(bed);
  Found found{box, 0, {}};
  for (const auto key : custom_keys) look_at(key, text_of(lines, key), box, found);
  if (found.excess == 0) return std::nullopt;
  return CustomReach{value::print(Ring{found.box.min, found.box.max}, Unit::mm), found.why};
}

std::string variables_of(const Lines& lines) {
  std::set<std::string_view> own;
  for (const auto& entry : catalogue()) own.insert({entry.key, entry.prusa});
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
          if (const auto bar = name.rfind('_'); bar != std::string_view::npos && bar + 1 < name.size() && name.find_first_not_of("0123456789", bar + 1) == std::string_view::npos)
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
