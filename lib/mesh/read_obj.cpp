// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/error.h"
#include "core/escape.h"
#include "core/stop.h"
#include "mesh/face.h"
#include "mesh/formats.h"
#include "mesh/text.h"
#include "mesh/weld.h"
#include "tasks/parallel.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

#include <fmt/format.h>

// Of Wavefront OBJ only what makes a surface: v, f, and o or g for the name. Texture and normal indices are passed
// over.
namespace weft::mesh {
namespace {

/// A face of more than three corners, which lies as a fan among the triangles.
struct Polygon {
  std::uint32_t first;  ///< of its triangles
  std::uint32_t corners;
  std::uint32_t vertices;  ///< that stand before it in the piece
};

/// What a piece of the text says. Corners are the numbers of vertices in the file, from 0.
struct Piece {
  std::vector<Point3> points{};
  std::vector<Triangle> triangles{};
  std::vector<Polygon> polygons{};
  /// Corners (3 × triangle + which) that are counted from the first vertex of the piece instead, modulo 2³².
  std::vector<std::uint32_t> relative{};
  std::size_t reach_back = 0;  ///< vertices that must stand before the piece
  std::string name{};          ///< the first that is none

  /// The face that asks for the vertex with the highest number, from 1.
  struct Furthest {
    std::size_t vertex = 0, face = 0, place = 0;
  } furthest{};
};

/// Reads a text, or lines of one.
class Obj {
 public:
  /// @param whole whether nothing stands before it
  Obj(const Source& source, std::string_view text, bool whole) : source_(source), words_(text), whole_(whole) {}

  Piece read() {
    StopNowAndThen stop(256);
    for (std::string_view word = words_.next(); !word.empty(); word = words_.next()) {
      stop.step();
      if (word == "v") {
        vertex();
      } else if (word == "f") {
        face();
      } else if ((word == "o" || word == "g") && piece_.name.empty()) {
        piece_.name = words_.rest_of_line();
        continue;
      }
      words_.rest_of_line();
    }
    return std::move(piece_);
  }

  /// Pre: the text is whole.
  [[noreturn]] void refuse_furthest(const Piece& piece) const {
    refuse(fmt::format("face {}: vertex {} of {}", piece.furthest.face, piece.furthest.vertex, piece.points.size()),
           piece.furthest.place, "the file was cut off or edited: export it again");
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
    piece_.points.push_back({lattice(mm[0]), lattice(mm[1]), lattice(mm[2])});
  }

  [[noreturn]] void refuse_coordinate(char axis, std::string_view word, double mm) const {
    const auto what = fmt::format("vertex {}: {}", piece_.points.size() + 1, axis);
    if (word.empty()) refuse(what + " is missing", words_.place(), "export the model again");
    if (number_in(word)) refuse(fmt::format("{} {}", what, fault_of(mm)), words_.place(), "check the unit and --scale");
    refuse(fmt::format("{} is {}, not a number", what, escape::message(word)), words_.place(),
           word.find(',') != word.npos ? "numbers take a point, not a comma" : "export the model again");
  }

  /// Adds the face as a fan: how a polygon is cut is seen when the vertices are known that stand before it.
  void face() {
    ++faces_;
    face_.clear();
    for (std::string_view word = next(); !word.empty() && !word.starts_with('#'); word = next()) add_corner(word);
    if (face_.size() < 3)
      refuse(fmt::format("face {} has {} corners", faces_, face_.size()), words_.place(), "export the model again");
    auto& triangles = piece_.triangles;
    if (triangles.size() + face_.size() > max_triangles)
      refuse(fmt::format("more than {} triangles", max_triangles), words_.place(), "reduce the mesh");
    const auto first = static_cast<std::uint32_t>(triangles.size());
    for (std::size_t i = 2; i < face_.size(); ++i) {
      for (const std::size_t from : {std::size_t{0}, i - 1, i})
        if (face_[from].relative)
          piece_.relative.push_back(static_cast<std::uint32_t>(3 * triangles.size() + (from == 0 ? 0 : from - i + 2)));
      triangles.push_back({face_[0].vertex, face_[i - 1].vertex, face_[i].vertex});
    }
    if (face_.size() > 3)
      piece_.polygons.push_back(
          {first, static_cast<std::uint32_t>(face_.size()), static_cast<std::uint32_t>(piece_.points.size())});
  }

