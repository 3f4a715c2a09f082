// SPDX-License-Identifier: GPL-3.0-or-later
#include "preview/page.h"

#include "preview/compare.h"
#include "preview/coverage.h"
#include "preview/pack.h"
#include "preview/picture.h"
#include "preview/solid.h"
#include "preview/timing.h"
#include "tasks/tasks.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <zlib.h>

using namespace weft;
using namespace weft::preview;

namespace {

/// Squares of 10 mm, one a layer, each of one bead of 0.5 × 0.2 mm all around; the second one 5 mm further.
std::string squares(int layers, double width_mm = 0.5, int shift = 0, const char* before = "") {
  std::string out = "G28\nM83\nM104 S215\nM106 S128\n";
  const double e = width_mm * 0.2 * 10 / 2.405282;
  for (int i = 0; i < layers; ++i) {
    const double z = 0.2 * (i + 1);
    const int x = 20 + shift * i;
    out += fmt::format(
        ";LAYER_CHANGE\n;Z:{0:.1f}\n;HEIGHT:0.2\nG1 E-0.8 F2400\nG1 Z{1:.1f} F600\nG1 X{2} Y20 F9000\nG1 "
        "Z{0:.1f} F600\nG1 E0.8 F2400\n;TYPE:External perimeter\n{3}G1 X{4} E{5:.5f} F1800\nG1 Y30 "
        "E{5:.5f}\nG1 X{2} E{5:.5f}\nG1 Y20 E{5:.5f}\n",
        z, z + 0.4, x, before, x + 10, e);
  }
  return out;
}

Toolpaths timed(const std::string& gcode) {
  auto paths = read(gcode, 1750);
  set_seconds(paths, {});
  set_support(paths);
  return paths;
}

/// The columns of packed strokes, unpacked by zlib's other half.
std::vector<std::string> columns(const std::string& packed) {
  std::string bytes(1 << 20, '\0');
  uLongf size = static_cast<uLong>(bytes.size());
  REQUIRE(uncompress(reinterpret_cast<Bytef*>(bytes.data()), &size, reinterpret_cast<const Bytef*>(packed.data()),
                     static_cast<uLong>(packed.size())) == Z_OK);
  bytes.resize(size);
  std::vector<std::size_t> sizes;
  std::size_t at = 0;
  for (int i = 0; i < 15; ++i) {
    std::size_t v = 0;
    for (int shift = 0;; shift += 7) {
      const auto b = static_cast<unsigned char>(bytes[at++]);
      v |= static_cast<std::size_t>(b & 127) << shift;
      if (b < 128) break;
    }
    sizes.push_back(v);
  }
  std::vector<std::string> out;
  for (const auto n : sizes) out.push_back(bytes.substr(at, n)), at += n;
  CHECK(at == bytes.size());
  return out;
}

}  // namespace

TEST_CASE("preview: heights, tools, fan, heat, rises and retractions are read", "[preview]") {
  const auto paths = read(
      "T0\n" + squares(2) + "T1\nM106 S255\nSET_VELOCITY_LIMIT ACCEL=1234\nG1 X40 Y20 E1\nM107\nG1 X41 E1\nPAUSE\n",
      1750);
  REQUIRE(paths.layers.size() == 2);
  const auto& layer = paths.layers[1];
  const auto first =
      std::find_if(layer.strokes.begin(), layer.strokes.end(), [](const Stroke& s) { return s.extrudes(); });
  REQUIRE(first != layer.strokes.end());
  CHECK(first->z == 400);
  CHECK(first->height == 200);
  CHECK(first->fan_percent == 50);
  CHECK(first->nozzle_c == 215);
  CHECK(std::any_of(layer.strokes.begin(), layer.strokes.end(),
                    [](const Stroke& s) { return s.from == s.to && s.z == 800; }));  // it rises on its place
  const auto count = [&](Event::Kind kind) {
    return std::count_if(layer.events.begin(), layer.events.end(), [&](const Event& e) { return e.kind == kind; });
  };
  CHECK(count(Event::Kind::prime) == 1);
  CHECK(count(Event::Kind::pause) == 1);
  CHECK(count(Event::Kind::tool_change) == 1);
  CHECK(paths.layers[0].events.size() == 3);  // also what came before the first move
  CHECK(layer.events.size() == 3);            // its retraction came before its first move
  const Stroke& last = layer.strokes.back();
  CHECK(last.tool == 1);
  CHECK(last.fan_percent == 0);
  CHECK(last.acceleration_mm_s2 == 1234);
}

TEST_CASE("preview: what fills two layers at once is as high as it says", "[preview]") {
  const auto paths = read(squares(1, 0.5, 0, ";HEIGHT:0.4\n"), 1750);
  const Stroke& bead = paths.layers[0].strokes.back();
  CHECK(bead.height == 400);
  CHECK(bead.width < 400);  // 0.1 mm² over 0.4 mm
}

