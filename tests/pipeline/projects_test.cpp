// SPDX-License-Identifier: GPL-3.0-or-later
// Projects of other slicers, made here in their dialects, against plates that say the same in weft's words.
#include "core/error.h"
#include "cuboid.h"
#include "mesh/zip_fixture.h"
#include "pipeline/pipeline.h"
#include "pipeline/project.h"
#include "plain_job.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <catch2/catch.hpp>
#include <unistd.h>

using namespace weft;
using namespace weft::literals;
using Catch::Matchers::Contains;

namespace {

namespace fs = std::filesystem;

struct Corner {
  int x, y, z;  // mm
};
struct Piece {
  std::string name;
  std::string kind;  // as PrusaSlicer calls it
  Corner from, to;
  std::vector<std::pair<std::string, std::string>> settings{};
};
using Pieces = std::vector<Piece>;

struct Folder {
  fs::path path;
  Folder() {
    std::string name = (fs::temp_directory_path() / "weft-projects-XXXXXX").string();
    path = ::mkdtemp(name.data());
  }
  ~Folder() { fs::remove_all(path); }
  std::string write(const std::string& name, const std::string& bytes) const {
    std::ofstream(path / name, std::ios::binary) << bytes;
    return (path / name).string();
  }
};

std::string vertices(const Piece& p) {
  std::ostringstream out;
  for (const int z : {p.from.z, p.to.z})
    for (const auto& [x, y] : {std::pair(p.from.x, p.from.y), {p.to.x, p.from.y}, {p.to.x, p.to.y}, {p.from.x, p.to.y}})
      out << "<vertex x=\"" << x << "\" y=\"" << y << "\" z=\"" << z << "\"/>";
  return out.str();
}
std::string triangles(int first) {
  std::ostringstream out;
  for (const auto& f : cuboid_faces)
    out << "<triangle v1=\"" << first + f[0] << "\" v2=\"" << first + f[1] << "\" v3=\"" << first + f[2] << "\"/>";
  return out.str();
}
std::string mesh_of(const Pieces& pieces) {
  std::string v, t;
  for (std::size_t i = 0; i < pieces.size(); ++i) v += vertices(pieces[i]), t += triangles(static_cast<int>(8 * i));
  return "<mesh><vertices>" + v + "</vertices><triangles>" + t + "</triangles></mesh>";
}
std::string model(const std::string& resources, const std::string& build) {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?><model unit=\"millimeter\" "
         "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\"><resources>" +
         resources + "</resources><build>" + build + "</build></model>";
}
std::string metadata(const std::string& type, const std::string& key, const std::string& value) {
  return "<metadata " + (type.empty() ? "" : "type=\"" + type + "\" ") + "key=\"" + key + "\" value=\"" + value +
         "\"/>";
}
std::string all_of(const std::string& type, const std::vector<std::pair<std::string, std::string>>& settings) {
  std::string out;
  for (const auto& [key, value] : settings) out += metadata(type, key, value);
  return out;
}

using Files = std::vector<std::pair<std::string, std::string>>;

/// As PrusaSlicer 2.5 and 2.9 write an object: one mesh, and which of its triangles are which volume.
std::string of_prusaslicer(const Pieces& pieces, const std::vector<std::pair<std::string, std::string>>& settings,
                           Files more = {}) {
  std::string config = "<config><object id=\"1\" instances_count=\"1\">" + metadata("object", "name", "thing") +
                       all_of("object", settings);
  for (std::size_t i = 0; i < pieces.size(); ++i)
    config += "<volume firstid=\"" + std::to_string(12 * i) + "\" lastid=\"" + std::to_string(12 * i + 11) + "\">" +
              metadata("volume", "name", pieces[i].name) + metadata("volume", "volume_type", pieces[i].kind) +
              metadata("volume", "matrix", "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1") +
              metadata("volume", "source_file", "a.stl") + all_of("volume", pieces[i].settings) + "</volume>";
  more.emplace_back("Metadata/Slic3r_PE_model.config", config + "</object></config>");
  return fixtures::three_mf(model("<object id=\"1\" type=\"model\">" + mesh_of(pieces) + "</object>",
                                  "<item objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 50 50 0\" printable=\"1\"/>"),
                            more);
}

/// As OrcaSlicer writes one: a component a volume.
std::string of_orca(const Pieces& pieces, const std::vector<std::pair<std::string, std::string>>& settings,
                    Files more = {}) {
  const auto subtype = [](const std::string& kind) -> std::string {
    return kind == "ModelPart" ? "normal_part" : kind == "NegativeVolume" ? "negative_part" : "modifier_part";
  };
  std::string resources, components,
      config = "<config><object id=\"9\">" + metadata("", "name", "thing") + all_of("", settings);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const auto id = std::to_string(i + 1);
    resources += "<object id=\"" + id + "\" type=\"model\">" + mesh_of({pieces[i]}) + "</object>";
    components += "<component objectid=\"" + id + "\"/>";
    config += "<part id=\"" + id + "\" subtype=\"" + subtype(pieces[i].kind) + "\">" +
              metadata("", "name", pieces[i].name) + metadata("", "source_file", "a.stl") +
              all_of("", pieces[i].settings) + "<mesh_stat edges_fixed=\"0\"/></part>";
  }
  more.emplace_back("Metadata/model_settings.config", config + "</object></config>");
  resources += "<object id=\"9\" type=\"model\"><components>" + components + "</components></object>";
  return fixtures::three_mf(model(resources, "<item objectid=\"9\" printable=\"1\"/>"), more);
}

