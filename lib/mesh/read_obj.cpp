#include "core/error.h"
#include "core/stop.h"
#include "mesh/face.h"
#include "mesh/formats.h"
#include "mesh/text.h"
#include "mesh/weld.h"

#include <algorithm>
#include <array>
#include <charconv>

#include <fmt/format.h>

// Of Wavefront OBJ only what makes a surface: v, f, and o or g for the name. Texture and normal indices are passed
// over.
namespace weft::mesh {
namespace {

class Obj {
 public:
  explicit Obj(const Source& source) : source_(source), words_(source.bytes), weld_(source.bytes.size() / 80 + 16) {}

  Body read() {
    Body body;
    StopNowAndThen stop(256);
    for (std::string_view word = words_.next(); !word.empty(); word = words_.next()) {
      stop.step();
      if (word == "v") {
        vertex();
      } else if (word == "f") {
        face();
      } else if ((word == "o" || word == "g") && body.name.empty()) {
        body.name = words_.rest_of_line();
        continue;
      }
      words_.rest_of_line();
    }
    if (furthest_ > welded_.size())
      refuse(fmt::format("face {}: vertex {} of {}", furthest_face_, furthest_, welded_.size()), furthest_place_,
             "the file was cut off or edited: export it again");
    body.mesh.vertices = weld_.take_vertices();
    for (Triangle corners : triangles_) {
      for (std::uint32_t& corner : corners) corner = welded_[corner];
      body.mesh.triangles.push_back(corners);
    }
    return body;
  }

 private:
  void vertex() {
    double mm[3];
    for (std::size_t i = 0; i < 3; ++i) {
      const std::string_view word = next();
      const auto number = number_in(word);
      mm[i] = number.value_or(0) * source_.scale;
      if (!number || !placeable(mm[i])) refuse_coordinate("xyz"[i], word, mm[i]);
    }
    points_.push_back({lattice(mm[0]), lattice(mm[1]), lattice(mm[2])});
    welded_.push_back(weld_.index(points_.back()));
  }

  [[noreturn]] void refuse_coordinate(char axis, std::string_view word, double mm) const {
    const auto what = fmt::format("vertex {}: {}", welded_.size() + 1, axis);
    if (word.empty()) refuse(what + " is missing", words_.place(), "export the model again");
    if (number_in(word)) refuse(fmt::format("{} {}", what, fault_of(mm)), words_.place(), "check the unit and --scale");
    refuse(fmt::format("{} is {}, not a number", what, quoted(word)), words_.place(),
           word.find(',') != word.npos ? "numbers take a point, not a comma" : "export the model again");
  }

  void face() {
    ++faces_;
    face_.clear();
    corners_.clear();
    bool known = true;
    for (std::string_view word = next(); !word.empty() && !word.starts_with('#'); word = next()) {
      face_.push_back(index(word));
      known &= face_.back() < points_.size();
      if (known) corners_.push_back(points_[face_.back()]);
    }
    if (face_.size() < 3)
      refuse(fmt::format("face {} has {} corners", faces_, face_.size()), words_.place(), "export the model again");
    if (triangles_.size() + face_.size() > max_triangles)
      refuse(fmt::format("more than {} triangles", max_triangles), words_.place(), "reduce the mesh");
    if (!known || face_.size() == 3) {  // vertices that follow later cannot be seen yet: a fan
      for (std::size_t i = 2; i < face_.size(); ++i) triangles_.push_back({face_[0], face_[i - 1], face_[i]});
      return;
    }
    for (const auto& [a, b, c] : triangulated(corners_)) triangles_.push_back({face_[a], face_[b], face_[c]});
  }

  /// Of "7", "7/1", "7//3", "7/1/3" or "-2/…", from 0.
  std::uint32_t index(std::string_view word) {
    const std::string_view number = word.substr(0, word.find('/'));
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
    const auto known = static_cast<std::int64_t>(welded_.size());
    if (end != number.data() + number.size() || error != std::errc{} || value == 0)
      refuse(fmt::format("face {}: {} is not the number of a vertex", faces_, quoted(word)), words_.place(),
             "export the model again");
    const std::int64_t from_one = value > 0 ? value : known + 1 + value;
    if (from_one < 1 || from_one > std::int64_t{max_triangles} * 3)
      refuse(fmt::format("face {}: vertex {} of {}", faces_, value, known), words_.place(), "export the model again");
    if (static_cast<std::size_t>(from_one) > furthest_) {
      furthest_ = static_cast<std::size_t>(from_one);
      furthest_face_ = faces_;
      furthest_place_ = words_.place();
    }
    return static_cast<std::uint32_t>(from_one - 1);
  }

  /// The next word of the line; a backslash at its end joins it to the next one.
  std::string_view next() {
    const std::string_view word = words_.next_in_line();
    return word == "\\" ? words_.next() : word;
  }

  [[noreturn]] void refuse(std::string what, std::size_t place, std::string hint) const {
    throw Error(Error::Kind::model, std::move(what), fmt::format("{}:{}", source_.path, words_.line_of(place)),
                std::move(hint));
  }

  const Source& source_;
  Words words_;
  Weld weld_;
  std::vector<Point3> points_;         ///< by the file's number
  std::vector<std::uint32_t> welded_;  ///< likewise
  std::vector<Triangle> triangles_;    ///< of the file's numbers, from 0
  std::vector<std::uint32_t> face_;
  std::vector<Point3> corners_;
  std::size_t faces_ = 0, furthest_ = 0, furthest_face_ = 0, furthest_place_ = 0;
};

}  // namespace

bool is_obj(std::string_view text) {
  constexpr std::array<std::string_view, 12> before_vertices = {"mtllib", "usemtl", "o", "g",      "s",      "vt",
                                                                "vn",     "vp",     "f", "maplib", "usemap", "cstype"};
  Words words(text);
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    if (word == "v") return !words.next_in_line().empty();
    const bool known = std::find(before_vertices.begin(), before_vertices.end(), word) != before_vertices.end();
    if (!known && !word.starts_with('#')) return false;
    words.rest_of_line();
  }
  return false;
}

Contents read_obj(const Source& source) {
  Contents contents;
  contents.bodies.push_back(Obj(source).read());
  return contents;
}

}  // namespace weft::mesh
