// SPDX-License-Identifier: GPL-3.0-or-later
#include "preview/thumbnail.h"

#include "core/stop.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace weft::preview {
namespace {

constexpr int samples = 2;       // a pixel, in each direction
constexpr float margin = 0.04F;  // share of the picture left free on each side
constexpr Rgb plastic{236, 146, 44};

struct Vec {
  float x, y, z;
};
float dot(Vec a, Vec b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
Vec cross(Vec a, Vec b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Vec unit(Vec a) {
  const float length = std::sqrt(dot(a, a));
  return {a.x / length, a.y / length, a.z / length};
}
Vec vec(Point3 p) {
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

/// Axes of the picture in space: right, up, and towards the eye.
struct Camera {
  Vec eye = unit({0.45F, -0.75F, 0.5F});
  Vec right = unit(cross({0, 0, 1}, eye));
  Vec up = cross(eye, right);
};

/// An edge of a triangle that lies to its left: where a row of samples crosses it.
struct Edge {
  Vec from;
  float rise, slope;  ///< slope: how far the edge moves along x for a step of y
  Edge(Vec a, Vec b) : from(a), rise(b.y - a.y), slope(rise == 0 ? 0 : (b.x - a.x) / rise) {}

  /// Takes from [least, most] what lies to the right of the edge. A hair is left on: neighbours must not leave cracks.
  void narrow(float y, float& least, float& most) const {
    constexpr float hair = 0.002F;
    const float x = from.x + (y - from.y) * slope;
    if (rise > 0) most = std::min(most, x + hair);
    if (rise < 0) least = std::max(least, x - hair);
  }
};

/// Samples with the nearest surface's depth and brightness.
struct Raster {
  int width, height;
  std::vector<float> depth, brightness;
  explicit Raster(PixelSize size)
      : width(size.width * samples),
        height(size.height * samples),
        depth(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), std::numeric_limits<float>::lowest()),
        brightness(depth.size()) {}

  /// Samples that may lie under the triangle; sample (i, j) lies at (i, j): the caller has moved the corners by half a
  /// one.
  struct Window {
    int x0, x1, y0, y1;
    bool empty() const { return x0 > x1 || y0 > y1; }
  };
  Window window(Vec a, Vec b, Vec c) const {
    return {std::max(0, upward(std::min(std::min(a.x, b.x), c.x))),
            std::min(width - 1, upward(std::max(std::max(a.x, b.x), c.x)) - 1),
            std::max(0, upward(std::min(std::min(a.y, b.y), c.y))),
            std::min(height - 1, upward(std::max(std::max(a.y, b.y), c.y)) - 1)};
  }

  /// Pre: turned towards the eye, with an area.
  void triangle(Vec a, Vec c, Vec b, float light, Window in) {  // y points down: the corners go round the other way
    // Depth is z0 + x·zx + y·zy on the plane of the triangle.
    const float share = 1.F / ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
    const float zx = ((b.z - a.z) * (c.y - a.y) - (b.y - a.y) * (c.z - a.z)) * share;
    const float zy = ((b.x - a.x) * (c.z - a.z) - (b.z - a.z) * (c.x - a.x)) * share;
    const Edge edges[] = {Edge(a, b), Edge(b, c), Edge(c, a)};
    for (int y = in.y0; y <= in.y1; ++y) {
      const float py = static_cast<float>(y);
      float from = static_cast<float>(in.x0), to = static_cast<float>(in.x1);
      for (const Edge& edge : edges) edge.narrow(py, from, to);
      if (!(from <= to)) continue;
      const int x1 = upward(to + 1) - 1;
      const std::size_t row = static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
      for (int x = upward(from); x <= x1; ++x) {
        const float z = a.z + (static_cast<float>(x) - a.x) * zx + (py - a.y) * zy;
        const std::size_t at = row + static_cast<std::size_t>(x);
        if (z <= depth[at]) continue;
        depth[at] = z;
        brightness[at] = light;
      }
    }
  }

 private:
  /// std::ceil for what lies in the picture, without a call into the library.
  static int upward(float v) {
    const int down = static_cast<int>(v);
    return down + (static_cast<float>(down) < v);
  }
};

/// The vertices of all meshes in samples of the picture, z towards the eye, fitted to it with the margin.
std::vector<Vec> projected(std::span<const Standing> meshes, const Camera& camera, const Raster& raster) {
  std::vector<Vec> out;
  std::size_t count = 0;
  for (const auto& [mesh, at] : meshes) count += mesh->vertices.size();
  out.reserve(count);
  constexpr float far = std::numeric_limits<float>::max();
  Vec least{far, far, far}, most{-far, -far, -far};
  for (const auto& [mesh, stands] : meshes)
    for (const Point3 p : mesh->vertices) {
      const Vec v = vec({p.x + stands.x, p.y + stands.y, p.z});
      const Vec at{dot(v, camera.right), -dot(v, camera.up), dot(v, camera.eye)};
      least = {std::min(least.x, at.x), std::min(least.y, at.y), 0};
      most = {std::max(most.x, at.x), std::max(most.y, at.y), 0};
      out.push_back(at);
    }
  const float width = static_cast<float>(raster.width), height = static_cast<float>(raster.height);
  const float across = std::max(most.x - least.x, 1.F), along = std::max(most.y - least.y, 1.F);
  const float scale = (1.F - 2 * margin) * std::min(width / across, height / along);
  const float shift_x = width / 2 - 0.5F - scale * (least.x + most.x) / 2;
  const float shift_y = height / 2 - 0.5F - scale * (least.y + most.y) / 2;
  for (Vec& at : out) at = {scale * at.x + shift_x, scale * at.y + shift_y, at.z};
  return out;
}

Vec normal_of(const Mesh& mesh, const Triangle& t) {
  const Vec a = vec(mesh.vertices[t[0]]), b = vec(mesh.vertices[t[1]]), c = vec(mesh.vertices[t[2]]);
  return cross({b.x - a.x, b.y - a.y, b.z - a.z}, {c.x - a.x, c.y - a.y, c.z - a.z});
}

/// Brightness of a face with that normal: light from above the viewer's left shoulder, some from everywhere.
float shade(Vec normal, const Camera& camera) {
  const Vec light =
      unit({camera.eye.x - 0.6F * camera.right.x, camera.eye.y - 0.6F * camera.right.y, camera.eye.z + 0.6F});
  const float length = std::sqrt(dot(normal, normal));
  if (length == 0) return 0;
  return 0.35F + 0.75F * std::max(0.F, dot(normal, light) / length);
}

Image resolved(const Raster& raster, PixelSize size) {
  Image image(size);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      float sum = 0;
      int hit = 0;
      for (int j = 0; j < samples; ++j)
        for (int i = 0; i < samples; ++i) {
          const std::size_t at = static_cast<std::size_t>(y * samples + j) * static_cast<std::size_t>(raster.width) +
                                 static_cast<std::size_t>(x * samples + i);
          if (raster.depth[at] == std::numeric_limits<float>::lowest()) continue;
          sum += raster.brightness[at];
          ++hit;
        }
      if (hit == 0) continue;
      const float light = sum / static_cast<float>(hit);
      auto tone = [light](std::uint8_t full) {  // above 1 towards white, as a glossy surface does
        const float value = light <= 1 ? full * light : full + (255.F - full) * (light - 1);
        return static_cast<std::uint8_t>(std::clamp(value, 0.F, 255.F) + 0.5F);
      };
      std::uint8_t* out = image.pixel(x, y);
      out[0] = tone(plastic.r), out[1] = tone(plastic.g), out[2] = tone(plastic.b);
      out[3] = static_cast<std::uint8_t>(255 * hit / (samples * samples));
    }
  return image;
}

}  // namespace

std::vector<std::uint8_t> thumbnail(std::span<const Standing> meshes, PixelSize size) {
  assert(size.width >= 1 && size.width <= 4096 && size.height >= 1 && size.height <= 4096);
  const Camera camera;
  Raster raster(size);
  const std::vector<Vec> corners = projected(meshes, camera, raster);
  const Vec* corner = corners.data();
  StopNowAndThen stop(1024);
  for (const auto& [mesh, at] : meshes) {
    for (const Triangle& t : mesh->triangles) {
      stop.step();
      const Vec a = corner[t[0]], b = corner[t[1]], c = corner[t[2]];
      if ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) >= 0) continue;  // turned away: y points down here
      const auto window = raster.window(a, b, c);
      if (window.empty()) continue;  // a fine mesh: most of its triangles lie between the samples
      raster.triangle(a, b, c, shade(normal_of(*mesh, t), camera), window);
    }
    corner += mesh->vertices.size();
  }
  return encode_png(resolved(raster, size));
}

}  // namespace weft::preview
