// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/error.h"
#include "core/escape.h"
#include "core/stop.h"
#include "mesh/formats.h"
#include "mesh/text.h"
#include "mesh/weld_parts.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

// solid NAME / facet normal x y z / outer loop / vertex x y z (three times) / endloop / endfacet / endsolid NAME.
// A file may hold several solids. Normals are not read: the order of the corners says the same and more exactly. Nor is
// NAME: programs write their own there ("OpenSCAD_Model"), by which nobody would know a part among others; its file's
// name does.
namespace weft::mesh {
namespace {

/// Reads a text, or a part of one that begins or ends between two facets.
class AsciiStl {
 public:
  AsciiStl(const Source& source, std::string_view text, Weld& weld) : source_(source), words_(text), weld_(weld) {}

  /// @param inside whether the text begins within a solid
  /// @return whether it ends within a solid
  bool read(bool inside, std::vector<Triangle>& triangles) {
    StopNowAndThen stop(256);
    for (std::string_view word = words_.next(); !word.empty(); word = words_.next()) {
      stop.step();
      if (same_word(word, "facet") && inside) {
        facet(triangles);
      } else if (same_word(word, "solid") && !inside) {
        skip_line();
        inside = true;
      } else if (same_word(word, "endsolid") || same_word(word, "end")) {
        skip_line();
        inside = false;
      } else if (same_word(word, "color") || !inside) {
        skip_line();  // extensions of some programs, and remarks between solids
      } else {
        if (words_.at_end()) break;  // cut off in the middle of the word
        refuse(fmt::format("expected 'facet' or 'endsolid', found {}", escape::message(word)));
      }
    }
    return inside;
  }

  /// Whether the text ends in a line that was read as a whole: of a part that may be longer.
  bool ends_in_a_line() const { return ends_in_a_line_; }

  [[noreturn]] void refuse_missing_end(std::size_t triangles) const {
    refuse(fmt::format("the file ends without 'endsolid', after {} triangles", triangles),
           "it was cut off: copy or export it again");
  }

 private:
  void skip_line() {
    words_.rest_of_line();
    ends_in_a_line_ = words_.at_end();
  }

  void facet(std::vector<Triangle>& triangles) {
    triangle_ = triangles.size() + 1;
    std::string_view word = words_.next();
    for (int skipped = 0; skipped < 4 && !same_word(word, "outer"); ++skipped) word = words_.next();  // the normal
    expect(word, "outer");
    expect("loop");
    Triangle corners;
    for (std::uint32_t& corner : corners) {
      expect("vertex");
      const double x = coordinate('x'), y = coordinate('y'), z = coordinate('z');
      corner = weld_.index({lattice(x), lattice(y), lattice(z)});
    }
    expect("endloop");
    expect("endfacet");
    triangles.push_back(corners);
  }

  void expect(std::string_view keyword) { expect(words_.next(), keyword); }

  void expect(std::string_view word, std::string_view keyword) {
    if (same_word(word, keyword)) return;
    if (words_.at_end()) refuse_end();
    refuse(fmt::format("triangle {}: expected '{}', found {}", triangle_, keyword, escape::message(word)));
  }

  double coordinate(char axis) {
    const std::string_view word = words_.next();
    if (words_.at_end()) refuse_end();
    const auto number = number_in(word);
    if (!number)
      refuse(fmt::format("triangle {}: {} is {}, not a number", triangle_, axis, escape::message(word)),
             word.find(',') != word.npos ? "numbers take a point, not a comma" : "export the model again");
    const double mm = *number * source_.scale;
    if (!placeable(mm))
      refuse(fmt::format("triangle {}: {} {}", triangle_, axis, fault_of(mm)), "check the unit and --scale");
    return mm;
  }

  [[noreturn]] void refuse_end() const {
    refuse(fmt::format("the file ends in the middle of triangle {}", triangle_),
           "it was cut off: copy or export it again");
  }

  [[noreturn]] void refuse(std::string what, std::string hint = "export the model again") const {
    throw Error(Error::Kind::model, std::move(what), fmt::format("{}:{}", source_.path, words_.line_of(words_.place())),
                std::move(hint));
  }

  const Source& source_;
  Words words_;
  Weld& weld_;
  bool ends_in_a_line_ = false;
  std::size_t triangle_ = 0;
};

constexpr std::size_t typical_facet_bytes = 250, least_facet_bytes = 70;

/// Where the first facet ends that does so behind a place; the end of the text when none does.
std::size_t facet_end(std::string_view text, std::size_t from) {
  constexpr std::string_view keyword = "endfacet";
  while ((from = text.find_first_of("eE", from)) < text.size()) {
    const std::string_view word = text.substr(from, keyword.size());
    from += 1;
    if (same_word(word, keyword)) return from - 1 + keyword.size();
  }
  return text.size();
}

/// The text in parts, side by side; nothing when one is not just as it would be read in its turn: then it says nothing
/// of what is wrong, which may have begun before.
std::optional<Body> read_in_parts(const Source& source) {
  constexpr std::size_t part_bytes = 1 << 19;
  const std::string_view text = source.bytes;
  PartReader reader;
  reader.parts = std::max(text.size() / part_bytes, std::size_t{1});
  reader.most_triangles = text.size() / least_facet_bytes;
  reader.expected_vertices = text.size() / (2 * typical_facet_bytes) + 16;
  const auto begin_of = [&](std::size_t i) { return i == 0 ? 0 : facet_end(text, i * part_bytes); };
  reader.read = [&](std::size_t i, std::size_t, Part& part) {
    const bool last = i + 1 == reader.parts;
    const std::size_t begin = begin_of(i), end = last ? text.size() : begin_of(i + 1);
    AsciiStl facets(source, text.substr(begin, end - begin), part.weld);
    const bool inside = facets.read(i > 0, part.triangles);
    if (inside == last || (!last && facets.ends_in_a_line())) facets.refuse_missing_end(part.triangles.size());
  };
  try {
    Body body;
    body.mesh = welded(reader);
    return body;
  } catch (const Error&) {
    return std::nullopt;
  }
}

Body read_as_a_whole(const Source& source) {
  Weld weld(source.bytes.size() / (2 * typical_facet_bytes) + 16);
  AsciiStl facets(source, source.bytes, weld);
  Body body;
  if (facets.read(false, body.mesh.triangles)) facets.refuse_missing_end(body.mesh.triangles.size());
  body.mesh.vertices = weld.take_vertices();
  return body;
}

}  // namespace

bool is_ascii_stl(std::string_view text) {
  return same_word(Words(text).next(), "solid");
}

Contents read_ascii_stl(const Source& source) {
  Contents contents;
  auto body = read_in_parts(source);
  contents.bodies.push_back(body ? std::move(*body) : read_as_a_whole(source));
  return contents;
}

}  // namespace weft::mesh