  /// "7", "7/1", "7//3", "7/1/3" or "-2/…".
  void add_corner(std::string_view word) {
    const std::string_view number = word.substr(0, word.find('/'));
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
    if (end != number.data() + number.size() || error != std::errc{} || value == 0)
      refuse(fmt::format("face {}: {} is not the number of a vertex", faces_, escape::message(word)), words_.place(),
             "export the model again");
    const auto known = static_cast<std::int64_t>(piece_.points.size());
    if (value > std::int64_t{max_triangles} * 3 || (value < 0 && whole_ && value < -known) ||
        value < -std::int64_t{max_triangles} * 3)
      refuse(fmt::format("face {}: vertex {} of {}", faces_, value, known), words_.place(), "export the model again");
    if (value < 0) {
      face_.push_back({static_cast<std::uint32_t>(known + value), true});
      piece_.reach_back =
          std::max(piece_.reach_back, static_cast<std::size_t>(std::max<std::int64_t>(-known - value, 0)));
      return;
    }
    face_.push_back({static_cast<std::uint32_t>(value - 1), false});
    if (static_cast<std::size_t>(value) > piece_.furthest.vertex)
      piece_.furthest = {static_cast<std::size_t>(value), faces_, words_.place()};
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

  struct Corner {
    std::uint32_t vertex;
    bool relative;
  };

  const Source& source_;
  Words words_;
  bool whole_;
  Piece piece_;
  std::vector<Corner> face_;
  std::size_t faces_ = 0;
};

/// Puts the pieces of a file together, in its order.
class Assembly {
 public:
  /// @param bytes of the text
  explicit Assembly(std::size_t bytes) : weld_(bytes / 80 + 16) {
    welded_.reserve(bytes / 50);  // room that is not used is address space, no memory
    body_.mesh.triangles.reserve(bytes / 20);
  }

  void take(Piece piece) {
    auto& triangles = body_.mesh.triangles;
    sound_ &= piece.reach_back <= welded_.size() && triangles.size() + piece.triangles.size() <= max_triangles;
    if (!sound_) return;
    furthest_ = std::max(furthest_, piece.furthest.vertex);
    if (body_.name.empty()) body_.name = std::move(piece.name);
    laid_.push_back({triangles.size(), triangles.size() + piece.triangles.size(),
                     static_cast<std::uint32_t>(welded_.size()), std::move(piece.polygons), std::move(piece.relative)});
    triangles.insert(triangles.end(), piece.triangles.begin(), piece.triangles.end());
    const auto numbers = weld_.indices(piece.points);
    welded_.insert(welded_.end(), numbers.begin(), numbers.end());
  }

  /// Whether all vertices are there, and no more triangles than may be.
  bool sound() const { return sound_ && furthest_ <= welded_.size(); }

  /// Pre: sound.
  Body body() {
    tasks::parallel_map(laid_.size(), [&](std::size_t i) {
      StopNowAndThen stop(1024);
      finish(laid_[i], stop);
      return true;
    });
    body_.mesh.vertices = weld_.take_vertices();
    return std::move(body_);
  }

 private:
  /// Where a piece lies in the mesh, and what is left to be done of it.
  struct Laid {
    std::size_t begin, end;  ///< its triangles
    std::uint32_t vertices;  ///< that stand before it
    std::vector<Polygon> polygons;
    std::vector<std::uint32_t> relative;
  };

