// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/density.h"

#include "core/error.h"
#include "core/file_bytes.h"
#include "core/hash.h"
#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/offset.h"
#include "infill/distance_transform.h"
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
    : infill_(infill),
      nozzle_(object.nozzle),
      patterns_(parse_pattern_list(infill.infill_pattern_by_density)),
      on_bed_(on_bed) {
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

void refuse_elsewhere(const field::Grid& g, const ShellObject& object, Point on_bed, const std::string& path) {
  const Box box{object.box.min + on_bed, object.box.max + on_bed};
  const auto end = [](double from, double step, std::size_t count) {
    return from + step * static_cast<double>(count - 1);
  };
  const double x1 = end(g.x0, g.dx, g.columns), y1 = end(g.y0, g.dy, g.rows), z1 = end(g.z0, g.dz, g.slices);
  const double high = to_mm(object.layers.back().z);
  const auto misses = [](double from, double to, std::size_t count, double low, double up) {
    return count > 1 && (to < low || from > up);  // a single node holds everywhere along its axis
  };
  if (misses(g.x0, x1, g.columns, to_mm(box.min.x), to_mm(box.max.x)) ||
      misses(g.y0, y1, g.rows, to_mm(box.min.y), to_mm(box.max.y)) || misses(g.z0, z1, g.slices, 0, high))
    throw Error{Error::Kind::settings,
                fmt::format("{:.6g}…{:.6g}, {:.6g}…{:.6g}, {:.6g}…{:.6g} misses the object at {:.6g}…{:.6g}, "
                            "{:.6g}…{:.6g}, 0…{:.6g}",
                            g.x0, x1, g.y0, y1, g.z0, z1, to_mm(box.min.x), to_mm(box.max.x), to_mm(box.min.y),
                            to_mm(box.max.y), high),
                path, "is it in metres or another frame?"};
}

std::optional<Direction> read_direction(const InfillSettings& infill, const ShellObject& object, Point on_bed) {
  const std::string& path = infill.infill_direction_field;
  if (path.empty() || object.layers.empty() || object.box.empty()) return std::nullopt;
  field::TensorGrid tensors = field::read_tensors(read_file(path, "infill_direction_field").view(), path);
  refuse_elsewhere(tensors.xx, object, on_bed, path);
  return Direction(std::move(tensors), on_bed);
}

std::string Density::files_of(const InfillSettings& infill) {
  std::string out;
  if (!infill.infill_density_image.empty())
    out += sha256(read_file(infill.infill_density_image, "infill_density_image").view());
  if (!infill.infill_density_field.empty())
    out += sha256(read_file(infill.infill_density_field, "infill_density_field").view());
  if (!infill.infill_direction_field.empty())
    out += sha256(read_file(infill.infill_direction_field, "infill_direction_field").view());
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
    refuse_elsewhere(*grid_, object, on_bed_, path);
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
  struct Between {
    int node;
    double share;  // of the way to the next
  };
  const auto between = [&](double v, int count) {
    const double t = std::clamp(v / cell - 0.5, 0.0, count - 1.0);
    const int i = std::min(static_cast<int>(t), count - 2);
    return Between{i, t - i};
  };
  const auto u = between(p.x - origin.x, columns), v = between(p.y - origin.y, rows), w = between(z_um - z0, slices);
  const auto value = [&](int a, int b, int c) {
    return static_cast<double>(
        values[(static_cast<std::size_t>(c) * static_cast<std::size_t>(rows) + static_cast<std::size_t>(b)) *
                   static_cast<std::size_t>(columns) +
               static_cast<std::size_t>(a)]);
  };
  const auto row = [&](int b, int c) { return std::lerp(value(u.node, b, c), value(u.node + 1, b, c), u.share); };
  const auto sheet = [&](int c) { return std::lerp(row(v.node, c), row(v.node + 1, c), v.share); };
  return std::lerp(sheet(w.node), sheet(w.node + 1), w.share);
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

}  // namespace weft::infill
