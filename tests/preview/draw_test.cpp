// SPDX-License-Identifier: GPL-3.0-or-later
#include "preview/colours.h"
#include "preview/picture.h"
#include "preview/preview.h"
#include "preview/scene.h"

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::preview;

namespace {

Stroke stroke(Point from, Point to, Um width, float speed, float flow, std::uint32_t line) {
  Stroke out;
  out.from = from, out.to = to, out.z = 200, out.width = width, out.height = width > 0 ? 200 : 0;
  out.speed_mm_s = speed, out.flow_mm3_s = flow, out.line = line;
  return out;
}

/// One horizontal bead, 10 mm long and 1 mm wide, along y = 5, and a travel behind it.
Toolpaths one_bead() {
  Toolpaths paths{{"outer_wall"}, {{200, 200, {}, {}}}};
  paths.layers[0].strokes = {stroke({0, 5000}, {10'000, 5000}, 1000, 30, 5, 7),
                             stroke({10'000, 5000}, {0, 0}, 0, 100, 0, 8)};
  return paths;
}

/// 20 × 10 mm in 800 × 400 pixels: 40 a millimetre, y up.
View close_up() {
  return {.size = 800, .window = Box{{-5000, 0}, {15'000, 10'000}}};
}

std::array<int, 3> at(Image& image, double x_mm, double y_mm) {
  const auto* p = image.pixel(static_cast<int>((x_mm + 5) * 40), static_cast<int>((10 - y_mm) * 40));
  return {p[0], p[1], p[2]};
}
std::array<int, 3> rgb(Rgb c) {
  return {c.r, c.g, c.b};
}

}  // namespace

TEST_CASE("preview: a bead covers its true width, with a darker edge, and nothing beside it", "[preview]") {
  Image image = decoded(png(one_bead(), close_up()));
  const Rgb wall = colour_of("outer_wall");
  const std::array white{255, 255, 255};
  CHECK(at(image, 5, 5) == rgb(wall));
  CHECK(at(image, 5, 5.4) == rgb(wall));
  CHECK(at(image, 5, 4.6) == rgb(wall));
  CHECK(at(image, 5, 5.6) == white);
  CHECK(at(image, 5, 4.4) == white);
  CHECK(at(image, 10.4, 5) == rgb(wall));  // a round end
  CHECK(at(image, 10.6, 5) == white);
  int dark = 255;
  for (double y = 5.4; y < 5.6; y += 0.025) dark = std::min(dark, at(image, 5, y)[0]);
  CHECK(dark < wall.r);
}

TEST_CASE("preview: the heights that a title tells are those of layers on which something lies", "[preview]") {
  Toolpaths paths = one_bead();
  paths.layers.push_back(paths.layers[0]);
  paths.layers[1].z = 400;
  paths.layers.push_back({});  // tips too thin to be laid: the file names the layer, and nothing lies there
  const auto title = words_of(paths, {}).title;
  CHECK(std::find(title.begin(), title.end(), "layers 0 to 2 of 3") != title.end());
  CHECK(std::find(title.begin(), title.end(), "z 0.20 to 0.40") != title.end());
}

TEST_CASE("preview: travels are drawn only when asked for", "[preview]") {
  View view = close_up();
  Image without = decoded(png(one_bead(), view));
  view.travels = true;
  Image with = decoded(png(one_bead(), view));
  CHECK(at(without, 5, 2.5) == std::array{255, 255, 255});
  CHECK(at(with, 5, 2.5) != std::array{255, 255, 255});
}

TEST_CASE("preview: moves that the audit found are red on top of everything, and the machine lies under it",
          "[preview]") {
  const Overlay overlay{{{0, 0}, {10'000, 0}, {10'000, 10'000}, {0, 10'000}},
                        {{{6000, 0}, {8000, 0}, {8000, 2000}, {6000, 2000}}},
                        {},
                        {7}};
  Image image = decoded(png(one_bead(), close_up(), overlay));
  CHECK(at(image, 5, 5) == rgb(offending_colour));
  CHECK(at(image, 3, 8) != std::array{255, 255, 255});   // bed
  CHECK(at(image, -3, 8) == std::array{255, 255, 255});  // beside it
  CHECK(at(image, 7, 1)[0] > at(image, 7, 1)[1] + 10);   // no-go area
  CHECK(svg(one_bead(), close_up(), overlay).find("outside") != std::string::npos);
  CHECK(html(one_bead(), close_up(), overlay).find("\"noGo\":[[[6.0,0.0],[8.0,0.0],[8.0,2.0],[6.0,2.0]]]") !=
        std::string::npos);
}

TEST_CASE("preview: colours tell what they are asked to tell, from violet to yellow", "[preview]") {
  Toolpaths paths = one_bead();
  paths.layers[0].strokes.push_back(stroke({0, 8000}, {10'000, 8000}, 500, 60, 3, 9));
  const auto [colour, first, second] =
      GENERATE(table<Colour, double, double>({{Colour::width, 1, 0}, {Colour::speed, 0, 1}, {Colour::flow, 1, 0}}));
  View view = close_up();
  view.colour = colour;
  Image image = decoded(png(paths, view));
  CHECK(at(image, 5, 5) == rgb(ramp(first)));
  CHECK(at(image, 5, 8) == rgb(ramp(second)));
}

TEST_CASE("preview: an SVG holds the bead in millimetres and a name that cannot break out of it", "[preview]") {
  View view = close_up();
  view.title = "<script>&.gcode";
  const std::string picture = svg(one_bead(), view);
  CHECK(picture.find("<path d=\"M0 5L10 5\" stroke-width=\"1\"") != std::string::npos);
  CHECK(picture.find("&lt;script&gt;&amp;.gcode") != std::string::npos);
  CHECK(picture.find("<script") == std::string::npos);
}

TEST_CASE("preview: a page holds everything it needs and cannot be broken by a file's name", "[preview]") {
  View view;
  view.title = "</script>\"";
  const std::string page = html(one_bead(), view);
  CHECK(page.find("http://") == page.find("http://www.w3.org/2000/svg"));
  CHECK(page.find("src=") == std::string::npos);
  CHECK(page.find("\\u003c/script>\\\"") != std::string::npos);
  std::size_t ends = 0;
  for (std::size_t i = 0; (i = page.find("</script>", i)) != std::string::npos; ++i) ++ends;
  CHECK(ends == 3);  // facts, moves, script
}

TEST_CASE("preview: pictures survive beads without length and files without beads", "[preview]") {
  Toolpaths paths = one_bead();
  paths.layers[0].strokes = {stroke({5, 5}, {5, 5}, 400, 10, 1, 1)};
  CHECK(!png(paths, {}).empty());
  CHECK(!html(paths, {}).empty());
  paths.layers[0].strokes.clear();
  CHECK(decoded(png(paths, {.size = 64})).size.width > 64);
  CHECK(svg(paths, {}).find("</svg>") != std::string::npos);
}