TEST_CASE("preview: moves take their way by their speed, with ramps, and standing still takes its time", "[preview]") {
  auto paths = read(
      "G28\nM83\n;LAYER_CHANGE\n;Z:0.2\n;HEIGHT:0.2\nG1 Z0.2 F600\nG1 X0 Y0 F6000\nG1 E-1 F600\n;TYPE:Perimeter\n"
      "M204 S1000\nG1 X100 E5 F6000\n",
      1750);
  MachineSettings machine;
  machine.machine_max_jerk = 1e-6;  // from rest to rest
  machine.machine_max_speed_x = 500;
  set_seconds(paths, machine);
  const Stroke& bead = paths.layers[0].strokes.back();
  REQUIRE(bead.extrudes());
  CHECK(static_cast<double>(bead.seconds) == Approx(1.1).epsilon(0.001));  // 100 mm at 100 mm/s, two ramps of 0.1 s
  CHECK(seconds_of(paths.layers[0]) >= 1.2);                               // and 0.1 s to draw 1 mm back
}

TEST_CASE("preview: support is the share of a bead's width that lies over the layer below", "[preview]") {
  const auto at = [](int shift_um) {  // two straight beads of about 0.5 mm above each other, the upper one moved
    const auto paths =
        timed(fmt::format("G28\nM83\n;LAYER_CHANGE\n;Z:0.2\n;HEIGHT:0.2\nG1 Z0.2\nG1 X10 Y10 F6000\n;TYPE:Perimeter\n"
                          "G1 X60 E2 F1800\n;LAYER_CHANGE\n;Z:0.4\n;HEIGHT:0.2\nG1 Z0.4\nG1 X15 Y{0:.3f} F6000\n"
                          ";TYPE:Perimeter\nG1 X55 E1.6 F1800\n",
                          10 + shift_um / 1000.0));
    CHECK(paths.layers[0].strokes.back().support_percent == 100);
    return int{paths.layers[1].strokes.back().support_percent};
  };
  CHECK(at(0) == 100);
  CHECK(at(5000) == 0);
  CHECK(std::abs(at(250) - 50) < 16);  // cells of 0.1 mm, nine samples
}

TEST_CASE("preview: cells that beads cover are as large as they", "[preview]") {
  Toolpaths paths = timed(squares(1));
  const Box window = box_of_beads(paths.layers[0], paths);
  Coverage cover(window);
  cover.add(paths.layers[0], paths);
  const auto all = Coverage::shared(cover, Coverage(window));
  const double width = to_mm(paths.layers[0].strokes.back().width);
  CHECK(static_cast<double>(all.only_a) * cover.cell_mm2() == Approx(4 * 10 * width).margin(4 * 10 * 0.1));
  CHECK(all.only_b + all.both == 0);
  CHECK(cover.at({25'000, 20'000}));
  CHECK_FALSE(cover.at({25'000, 25'000}));
}

TEST_CASE("preview: coordinates beyond reason cost no memory", "[preview]") {
  const auto paths = timed(
      "G28\nM83\n;LAYER_CHANGE\n;Z:0.2\n;HEIGHT:0.2\nG1 Z0.2\nG1 X-900 Y-900 F6000\n;TYPE:Perimeter\nG1 X900 Y900 E99\n"
      ";LAYER_CHANGE\n;Z:0.4\nG1 Z0.4\nG1 X-900 E99\n");
  CHECK(paths.layers.size() == 2);
}

TEST_CASE("preview: a page's columns hold every move, a travel and a bead each in one byte of width", "[preview]") {
  const auto paths = timed(squares(3));
  const auto in = columns(packed(paths));
  REQUIRE(in.size() == 15);
  std::size_t moves = 0;
  for (const auto& layer : paths.layers) moves += layer.strokes.size();
  CHECK(in[2].size() <= moves + 2);  // the first width takes two bytes, all that follow are steps of 0
  CHECK(static_cast<unsigned char>(in[13][0]) == paths.layers[0].strokes.size());
  CHECK(in[12][0] == 0);  // the way begins before the first move, and nowhere else
  CHECK(in[14].size() == 2 * 6);
}

TEST_CASE("preview: a page's figures are the reader's", "[preview]") {
  const auto paths = timed(squares(3));
  const auto figures = figures_of(paths);
  CHECK(figures.beads == 12);
  CHECK(figures.retractions == 3);
  CHECK(figures.features.at(paths.layers[0].strokes.back().feature).mm == Approx(120));
  CHECK(figures.mm3 == Approx(12 * 0.5 * 0.2 * 10).epsilon(0.001));
  const auto text =
      page({"p", {}, {}, {{paths, "p", {{"a mark", {20'000, 20'000, 200}, paths.layers[0].strokes.back().line}}, {}}}});
  const auto from = text.find("id=\"facts\">") + 11;
  const auto facts = nlohmann::json::parse(text.substr(from, text.find("</script>", from) - from));
  const auto& print = facts["prints"][0];
  CHECK(print["figures"]["beads"] == 12);
  CHECK(print["figures"]["seconds"].get<double>() == Approx(figures.seconds).epsilon(1e-3));
  CHECK(print["layers"].size() == 3);
  CHECK(print["findings"][0]["move"] == paths.layers[0].strokes.size() - 1);
}