Job plain_job(const std::string& file) {
  Job job = test::plain_job({file});
  job.settings.adhesion.skirt_line_count = 0;
  return job;
}

struct Outcome {
  std::string text;
  Report report;
  /// Everything but comments.
  std::string commands() const {
    std::string out;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);)
      if (!line.starts_with(";")) out += line.substr(0, line.find(" ;")) + "\n";
    return out;
  }
};
Outcome printed(const Job& job) {
  Outcome out;
  const auto passed = run(job, {}, out.report);
  REQUIRE(passed.has_value());
  out.text = passed->gcode();
  return out;
}

Volume volume(const Piece& p, VolumeKind kind, Corner middle, const std::string& key = {},
              const std::string& text = {}) {
  Volume out{.name = p.name, .mesh = {}, .kind = kind};
  for (const int z : {p.from.z, p.to.z})
    for (const auto& [x, y] : {std::pair(p.from.x, p.from.y), {p.to.x, p.from.y}, {p.to.x, p.to.y}, {p.from.x, p.to.y}})
      out.mesh.vertices.push_back({(x - middle.x) * 1_mm, (y - middle.y) * 1_mm, z * 1_mm});
  for (const auto& f : cuboid_faces)
    out.mesh.triangles.push_back(
        {static_cast<std::uint32_t>(f[0]), static_cast<std::uint32_t>(f[1]), static_cast<std::uint32_t>(f[2])});
  if (!key.empty()) out.overlay.add(key, text, "test");
  return out;
}

const Piece body{"body", "ModelPart", {0, 0, 0}, {30, 20, 6}}, plug{"plug", "ModelPart", {22, 0, 0}, {38, 20, 4}},
    hole{"hole", "NegativeVolume", {4, 4, 0}, {10, 10, 6}}, grip{"grip", "ParameterModifier", {12, -2, 1}, {20, 30, 5}};

