// SPDX-License-Identifier: GPL-3.0-or-later
#include "settings/catalogue.h"

#include "core/error.h"
#include "settings/near.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace weft {
namespace {

template <class T>
struct OptionalOf : std::false_type {
  using type = T;
};
template <class T>
struct OptionalOf<std::optional<T>> : std::true_type {
  using type = T;
};

template <class T>
std::vector<std::string_view> choice_names() {
  std::vector<std::string_view> names;
  if constexpr (std::is_enum_v<T>) {
    static_assert(
        [] {
          constexpr auto choices = choices_of(T{});
          for (std::size_t i = 0; i < choices.size(); ++i)
            if (choices[i].value != static_cast<T>(i)) return false;
          return true;
        }(),
        "row i of choices_of is value i");
    for (const auto& choice : choices_of(T{})) names.push_back(choice.name);
  }
  return names;
}

template <class T>
std::string print_value(const T& v, Unit unit) {
  if constexpr (OptionalOf<T>::value)
    return v ? print_value(*v, unit) : "auto";
  else if constexpr (std::is_enum_v<T>)
    return std::string(choices_of(T{})[static_cast<std::size_t>(v)].name);
  else
    return value::print(v, unit);
}

template <class T>
T parse_value(std::string_view text, Unit unit) {
  if constexpr (OptionalOf<T>::value) {
    if (value::trimmed(text) == "auto") return std::nullopt;
    return parse_value<typename OptionalOf<T>::type>(text, unit);
  } else if constexpr (std::is_enum_v<T>) {
    return static_cast<T>(value::parse_choice(text, choice_names<T>()));
  } else {
    T out{};
    value::parse(text, unit, out);
    return out;
  }
}

template <class T>
std::string_view type_name(Unit unit) {
  if constexpr (OptionalOf<T>::value)
    return type_name<typename OptionalOf<T>::type>(unit);
  else if constexpr (std::is_enum_v<T>)
    return "choice";
  else if constexpr (std::is_same_v<T, bool>)
    return "flag";
  else if constexpr (std::is_same_v<T, Um>)
    return unit == Unit::mm ? "length" : "integer";
  else if constexpr (std::is_same_v<T, double>)
    return "number";
  else if constexpr (std::is_same_v<T, std::string>)
    return "text";
  else if constexpr (std::is_same_v<T, LengthOrShare>)
    return "length or %";
  else if constexpr (std::is_same_v<T, SpeedOrShare>)
    return "speed or %";
  else if constexpr (std::is_same_v<T, Ring>)
    return "points";
  else if constexpr (std::is_same_v<T, PictureSizes>)
    return "sizes";
  else if constexpr (std::is_same_v<T, Numbers>)
    return "numbers";
  else if constexpr (std::is_same_v<T, ValuesAt>)
    return "steps";
  else if constexpr (std::is_same_v<T, TransferCurve>)
    return "curve";
  else if constexpr (std::is_same_v<T, Rgb>)
    return "colour";
  else if constexpr (std::is_same_v<T, HeightMarks>)
    return "heights";
  else if constexpr (std::is_same_v<T, HeightBands>)
    return "ranges";
  else if constexpr (std::is_same_v<T, PressureRows>)
    return "rows";
  else if constexpr (std::is_same_v<T, ToolValues>)
    return "settings of tools";
  else
    return "polygons";
}

/// The unit to print a number with where its symbol is written behind it anyway: `%` would stand there twice.
constexpr Unit bare(Unit unit) {
  return unit == Unit::percent ? Unit::none : unit;
}

/// Throws unless `v` lies in the row's range. Of a share only the sign is known here, not its base.
template <class T, class Bound>
void check_range(const T& v, const Bound& least, const Bound& most, Unit unit) {
  if constexpr (OptionalOf<T>::value) {
    if (v) check_range(*v, least, most, unit);
  } else if constexpr (std::is_same_v<T, LengthOrShare>) {
    if (!v.is_share) return check_range(v.length, least, most, unit);
    if (least >= 0 && (v.percent < 0 || (least > 0 && v.percent == 0)))
      throw std::invalid_argument(
          fmt::format("{} % is not {}", print_value(v.percent, Unit::none), least > 0 ? "above 0" : "0 or more"));
  } else if constexpr (std::is_same_v<T, SpeedOrShare>) {
    if (!v.is_share) check_range(v.value, least, most, unit);
  } else if constexpr (std::is_same_v<T, Numbers>) {
    for (const double each : v) check_range(each, least, most, unit);
  } else if constexpr (std::is_same_v<T, ValuesAt>) {
    for (const ValueAt& each : v)
      check_range(each.at, least, most, Unit::mm), check_range(each.value, 0.0, 100.0, Unit::percent);
  } else if (v < least || v > most) {
    throw std::invalid_argument(fmt::format(
        "{}{}{} is outside {} … {}{}{}", print_value(v, bare(unit)), unit == Unit::none ? "" : " ", symbol_of(unit),
        print_value(least, bare(unit)), print_value(most, bare(unit)), unit == Unit::none ? "" : " ", symbol_of(unit)));
  }
}

const Settings defaults{};

/// Adds the entry of a row: in place, because compilers take minutes over three hundred temporary ones.
template <class S, class Row>
void add_entry(std::vector<CatalogueEntry>& to, const S& section, const Row& row) {
  using T = typename Row::field_type;
  constexpr bool ranged = !std::is_same_v<decltype(row.least), detail::NoBound>;
  CatalogueEntry& e = to.emplace_back();
  e.section = section.name;
  e.key = row.key;
  e.scope = row.scope;
  e.type = type_name<T>(row.unit);
  e.unit = symbol_of(row.unit);
  e.meaning = row.meaning;
  e.automatic = OptionalOf<T>::value;
  e.choices = choice_names<typename OptionalOf<T>::type>();
  if constexpr (ranged) {
    e.least = print_value(row.least, bare(row.unit));
    e.most = print_value(row.most, bare(row.unit));
  }
  const auto group = section.group;
  const auto field = row.field;
  const Unit unit = row.unit;
  e.print = [=](const Settings& s) { return print_value((s.*group).*field, unit); };
  const auto least = row.least, most = row.most;
  e.read = [=](std::string_view text) {
    T v = parse_value<T>(text, unit);
    if constexpr (ranged) check_range(v, least, most, unit);
    return std::any(std::move(v));
  };
  e.lay = [=](Settings& s, const std::any& v) { (s.*group).*field = std::any_cast<const T&>(v); };
  e.default_text = print_value((defaults.*group).*field, unit);
}

std::vector<CatalogueEntry> every_entry() {
  std::vector<CatalogueEntry> out;
  auto add_section = [&](const auto& section) {
    section.rows.for_each([&](const auto& row) { add_entry(out, section, row); });
  };
  sections.for_each(add_section);
  return out;
}

std::string underscored(std::string_view key) {
  std::string out(key);
  std::replace(out.begin(), out.end(), '-', '_');
  return out;
}

}  // namespace

