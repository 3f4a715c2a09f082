// SPDX-License-Identifier: GPL-3.0-or-later
#include "preview/thumbnail.h"

#include "corpus.h"
#include "mesh/read.h"
#include "preview/picture.h"

using namespace weft;
using namespace weft::preview;

namespace {

Mesh box(Um size) {
  Mesh mesh;
  for (int i = 0; i < 8; ++i) mesh.vertices.push_back({i & 1 ? size : 0, i & 2 ? size : 0, i & 4 ? size : 0});
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

std::vector<std::uint8_t> picture_of(const Mesh& mesh, PixelSize size) {
  const Standing standing{&mesh, {0, 0}};
  return thumbnail({&standing, 1}, size);
}

}  // namespace

TEST_CASE("thumbnail: a box is opaque in the middle, clear in the corners, and has three tones", "[preview]") {
  const PixelSize size = GENERATE(PixelSize{32, 32}, PixelSize{220, 124}, PixelSize{300, 300}, PixelSize{1, 1});
  Image image = decoded(picture_of(box(20'000), size));
  REQUIRE(image.size == size);
  CHECK(image.pixel(size.width / 2, size.height / 2)[3] == 255);
  if (size.width == 1) return;
  CHECK(image.pixel(0, 0)[3] == 0);
  CHECK(image.pixel(size.width - 1, size.height - 1)[3] == 0);
  auto red = [&](double across, double along) {
    return static_cast<int>(
        image.pixel(static_cast<int>(across * size.width), static_cast<int>(along * size.height))[0]);
  };
  const int top = red(0.5, 0.3), front = red(0.42, 0.65), right = red(size.width > size.height ? 0.6 : 0.75, 0.6);
  CHECK(top > front);
  CHECK(front > right);
}

TEST_CASE("thumbnail: where the mesh stands does not matter", "[preview][law]") {
  Mesh mesh = box(20'000);
  const auto here = picture_of(mesh, {64, 64});
  for (Point3& p : mesh.vertices) p = {p.x + 131'072, p.y - 65'536, p.z};
  CHECK(picture_of(mesh, {64, 64}) == here);
}

TEST_CASE("thumbnail: meshes that stand on a plate look like one of all their triangles", "[preview][law]") {
  const Mesh large = box(20'000), small = box(5'000);
  const Standing plate[] = {{&large, {0, 0}}, {&small, {30'000, -10'000}}};
  Mesh all = large;
  for (const Point3& p : small.vertices) all.vertices.push_back({p.x + 30'000, p.y - 10'000, p.z});
  for (const auto& [a, b, c] : small.triangles) all.triangles.push_back({a + 8, b + 8, c + 8});
  CHECK(thumbnail(plate, {64, 64}) == picture_of(all, {64, 64}));
}

TEST_CASE("thumbnail: an empty mesh and one without thickness give a picture", "[preview]") {
  CHECK(decoded(thumbnail({}, {16, 16})).size == PixelSize{16, 16});
  CHECK(decoded(picture_of({}, {16, 16})).size == PixelSize{16, 16});
  Mesh flat_mesh{{{0, 0, 0}, {10, 0, 0}, {20, 0, 0}}, {{0, 1, 2}}};
  CHECK(decoded(picture_of(flat_mesh, {16, 16})).size == PixelSize{16, 16});
}

TEST_CASE("thumbnail: a real model", "[preview]") {
  const auto path = corpus("models/benchy.stl");
  if (!path) return;
  const auto loaded = mesh::read_file(path->string());
  const auto bytes = picture_of(loaded.objects[0].mesh, {300, 300});
  Image image = decoded(bytes);
  std::size_t covered = 0;
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) covered += image.rgba[i] == 255;
  CHECK(covered > 300 * 300 / 5);
  CHECK(covered < 300 * 300 * 4 / 5);
}