/// What the projects below mean, said in weft's words.
Plate meant() {
  const Corner middle{19, 10, 0};
  Object object{.name = "thing", .volumes = {}};
  object.overlay.add("infill_sparse_density", "15", "test");
  object.volumes.push_back(volume(body, VolumeKind::model, middle));
  object.volumes.push_back(volume(plug, VolumeKind::model, middle, "infill_sparse_density", "50"));
  object.volumes.push_back(volume(hole, VolumeKind::negative, middle));
  object.volumes.push_back(volume(grip, VolumeKind::modifier, middle, "wall_line_count", "4"));
  object.ranges.push_back({2_mm, 3_mm, {}});
  object.ranges.back().overlay.scope = Scope::layer;
  object.ranges.back().overlay.add("wall_line_count", "3", "test");
  object.hull = {{-19_mm, -10_mm}, {19_mm, -10_mm}, {19_mm, 10_mm}, {-19_mm, 10_mm}};
  object.copies = {{100_mm, 100_mm}};
  return {{object}};
}

Outcome printed_as_meant() {
  Outcome out;
  const auto passed = run(plain_job(""), meant(), {}, {}, out.report);
  REQUIRE(passed.has_value());
  out.text = passed->gcode();
  return out;
}

const char* const ranges =
    "<objects><object id=\"1\"><range min_z=\"2\" max_z=\"3\"><option opt_key=\"extruder\">0</option><option "
    "opt_key=\"KEY\">3</option></range></object></objects>";
std::string ranges_with(const std::string& key) {
  std::string out = ranges;
  return out.replace(out.find("KEY"), 3, key);
}

}  // namespace

TEST_CASE("project: one of PrusaSlicer is printed as a plate that says the same in weft's words") {
  const Folder folder;
  auto dense = plug;
  dense.settings = {{"fill_density", "50%"}, {"extruder", "0"}};
  auto thick = grip;
  thick.settings = {{"perimeters", "4"}};
  const auto file = folder.write(
      "p.3mf", of_prusaslicer({body, dense, hole, thick}, {{"fill_density", "15%"}},
                              {{"Metadata/Prusa_Slicer_layer_config_ranges.xml", ranges_with("perimeters")}}));
  const auto out = printed(plain_job(file));
  CHECK_THAT(out.text, Contains("; weft_overlay = object 'thing': infill_sparse_density = 15 (") &&
                           Contains("; weft_overlay = object 'thing', 2 … 3 mm: wall_line_count = 3 (") &&
                           Contains("; weft_overlay = part 'plug': infill_sparse_density = 50 (") &&
                           Contains("; weft_overlay = modifier 'grip': wall_line_count = 4 ("));
  CHECK(out.commands() == printed_as_meant().commands());
}

TEST_CASE("project: heights of layers that come with an object are its own, unless they are for another height") {
  const Folder folder;
  const auto heights = [&](const std::string& profile) {
    const auto file =
        folder.write("h.3mf", of_prusaslicer({body}, {}, {{"Metadata/Slic3r_PE_layer_heights_profile.txt", profile}}));
    return printed(plain_job(file));
  };
  const auto own = heights("object_id=1|0;0.2;0.2;0.2;2;0.1;6;0.1\n");
  const auto plain = heights("");
  CHECK(own.report.layers > plain.report.layers + 10);
  CHECK_THAT(own.text, Contains(";Z:5.9") || Contains(";Z:6\n"));
  const auto other = heights("object_id=1|0;0.2;9;0.1\n");
  CHECK(other.report.layers == plain.report.layers);
  CHECK(std::any_of(other.report.warnings.begin(), other.report.warnings.end(),
                    [](const Notice& notice) { return notice.code == "layer_heights_left_out"; }));
}

TEST_CASE("project: heights of layers hold where nothing else is said of the object, too") {
  const Folder folder;
  const auto bare = [&](const Files& more) {
    const auto file = folder.write(
        "b.3mf", fixtures::three_mf(model("<object id=\"7\" type=\"model\">" + mesh_of({body}) + "</object>",
                                          "<item objectid=\"7\" printable=\"1\"/>"),
                                    more));
    return printed(plain_job(file)).report.layers;
  };
  const auto plain = bare({});
  CHECK(bare({{"Metadata/Slic3r_PE_layer_heights_profile.txt", "object_id=1|0;0.2;0.2;0.2;2;0.1;6;0.1\n"}}) >
        plain + 10);
  CHECK(bare({{"Metadata/Slic3r_PE_layer_heights_profile.txt", "object_id=2|0;0.2;0.2;0.2;2;0.1;6;0.1\n"}}) == plain);
}

