// SPDX-License-Identifier: GPL-3.0-or-later
#include "field/grid.h"
#include "field/lattice.h"

#include <cmath>

namespace weft::field {
namespace {

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
  std::vector<double> steps;
  for (std::size_t i = 1; i < places.size(); ++i) steps.push_back(places[i] - places[i - 1]);
  // what most of them keep: by a place that is off all others would be
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  out.step = *middle;
  out.count = static_cast<std::size_t>(std::min(1e9, std::round((places.back() - places.front()) / out.step))) + 1;
  return out;
}

constexpr std::size_t most_figures = 9;

struct Row {
  std::array<double, most_figures> v{};
  int line = 0;
};

/// Numbers between commas or semicolons.
struct Figures {
  std::array<double, most_figures> v{};
  std::size_t found = 0;
  bool numbers = true;  ///< all of them are
};
Figures figures_of(std::string_view text) {
  Figures out;
  while (!text.empty() && out.found < most_figures) {
    const std::size_t end = std::min(text.size(), text.find_first_of(",;"));
    std::string_view part = text.substr(0, end);
    while (!part.empty() && (part.front() == ' ' || part.front() == '\t')) part.remove_prefix(1);
    while (!part.empty() && (part.back() == ' ' || part.back() == '\t')) part.remove_suffix(1);
    const auto [stop, error] = std::from_chars(part.data(), part.data() + part.size(), out.v[out.found]);
    out.numbers = out.numbers && error == std::errc{} && stop == part.data() + part.size();
    text.remove_prefix(std::min(text.size(), end + 1)), ++out.found;
  }
  return out;
}

/// The columns of a kind: behind the place, a density, or a tensor's six numbers.
struct Columns {
  std::size_t count;
  const char* names;
};
Columns columns_of(Kind kind) {
  return kind == Kind::density ? Columns{4, "x, y, z, density"} : Columns{9, "x, y, z, sxx, syy, szz, sxy, syz, szx"};
}

std::vector<Row> rows_of(Words& words, Kind kind) {
  const Columns columns = columns_of(kind);
  std::vector<Row> rows;
  for (int line = 1; !words.done(); ++line) {
    const Words here = words;
    const auto [v, found, numbers] = figures_of(words.line());
    if (found == 0) continue;
    if (!numbers && line == 1) continue;  // names of the columns
    if (!numbers || found < columns.count) here.refuse(fmt::format("is not {}", columns.names));
    for (std::size_t i = 0; i < 3; ++i)
      if (!std::isfinite(v[i])) here.refuse(fmt::format("a place at {}", v[i]));
    rows.push_back({v, line});
    if (rows.size() > most_values) here.refuse_all(fmt::format("more than {} values", round_number(most_values)));
  }
  if (rows.empty()) words.refuse_all(fmt::format("holds no {}", columns.names));
  return rows;
}

void refuse_off_lattice(const std::vector<Row>& rows, const std::array<Axis, 3>& axes, const std::string& path) {
  constexpr double off = 0.01;  // of the distance of places
  constexpr std::string_view names = "xyz";
  for (const Row& row : rows)
    for (std::size_t i = 0; i < 3; ++i) {
      const double t = (row.v[i] - axes[i].from) / axes[i].step;
      if (std::abs(t - std::round(t)) > off)
        throw Error{Error::Kind::settings,
                    fmt::format("{} = {} is off the lattice of {:.6g} mm", names[i], row.v[i], axes[i].step),
                    fmt::format("{}:{}", path, row.line)};
    }
}

}  // namespace

Lattice read_csv(std::string_view bytes, const std::string& path, Kind kind) {
  Words words(bytes, path);
  const std::vector<Row> rows = rows_of(words, kind);
  std::array<Axis, 3> axes;
  for (std::size_t i = 0; i < 3; ++i) {
    std::vector<double> places;
    for (const Row& row : rows) places.push_back(row.v[i]);
    axes[i] = axis_of(std::move(places));
  }
  refuse_off_lattice(rows, axes, path);
  Lattice out;
  for (std::size_t i = 0; i < 3; ++i)
    out.size[i] = static_cast<double>(axes[i].count), out.from[i] = axes[i].from, out.step[i] = axes[i].step;
  check_size(out, words);
  const std::size_t count = out.count();
  if (count != rows.size()) words.refuse_all(out.expected(rows.size()));
  out.components = columns_of(kind).count - 3;
  out.values.resize(count * out.components), out.lines.assign(count, 0);
  for (const Row& row : rows) {
    const auto place = [&](std::size_t i) {
      return static_cast<std::size_t>(std::lround((row.v[i] - axes[i].from) / axes[i].step));
    };
    const std::size_t n = (place(2) * axes[1].count + place(1)) * axes[0].count + place(0);
    if (out.lines[n] != 0)
      throw Error{Error::Kind::settings, fmt::format("gives a place that line {} gave before", out.lines[n]),
                  fmt::format("{}:{}", path, row.line)};
    out.lines[n] = row.line;
    for (std::size_t c = 0; c < out.components; ++c)
      out.values[n * out.components + c] = static_cast<float>(row.v[3 + c]);
  }
  return out;
}

}  // namespace weft::field
