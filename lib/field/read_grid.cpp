// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/error.h"
#include "core/number.h"
#include "field/grid.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include <fmt/format.h>

namespace weft::field {
namespace {

/// Lines and words of a text, with the number of the line.
class Words {
 public:
  Words(std::string_view text, const std::string& path) : rest_(text), path_(path) {}

  [[noreturn]] void refuse(std::string problem, std::string hint = {}) const {
    throw Error{Error::Kind::settings, std::move(problem), fmt::format("{}:{}", path_, line_), std::move(hint)};
  }
  [[noreturn]] void refuse_all(std::string problem, std::string hint = {}) const {
    throw Error{Error::Kind::settings, std::move(problem), path_, std::move(hint)};
  }
  std::string_view line() {
    const std::size_t end = std::min(rest_.size(), rest_.find('\n'));
    std::string_view out = rest_.substr(0, end);
    rest_.remove_prefix(std::min(rest_.size(), end + 1)), ++line_;
    if (!out.empty() && out.back() == '\r') out.remove_suffix(1);
    return out;
  }
  bool done() const { return rest_.empty(); }
  /// Empty at the end.
  std::string_view word() {
    const auto space = [](char c) { return c == ' ' || (c >= '\t' && c <= '\r'); };
    while (!rest_.empty() && space(rest_.front())) {
      if (rest_.front() == '\n') ++line_;
      rest_.remove_prefix(1);
    }
    std::size_t n = 0;
    while (n < rest_.size() && !space(rest_[n])) ++n;
    const std::string_view out = rest_.substr(0, n);
    rest_.remove_prefix(n);
    return out;
  }
  double number() {
    const std::string_view w = word();
    const auto v = as_number<double>(w);
    if (!v) refuse(fmt::format("'{}' is not a number", w));
    return *v;
  }
  std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
  const std::string& path_;
  int line_ = 1;
};

float checked(double v, double most, const Words& words) {
  if (!(v >= 0 && v <= most))
    words.refuse(fmt::format("{} is not within 0 … {}", v, most),
                 most < 2 ? "infill_density_field_unit = percent?" : "infill_density_field_unit = fraction?");
  return static_cast<float>(v / most);
}

std::size_t count_of(const std::array<double, 3>& n, const Words& words) {
  for (const double each : n)
    if (!(each >= 1 && each == std::floor(each))) words.refuse(fmt::format("{} is no number of nodes", each));
  const double all = n[0] * n[1] * n[2];
  if (all > static_cast<double>(most_values))
    words.refuse_all(fmt::format("{:.3g} values, {:.3g} at most", all, static_cast<double>(most_values)));
  return static_cast<std::size_t>(all);
}

double big_endian(std::string_view bytes, bool wide) {
  std::uint64_t v = 0;
  for (const char c : bytes) v = v << 8U | static_cast<std::uint8_t>(c);
  return wide ? std::bit_cast<double>(v) : static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(v)));
}

/// The numbers behind the head of a VTK file.
void take_values(Words& words, const std::array<double, 3>& size, bool binary, bool wide, double most, Grid& out) {
  const std::size_t count = count_of(size, words);
  out.columns = static_cast<std::size_t>(size[0]), out.rows = static_cast<std::size_t>(size[1]),
  out.slices = static_cast<std::size_t>(size[2]);
  const auto too_few = [&](std::size_t found) {
    words.refuse_all(fmt::format("{} values, {} ({} × {} × {}) expected", found, count, size[0], size[1], size[2]));
  };
  if (binary) {
    const std::size_t each = wide ? 8 : 4;
    std::string_view data = words.rest();
    if (!data.empty()) data.remove_prefix(1);
    if (data.size() < count * each) too_few(data.size() / each);
    out.values.reserve(count);
    for (std::size_t i = 0; i < count; ++i)
      out.values.push_back(checked(big_endian(data.substr(i * each, each), wide), most, words));
    return;
  }
  if (words.rest().size() < 2 * count - 1) too_few(static_cast<std::size_t>(words.rest().size() / 2));
  out.values.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    Words before = words;
    if (before.word().empty()) too_few(i);
    const double v = words.number();
    out.values.push_back(checked(v, most, words));
  }
}

Grid read_vtk(std::string_view bytes, const std::string& path, double most) {
  Words words(bytes, path);
  words.line(), words.line();
  const std::string_view coding = words.word();
  if (coding != "ASCII" && coding != "BINARY") words.refuse(fmt::format("'{}' is neither ASCII nor BINARY", coding));
  Grid out;
  std::array<double, 3> size{}, from{0, 0, 0}, step{1, 1, 1};
  bool wide = false;
  for (;;) {
    const std::string_view word = words.word();
    if (word.empty()) words.refuse_all("has no SCALARS");
    const auto three = [&](std::array<double, 3>& to) {
      for (double& each : to) each = words.number();
    };
    if (word == "DATASET") {
      const std::string_view kind = words.word();
      if (kind != "STRUCTURED_POINTS")
        words.refuse(fmt::format("{} is no regular grid", kind), "resample it to STRUCTURED_POINTS");
    } else if (word == "DIMENSIONS") {
      three(size);
    } else if (word == "ORIGIN") {
      three(from);
    } else if (word == "SPACING" || word == "ASPECT_RATIO") {
      three(step);
      for (const double each : step)
        if (!(each > 0 && std::isfinite(each))) words.refuse(fmt::format("a spacing of {} mm", each));
    } else if (word == "SCALARS") {
      words.word();
      const std::string_view type = words.word();
      wide = type == "double";
      if (coding == "BINARY" && type != "double" && type != "float")
        words.refuse(fmt::format("binary values of type {}", type), "write them as float, double or ASCII");
    } else if (word == "LOOKUP_TABLE") {
      words.word();
      break;
    }
  }
  take_values(words, size, coding == "BINARY", wide, most, out);
  out.x0 = from[0], out.y0 = from[1], out.z0 = from[2], out.dx = step[0], out.dy = step[1], out.dz = step[2];
  return out;
}