TEST_CASE("project: one of OrcaSlicer is printed as a plate that says the same in weft's words") {
  const Folder folder;
  auto dense = plug;
  dense.settings = {{"sparse_infill_density", "50%"}};
  auto thick = grip;
  thick.settings = {{"wall_loops", "4"}};
  const auto file =
      folder.write("o.3mf", of_orca({body, dense, hole, thick}, {{"sparse_infill_density", "15%"}, {"extruder", "1"}},
                                    {{"Metadata/layer_config_ranges.xml", ranges_with("wall_loops")}}));
  CHECK(printed(plain_job(file)).commands() == printed_as_meant().commands());
}

TEST_CASE("project: one of Cura has objects with settings, and meshes that change what they meet") {
  const Folder folder;
  const auto setting = [](const std::string& key, const std::string& value) {
    return "<metadata name=\"cura:" + key + "\" type=\"xs:string\" preserve=\"0\">" + value + "</metadata>";
  };
  const std::string resources =
      "<object id=\"1\" name=\"thing\" type=\"model\"><metadatagroup>" + setting("drop_to_buildplate", "True") +
      setting("infill_sparse_density", "15") + setting("no_such_thing", "7") +
      setting("infill_density_image", "/etc/passwd") + "</metadatagroup>" + mesh_of({body}) +
      "</object><object id=\"2\" name=\"grip\" type=\"model\"><metadatagroup>" + setting("infill_mesh", "True") +
      setting("wall_line_count", "4") + "</metadatagroup>" + mesh_of({grip}) + "</object>";
  const auto file =
      folder.write("c.3mf", fixtures::three_mf(model(resources, "<item objectid=\"1\"/><item objectid=\"2\"/>")));
  const auto out = printed(plain_job(file));
  auto plate = meant();
  auto& object = plate.objects.front();
  const Corner middle{15, 10, 0};
  object.volumes = {volume(body, VolumeKind::model, middle),
                    volume(grip, VolumeKind::modifier, middle, "wall_line_count", "4")};
  object.ranges.clear();
  object.hull = {{-15_mm, -10_mm}, {15_mm, -10_mm}, {15_mm, 10_mm}, {-15_mm, 10_mm}};
  Outcome by_hand;
  const auto passed = run(plain_job(""), plate, {}, {}, by_hand.report);
  REQUIRE(passed.has_value());
  by_hand.text = passed->gcode();
  CHECK(out.commands() == by_hand.commands());
  std::string told;
  for (const auto& notice : out.report.warnings) told += notice.message + "\n";
  CHECK_THAT(told,
             Contains("object 'thing': no_such_thing = 7 is left out: weft has no such setting") &&
                 Contains("object 'thing': infill_density_image = /etc/passwd is left out: a project does not say "
                          "which files of this machine are read"));
}

TEST_CASE("project: Cura's retraction before outer walls is told by the name that it has here") {
  const Folder folder;
  for (const auto& [theirs, ours] : {std::pair{"True", "0"}, {"False", "auto"}}) {
    CAPTURE(theirs);
    const std::string said = std::string(
                                 "<metadatagroup><metadata name=\"cura:travel_retract_before_outer_wall\" "
                                 "type=\"xs:string\">") +
                             theirs + "</metadata></metadatagroup>";
    const auto file = folder.write("w.3mf", fixtures::three_mf(model("<object id=\"1\" name=\"thing\" type=\"model\">" +
                                                                         said + mesh_of({body}) + "</object>",
                                                                     "<item objectid=\"1\"/>")));
    const auto out = printed(plain_job(file));
    REQUIRE(out.report.warnings.size() == 1);
    CHECK_THAT(out.report.warnings.front().message,
               Contains(std::string("travel_retract_before_outer_wall = ") + ours + " is left out") &&
                   Contains("retraction_combing_max_distance_wall_0 holds for the whole plate"));
  }
}

