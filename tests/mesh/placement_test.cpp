// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/placement.h"

#include "mesh/fits.h"
#include "mesh/fixtures.h"
#include "rectangle.h"

#include <algorithm>
#include <random>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::mesh;
using namespace fixtures;
using Catch::Contains;

namespace {

const Plate square{.surface = test::rectangle(0, 0, 200_mm, 200_mm).outer, .height = 100_mm};

/// The print surface is an L: the quarter at the back right is missing.
const Plate l_shaped{
    .surface = {{0, 0}, {200'000, 0}, {200'000, 100'000}, {100'000, 100'000}, {100'000, 200'000}, {0, 200'000}},
    .height = 100_mm};

Loaded box_model(float x, float y, float z, Corner from = {0, 0, 0}) {
  return read(binary_stl(box(from, {from.x + x, from.y + y, from.z + z})));
}

std::vector<PlacedModel> placed(std::vector<Loaded> models, const PlacementOptions& options = {},
                                const Plate& plate = square) {
  return place(std::move(models), options, plate);
}

/// The boxes of all copies on the plate.
std::vector<Box> footprints(const std::vector<PlacedModel>& models) {
  std::vector<Box> boxes;
  for (const PlacedModel& model : models)
    for (const Point at : model.instances)
      boxes.push_back({model.box.footprint().min + at, model.box.footprint().max + at});
  return boxes;
}

Box all_of(const std::vector<Box>& boxes) {
  Box all;
  for (const Box& b : boxes) all.add(b);
  return all;
}

bool apart(const std::vector<Box>& boxes, Um spacing) {
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (boxes[i].grown(spacing - 1).overlaps(boxes[j])) return false;
  return true;
}

std::string misfit(const std::vector<PlacedModel>& models, const Plate& plate = square) {
  try {
    check_fits(models, plate, 10_um);
  } catch (const Error& error) {
    CHECK(error.kind() == Error::Kind::audit);
    return error.what();
  }
  return "fits";
}

}  // namespace

