// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/fixtures.h"
#include "mesh/zip_fixture.h"

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::mesh;
using namespace fixtures;
using Catch::Contains;

namespace {

/// <mesh> of a box from the origin, in the file's unit.
std::string mesh_of_box(int x, int y, int z) {
  std::string text = "<mesh><vertices>";
  for (int i = 0; i < 8; ++i)
    text += "<vertex x=\"" + std::to_string(i & 1 ? x : 0) + "\" y=\"" + std::to_string(i & 2 ? y : 0) + "\" z=\"" +
            std::to_string(i & 4 ? z : 0) + "\"/>\n";
  text += "</vertices><triangles>";
  constexpr int quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  const auto triangle = [&](int a, int b, int c) {
    text += "<triangle v1=\"" + std::to_string(a) + "\" v2=\"" + std::to_string(b) + "\" v3=\"" + std::to_string(c) +
            "\"/>\n";
  };
  for (const auto& q : quads) triangle(q[0], q[1], q[2]), triangle(q[0], q[2], q[3]);
  return text + "</triangles></mesh>";
}

std::string model(const std::string& resources, const std::string& build, const std::string& attributes = "") {
  return R"(<?xml version="1.0" encoding="UTF-8"?>
<model )" +
         attributes +
         R"( xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02")"
         R"( xmlns:p="http://schemas.microsoft.com/3dmanufacturing/production/2015/06">
<metadata name="Title">x</metadata><resources>)" +
         resources + "</resources><build>" + build + "</build></model>";
}

std::string object(int id, const std::string& content, const std::string& attributes = "") {
  return "<object id=\"" + std::to_string(id) + "\" " + attributes + ">" + content + "</object>\n";
}

const std::string one = object(1, mesh_of_box(20, 10, 5), "name=\"box\"");
const std::string item = "<item objectid=\"1\"/>";

}  // namespace

