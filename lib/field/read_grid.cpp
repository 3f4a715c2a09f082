// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/error.h"
#include "field/grid.h"
#include "field/lattice.h"

#include <cmath>

#include <fmt/format.h>

namespace weft::field {
namespace {

Grid empty_grid(const Lattice& lattice) {
  Grid out;
  out.columns = static_cast<std::size_t>(lattice.size[0]), out.rows = static_cast<std::size_t>(lattice.size[1]),
  out.slices = static_cast<std::size_t>(lattice.size[2]);
  out.x0 = lattice.from[0], out.y0 = lattice.from[1], out.z0 = lattice.from[2];
  out.dx = lattice.step[0], out.dy = lattice.step[1], out.dz = lattice.step[2];
  out.values.reserve(lattice.count());
  return out;
}

std::string place_of(const Lattice& lattice, std::size_t node, const std::string& path) {
  return lattice.lines.empty() ? path : fmt::format("{}:{}", path, lattice.lines[node]);
}

[[noreturn]] void refuse_value(const Lattice& lattice, std::size_t node, const std::string& path, std::string what,
                               std::string hint = {}) {
  if (lattice.lines.empty()) what = fmt::format("value {}: {}", node + 1, what);
  throw Error{Error::Kind::settings, std::move(what), place_of(lattice, node, path), std::move(hint)};
}

bool ends_with(const std::string& path, std::string_view ending) {
  if (path.size() < ending.size()) return false;
  return std::equal(ending.rbegin(), ending.rend(), path.rbegin(),
                    [](char a, char b) { return a == (b >= 'A' && b <= 'Z' ? b - 'A' + 'a' : b); });
}

Lattice read_lattice(std::string_view bytes, const std::string& path, Kind kind) {
  if (bytes.starts_with("# vtk DataFile")) return read_vtk(bytes, path, kind);
  if (bytes.substr(0, 512).find("<VTKFile") != std::string_view::npos) return read_vti(bytes, path, kind);
  if (ends_with(path, ".csv")) return read_csv(bytes, path, kind);
  throw Error{Error::Kind::settings, "is neither a legacy VTK file, nor a .vti, nor a CSV", path,
              "write STRUCTURED_POINTS, ImageData, or lines of numbers"};
}

/// A vector's or a tensor's three numbers in the plane; a vector is the tensor that stretches along it.
std::array<double, 3> in_plane(const Lattice& lattice, std::size_t node, const std::string& path) {
  const float* v = &lattice.values[node * lattice.components];
  const auto at = [&](std::size_t i) { return static_cast<double>(v[i]); };
  for (std::size_t i = 0; i < lattice.components; ++i)
    if (!std::isfinite(at(i))) refuse_value(lattice, node, path, fmt::format("{} is no number", at(i)));
  if (lattice.components == 3) return {at(0) * at(0), at(1) * at(1), at(0) * at(1)};
  if (lattice.components == 6) return {at(0), at(1), at(3)};
  constexpr double unlike = 1e-3;  // of the greater of the two, or of one
  const double size = std::max({std::abs(at(1)), std::abs(at(3)), 1e-30});
  if (std::abs(at(1) - at(3)) > unlike * size)
    throw Error{Error::Kind::settings, fmt::format("value {}: sxy {:.6g} but syx {:.6g}", node + 1, at(1), at(3)), path,
                "a stress is symmetric"};
  return {at(0), at(4), at(1)};
}

}  // namespace

std::string round_number(double v) {
  std::string out = fmt::format("{:.3g}", v);
  for (const std::string_view needless : {"+0", "+"})
    if (const auto at = out.find(needless); at != std::string::npos) out.erase(at, needless.size());
  return out;
}

std::string Lattice::expected(std::size_t found) const {
  return fmt::format("{} values, {} ({} × {} × {}) expected", found, count(), size[0], size[1], size[2]);
}

void check_size(const Lattice& lattice, const Words& words) {
  for (const double each : lattice.size)
    if (!(each >= 1 && each == std::floor(each))) words.refuse(fmt::format("{} is no number of nodes", each));
  const double all = lattice.size[0] * lattice.size[1] * lattice.size[2];
  if (all > static_cast<double>(most_values))
    words.refuse_all(fmt::format("{} values, {} at most", round_number(all), round_number(most_values)));
}

Grid read_grid(std::string_view bytes, const std::string& path, double most) {
  const Lattice lattice = read_lattice(bytes, path, Kind::density);
  Grid out = empty_grid(lattice);
  for (std::size_t i = 0; i < lattice.count(); ++i) {
    const auto v = static_cast<double>(lattice.values[i]);
    if (!(v >= 0 && v <= most))
      refuse_value(lattice, i, path, fmt::format("{:.6g} is not within 0 … {}", v, most),
                   most < 2 ? "infill_density_field_unit = percent?" : "infill_density_field_unit = fraction?");
    out.values.push_back(static_cast<float>(v / most));
  }
  return out;
}

TensorGrid read_tensors(std::string_view bytes, const std::string& path) {
  const Lattice lattice = read_lattice(bytes, path, Kind::direction);
  TensorGrid out;
  out.xx = out.yy = out.xy = empty_grid(lattice);
  for (std::size_t i = 0; i < lattice.count(); ++i) {
    const auto [xx, yy, xy] = in_plane(lattice, i, path);
    out.xx.values.push_back(static_cast<float>(xx)), out.yy.values.push_back(static_cast<float>(yy));
    out.xy.values.push_back(static_cast<float>(xy));
  }
  return out;
}

}  // namespace weft::field
