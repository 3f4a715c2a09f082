// SPDX-License-Identifier: GPL-3.0-or-later
#include "macro/functions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <regex>

#include <fmt/format.h>

namespace weft::macro {
namespace {

constexpr std::size_t any = 1000;
constexpr std::array table{
    Signature{"ceil", 1, 1},     Signature{"digits", 2, 3}, Signature{"empty", 1, 1},
    Signature{"floor", 1, 1},    Signature{"int", 1, 1},    Signature{"interpolate_table", 2, any},
    Signature{"is_nil", 1, 1},   Signature{"max", 2, any},  Signature{"min", 2, any},
    Signature{"one_of", 2, any}, Signature{"random", 2, 2}, Signature{"regex_replace", 3, 3},
    Signature{"repeat", 2, 2},   Signature{"round", 1, 1},  Signature{"size", 1, 1},
    Signature{"zdigits", 2, 3},
};

/// Which numbers a function has whole results for.
std::int64_t whole(double v) {
  if (!(std::abs(v) < 9e18)) throw std::invalid_argument("the number is too large");
  return static_cast<std::int64_t>(v);
}

std::int64_t whole_of(const Scalar& value, std::int64_t least, std::int64_t most) {
  const auto* i = std::get_if<std::int64_t>(&value);
  if (!i || *i < least || *i > most)
    throw std::invalid_argument(fmt::format("'{}' is not a whole number from {} to {}", text_of(value), least, most));
  return *i;
}

const Scalar& single(const Argument& argument) {
  if (argument.regex) throw std::invalid_argument("a /regular expression/ is not a value");
  if (argument.list) throw std::invalid_argument("a list stands where one value is expected");
  return argument.values[0];
}

const std::string& text(const Argument& argument) {
  const auto* s = std::get_if<std::string>(&argument.values[0]);
  if (argument.list || !s) throw std::invalid_argument("a text is expected");
  return *s;
}

Scalar extreme(const std::vector<Argument>& arguments, bool largest) {
  Scalar best = single(arguments[0]);
  for (const auto& a : arguments) {
    const double v = number_of(single(a)), b = number_of(best);
    if (largest ? v > b : v < b) best = single(a);
  }
  return best;
}

std::string digits(const std::vector<Argument>& a, bool zeros) {
  const double v = number_of(single(a[0]));
  const auto width = whole_of(single(a[1]), 0, 64), decimals = a.size() > 2 ? whole_of(single(a[2]), 0, 64) : 0;
  return zeros ? fmt::format("{:0{}.{}f}", v, width, decimals) : fmt::format("{:{}.{}f}", v, width, decimals);
}

/// SplitMix64 (Steele, Lea, Flood 2014).
std::uint64_t next(std::uint64_t& state) {
  std::uint64_t z = state += 0x9e3779b97f4a7c15U;
  z = (z ^ z >> 30U) * 0xbf58476d1ce4e5b9U;
  z = (z ^ z >> 27U) * 0x94d049bb133111ebU;
  return z ^ z >> 31U;
}

Scalar random_of(const Scalar& least, const Scalar& most, std::uint64_t& state) {
  const auto *a = std::get_if<std::int64_t>(&least), *b = std::get_if<std::int64_t>(&most);
  if (number_of(least) > number_of(most)) throw std::invalid_argument("random(least, most): least is more than most");
  const std::uint64_t drawn = next(state);
  if (a && b) {
    const std::uint64_t span = static_cast<std::uint64_t>(*b) - static_cast<std::uint64_t>(*a) + 1;
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(*a) + (span == 0 ? drawn : drawn % span));
  }
  const double share = static_cast<double>(drawn >> 11U) * 0x1p-53;
  return number_of(least) + share * (number_of(most) - number_of(least));
}

/// Between the points in which x lies; before the first and after the last their own value holds.
double interpolated(const std::vector<Argument>& a) {
  const double x = number_of(single(a[0]));
  for (std::size_t i = 1; i < a.size(); ++i) {
    if (!a[i].list || a[i].values.size() != 2)
      throw std::invalid_argument("interpolate_table takes points: interpolate_table(x, (x0, y0), (x1, y1))");
    if (i > 1 && number_of(a[i].values[0]) <= number_of(a[i - 1].values[0]))
      throw std::invalid_argument("the x of interpolate_table's points must rise");
  }
  double x0 = 0, y0 = 0;
  for (std::size_t i = 1; i < a.size(); ++i) {
    const double x1 = number_of(a[i].values[0]), y1 = number_of(a[i].values[1]);
    if (x <= x1) return i == 1 ? y1 : y0 + (y1 - y0) * (x - x0) / (x1 - x0);
    x0 = x1, y0 = y1;
  }
  return y0;
}

/// Longer ones are none that a person writes; the library reads them by recursion.
constexpr std::size_t most_pattern = 1000, most_subject = 100'000;

/// Steps of the automaton for each character of a text, at most: the pattern's length, multiplied by every repetition
/// count in it, as if they were all within each other.
double steps_of(const std::string& pattern) {
  double steps = static_cast<double>(pattern.size());
  for (std::size_t at = pattern.find('{'); at != pattern.npos; at = pattern.find('{', at + 1)) {
    double most = 1;
    for (std::size_t i = at + 1; i < pattern.size() && pattern[i] != '}';) {
      double count = 0;
      for (; i < pattern.size() && pattern[i] >= '0' && pattern[i] <= '9'; ++i) count = 10 * count + (pattern[i] - '0');
      most = std::max(most, count);
      if (i < pattern.size() && pattern[i] != '}') ++i;
    }
    steps *= most;
  }
  return steps;
}

/// @throws std::invalid_argument when a few of these would take seconds
void refuse_slow(double steps) {
  constexpr double most_steps = 1e8;
  if (steps > most_steps) throw std::invalid_argument("the regular expression would take too long on so long a text");
}

[[noreturn]] void refuse(const std::string& pattern) {
  throw std::invalid_argument(fmt::format("/{}/ is not a regular expression that is understood", pattern));
}

std::regex compiled(const std::string& pattern) {
  constexpr std::size_t most_digits = 9;  // the library reads back-references and counts without looking for overflow
  const auto digits_at = [&](std::size_t i) {
    return std::min(pattern.find_first_not_of("0123456789", i), pattern.size()) - i;
  };
  if (pattern.size() > most_pattern)
    throw std::invalid_argument(fmt::format("a regular expression of more than {} characters", most_pattern));
  std::string spelled;
  bool in_class = false;
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    const char c = pattern[i];
    if (c == '\\' && i + 1 < pattern.size()) {
      if (digits_at(i + 1) > most_digits) refuse(pattern);
      spelled += c;
      spelled += pattern[++i];
      continue;
    }
    if (c == '{' && !in_class) {
      const std::size_t least = digits_at(i + 1), comma = i + 1 + least;
      const std::size_t most = comma < pattern.size() && pattern[comma] == ',' ? digits_at(comma + 1) : 0;
      if (std::max(least, most) > most_digits) refuse(pattern);
    }
    if (c == '[') in_class = true;
    if (c == ']') in_class = false;
    if (c == '.' && !in_class)
      spelled += "[\\s\\S]";
    else
      spelled += c;
  }
  auto flags = std::regex::ECMAScript;
#ifdef __GLIBCXX__
  flags |= std::regex_constants::__polynomial;  // no pattern takes exponential time or deep recursion
#endif
  try {
    return std::regex(spelled, flags);
  } catch (const std::regex_error&) {
    refuse(pattern);
  }
}