TEST_CASE("placement: a model stands in the middle of the plate on its lowest point", "[mesh][placement]") {
  const auto models = placed({box_model(20, 10, 5, {-300, 70, -12})});
  REQUIRE(models.size() == 1);
  CHECK(models[0].box == Box3{{-10'000, -5'000, 0}, {10'000, 5'000, 5'000}});
  CHECK(models[0].instances == std::vector<Point>{{100'000, 100'000}});
  CHECK(box_of(models[0].objects[0]) == models[0].box);
}

TEST_CASE("placement: a center is the middle of the box of everything", "[mesh][placement]") {
  const auto one = placed({box_model(20, 10, 5)}, {.center = Point{30'000, 40'000}});
  CHECK(all_of(footprints(one)) == Box{{20'000, 35'000}, {40'000, 45'000}});
  const auto several =
      placed({box_model(20, 10, 5), box_model(10, 10, 5)}, {.center = Point{30'000, 40'000}, .copies = 3});
  CHECK(all_of(footprints(several)).centre() == Point{30'000, 40'000});
}

TEST_CASE("placement: a kept position keeps x and y, and z where it is told not to drop", "[mesh][placement]") {
  const auto models = placed({box_model(20, 10, 5, {-3, 70, -12}), box_model(20, 10, 5, {50, 60, 9})},
                             {.keep_position = true, .drop = true});
  CHECK(footprints(models)[0] == Box{{-3'000, 70'000}, {17'000, 80'000}});
  CHECK(footprints(models)[1] == Box{{50'000, 60'000}, {70'000, 70'000}});
  CHECK(models[1].box.min.z == 0);
  CHECK_THROWS_AS(placed({box_model(20, 10, 5, {-3, 70, -12})}, {.keep_position = true}), Error);
  CHECK_THROWS_AS(placed({box_model(20, 10, 5, {50, 60, 9})}, {.keep_position = true}), Error);
  CHECK_THROWS_AS(placed({box_model(1, 1, 1)}, {.keep_position = true, .copies = 2}), Error);
}

TEST_CASE("placement: the objects of a file keep their places among themselves", "[mesh][placement]") {
  Loaded pair = box_model(20, 10, 5);
  pair.objects.push_back(box_model(10, 10, 8, {40, 0, 5}).objects[0]);
  const auto models = placed({pair}, {.rotate_deg = 90});
  REQUIRE(models[0].objects.size() == 2);
  CHECK(models[0].box == Box3{{-5'000, -25'000, 0}, {5'000, 25'000, 13'000}});
  CHECK(box_of(models[0].objects[1]) == Box3{{-5'000, 15'000, 5'000}, {5'000, 25'000, 13'000}});
}

TEST_CASE("placement: quarter turns are exact, four of them are none", "[mesh][placement][law]") {
  const Mesh mesh = box_model(20.001f, 10.003f, 5, {1.007f, 2, 3}).objects[0].mesh;
  Mesh turned = mesh;
  const double angle = GENERATE(90.0, -90.0, 450.0);
  for (int i = 0; i < 4; ++i) turned = rotated(std::move(turned), angle, {7, -3});
  CHECK(turned == mesh);
  CHECK(rotated(mesh, 180, {0, 0}) == rotated(rotated(mesh, 90, {0, 0}), 90, {0, 0}));
  CHECK(rotated(mesh, -3600, {0, 0}) == mesh);
  CHECK(volume_mm3(rotated(mesh, 33, {0, 0})) == Approx(volume_mm3(mesh)).epsilon(1e-3));
  CHECK(box_of(rotated(mesh, 45, {0, 0})).size().z == 5'000);
}

TEST_CASE("placement: copies stand apart by the spacing, in the middle, on the plate", "[mesh][placement][law]") {
  std::mt19937 random(7);
  for (int run = 0; run < 60; ++run) {
    std::vector<Loaded> models;
    for (std::size_t i = 0; i <= random() % 3; ++i)
      models.push_back(box_model(static_cast<float>(3 + random() % 40), static_cast<float>(3 + random() % 40), 5));
    const PlacementOptions options{.copies = static_cast<int>(1 + random() % 4),
                                   .spacing = static_cast<Um>(random() % 4000)};
    const auto result = placed(models, options);
    CHECK(result == placed(models, options));
    for (const PlacedModel& model : result) CHECK(model.instances.size() == static_cast<std::size_t>(options.copies));
    const auto boxes = footprints(result);
    CHECK(apart(boxes, options.spacing));
    if (misfit(result) == "fits") CHECK(all_of(boxes).contains({100'000, 100'000}));
  }
}

TEST_CASE("placement: as many copies fit as there is room for, and one more does not", "[mesh][placement]") {
  const Loaded model = box_model(46, 62, 5);  // 4 × 46 + 3 × 5 = 199, 3 × 62 + 2 × 5 = 196
  CHECK(misfit(placed({model}, {.copies = 12, .spacing = 5_mm})) == "fits");
  CHECK_THAT(misfit(placed({model}, {.copies = 13, .spacing = 5_mm})), Contains("outside the print surface"));
}

TEST_CASE("placement: copies avoid the notch of a concave plate and what is kept out", "[mesh][placement]") {
  const Loaded model = box_model(40, 40, 5);
  const auto on_l = placed({model}, {.copies = 8, .spacing = 5_mm}, l_shaped);
  CHECK(misfit(on_l, l_shaped) == "fits");
  CHECK(apart(footprints(on_l), 5_mm));

  Plate with_clip = square;
  with_clip.keep_out = {{{90'000, 90'000}, {110'000, 90'000}, {110'000, 110'000}, {90'000, 110'000}}};
  const auto around = placed({model}, {.copies = 4}, with_clip);
  for (const Box& b : footprints(around)) CHECK_FALSE(b.grown(-1).overlaps(Box{{90'000, 90'000}, {110'000, 110'000}}));
}

TEST_CASE("placement: a million copies end in an error or in rows, not in an overflow", "[mesh][placement]") {
  CHECK_THROWS_AS(placed({box_model(199, 199, 5)}, {.copies = 1'000'000}), Error);
  const auto many = placed({box_model(1, 1, 1)}, {.copies = 20'000, .spacing = 0});
  CHECK(apart({footprints(many).front(), footprints(many).back()}, 0));
}

TEST_CASE("placement: a model that does not fit is named with the size it has and the size there is",
          "[mesh][placement]") {
  CHECK(misfit(placed({box_model(200, 200, 100)})) == "fits");
  CHECK_THAT(
      misfit(placed({box_model(200.5f, 100, 5)})),
      Contains(
          "part: does not fit: it is 200.50 × 100.00 × 5.00 mm, the build volume is 200.00 × 200.00 × 100.00 mm") &&
          Contains("0.25 mm outside the print surface; scale"));
  CHECK_THAT(misfit(placed({box_model(20, 20, 101)})), Contains("it is 1.00 mm too high"));
  CHECK_THAT(misfit(placed({box_model(20, 20, 5)}, {.center = Point{5'000, 50'000}})),
             Contains("at (-5.00, 40.00) it is 5.00 mm outside the print surface; place it"));
}

TEST_CASE("placement: an L fits on an L, a box across its notch does not", "[mesh][placement]") {
  const Loaded l = read(binary_stl(box({0, 0, 0}, {200, 100, 5}) + box({0, 100, 0}, {100, 200, 5})));
  CHECK(misfit(placed({l}, {.keep_position = true}, l_shaped), l_shaped) == "fits");
  const Loaded across = read(binary_stl(box({60, 60, 0}, {140, 140, 5})));
  CHECK(misfit(placed({across}, {.keep_position = true}, l_shaped), l_shaped) != "fits");
  // All corners are on the surface, the body is not.
  const Loaded wedge = read(binary_stl({{{{10, 190, 0}, {190, 10, 0}, {10, 190, 5}}},
                                        {{{190, 10, 0}, {190, 10, 5}, {10, 190, 5}}},
                                        {{{10, 190, 0}, {150, 100, 0}, {190, 10, 0}}}}));
  CHECK_THAT(misfit(placed({wedge}, {.keep_position = true}, l_shaped), l_shaped), Contains("over a notch"));
}

TEST_CASE("placement: a disc fits on a round plate of its size", "[mesh][placement]") {
  Plate round{.height = 100_mm};
  Facets disc;
  constexpr int steps = 180;
  const auto at = [](double r, int i, float z) {
    return Corner{static_cast<float>(r * std::cos(2 * M_PI * i / steps)),
                  static_cast<float>(r * std::sin(2 * M_PI * i / steps)), z};
  };
  for (int i = 0; i < steps; ++i) {
    const Corner corner = at(100, i, 0);
    round.surface.push_back({from_mm(static_cast<double>(corner.x)), from_mm(static_cast<double>(corner.y))});
    disc.push_back({at(100, i, 0), at(100, i + 1, 0), Corner{0, 0, 5}});
    disc.push_back({at(100, i + 1, 0), at(100, i, 0), Corner{0, 0, 0}});
  }
  CHECK(misfit(placed({read(binary_stl(disc))}, {}, round), round) == "fits");
  CHECK(misfit(placed({read(binary_stl(disc), {.scale = 1.01})}, {}, round), round) != "fits");
  const auto many = placed({box_model(40, 40, 5)}, {.copies = 12, .spacing = 2_mm}, round);  // 4 × 3 would be out
  CHECK(misfit(many, round) == "fits");
  CHECK(apart(footprints(many), 2_mm));
}

TEST_CASE("placement: a shape lies in a ring, overlaps it, or does neither", "[mesh][placement]") {
  const Ring ring = l_shaped.surface;
  const auto at = [](Um x0, Um y0, Um x1, Um y1) { return Ring{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}; };
  CHECK(lies_in(at(0, 0, 100'000, 100'000), ring));
  CHECK(lies_in(at(0, 0, 200'000, 100'000), ring));
  CHECK_FALSE(lies_in(at(0, 0, 200'000, 200'000), ring));  // all corners but one are on the surface
  CHECK_FALSE(lies_in(at(50'000, 50'000, 101'000, 101'000), ring));
  CHECK_FALSE(overlap(at(100'000, 100'000, 200'000, 200'000), ring));  // in the notch, touching
  CHECK(overlap(at(100'000, 99'999, 200'000, 200'000), ring));
  CHECK(overlap(at(10, 10, 20, 20), ring));
  CHECK(overlap(at(-10, -10, 300'000, 300'000), ring));
  CHECK(overlap(at(0, 0, 100'000, 100'000), at(0, 0, 100'000, 100'000)));
  CHECK_FALSE(overlap(at(-100, 0, 0, 100), at(0, 0, 100, 100)));
}

TEST_CASE("placement: a model is stretched about the middle of its place, from the bed upwards", "[mesh][placement]") {
  const auto models =
      placed({box_model(20, 10, 5, {50, 60, 0})}, {.stretch_xy = 1.01, .stretch_z = 1.04, .keep_position = true});
  CHECK(models[0].box.max.x - models[0].box.min.x == 20'200);
  CHECK(models[0].box.max.z == 5'200);
  CHECK(models[0].instances[0] == Point{60'000, 65'000});
}