TEST_CASE("project: Cura's support mesh is printed though support is off, and what meets nothing is told") {
  const Folder folder;
  const auto says = [](const std::string& key) {
    return "<metadatagroup><metadata name=\"cura:" + key + "\" type=\"xs:string\">True</metadata></metadatagroup>";
  };
  const auto of = [&](int id, const std::string& name, const std::string& more, const Pieces& pieces) {
    return "<object id=\"" + std::to_string(id) + "\" name=\"" + name + "\" type=\"model\">" + more + mesh_of(pieces) +
           "</object>";
  };
  const Pieces gate{
      {"", "", {-15, -5, 0}, {-10, 5, 8}}, {"", "", {10, -5, 0}, {15, 5, 8}}, {"", "", {-15, -5, 8}, {15, 5, 10}}};
  const Pieces prop{{"", "", {-3, -3, 0}, {3, 3, 7}}};
  const auto sliced = [&](const std::string& kind, const std::string& at) {
    const auto items = "<item objectid=\"1\"/><item objectid=\"2\" transform=\"1 0 0 0 1 0 0 0 1 " + at + "\"/>";
    return printed(plain_job(folder.write(
        "s.3mf", fixtures::three_mf(model(of(1, "gate", "", gate) + of(2, "prop", says(kind), prop), items)))));
  };
  CHECK(sliced("support_mesh", "0 0 0").text.find(";TYPE:Support") != std::string::npos);
  CHECK(sliced("anti_overhang_mesh", "0 0 0").text.find(";TYPE:Support") == std::string::npos);
  const auto apart = sliced("support_mesh", "60 0 0");
  CHECK(apart.text.find(";TYPE:Support") == std::string::npos);
  CHECK(std::any_of(apart.report.warnings.begin(), apart.report.warnings.end(), [](const auto& warning) {
    return warning.message.find("'prop' changes other models where it meets them: it meets none") != std::string::npos;
  }));
}

TEST_CASE("project: a negative volume cuts the parts before it and no other") {
  const Folder folder;
  auto first = body, second = body;
  second.name = "second", second.from.x = 30, second.to.x = 60;
  auto cut = hole;
  cut.from = {25, 5, 0}, cut.to = {35, 15, 6};
  const auto solid = [&](const Pieces& pieces) {
    auto job = plain_job(folder.write("n.3mf", of_prusaslicer(pieces, {})));
    job.settings.infill.infill_sparse_density = 100;
    return printed(job).report.filament_mm3;
  };
  const double whole = solid({first, second}), between = solid({first, cut, second}),
               behind = solid({first, second, cut});
  CHECK(whole - between == Approx(5 * 10 * 6).epsilon(0.1));  // half of it lies in the first
  CHECK(whole - behind == Approx(10 * 10 * 6).epsilon(0.1));
}

TEST_CASE("project: copies of an object are sliced once, and what is not read is told by name") {
  const Folder folder;
  const std::string resources = "<object id=\"1\" name=\"a\" type=\"model\">" + mesh_of({body}) + "</object>";
  const auto item = [](const std::string& at) {
    return "<item objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 " + at + " 0\"/>";
  };
  const auto file = folder.write(
      "c.3mf", fixtures::three_mf(model(resources, item("20 20") + item("80.0000004 20") + item("20 80")),
                                  {{"Metadata/Secret_plans.xml", "<plans/>"}, {"Metadata/thumbnail.png", "x"}}));
  const auto out = printed(plain_job(file));
  CHECK(out.report.objects.size() == 3);
  bool told = false, pictures = false;
  for (const auto& notice : out.report.warnings) {
    told = told || notice.message.find("Metadata/Secret_plans.xml is not read") != std::string::npos;
    pictures = pictures || notice.message.find("thumbnail") != std::string::npos;
  }
  CHECK(told);
  CHECK_FALSE(pictures);
}

