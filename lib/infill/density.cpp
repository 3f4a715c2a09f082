// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/density.h"

#include "core/error.h"
#include "core/file_bytes.h"
#include "core/hash.h"
#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/offset.h"
#include "infill/level_set.h"
#include "infill/mask.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <system_error>

#include <fmt/format.h>

namespace weft::infill {
namespace {

constexpr double finest = 500;  // µm, of cells that distances are known on
constexpr double most_cells = 4e6;
constexpr Um step = 1000;              // between places that a layer's density is looked at
constexpr double longest_even = 1000;  // µm of a line along which its width stays

/// The least sum of a parabola's height and its foot, for each place of a row.
/// Source: Felzenszwalb & Huttenlocher 2012, "Distance transforms of sampled functions".
void lower_envelope(const std::vector<double>& f, std::vector<double>& out) {
  const std::size_t n = f.size();
  std::vector<std::size_t> foot(n);
  std::vector<double> from(n + 1);
  std::size_t k = 0;
  constexpr double far = std::numeric_limits<double>::infinity();
  const auto meet = [&](std::size_t p, std::size_t q) {
    const auto a = static_cast<double>(p), b = static_cast<double>(q);
    return ((f[q] + b * b) - (f[p] + a * a)) / (2 * (b - a));
  };
  from[0] = -far, from[1] = far;
  for (std::size_t q = 1; q < n; ++q) {
    double s = meet(foot[k], q);
    while (k > 0 && s <= from[k]) s = meet(foot[--k], q);
    if (s <= from[k]) s = from[k];
    foot[++k] = q, from[k] = s, from[k + 1] = far;
  }
  k = 0;
  for (std::size_t q = 0; q < n; ++q) {
    while (from[k + 1] < static_cast<double>(q)) ++k;
    const double d = static_cast<double>(q) - static_cast<double>(foot[k]);
    out[q] = d * d + f[foot[k]];
  }
}

}  // namespace

bool Density::varies(const InfillSettings& infill) {
  return !infill.infill_density_by_distance.empty() || !infill.infill_density_by_height.empty() ||
         infill.gradual_infill_steps > 0 || !infill.infill_density_image.empty() ||
         !infill.infill_density_field.empty();
}

double Density::value_of(const ValuesAt& curve, double at) {
  if (at < curve.front().at) return curve.front().value;
  for (std::size_t i = 1; i < curve.size(); ++i)
    if (at < curve[i].at)
      return std::lerp(curve[i - 1].value, curve[i].value, (at - curve[i - 1].at) / (curve[i].at - curve[i - 1].at));
  return curve.back().value;
}

Density::Density(const InfillSettings& infill, const ShellObject& object, const std::vector<LayerAreas>& areas,
                 Point on_bed)
    : infill_(infill), on_bed_(on_bed) {
  if (object.layers.empty() || object.box.empty()) return;
  read_files(object);
  if (!infill.infill_density_by_distance.empty()) find_distance(object);
  if (infill.gradual_infill_steps > 0) find_depth(object, areas);
}

namespace {
/// @throws Error{settings} when it is not there
FileBytes read_file(const std::string& path, std::string_view key) {
  std::error_code problem;
  if (!std::filesystem::exists(path, problem))
    throw Error{Error::Kind::settings, fmt::format("'{}' is not there", path), std::string(key),
                "the path is relative to where weft is started"};
  return FileBytes(path);
}
}  // namespace

std::string Density::files_of(const InfillSettings& infill) {
  std::string out;
  if (!infill.infill_density_image.empty())
    out += sha256(read_file(infill.infill_density_image, "infill_density_image").view());
  if (!infill.infill_density_field.empty())
    out += sha256(read_file(infill.infill_density_field, "infill_density_field").view());
  return out;
}

void Density::read_files(const ShellObject& object) {
  const Box on_bed{object.box.min + on_bed_, object.box.max + on_bed_};
  if (const std::string& path = infill_.infill_density_image; !path.empty()) {
    picture_ = field::read_picture(read_file(path, "infill_density_image").view(), path);
    picture_box_ = on_bed;
    if (const Ring& corners = infill_.infill_density_image_box; !corners.empty()) {
      picture_box_ = box_of(corners);
      if (corners.size() != 2 || picture_box_.size().x <= 0 || picture_box_.size().y <= 0)
        throw Error{Error::Kind::settings,
                    "infill_density_image_box is not two corners of a box",
                    {},
                    "two points, such as 0x0, 80x40"};
    }
  }
  if (const std::string& path = infill_.infill_density_field; !path.empty()) {
    const double most = infill_.infill_density_field_unit == DensityUnit::percent ? 100 : 1;
    grid_ = field::read_grid(read_file(path, "infill_density_field").view(), path, most);
    const field::Grid& g = *grid_;
    const auto end = [](double from, double step, std::size_t count) {
      return from + step * static_cast<double>(count - 1);
    };
    const double x1 = end(g.x0, g.dx, g.columns), y1 = end(g.y0, g.dy, g.rows), z1 = end(g.z0, g.dz, g.slices);
    const double high = to_mm(object.layers.back().z);
    if (x1 < to_mm(on_bed.min.x) || g.x0 > to_mm(on_bed.max.x) || y1 < to_mm(on_bed.min.y) ||
        g.y0 > to_mm(on_bed.max.y) || z1 < 0 || g.z0 > high)
      throw Error{Error::Kind::settings,
                  fmt::format("{:.6g}…{:.6g}, {:.6g}…{:.6g}, {:.6g}…{:.6g} misses the object at {:.6g}…{:.6g}, "
                              "{:.6g}…{:.6g}, 0…{:.6g}",
                              g.x0, x1, g.y0, y1, g.z0, z1, to_mm(on_bed.min.x), to_mm(on_bed.max.x),
                              to_mm(on_bed.min.y), to_mm(on_bed.max.y), high),
                  path, "is it in metres or another frame?"};
  }
}

/// A number of a picture or grid, 0 … 1, as the share that the curve makes of it.
/// Source: simp: Bendsøe 1989, "Optimal shape design as a material distribution problem"; ramp: Stolpe & Svanberg 2001,
///         "An alternative interpolation scheme for minimum compliance topology optimization", both solved for the
///         density; heaviside: Wang, Lazarov, Sigmund 2011, "On projection methods".
double Density::transferred(double v) const {
  const TransferCurve& curve = infill_.infill_density_transfer;
  const double least = std::max(infill_.infill_density_min / 100, 0.01),
               most = std::max(infill_.infill_density_max / 100, least);
  switch (curve.kind) {
    case Transfer::linear:
      return v;
    case Transfer::simp:
      return std::pow(v, 1 / curve.first);
    case Transfer::ramp:
      return v * (1 + curve.first) / (1 + curve.first * v);
    case Transfer::heaviside: {
      const double low = std::tanh(curve.first * curve.second);
      return (low + std::tanh(curve.first * (v - curve.second))) / (low + std::tanh(curve.first * (1 - curve.second)));
    }
    case Transfer::linear_spacing:
      return 1 / std::lerp(1 / least, 1 / most, v);
    case Transfer::exponential_spacing:
      return least * std::pow(most / least, v);
  }
  return v;
}

/// Around the object, with a cell of air on each side.
Density::Volume Density::empty_volume(const ShellObject& object) const {
  const ShellLayer &bottom = object.layers.front(), &top = object.layers.back();
  const double wide = object.box.size().x, deep = object.box.size().y, low = bottom.z - bottom.height,
               high = top.z - low;
  Volume out;
  out.cell = std::max(finest, std::cbrt(wide * deep * high / most_cells));
  const auto count = [&](double size) { return static_cast<int>(std::ceil(size / out.cell)) + 2; };
  out.columns = count(wide), out.rows = count(deep), out.slices = count(high);
  const auto margin = [&](int cells, double size) { return (cells * out.cell - size) / 2; };
  out.origin = object.box.min - Point{rounded(margin(out.columns, wide)), rounded(margin(out.rows, deep))};
  out.z0 = low - margin(out.slices, high);
  out.values.assign(
      static_cast<std::size_t>(out.columns) * static_cast<std::size_t>(out.rows) * static_cast<std::size_t>(out.slices),
      0.F);
  return out;
}

double Density::Volume::at(Point p, double z_um) const {
  const auto split = [&](double v, int count) {
    const double t = std::clamp(v / cell - 0.5, 0.0, count - 1.0);
    const int i = std::min(static_cast<int>(t), count - 2);
    return std::pair{i, t - i};
  };
  const auto [i, u] = split(p.x - origin.x, columns);
  const auto [j, v] = split(p.y - origin.y, rows);
  const auto [k, w] = split(z_um - z0, slices);
  const auto value = [&](int a, int b, int c) {
    return static_cast<double>(
        values[(static_cast<std::size_t>(c) * static_cast<std::size_t>(rows) + static_cast<std::size_t>(b)) *
                   static_cast<std::size_t>(columns) +
               static_cast<std::size_t>(a)]);
  };
  const auto row = [&](int b, int c) { return std::lerp(value(i, b, c), value(i + 1, b, c), u); };
  const auto sheet = [&](int c) { return std::lerp(row(j, c), row(j + 1, c), v); };
  return std::lerp(sheet(k), sheet(k + 1), w);
}

namespace {
/// The layer that a height lies in.
std::optional<std::size_t> layer_at(const ShellObject& object, double z) {
  const auto above = std::lower_bound(object.layers.begin(), object.layers.end(), z,
                                      [](const ShellLayer& layer, double at) { return layer.z < at; });
  if (above == object.layers.end() || z < above->z - above->height) return std::nullopt;
  return static_cast<std::size_t>(above - object.layers.begin());
}
}  // namespace

/// Exact between the middles of cells, so within half a cell.
void Density::find_distance(const ShellObject& object) {
  distance_ = empty_volume(object);
  Volume& v = distance_;
  const auto columns = static_cast<std::size_t>(v.columns), rows = static_cast<std::size_t>(v.rows),
             slices = static_cast<std::size_t>(v.slices);
  constexpr float far = 1e12F;
  const Grid grid{v.origin, rounded(v.cell), v.columns, v.rows};
  for (std::size_t k = 0; k < slices; ++k) {
    stop_if_asked();
    const auto layer = layer_at(object, v.z0 + (static_cast<double>(k) + 0.5) * v.cell);
    if (!layer) continue;
    const Mask mask(grid, *object.layers[*layer].outline);
    for (std::size_t j = 0; j < rows; ++j)
      for (std::size_t i = 0; i < columns; ++i)
        if (mask.at(static_cast<int>(i), static_cast<int>(j))) v.values[(k * rows + j) * columns + i] = far;
  }
  const auto sweep = [&](std::size_t count, std::size_t stride, std::size_t start) {
    std::vector<double> f(count), out(count);
    for (std::size_t n = 0; n < count; ++n) f[n] = static_cast<double>(v.values[start + n * stride]);
    lower_envelope(f, out);
    for (std::size_t n = 0; n < count; ++n) v.values[start + n * stride] = static_cast<float>(out[n]);
  };
  for (std::size_t k = 0; k < slices; ++k) {
    stop_if_asked();
    for (std::size_t j = 0; j < rows; ++j) sweep(columns, 1, (k * rows + j) * columns);
    for (std::size_t i = 0; i < columns; ++i) sweep(rows, columns, k * rows * columns + i);
  }
  for (std::size_t j = 0; j < rows; ++j) {
    stop_if_asked();
    for (std::size_t i = 0; i < columns; ++i) sweep(slices, rows * columns, j * columns + i);
  }
  // the surface lies half a cell before the nearest cell of air
  for (float& d : v.values) d = static_cast<float>(std::max(0.0, (std::sqrt(static_cast<double>(d)) - 0.5) * v.cell));
}

void Density::find_depth(const ShellObject& object, const std::vector<LayerAreas>& areas) {
  depth_ = empty_volume(object);
  Volume& v = depth_;
  const auto columns = static_cast<std::size_t>(v.columns), rows = static_cast<std::size_t>(v.rows),
             slices = static_cast<std::size_t>(v.slices);
  const Grid grid{v.origin, rounded(v.cell), v.columns, v.rows};
  for (std::size_t k = slices; k-- > 0;) {
    stop_if_asked();
    const auto layer = layer_at(object, v.z0 + (static_cast<double>(k) + 0.5) * v.cell);
    if (!layer || *layer >= areas.size()) continue;
    Regions sparse;
    for (const PartAreas& part : areas[*layer]) {
      sparse.insert(sparse.end(), part.sparse.begin(), part.sparse.end());
      sparse.insert(sparse.end(), part.combined.begin(), part.combined.end());
    }
    const Mask mask(grid, sparse);
    for (std::size_t j = 0; j < rows; ++j)
      for (std::size_t i = 0; i < columns; ++i) {
        const std::size_t here = (k * rows + j) * columns + i;
        const float above = k + 1 < slices ? v.values[here + rows * columns] : 0.F;
        if (mask.at(static_cast<int>(i), static_cast<int>(j)))
          v.values[here] = above > 0 ? above + static_cast<float>(v.cell) : static_cast<float>(v.cell / 2);
      }
  }
}

double Density::at(Point p, double z_um) const {
  std::optional<double> out;
  const auto add = [&](double percent) {
    const double v = percent / 100;
    if (!out)
      out = v;
    else if (infill_.infill_density_combine == DensityCombine::multiply)
      *out *= v;
    else
      out = infill_.infill_density_combine == DensityCombine::max ? std::max(*out, v) : std::min(*out, v);
  };
  if (!distance_.values.empty()) add(value_of(infill_.infill_density_by_distance, distance_.at(p, z_um) / 1000));
  if (!infill_.infill_density_by_height.empty()) add(value_of(infill_.infill_density_by_height, z_um / 1000));
  const Point on_bed = p + on_bed_;
  if (picture_) {
    const double u = static_cast<double>(on_bed.x - picture_box_.min.x) / picture_box_.size().x,
                 v = static_cast<double>(on_bed.y - picture_box_.min.y) / picture_box_.size().y;
    const double dark = transferred(std::clamp(
        picture_->at(u * static_cast<double>(picture_->columns), v * static_cast<double>(picture_->rows)), 0.0, 1.0));
    const Transfer kind = infill_.infill_density_transfer.kind;
    const bool is_density = kind == Transfer::linear_spacing || kind == Transfer::exponential_spacing;
    add(is_density ? 100 * dark : std::lerp(infill_.infill_density_min, infill_.infill_density_max, dark));
  }
  if (grid_) add(100 * transferred(std::clamp(grid_->at(to_mm(on_bed.x), to_mm(on_bed.y), z_um / 1000), 0.0, 1.0)));
  if (!out) out = infill_.infill_sparse_density / 100;
  if (!depth_.values.empty()) {
    const double steps = std::floor(depth_.at(p, z_um) / infill_.gradual_infill_step_height);
    *out = std::ldexp(*out, -static_cast<int>(std::min(steps, static_cast<double>(infill_.gradual_infill_steps))));
  }
  const double least = infill_.infill_density_min / 100, most = std::max(least, infill_.infill_density_max / 100);
  return std::clamp(*out, least, most);
}

std::vector<Density::Part> Density::parts(const Region& region, double z_um) const {
  const Box box = weft::box_of(region.outer);
  const Point from = box.min;
  const LevelGrid grid({{0, 0}, {static_cast<double>(box.size().x), static_cast<double>(box.size().y)}}, step);
  const double base = std::max(infill_.infill_sparse_density, 1.0) / 100;
  std::vector<double> level(grid.columns * grid.rows);
  double least = 1e9, most = -1e9;
  for (std::size_t j = 0; j < grid.rows; ++j) {
    stop_if_asked();
    for (std::size_t i = 0; i < grid.columns; ++i) {
      const double rho = at(from + Point{rounded(grid.x(i)), rounded(grid.y(j))}, z_um);
      const double l = rho > 0 ? std::log2(rho / base) : -30;
      level[j * grid.columns + i] = l;
      least = std::min(least, l), most = std::max(most, l);
    }
  }
  std::vector<Part> out;
  Regions rest{region};
  constexpr double half = 0.5;
  for (double k = std::floor(most + half); k > std::floor(least + half) && !rest.empty(); --k) {
    std::vector<double> over(level.size(), -1);
    for (std::size_t j = 1; j + 1 < grid.rows; ++j)
      for (std::size_t i = 1; i + 1 < grid.columns; ++i)
        over[j * grid.columns + i] = std::clamp(level[j * grid.columns + i] - (k - half), -1.0, 1.0);
    std::vector<Ring> rings;
    for (const Curve& curve : zero_curves(grid, over)) {
      Ring& ring = rings.emplace_back();
      for (const Turned t : curve.points) ring.push_back(from + Point{rounded(t.x), rounded(t.y)});
    }
    // what is narrower than the places that were looked at are apart is no part of its own
    const Regions dense = geometry::opening(geometry::regions_from_rings(rings), step / 2);
    for (Region& r : geometry::intersect(rest, dense)) out.push_back({std::move(r), base * std::exp2(k)});
    rest = geometry::subtract(rest, dense);
  }
  for (Region& r : rest) out.push_back({std::move(r), base * std::exp2(std::floor(least + half))});
  return out;
}

void Density::follow(double level, double z_um, std::size_t from, Beads& beads) const {
  constexpr double narrowest = 0.7, widest = 1.42;
  for (std::size_t b = from; b < beads.size(); ++b) {
    Bead& bead = beads[b];
    std::vector<Junction> path;
    const std::size_t count = bead.path.size();
    const auto share = [&](Point p) { return std::clamp(at(p, z_um) / level, narrowest, widest); };
    const auto add = [&](Junction j) {
      j.width = std::max(1, rounded(j.width * share(j.at)));
      path.push_back(j);
    };
    for (std::size_t i = 0; i < count; ++i) {
      add(bead.path[i]);
      if (i + 1 == count && !bead.closed) break;
      const Junction &a = bead.path[i], &c = bead.path[(i + 1) % count];
      const int pieces = static_cast<int>(std::ceil(distance(a.at, c.at) / longest_even));
      for (int k = 1; k < pieces; ++k) {
        const double t = static_cast<double>(k) / pieces;
        const Point p{rounded(std::lerp(a.at.x, c.at.x, t)), rounded(std::lerp(a.at.y, c.at.y, t))};
        add({p, rounded(std::lerp(a.width, c.width, t)), a.flow});
      }
    }
    bead.path = std::move(path);
  }
}

}  // namespace weft::infill