Scalar one_of(const std::vector<Argument>& a) {
  const std::string& wanted = text(a[0]);
  return std::any_of(a.begin() + 1, a.end(), [&](const Argument& candidate) {
    return candidate.regex ? matches(wanted, text(candidate)) : wanted == text(candidate);
  });
}

}  // namespace

std::span<const Signature> signatures() {
  return table;
}

double number_of(const Scalar& value) {
  if (const auto* i = std::get_if<std::int64_t>(&value)) return static_cast<double>(*i);
  if (const auto* d = std::get_if<double>(&value)) return *d;
  throw std::invalid_argument(std::holds_alternative<Nil>(value) ? "the value is nil"
                                                                 : fmt::format("'{}' is not a number", text_of(value)));
}

bool matches(const std::string& text, const std::string& pattern) {
  if (text.size() > most_subject)
    throw std::invalid_argument(
        fmt::format("a text of more than {} characters for a regular expression", most_subject));
  refuse_slow(steps_of(pattern) * static_cast<double>(text.size()));
  return std::regex_match(text, compiled(pattern));
}

Scalar call(std::string_view name, const std::vector<Argument>& a, std::uint64_t& random) {
  if (name == "min") return extreme(a, false);
  if (name == "max") return extreme(a, true);
  if (name == "round") return whole(std::round(number_of(single(a[0]))));
  if (name == "floor") return whole(std::floor(number_of(single(a[0]))));
  if (name == "ceil") return whole(std::ceil(number_of(single(a[0]))));
  if (name == "int") return whole(number_of(single(a[0])));
  if (name == "digits") return digits(a, false);
  if (name == "zdigits") return digits(a, true);
  if (name == "random") return random_of(single(a[0]), single(a[1]), random);
  if (name == "one_of") return one_of(a);
  if (name == "interpolate_table") return interpolated(a);
  if (name == "regex_replace") {
    if (!a[1].regex) throw std::invalid_argument("regex_replace(text, /pattern/, text)");
    if (text(a[0]).size() > most_subject) throw std::invalid_argument("the text is too long");
    const auto length = static_cast<double>(text(a[0]).size());
    refuse_slow(steps_of(text({a[1].values})) * length * length);  // it may look at the rest from every place
    return std::regex_replace(text(a[0]), compiled(text({a[1].values})), text(a[2]));
  }
  throw std::logic_error("a function without body");
}

}  // namespace weft::macro