  void finish(const Laid& laid, StopNowAndThen& stop) {
    auto& triangles = body_.mesh.triangles;
    for (const std::uint32_t at : laid.relative) triangles[laid.begin + at / 3][at % 3] += laid.vertices;
    for (const Polygon& polygon : laid.polygons) stop.step(), cut(laid, polygon);
    for (std::size_t i = laid.begin; i < laid.end; ++i)
      for (std::uint32_t& corner : triangles[i]) corner = welded_[corner];
  }

  /// A polygon of vertices that stand before it is cut as it lies in space; of others it stays a fan.
  void cut(const Laid& laid, const Polygon& polygon) {
    Triangle* const fan = body_.mesh.triangles.data() + laid.begin + polygon.first;
    std::vector<std::uint32_t> face{fan[0][0], fan[0][1]};
    for (std::uint32_t i = 0; i + 2 < polygon.corners; ++i) face.push_back(fan[i][2]);
    const std::uint32_t known = laid.vertices + polygon.vertices;
    std::vector<Point3> corners;
    for (const std::uint32_t vertex : face) {
      if (vertex >= known) return;
      corners.push_back(weld_.vertices()[welded_[vertex]]);
    }
    const auto triangles = triangulated(corners);
    std::transform(triangles.begin(), triangles.end(), fan, [&](const Triangle& t) {
      return Triangle{face[t[0]], face[t[1]], face[t[2]]};
    });
  }

  Weld weld_;
  std::vector<std::uint32_t> welded_;  ///< by the file's number
  Body body_;
  std::vector<Laid> laid_;
  std::size_t furthest_ = 0;
  bool sound_ = true;
};

/// Where the line of the first word ends that stands at a place or behind it; the next line when a backslash joins
/// them.
std::size_t line_end(std::string_view text, std::size_t from) {
  constexpr std::string_view blanks = " \t\v\f\n\r";
  while ((from = text.find_first_not_of(blanks, from)) < text.size()) {
    const std::size_t end = std::min(text.find_first_of("\n\r", from), text.size());
    if (text[text.find_last_not_of(blanks, end - 1)] != '\\') return end;
    from = end;
  }
  return text.size();
}

/// Where pieces of about so many bytes begin, and the end of the last one: each holds whole lines.
std::vector<std::size_t> cut_at_lines(std::string_view text, std::size_t bytes) {
  std::vector<std::size_t> cuts{0};
  while (cuts.back() < text.size()) cuts.push_back(line_end(text, cuts.back() + bytes));
  return cuts;
}

/// The text in pieces, side by side; nothing when one is not sound, for what is wrong is told as of the whole.
std::optional<Body> read_in_pieces(const Source& source, const std::vector<std::size_t>& cuts) {
  const auto read = [&](std::size_t i) {
    return Obj(source, source.bytes.substr(cuts[i], cuts[i + 1] - cuts[i]), i == 0).read();
  };
  Assembly assembly(source.bytes.size());
  try {
    tasks::parallel_in_order(cuts.size() - 1, read, [&](std::size_t, Piece piece) { assembly.take(std::move(piece)); });
  } catch (const Error&) {
    return std::nullopt;
  }
  if (!assembly.sound()) return std::nullopt;
  return assembly.body();
}

Body read_as_a_whole(const Source& source) {
  Obj obj(source, source.bytes, true);
  Piece piece = obj.read();
  if (piece.furthest.vertex > piece.points.size()) obj.refuse_furthest(piece);
  Assembly assembly(source.bytes.size());
  assembly.take(std::move(piece));
  return assembly.body();
}

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

Contents read_obj(const Source& source, std::size_t piece_bytes) {
  const auto cuts = cut_at_lines(source.bytes, piece_bytes);
  auto body = cuts.size() > 2 ? read_in_pieces(source, cuts) : std::nullopt;
  Contents contents;
  contents.bodies.push_back(body ? std::move(*body) : read_as_a_whole(source));
  return contents;
}

}  // namespace weft::mesh