/// The places along an axis, and their distance; one place is a distance of 1.
struct Axis {
  double from = 0, step = 1;
  std::size_t count = 1;
};
Axis axis_of(std::vector<double> places) {
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  Axis out{places.front(), 1, 1};
  if (places.size() < 2) return out;
  out.step = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < places.size(); ++i) out.step = std::min(out.step, places[i] - places[i - 1]);
  out.count = static_cast<std::size_t>(std::min(1e9, std::round((places.back() - places.front()) / out.step))) + 1;
  return out;
}

struct Row {
  std::array<double, 3> at{};
  float value = 0;
  int line = 0;
};

/// Up to four numbers between commas or semicolons.
struct Figures {
  std::array<double, 4> v{};
  std::size_t found = 0;
  bool numbers = true;  ///< all of them are
};
Figures figures_of(std::string_view text) {
  Figures out;
  while (!text.empty() && out.found < 4) {
    const std::size_t end = std::min(text.size(), text.find_first_of(",;"));
    std::string_view part = text.substr(0, end);
    while (!part.empty() && (part.front() == ' ' || part.front() == '\t')) part.remove_prefix(1);
    while (!part.empty() && (part.back() == ' ' || part.back() == '\t')) part.remove_suffix(1);
    const auto number = as_number<double>(part);
    out.v[out.found] = number.value_or(0);
    out.numbers = out.numbers && number;
    text.remove_prefix(std::min(text.size(), end + 1)), ++out.found;
  }
  return out;
}

std::vector<Row> rows_of(Words& words, double most) {
  std::vector<Row> rows;
  for (int line = 1; !words.done(); ++line) {
    const Words here = words;
    const auto [v, found, numbers] = figures_of(words.line());
    if (found == 0) continue;
    if (!numbers && line == 1) continue;  // names of the columns
    if (!numbers || found < 4) here.refuse("is not x, y, z, density");
    for (std::size_t i = 0; i < 3; ++i)
      if (!std::isfinite(v[i])) here.refuse(fmt::format("a place at {}", v[i]));
    rows.push_back({{v[0], v[1], v[2]}, checked(v[3], most, here), line});
    if (rows.size() > most_values)
      here.refuse_all(fmt::format("more than {:.3g} values", static_cast<double>(most_values)));
  }
  return rows;
}

Grid read_csv(std::string_view bytes, const std::string& path, double most) {
  Words words(bytes, path);
  const std::vector<Row> rows = rows_of(words, most);
  if (rows.empty()) words.refuse_all("holds no x, y, z, density");
  std::array<Axis, 3> axes;
  for (std::size_t i = 0; i < 3; ++i) {
    std::vector<double> places;
    for (const Row& row : rows) places.push_back(row.at[i]);
    axes[i] = axis_of(std::move(places));
  }
  constexpr double off = 0.01;  // of the distance of places
  constexpr std::string_view names = "xyz";
  for (const Row& row : rows)
    for (std::size_t i = 0; i < 3; ++i) {
      const double t = (row.at[i] - axes[i].from) / axes[i].step;
      if (std::abs(t - std::round(t)) > off)
        throw Error{Error::Kind::settings,
                    fmt::format("{} = {} is off the lattice of {:.6g} mm", names[i], row.at[i], axes[i].step),
                    fmt::format("{}:{}", path, row.line)};
    }
  const std::size_t count = count_of(
      {static_cast<double>(axes[0].count), static_cast<double>(axes[1].count), static_cast<double>(axes[2].count)},
      words);
  if (count != rows.size())
    words.refuse_all(fmt::format("{} values, {} ({} × {} × {}) expected", rows.size(), count, axes[0].count,
                                 axes[1].count, axes[2].count));
  Grid out;
  out.columns = axes[0].count, out.rows = axes[1].count, out.slices = axes[2].count;
  out.x0 = axes[0].from, out.y0 = axes[1].from, out.z0 = axes[2].from;
  out.dx = axes[0].step, out.dy = axes[1].step, out.dz = axes[2].step;
  out.values.resize(count);
  std::vector<bool> given(count, false);
  for (const Row& row : rows) {
    const auto place = [&](std::size_t i) {
      return static_cast<std::size_t>(std::lround((row.at[i] - axes[i].from) / axes[i].step));
    };
    const std::size_t n = (place(2) * out.rows + place(1)) * out.columns + place(0);
    if (given[n])
      throw Error{Error::Kind::settings, "gives a place that was given before", fmt::format("{}:{}", path, row.line)};
    given[n] = true, out.values[n] = row.value;
  }
  return out;
}

}  // namespace

Grid read_grid(std::string_view bytes, const std::string& path, double most) {
  if (bytes.starts_with("# vtk DataFile")) return read_vtk(bytes, path, most);
  if (path.ends_with(".csv") || path.ends_with(".CSV")) return read_csv(bytes, path, most);
  throw Error{Error::Kind::settings, "is neither a legacy VTK file nor a CSV", path,
              "write STRUCTURED_POINTS, or x, y, z, density"};
}

}  // namespace weft::field
