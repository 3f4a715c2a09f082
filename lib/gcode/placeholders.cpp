#include "gcode/placeholders.h"

#include "core/error.h"
#include "settings/catalogue.h"
#include "settings/value.h"

#include <algorithm>
#include <charconv>
#include <optional>

#include <fmt/format.h>

namespace weft::gcode {
namespace {

bool is_control(char c) {
  return static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
}
bool starts_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool in_name(char c) {
  return starts_name(c) || (c >= '0' && c <= '9');
}

std::string one_line(std::string text) {
  std::replace_if(text.begin(), text.end(), is_control, '_');
  return text;
}

struct Place {
  std::string_view setting, text;
  std::size_t at;
  [[noreturn]] void refuse(std::string what, std::string hint) const {
    const auto before = text.substr(0, at);
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const auto last = before.rfind('\n');
    const auto column = last == std::string_view::npos ? at + 1 : at - last;
    throw Error{Error::Kind::settings, std::move(what), fmt::format("{}:{}:{}", setting, line, column),
                std::move(hint)};
  }
};

std::string nearest(std::string_view name) {
  const auto near = nearest_setting(name);
  return near.empty() ? "`weft settings` lists the names of settings" : fmt::format("did you mean '{}'?", near);
}

/// The value of `name` or `name[index]`.
std::string value_of(const Place& place, const Variables& variables, std::string_view name,
                     std::optional<std::size_t> index) {
  const auto found = variables.find(name);
  if (found == variables.end()) place.refuse(fmt::format("unknown placeholder '{}'", name), nearest(name));
  const auto& values = found->second;
  if (values.empty())
    place.refuse(fmt::format("'{}' is auto: it has no value to write", name), "give the setting a value");
  if (!index) return fmt::format("{}", fmt::join(values, ","));
  if (values.size() == 1) return values[0];  // one extruder: every index names it, as in PrusaSlicer
  if (*index >= values.size())
    place.refuse(fmt::format("'{}' has {} values, there is no [{}]", name, values.size(), *index), "count from 0");
  return values[*index];
}

std::optional<std::size_t> number(std::string_view text) {
  std::size_t v = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), v);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return v;
}

/// `name` or `name[index]`; nothing when it is neither.
struct Reference {
  std::string_view name;
  std::optional<std::size_t> index;
};
std::optional<Reference> parse_reference(std::string_view body) {
  body = value::trimmed(body);
  std::size_t n = 0;
  while (n < body.size() && in_name(body[n])) ++n;
  if (n == 0 || !starts_name(body[0])) return std::nullopt;
  const auto name = body.substr(0, n);
  auto rest = value::trimmed(body.substr(n));
  if (rest.empty()) return Reference{name, {}};
  if (rest.size() < 3 || rest.front() != '[' || rest.back() != ']') return std::nullopt;
  const auto index = number(value::trimmed(rest.substr(1, rest.size() - 2)));
  if (!index) return std::nullopt;
  return Reference{name, index};
}

/// `[name]`, or `[name_0]` for one of several.
Reference parse_legacy(const Variables& variables, std::string_view name) {
  const auto tail = name.rfind('_');
  if (variables.find(name) == variables.end() && tail != std::string_view::npos &&
      variables.find(name.substr(0, tail)) != variables.end())
    if (const auto index = number(name.substr(tail + 1))) return {name.substr(0, tail), index};
  return {name, {}};
}

}  // namespace

std::string escaped_name(std::string_view name) {
  std::string out(name);
  for (char& c : out)
    if (is_control(c) || std::string_view(";\"'\\{}[]*").find(c) != std::string_view::npos) c = '_';
  return out;
}

Variables variables_of(const Settings& settings) {
  Variables out;
  for (const auto& entry : catalogue()) {
    std::string text = entry.print(settings);
    std::vector<std::string> values;
    if (!entry.automatic || text != "auto") {
      if (entry.type == "number" && entry.unit == symbol_of(Unit::percent) && !text.empty() && text.back() == '%')
        text.pop_back();
      values.push_back(one_line(std::move(text)));
    }
    out[std::string(entry.key)] = values;
    if (!entry.prusa.empty()) out.emplace(std::string(entry.prusa), std::move(values));
  }
  const auto set = [&](const char* key, const char* prusa, std::string text) {
    out[key] = out[prusa] = {std::move(text)};
  };
  const auto& m = settings.material;
  set("material_print_temperature_layer_0", "first_layer_temperature",
      fmt::format("{}", m.material_print_temperature_layer_0.value_or(m.material_print_temperature)));
  set("material_bed_temperature_layer_0", "first_layer_bed_temperature",
      fmt::format("{}", m.material_bed_temperature_layer_0.value_or(m.material_bed_temperature)));
  set("initial_layer_height", "first_layer_height",
      value::print(settings.layers.initial_layer_height.value_or(settings.layers.layer_height), Unit::mm));
  out["extrusion_multiplier"] = {value::number(m.material_flow / 100.0)};
  return out;
}

Expansion expand(std::string_view text, const Variables& variables, std::string_view setting) {
  Expansion out;
  for (std::size_t i = 0; i < text.size();) {
    const Place place{setting, text, i};
    Reference reference;
    std::size_t end = 0;
    if (text[i] == '{') {
      end = text.find_first_of("}\n", i);
      if (end == std::string_view::npos || text[end] == '\n')
        place.refuse("'{' without '}'", "close the placeholder on the same line");
      const auto body = text.substr(i + 1, end - i - 1);
      const auto parsed = parse_reference(body);
      if (!parsed)
        place.refuse(fmt::format("'{{{}}}' is not a name; expressions are not supported", body),
                     "write {name}, {name[0]} or [name]");
      reference = *parsed;
    } else if (text[i] == '[' && i + 1 < text.size() && starts_name(text[i + 1])) {
      for (end = i + 1; end < text.size() && in_name(text[end]);) ++end;
      if (end == text.size() || text[end] != ']') end = 0;  // not a placeholder
      if (end != 0) reference = parse_legacy(variables, text.substr(i + 1, end - i - 1));
    }
    if (end == 0) {
      out.text += text[i++];
      continue;
    }
    out.text += value_of(place, variables, reference.name, reference.index);
    out.used.emplace_back(reference.name);
    i = end + 1;
  }
  return out;
}

}  // namespace weft::gcode
