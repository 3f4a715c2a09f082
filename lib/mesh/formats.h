// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/file_bytes.h"
#include "mesh/read.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// The readers behind read.h. Each takes bytes that look like its format and gives the bodies in them, welded and not
/// yet repaired. All throw Error::Kind::model.
namespace weft::mesh {

/// What a reader works on.
struct Source {
  std::string_view bytes;
  const std::string& path;
  double scale = 1.0;
  int plate = 0;  ///< as in ReadOptions
};

struct Body {
  std::string name;
  Mesh mesh;
  std::vector<Mark> marks{};  ///< what is no part of it
  std::size_t item = 0;       ///< as in Object, where there are items
  std::vector<ForeignSetting> settings{};
};

struct Contents {
  std::vector<Body> bodies;
  std::string unit = "millimeter";
  Notices notices;  ///< what of the file was left out
  Author author = Author::unknown;
  std::vector<ItemOfFile> items{};  ///< empty: each body is one
  std::vector<PlateOfFile> plates{};
};

/// More than this is refused: sides and vertices are counted in 32 bits, and a file may ask for endless copies.
inline constexpr std::size_t max_triangles = 100'000'000;
/// Objects of one file: as many as copies there may be of one.
inline constexpr std::size_t max_items = 10'000;

/// Whether the size is to the byte that of the number of triangles in the header. The word `solid` in the header and
/// the values of the bytes say nothing; and as a count, four bytes of text would ask for gigabytes.
bool is_binary_stl(std::string_view front, std::uint64_t size);
inline bool is_binary_stl(std::string_view bytes) {
  return is_binary_stl(bytes, bytes.size());
}
/// What is wrong with the size of something that may be a binary STL; nothing when it is sound, or more likely
/// something else: a damaged file is still within a factor of 1000 of the size that its count asks for.
std::optional<std::string> damage_of_binary_stl(std::string_view bytes);
Contents read_binary_stl(const Source& source);
/// The same of a file that is not in memory as a whole: in blocks, each of which is shown to `see` in its turn, on any
/// thread and beside what else is done.
/// How many bytes a binary STL has behind its triangles, when they are few and none of them is a triangle: what some
/// programs append. Nothing: it has none, or is no such file.
std::optional<std::size_t> bytes_behind_binary_stl(std::string_view bytes);
/// Throws: Error::Kind::file as well. Pre: is_binary_stl.
Contents read_binary_stl(InputFile& file, const std::string& path, double scale,
                         const std::function<void(std::string_view)>& see);

/// Whether text begins with `solid`, in any case.
bool is_ascii_stl(std::string_view text);
Contents read_ascii_stl(const Source& source);

/// Whether the lines of the text begin with the keywords of OBJ, as far as the first vertex.
bool is_obj(std::string_view text);
/// @param piece_bytes so long are the pieces that are read side by side; they make no difference. Pre: > 0
Contents read_obj(const Source& source, std::size_t piece_bytes = std::size_t{1} << 19);

/// Whether it is a zip archive.
bool is_3mf(std::string_view bytes);
Contents read_3mf(const Source& source);

/// "is not a number", "is infinite" or "lies beyond ±16 m": why a coordinate is not placeable.
std::string fault_of(double mm);

}  // namespace weft::mesh