TEST_CASE("mesh: a 3MF is read with the name of its object", "[mesh][3mf]") {
  const Loaded loaded = read(three_mf(model(one, item)));
  CHECK(loaded.format == Format::three_mf);
  CHECK(loaded.unit == "millimeter");
  REQUIRE(loaded.objects.size() == 1);
  CHECK(loaded.objects[0].name == "box");
  CHECK(loaded.objects[0].repairs == Repairs{.shells = 1});
  CHECK(box_of(loaded.objects[0].mesh) == Box3{{0, 0, 0}, {20'000, 10'000, 5'000}});
  CHECK(loaded.notices.empty());
}

TEST_CASE("mesh: the unit of a 3MF scales it", "[mesh][3mf]") {
  const auto [unit, um] =
      GENERATE(std::pair<std::string, Um>{"micron", 20}, std::pair<std::string, Um>{"millimeter", 20'000},
               std::pair<std::string, Um>{"centimeter", 200'000}, std::pair<std::string, Um>{"inch", 508'000},
               std::pair<std::string, Um>{"foot", 6'096'000});
  const Loaded loaded = read(three_mf(model(one, item, "unit=\"" + unit + "\"")));
  CHECK(loaded.unit == unit);
  CHECK(box_of(loaded.objects[0].mesh).max.x == um);
  CHECK_THAT(refusal(three_mf(model(one, item, "unit=\"meter\""))),
             Contains("object 1, vertex 1: a coordinate is 20000 mm"));
  CHECK_THAT(refusal(three_mf(model(one, item, "unit=\"cubit\""))), Contains("unknown unit 'cubit'"));
}

TEST_CASE("mesh: every item of a 3MF's build is an object in its place", "[mesh][3mf]") {
  const Loaded loaded =
      read(three_mf(model(one, item + "<item objectid=\"1\" transform=\"0 1 0 -1 0 0 0 0 1 100 0.5 3\"/>")));
  REQUIRE(loaded.objects.size() == 2);
  CHECK(loaded.triangles_in_file == 24);
  CHECK(box_of(loaded.objects[1].mesh) == Box3{{90'000, 500, 3'000}, {100'000, 20'500, 8'000}});  // a quarter turn
}

TEST_CASE("mesh: components are joined, transformed from the inside out", "[mesh][3mf]") {
  const std::string pair = object(2,
                                  "<components><component objectid=\"1\"/>"
                                  "<component objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 30 0 0\"/></components>",
                                  "name=\"pair\"");
  const Loaded loaded =
      read(three_mf(model(one + pair, "<item objectid=\"2\" transform=\"2 0 0 0 2 0 0 0 2 1 0 0\"/>")));
  REQUIRE(loaded.objects.size() == 1);
  CHECK(loaded.objects[0].name == "pair");
  CHECK(loaded.objects[0].repairs.shells == 2);
  CHECK(box_of(loaded.objects[0].mesh) == Box3{{1'000, 0, 0}, {101'000, 20'000, 10'000}});
  CHECK(volume_mm3(loaded.objects[0].mesh) == Approx(2 * 8 * 1000));
}

TEST_CASE("mesh: a mirrored item is not inside out", "[mesh][3mf]") {
  const Loaded loaded = read(three_mf(model(one, "<item objectid=\"1\" transform=\"-1 0 0 0 1 0 0 0 1 0 0 0\"/>")));
  CHECK(volume_mm3(loaded.objects[0].mesh) == Approx(1000));
  CHECK(loaded.objects[0].repairs == Repairs{.shells = 1});
}

TEST_CASE("mesh: an object may be in a part of its own", "[mesh][3mf]") {
  const std::string root =
      model(object(2, "<components><component p:path=\"/3D/Objects/a.model\" objectid=\"1\"/></components>"),
            "<item objectid=\"2\"/>", "requiredextensions=\"p\"");
  CHECK(volume_mm3(read(three_mf(root, {{"3D/Objects/a.model", model(one, "")}})).objects[0].mesh) == Approx(1000));
  CHECK_THAT(refusal(three_mf(root)), Contains("part/3D/Objects/a.model: not in the archive"));
}

TEST_CASE("mesh: what a 3MF does not print is left out, with a notice", "[mesh][3mf]") {
  const std::string modifier = object(2, mesh_of_box(1, 1, 1), "type=\"other\"");
  const std::string both = object(3, "<components><component objectid=\"1\"/><component objectid=\"2\"/></components>");
  const Loaded loaded =
      read(three_mf(model(one + modifier + both, "<item objectid=\"3\"/><item objectid=\"1\" printable=\"0\"/>")));
  REQUIRE(loaded.objects.size() == 1);
  CHECK(loaded.triangles_in_file == 12);
  REQUIRE(loaded.notices.size() == 2);
  CHECK_THAT(loaded.notices[0].message, Contains("not printable"));
  CHECK_THAT(loaded.notices[1].message, Contains("object 2 is of type 'other'"));
}

TEST_CASE("mesh: a damaged 3MF is refused with its part and line", "[mesh][3mf]") {
  const auto with = [&](std::string_view old, std::string_view put) {
    std::string text = model(one, item);
    return three_mf(text.replace(text.find(old), old.size(), put));
  };
  CHECK_THAT(refusal(with("v1=\"0\" v2=\"3\"", "v1=\"8\" v2=\"3\"")),
             Contains("part/3D/3dmodel.model:12: object 1, triangle 2: v1 is 8, but there are 8 vertices"));
  CHECK_THAT(refusal(with("v1=\"0\" v2=\"3\"", "v1=\"-1\" v2=\"3\"")), Contains("v1 is '-1', not a whole number"));
  CHECK_THAT(refusal(with("x=\"20\"", "x=\"nan\"")), Contains("object 1, vertex 1: x is 'nan', not a number"));
  CHECK_THAT(refusal(with("x=\"20\" y=\"0\" z=\"0\"", "x=\"a\" y=\"b\" z=\"c\"")), Contains("vertex 1: x is 'a'"));
  CHECK_THAT(refusal(with("x=\"20\"", "y=\"0\"")), Contains("duplicate attribute"));
  CHECK_THAT(refusal(with("x=\"20\"", "x=\"1e7\"")), Contains("beyond ±16 m"));
  CHECK_THAT(refusal(with("<item objectid=\"1\"/>", "<item objectid=\"7\"/>")), Contains("there is no object 7"));
  CHECK_THAT(refusal(with("<item objectid=\"1\"/>", "<item objectid=\"1\" transform=\"1 2\"/>")),
             Contains("not 12 numbers"));
  CHECK_THAT(refusal(with("<item objectid=\"1\"/>", "")), Contains("its build holds nothing to print"));
  CHECK_THAT(refusal(with("</model>", "")), Contains("XML: no element found"));
  CHECK_THAT(refusal(with("<model ", "<model requiredextensions=\"b\" xmlns:b=\"http://beams\" ")),
             Contains("needs the 3MF extension 'b' (http://beams)"));
  CHECK_THAT(refusal(three_mf(model(object(1, ""), item))), Contains("3MF without a triangle"));
  CHECK_THAT(refusal(three_mf("<html/>")), Contains("expected <model>, found <html>"));
  const std::string whole = three_mf(model(one, item));
  CHECK_THAT(refusal(whole.substr(0, whole.size() / 2)), Contains("damaged archive"));
  CHECK_THAT(refusal(zipped({{"letter.txt", "hello"}})), Contains("no 3MF: it names no model part"));
}

TEST_CASE("mesh: a part whose packed bytes are damaged, encrypted or packed otherwise is refused", "[mesh][3mf]") {
  // Of the first part: where its local header and its entry of the directory begin. Source: APPNOTE.TXT, 4.3.7, 4.3.12.
  const std::string whole = three_mf(model(one, item));
  const std::size_t local = 0, entry = whole.find("PK\1\2");
  REQUIRE(whole.substr(local, 4) == "PK\3\4");
  REQUIRE(entry != whole.npos);
  const auto with = [&](std::initializer_list<std::size_t> places, char value) {
    std::string bytes = whole;
    for (const std::size_t at : places) bytes[at] = value;
    return refusal(bytes);
  };
  const std::size_t flags_local = local + 6, flags_entry = entry + 8, method_local = local + 8,
                    method_entry = entry + 10;
  const std::size_t crc_local = local + 14, crc_entry = entry + 16;
  CHECK_THAT(with({flags_local, flags_entry}, 1), Contains("_rels/.rels: damaged archive: it is encrypted"));
  CHECK_THAT(with({method_local, method_entry}, 12), Contains("damaged archive: packed in a way that is not read"));
  CHECK_THAT(with({crc_local, crc_entry}, static_cast<char>(whole[crc_entry] ^ 1)),
             Contains("damaged archive: its check sum is wrong"));
  const std::size_t packed = whole.find("_rels/.rels") + 11;
  for (const std::size_t at : {packed, packed + 40, packed + 100})
    CHECK_THAT(with({at}, static_cast<char>(whole[at] ^ 0x55)), Contains("part/"));
}

TEST_CASE("mesh: a 3MF cannot multiply itself beyond measure", "[mesh][3mf]") {
  SECTION("by entities") {
    std::string text = model(one, item);
    text.insert(text.find("<model"), "<!DOCTYPE model [<!ENTITY a \"aaaaaaaaaa\"><!ENTITY b \"&a;&a;&a;&a;\">]>\n");
    CHECK_THAT(refusal(three_mf(text)), Contains("document type, which a 3MF must not have"));
  }
  SECTION("by components of components") {
    std::string resources = one;
    for (int id = 2; id < 60; ++id) {
      const std::string reference = "<component objectid=\"" + std::to_string(id - 1) + "\"/>";
      resources += object(id, "<components>" + reference + reference + "</components>");
    }
    CHECK_THAT(refusal(three_mf(model(resources, "<item objectid=\"59\"/>"))),
               Contains("the build asks for more than"));
  }
  SECTION("by components that hold themselves") {
    CHECK_THAT(refusal(three_mf(model(object(1, "<components><component objectid=\"1\"/></components>"), item))),
               Contains("components within components without end"));
  }
  SECTION("by depth") {
    std::string deep;
    for (int i = 0; i < 100; ++i) deep += "<object id=\"9\">";
    CHECK_THAT(refusal(three_mf(model(deep, item))), Contains("a second object with id 9"));
    deep.clear();
    for (int i = 0; i < 100; ++i) deep += "<x>";
    CHECK_THAT(refusal(three_mf(model(deep, item))), Contains("nested too deeply"));
  }
  SECTION("by packing") {
    CHECK_THAT(refusal(three_mf(model(one + std::string(90 << 20, ' '), item))),
               Contains("unpacks to more than 64 MB"));
  }
}

TEST_CASE("mesh: a build of more items than could be printed is refused before they are made", "[mesh][3mf]") {
  std::string items;
  for (int i = 0; i < 100'000; ++i) items += item;
  CHECK_THAT(refusal(three_mf(model(one, items))),
             Contains("the build has 100000 items, of which 10000 could be printed"));
}
