// SPDX-License-Identifier: GPL-3.0-or-later
#include "plate/by_name.h"

#include "core/error.h"
#include "core/microns.h"

#include <stdexcept>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::literals;

namespace {

/// Two lids and a box: models as typed, and their objects.
Plate three_objects() {
  Plate plate;
  for (const char* name : {"lid", "lid", "box"}) {
    Object object{.name = name, .volumes = {}};
    object.volumes.push_back({.name = std::string(name) + "-body", .mesh = {}});
    object.volumes.push_back({.name = "logo.stl", .mesh = {}});
    plate.objects.push_back(std::move(object));
  }
  return plate;
}
const plate::Origins origins{{"parts/a.stl", "parts/a.stl", "b.3mf"}, {0, 0, 1}};

ByName::Setting five_walls(Named of) {
  return {std::move(of), "wall_line_count", "5", "--for"};
}

}  // namespace

TEST_CASE("by name: what is said of objects is written and read back as it is") {
  ByName said;
  said.settings.push_back({{.name = "a \"quoted\" name, with ü"}, "infill_sparse_density", "20", ""});
  said.settings.push_back({{.model = 1, .part = 2}, "wall_line_count", "4", ""});
  said.places.push_back({{.model = 0}, {-1, 123'456}, -12.5});
  said.copies.push_back({{.name = "lid"}, 7});
  CHECK(by_name_of(text_of(said)) == said);
  CHECK(by_name_of(text_of({})) == ByName{});
}

TEST_CASE("by name: text that weft never wrote is refused, not guessed at") {
  for (const char* text :
       {"", "{", "[]", "null", R"({"for": [], "place": []})", R"({"for": [["lid", "key"]], "place": [], "copies": []})",
        R"({"for": [], "place": [], "copies": [["lid", "many"]]})",
        R"({"for": [[[], "a", "b"]], "place": [], "copies": []})"}) {
    CAPTURE(text);
    CHECK_THROWS_AS(by_name_of(text), std::invalid_argument);
  }
}

TEST_CASE("by name: an object is meant by its name, by its model as typed, by its file, and by its place") {
  const Plate plate = three_objects();
  const auto meant = [&](Named named) {
    std::vector<bool> out;
    for (std::size_t i = 0; i < plate.objects.size(); ++i) out.push_back(plate::means(named, plate, origins, i));
    return out;
  };
  CHECK(meant({.name = "lid"}) == std::vector<bool>{true, true, false});
  CHECK(meant({.name = "parts/a.stl"}) == std::vector<bool>{true, true, false});
  CHECK(meant({.name = "a.stl"}) == std::vector<bool>{true, true, false});
  CHECK(meant({.name = "b"}) == std::vector<bool>{false, false, true});
  CHECK(meant({.model = 1}) == std::vector<bool>{false, false, true});
  CHECK(meant({.model = 1, .part = 0}) == std::vector<bool>{false, false, false});  // a part, not the object
}

TEST_CASE("by name: settings are laid over the objects, and the parts, that are meant") {
  Plate plate = three_objects();
  ByName said;
  said.settings = {five_walls({.name = "lid"}), five_walls({.name = "box-body"}), five_walls({.model = 1, .part = 1})};
  plate::lay_by_name(said, plate, origins);
  CHECK(plate.objects[0].said.values.size() == 1);
  CHECK(plate.objects[1].said.values.size() == 1);
  CHECK(plate.objects[2].said.empty());
  CHECK(plate.objects[2].volumes[0].said.values.size() == 1);
  CHECK(plate.objects[2].volumes[1].said.values.size() == 1);
  CHECK(plate.objects[0].volumes[1].said.empty());
}

TEST_CASE("by name: a name that nothing has is an error that says which there are") {
  Plate plate = three_objects();
  ByName said;
  said.settings = {five_walls({.name = "lit"})};
  try {
    plate::lay_by_name(said, plate, origins);
    FAIL("was laid over nothing");
  } catch (const Error& e) {
    CHECK(e.kind() == Error::Kind::usage);
    CHECK(e.problem().find("'lit'") != std::string::npos);
    CHECK(e.hint().find("lid") != std::string::npos);
  }
}