TEST_CASE("preview: names and comments of a file are text on its page", "[preview]") {
  const auto hostile = "</script><script>alert(1)</script>\"'\xE2\x80\xAE\xFF<!--";
  const auto paths = timed(squares(1) + ";TYPE:" + hostile + "\nG1 X50 E1\n");
  const auto text = page({hostile, {.title = hostile}, {}, {{paths, hostile, {{hostile, {}, 1}}, {}}}});
  CHECK(text.find("alert(1)</script>") == std::string::npos);
  CHECK(text.find("<!--") == std::string::npos);
  std::size_t ends = 0;
  for (std::size_t i = 0; (i = text.find("</script>", i)) != std::string::npos; ++i) ++ends;
  CHECK(ends == 3);
}

TEST_CASE("preview: solids hide what lies behind them, whatever the number of threads", "[preview]") {
  auto paths = timed(squares(10));
  paths.layers[9].strokes.back().feature = 1;
  paths.features.resize(2, "infill");
  View view;
  view.eye = {0, 0, 1};
  std::vector<std::uint8_t> one, many;
  tasks::with_threads(1, [&] { one = encode_png(solid(paths, view, {200, 200})); });
  tasks::with_threads(4, [&] { many = encode_png(solid(paths, view, {200, 200})); });
  CHECK(one == many);
  Image image = decoded(one);
  CHECK(image.pixel(100, 100)[3] == 0);   // inside the square is nothing
  CHECK(image.pixel(100, 12)[3] == 255);  // its far side
  const auto* near = image.pixel(12, 100);
  CHECK(near[0] > near[2]);  // walls: orange
  view.eye = {0, -1, 0};
  Image front = solid(paths, view, fitting_size(paths, view, 400));
  CHECK(front.size.width == 400);
  CHECK(front.size.height < 120);  // 2 mm of 10.5
  CHECK(front.pixel(200, front.size.height / 2)[3] == 255);
}

TEST_CASE("preview: a bead seen from above is as wide as it is, and from the side as high", "[preview]") {
  auto paths = timed(
      "G28\nM83\n;LAYER_CHANGE\n;Z:0.4\n;HEIGHT:0.4\nG1 Z0.4\nG1 X10 Y10 F6000\n;TYPE:Perimeter\nG1 X14 E1 F1800\n");
  const Stroke bead = paths.layers[0].strokes.back();
  View view;
  const auto extent = [&](std::array<double, 3> eye) {
    view.eye = eye;
    const auto size = fitting_size(paths, view, 1000);
    return std::pair{1000.0 / (4 + to_mm(bead.width)), static_cast<double>(size.height)};
  };
  const auto [scale, deep] = extent({0, 0, 1});
  CHECK(deep == Approx(scale * to_mm(bead.width)).margin(2));
  CHECK(extent({0, -1, 0}).second == Approx(scale * 0.4).margin(2));
}

TEST_CASE("compare: a print is like itself, and one with other beads is not", "[preview]") {
  const auto a = timed(squares(5));
  const auto same = compare(a, timed(squares(5)));
  CHECK(same.same_moves);
  CHECK(same.worst_percent() == 0);
  CHECK(same.alike(0));
  const auto wide = compare(a, timed(squares(5, 0.6)));
  CHECK_FALSE(wide.same_moves);
  CHECK_FALSE(wide.alike(0));
  CHECK_FALSE(wide.alike(5));
  CHECK(wide.alike(50));
  const auto figure = [](const Comparison& c, std::string_view name) {
    const auto at = std::find_if(c.figures.begin(), c.figures.end(), [&](const auto& f) { return f.name == name; });
    REQUIRE(at != c.figures.end());
    return *at;
  };
  CHECK(figure(wide, "plastic").percent == Approx(100 * 0.1 / 0.6).epsilon(0.01));
  const auto moved = compare(a, timed(squares(5, 0.5, 1)));
  CHECK(figure(moved, "plastic").percent == Approx(0).margin(0.01));
  CHECK(figure(moved, "area that only one covers, all layers").percent > 30);
  CHECK(moved.layers.size() == 5);
  CHECK(moved.layers[0].only_a_mm2 == 0);
  CHECK(moved.layers[4].only_a_mm2 > 5);
}

TEST_CASE("compare: a layer that only one has is one that only one covers", "[preview]") {
  const auto more = compare(timed(squares(4)), timed(squares(5)));
  REQUIRE(more.layers.size() == 5);
  CHECK(more.layers[4].both_mm2 == 0);
  CHECK(more.layers[4].only_b_mm2 > 15);
  CHECK(more.layers[3].only_b_mm2 == 0);
}

TEST_CASE("compare: settings that differ, of either side", "[preview]") {
  const auto out = differences("a = 1\nb = 2\nc = x = y\n", "a = 1\nb = 3\nd = 4\n");
  REQUIRE(out.size() == 3);
  CHECK((out[0].key == "b" && out[0].a == "2" && out[0].b == "3"));
  CHECK((out[1].key == "c" && out[1].a == "x = y" && out[1].b.empty()));
  CHECK((out[2].key == "d" && out[2].b == "4"));
}