const std::vector<CatalogueEntry>& catalogue() {
  static const std::vector<CatalogueEntry> entries = every_entry();
  return entries;
}

const CatalogueEntry* find_setting(std::string_view key) {
  static const std::vector<std::pair<std::string_view, const CatalogueEntry*>> by_key = [] {
    std::vector<std::pair<std::string_view, const CatalogueEntry*>> out;
    for (const auto& e : catalogue()) out.emplace_back(e.key, &e);
    std::sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    return out;
  }();
  const std::string wanted = underscored(key);
  const auto at = std::lower_bound(by_key.begin(), by_key.end(), std::string_view(wanted),
                                   [](const auto& a, std::string_view k) { return a.first < k; });
  return at != by_key.end() && at->first == wanted ? at->second : nullptr;
}

namespace {

std::string range_of(const CatalogueEntry& entry) {
  if (entry.least.empty()) return entry.default_text.empty() ? "" : fmt::format("default: {}", entry.default_text);
  return fmt::format("range {} … {}{}{}, default {}{}", entry.least, entry.most, entry.unit.empty() ? "" : " ",
                     entry.unit, entry.default_text, entry.automatic ? ", or auto" : "");
}

}  // namespace

std::any read_value(const CatalogueEntry& entry, const std::string& text, const std::string& where) {
  try {
    return entry.read(text);
  } catch (const std::invalid_argument& problem) {
    throw Error{Error::Kind::settings, fmt::format("{}: {}", entry.key, problem.what()), where, range_of(entry)};
  }
}

std::string_view nearest_setting(std::string_view wrong, std::string_view (*also_called)(std::string_view)) {
  constexpr std::size_t longest = 100;  // of what may be a word; a distance takes as many steps as a name has letters
  if (wrong.size() > longest) return {};
  const std::string wanted = underscored(wrong);
  std::string_view best;
  std::size_t least = wanted.size() / 2 + 1;  // more than half of it wrong is no likeness
  for (const auto& e : catalogue())
    for (const auto name : {e.key, also_called(e.key)})
      if (!name.empty())
        if (const auto d = edit_distance(wanted, name); d < least) least = d, best = e.key;
  for (const std::string_view on : {"_enable", "_enabled"})  // "support", "ironing"
    if (const auto* e = best.empty() ? find_setting(wanted + std::string(on)) : nullptr) best = e->key;
  return best;
}

std::string as_text(const Settings& settings, std::string_view section) {
  std::string out;
  for (const auto& e : catalogue())
    if (section.empty() || e.section == section) out += fmt::format("{} = {}\n", e.key, e.print(settings));
  return out;
}

}  // namespace weft
