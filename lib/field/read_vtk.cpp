// SPDX-License-Identifier: GPL-3.0-or-later
// VTK's legacy format. Source: Kitware, "VTK file formats", simple legacy formats.
#include "field/lattice.h"

#include <bit>
#include <cmath>
#include <cstdint>

namespace weft::field {
namespace {

double big_endian(std::string_view bytes, bool wide) {
  std::uint64_t v = 0;
  for (const char c : bytes) v = v << 8U | static_cast<std::uint8_t>(c);
  return wide ? std::bit_cast<double>(v) : static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(v)));
}

/// What follows the head.
struct Coding {
  bool binary = false, wide = false;
};

void take_binary(Words& words, const Coding& coding, Lattice& out) {
  const std::size_t each = coding.wide ? 8 : 4, count = out.count() * out.components;
  std::string_view data = words.rest();
  if (!data.empty()) data.remove_prefix(1);
  if (data.size() / each < count) words.refuse_all(out.expected(data.size() / each / out.components));
  out.values.reserve(count);
  for (std::size_t i = 0; i < count; ++i)
    out.values.push_back(static_cast<float>(big_endian(data.substr(i * each, each), coding.wide)));
}

void take_text(Words& words, Lattice& out) {
  const std::size_t count = out.count() * out.components;
  if (words.rest().size() / 2 + 1 < count) words.refuse_all(out.expected(words.left() / out.components));
  out.values.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    Words before = words;
    if (before.word().empty()) words.refuse_all(out.expected(i / out.components));
    out.values.push_back(static_cast<float>(words.number()));
    if (i % out.components == 0) out.lines.push_back(words.at());
  }
}

/// Reads the words before the numbers. @returns whether numbers of the kind follow
class Head {
 public:
  Head(Words& words, Kind kind, Lattice& out) : words_(words), kind_(kind), out_(out) {
    words_.line(), words_.line();
    const std::string_view coding = words_.word();
    if (coding != "ASCII" && coding != "BINARY") words_.refuse(fmt::format("'{}' is neither ASCII nor BINARY", coding));
    coding_.binary = coding == "BINARY";
  }

  Coding read() {
    const char* wanted = kind_ == Kind::density ? "SCALARS" : "VECTORS or TENSORS";
    for (;;) {
      const std::string_view word = words_.word();
      if (word.empty()) words_.refuse_all(fmt::format("has no {}", wanted));
      if (word == "DATASET")
        take_kind();
      else if (word == "DIMENSIONS")
        take_three(out_.size);
      else if (word == "ORIGIN")
        take_three(out_.from);
      else if (word == "SPACING" || word == "ASPECT_RATIO")
        take_step();
      else if (kind_ == Kind::density && word == "SCALARS")
        take_type();
      else if (kind_ == Kind::density && word == "LOOKUP_TABLE")
        return words_.word(), out_.components = 1, coding_;
      else if (kind_ == Kind::direction && (word == "VECTORS" || word == "TENSORS"))
        return take_type(), out_.components = word == "VECTORS" ? 3 : 9, coding_;
    }
  }

 private:
  void take_kind() {
    const std::string_view kind = words_.word();
    if (kind != "STRUCTURED_POINTS")
      words_.refuse(fmt::format("{} is no regular grid", kind), "resample it to STRUCTURED_POINTS");
  }
  void take_three(std::array<double, 3>& to) {
    for (double& each : to) {
      each = words_.number();
      if (!std::isfinite(each)) words_.refuse(fmt::format("{} is no place", each));
    }
  }
  void take_step() {
    take_three(out_.step);
    for (const double each : out_.step)
      if (each <= 0) words_.refuse(fmt::format("a spacing of {} mm", each));
  }
  void take_type() {
    words_.word();
    const std::string_view type = words_.word();
    coding_.wide = type == "double";
    if (coding_.binary && type != "double" && type != "float")
      words_.refuse(fmt::format("binary values of type {}", type), "write them as float, double or ASCII");
  }

  Words& words_;
  Kind kind_;
  Lattice& out_;
  Coding coding_;
};

}  // namespace

Lattice read_vtk(std::string_view bytes, const std::string& path, Kind kind) {
  Words words(bytes, path);
  Lattice out;
  const Coding coding = Head(words, kind, out).read();
  check_size(out, words);
  if (coding.binary)
    take_binary(words, coding, out);
  else
    take_text(words, out);
  return out;
}

}  // namespace weft::field