TEST_CASE("project: OrcaSlicer's own configuration holds where no profile is named") {
  const Folder folder;
  const auto file =
      folder.write("o.3mf", of_orca({body}, {},
                                    {{"Metadata/project_settings.config",
                                      R"({"layer_height": "0.24", "wall_loops": "4", "sparse_infill_density": "35%",
                             "nozzle_temperature": ["221"], "printable_area": ["0x0", "180x0", "180x180", "0x180"],
                             "machine_start_gcode": "G28\nG1 Z5", "brim_type": "brim_ears", "brim_width": "6",
                             "some_new_thing": "1"})"}}));
  Profile alone, with_profile;
  apply_project(alone, {file}, true, 0);
  apply_project(with_profile, {file}, false, 0);
  const auto& s = alone.settings;
  CHECK(s.layers.layer_height == 240);
  CHECK(s.walls.wall_line_count == 4);
  CHECK(s.infill.infill_sparse_density == 35);
  CHECK(s.material.material_print_temperature == 221);
  CHECK(box_of(print_surface(s.machine)).size() == Point{180_mm, 180_mm});
  CHECK(s.gcode.machine_start_gcode == "G28\nG1 Z5");
  CHECK(s.adhesion.brim_ears);
  CHECK(with_profile.settings.layers.layer_height == 200);
  std::string told;
  for (const auto& notice : alone.notices) told += notice.message + "\n";
  CHECK_THAT(told, Contains("some_new_thing") && Contains("the project's own settings hold"));
}

TEST_CASE("project: a tool that there is not is refused for an object's support, too") {
  const Folder folder;
  const auto file = folder.write("o.3mf", of_orca({body}, {}));
  for (const char* key : {"support_infill_extruder_nr", "support_interface_extruder_nr"}) {
    Job job = plain_job(file);
    job.settings.support.support_enable = true;
    job.by_name.settings = {{{"thing", {}, {}}, key, "3", {}}};
    Report report;
    try {
      (void)run(job, {}, report);
      FAIL_CHECK("nothing was thrown");
    } catch (const Error& error) {
      CHECK(error.kind() == Error::Kind::settings);
      CHECK_THAT(error.what(), Contains("object 'thing': there is no tool 3, the printer has T0 alone"));
    }
  }
}

TEST_CASE("project: what weft does not know or cannot have there is left out and told by name") {
  const Folder folder;
  auto dense = plug;
  dense.settings = {{"fill_density", "50%"}, {"layer_height", "0.1"}, {"frobnicate", "1"}, {"extruder", "3"}};
  const auto out = printed(plain_job(folder.write("p.3mf", of_prusaslicer({body, dense}, {}))));
  std::string told;
  for (const auto& notice : out.report.warnings) told += notice.message + "\n";
  CHECK_THAT(
      told,
      Contains("part 'plug': frobnicate = 1 is left out: weft does not know it") &&
          Contains("part 'plug': layer_height = 0.1 is left out: part 'plug': layer_height holds for a whole layer") &&
          Contains("part 'plug': extruder = 3 is left out: the printer has T0 alone"));
  CHECK_THAT(out.text, Contains("part 'plug': infill_sparse_density = 50"));
}

TEST_CASE("project: of several plates one is named") {
  const Folder folder;
  const std::string resources = "<object id=\"1\" name=\"a\" type=\"model\">" + mesh_of({body}) +
                                "</object><object id=\"2\" name=\"b\" type=\"model\">" + mesh_of({plug}) + "</object>";
  const auto plate = [](int number, const std::vector<std::pair<int, int>>& instances) {
    std::string out = "<plate>" + metadata("", "plater_id", std::to_string(number)) + metadata("", "plater_name", "");
    for (const auto& [object, instance] : instances)
      out += "<model_instance>" + metadata("", "object_id", std::to_string(object)) +
             metadata("", "instance_id", std::to_string(instance)) + "</model_instance>";
    return out + "</plate>";
  };
  const auto file = folder.write(
      "b.3mf", fixtures::three_mf(model(resources,
                                        "<item objectid=\"1\"/><item objectid=\"2\" transform=\"1 0 0 0 1 0 0 0 1 80 0 "
                                        "0\"/><item objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 0 80 0\"/>"),
                                  {{"Metadata/model_settings.config",
                                    "<config>" + plate(1, {{1, 0}, {2, 0}}) + plate(2, {{1, 1}}) + "</config>"}}));
  auto job = plain_job(file);
  Report report;
  const auto message = [&] {
    try {
      run(job, {}, report);
    } catch (const Error& problem) {
      return std::string(problem.what());
    }
    return std::string("nothing was thrown");
  };
  CHECK_THAT(message(), Contains("b.3mf: 2 plates") && Contains("--plate 1 … 2"));
  job.placement.plate = 3;
  CHECK_THAT(message(), Contains("there is no plate 3 with something on it"));
  job.placement.plate = 1;
  const double both = printed(job).report.models.front().volume_mm3;
  job.placement.plate = 2;
  const double one = printed(job).report.models.front().volume_mm3;
  CHECK(both == Approx(30 * 20 * 6 + 16 * 20 * 4));
  CHECK(one == Approx(30 * 20 * 6));
}

TEST_CASE("project: what happens at heights, and the configuration where no profile is named") {
  const Folder folder;
  std::string config =
      "; generated by PrusaSlicer 2.9.0\n\n; perimeters = 5\n; layer_height = 0.25\n; nozzle_diameter = "
      "0.4\n; fill_density = 33%\n";
  for (int k = 0; k < 20; ++k) config += "; made_up_" + std::to_string(k) + " = 1\n";  // a real one has hundreds
  const auto file = folder.write(
      "p.3mf",
      of_prusaslicer(
          {body}, {},
          {{"Metadata/Prusa_Slicer_custom_gcode_per_print_z.xml",
            "<custom_gcodes_per_print_z><code print_z=\"2.4\" type=\"1\" extruder=\"1\" extra=\"put the nut in\"/>"
            "<code print_z=\"4\" type=\"0\" extruder=\"1\" color=\"#FF0000\"/><code print_z=\"5\" type=\"2\" "
            "extruder=\"2\"/><mode value=\"SingleExtruder\"/></custom_gcodes_per_print_z>"},
           {"Metadata/Slic3r_PE.config", config}}));
  Profile with_profile, alone;
  apply_project(with_profile, {file}, false, 0);
  apply_project(alone, {file}, true, 0);
  for (const auto* profile : {&with_profile, &alone}) {
    const auto& t = profile->settings.tools;
    REQUIRE(t.pause_at_heights.size() == 1);
    CHECK(t.pause_at_heights[0].z == 2399);  // the layer whose top is at 2.4 is the first after it
    CHECK(t.pause_at_heights[0].text == "put the nut in");
    REQUIRE(t.color_change_at_heights.size() == 1);
    CHECK(t.color_change_at_heights[0].z == 3999);
    CHECK(t.tool_change_at_heights.empty());
  }
  const auto told = [](const Profile& profile) {
    std::string out;
    for (const auto& notice : profile.notices) out += notice.message + "\n";
    return out;
  };
  CHECK(alone.settings.layers.layer_height == 250);
  CHECK(alone.settings.walls.wall_line_count == 5);
  CHECK(with_profile.settings.layers.layer_height == 200);
  CHECK_THAT(told(alone), Contains("the project's own settings hold"));
  CHECK_THAT(told(with_profile), Contains("the project's own settings do not hold") &&
                                     Contains("what is to happen at 5 mm is left out: there is no tool 1"));
}
