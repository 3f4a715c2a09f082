#include "core/error.h"
#include "mesh/formats.h"
#include "mesh/text.h"
#include "mesh/weld.h"

#include <fmt/format.h>

// solid NAME / facet normal x y z / outer loop / vertex x y z (three times) / endloop / endfacet / endsolid NAME.
// A file may hold several solids. Normals are not read: the order of the corners says the same and more exactly.
namespace weft::mesh {
namespace {

class AsciiStl {
 public:
  explicit AsciiStl(const Source& source)
      : source_(source), words_(source.bytes), weld_(source.bytes.size() / (2 * typical_facet_bytes) + 16) {}

  Body read() {
    Body body;
    bool inside = false;
    for (std::string_view word = words_.next(); !word.empty(); word = words_.next()) {
      if (same_word(word, "facet") && inside) {
        facet(body.mesh.triangles);
      } else if (same_word(word, "solid") && !inside) {
        const std::string_view name = words_.rest_of_line();
        if (body.name.empty()) body.name = name;
        inside = true;
      } else if (same_word(word, "endsolid") || same_word(word, "end")) {
        words_.rest_of_line();
        inside = false;
      } else if (same_word(word, "color") || !inside) {
        words_.rest_of_line();  // extensions of some programs, and remarks between solids
      } else {
        if (words_.at_end()) break;  // cut off in the middle of the word
        refuse(fmt::format("expected 'facet' or 'endsolid', found {}", quoted(word)));
      }
    }
    if (inside)
      refuse(fmt::format("the file ends without 'endsolid', after {} triangles", body.mesh.triangles.size()),
             "it was cut off: copy or export it again");
    body.mesh.vertices = weld_.take_vertices();
    return body;
  }

 private:
  static constexpr std::size_t typical_facet_bytes = 250;

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
    refuse(fmt::format("triangle {}: expected '{}', found {}", triangle_, keyword, quoted(word)));
  }

  double coordinate(char axis) {
    const std::string_view word = words_.next();
    if (words_.at_end()) refuse_end();
    const auto number = number_in(word);
    if (!number)
      refuse(fmt::format("triangle {}: {} is {}, not a number", triangle_, axis, quoted(word)),
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
  Weld weld_;
  std::size_t triangle_ = 0;
};

}  // namespace

bool is_ascii_stl(std::string_view text) {
  return same_word(Words(text).next(), "solid");
}

Contents read_ascii_stl(const Source& source) {
  Contents contents;
  contents.bodies.push_back(AsciiStl(source).read());
  return contents;
}

}  // namespace weft::mesh
