// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/error.h"
#include "mesh/formats.h"
#include "mesh/weld_parts.h"
#include "tasks/tasks.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <memory>
#include <optional>

#include <fmt/format.h>

namespace weft::mesh {
namespace {

// Binary STL: 80 bytes of anything, the number of triangles, and for each its normal, three corners (little-endian
// floats) and two more bytes.
constexpr std::size_t header_bytes = 84, triangle_bytes = 50, corners_offset = 12;
static_assert(std::endian::native == std::endian::little, "corners are copied as they lie in the file");

std::uint32_t count_of(std::string_view bytes) {
  std::uint32_t count;
  std::memcpy(&count, bytes.data() + header_bytes - sizeof count, sizeof count);
  return count;
}

/// Corners that are numbers a model may have, and three different ones.
bool may_be_triangle(const char* at) {
  constexpr float least = 1e-6F;  // mm, of what is not zero: text and counters make numbers far below and far above
  float corners[9];
  std::memcpy(corners, at, sizeof corners);
  for (const float v : corners)
    if (!placeable(double{v}) || (v != 0 && std::abs(v) < least)) return false;
  const auto same = [&](std::size_t a, std::size_t b) {
    return std::equal(corners + 3 * a, corners + 3 * a + 3, corners + 3 * b);
  };
  return !same(0, 1) && !same(1, 2) && !same(2, 0);
}

[[noreturn]] void refuse_corner(const std::string& path, double scale, std::size_t triangle,
                                const float (&corners)[9]) {
  for (std::size_t i = 0; i < 9; ++i) {
    const double mm = double{corners[i]} * scale;
    if (placeable(mm)) continue;
    const std::size_t at = header_bytes + triangle * triangle_bytes + corners_offset + i * sizeof(float);
    throw Error(Error::Kind::model,
                fmt::format("triangle {} (byte {}): {} of its corner {} {}", triangle + 1, at, "xyz"[i % 3], i / 3 + 1,
                            fault_of(mm)),
                path, std::abs(mm) > max_coordinate_mm ? "check the unit and --scale" : "export the model again");
  }
  std::abort();  // only called when one of them is not placeable
}

/// Gives the next so many bytes of the file, and may use the room for them.
using Fetch = std::function<std::string_view(char* room, std::size_t bytes)>;
/// Is shown what was fetched, in order.
using See = std::function<void(std::string_view)>;

/// Reads the triangles of a file, in blocks.
class Triangles {
 public:
  Triangles(std::size_t count, const std::string& path, double scale) : count_(count), path_(path), scale_(scale) {}

  Contents read(const Fetch& fetch, const See& see) const {
    constexpr std::size_t block_triangles = 4096;
    struct Block {
      std::unique_ptr<char[]> room = std::make_unique_for_overwrite<char[]>(block_triangles * triangle_bytes);
      std::string_view bytes{};
    };
    PartReader reader;
    reader.parts = (count_ + block_triangles - 1) / block_triangles;
    reader.most_triangles = count_;
    reader.expected_vertices = count_ / 2 + 16;  // Euler: a closed surface has half as many vertices as triangles
    std::vector<Block> blocks(std::min(reader.parts, tasks::most_in_flight()));
    std::optional<tasks::Beside> seeing;  // a block, until the next one is fetched: so long its room is its own
    reader.fetch = [&](std::size_t i, std::size_t place) {
      const std::size_t triangles = std::min(block_triangles, count_ - i * block_triangles);
      const auto bytes = blocks[place].bytes = fetch(blocks[place].room.get(), triangles * triangle_bytes);
      if (!see) return;
      if (seeing) seeing->wait();
      seeing.emplace([&see, bytes] { see(bytes); });
    };
    reader.read = [&](std::size_t i, std::size_t place, Part& part) {
      decode(blocks[place].bytes, i * block_triangles, part);
    };
    Contents contents;
    contents.bodies.push_back({"", welded(reader)});
    if (seeing) seeing->wait();
    return contents;
  }

 private:
  void decode(std::string_view bytes, std::size_t first, Part& part) const {
    for (; !bytes.empty(); bytes.remove_prefix(triangle_bytes))
      part.triangles.push_back(decoded(bytes.data() + corners_offset, first + part.triangles.size(), part.weld));
  }

  Triangle decoded(const char* at, std::size_t triangle, Weld& weld) const {
    float corners[9];
    std::memcpy(corners, at, sizeof corners);
    double mm[9];
    bool sound = true;
    for (std::size_t k = 0; k < 9; ++k) {
      mm[k] = double{corners[k]} * scale_;
      sound &= placeable(mm[k]);
    }
    if (!sound) refuse_corner(path_, scale_, triangle, corners);
    Um um[9];
    for (std::size_t k = 0; k < 9; ++k) um[k] = lattice(mm[k]);
    const auto a = weld.index({um[0], um[1], um[2]});
    const auto b = weld.index({um[3], um[4], um[5]});
    const auto c = weld.index({um[6], um[7], um[8]});
    return {a, b, c};
  }

  std::size_t count_;
  const std::string& path_;
  double scale_;
};

void refuse_too_many(std::size_t count, const std::string& path) {
  if (count > max_triangles)
    throw Error(Error::Kind::model, fmt::format("{} triangles, more than {}", count, max_triangles), path,
                "reduce the mesh");
}

}  // namespace

bool is_binary_stl(std::string_view front, std::uint64_t size) {
  return front.size() >= header_bytes && size == header_bytes + std::uint64_t{count_of(front)} * triangle_bytes;
}

std::optional<std::size_t> bytes_behind_binary_stl(std::string_view bytes) {
  constexpr std::uint64_t most_behind = 1024;
  if (bytes.size() <= header_bytes) return std::nullopt;
  const std::uint64_t promised = header_bytes + std::uint64_t{count_of(bytes)} * triangle_bytes;
  if (count_of(bytes) == 0 || promised >= bytes.size() || bytes.size() - promised > most_behind) return std::nullopt;
  const std::string_view behind = bytes.substr(promised);
  // Triangles there tell that the count is wrong.
  for (std::size_t at = 0; at + triangle_bytes <= behind.size(); at += triangle_bytes)
    if (may_be_triangle(behind.data() + at + corners_offset)) return std::nullopt;
  return behind.size();
}

std::optional<std::string> damage_of_binary_stl(std::string_view bytes) {
  if (bytes.size() < header_bytes) return std::nullopt;
  const std::uint32_t count = count_of(bytes);
  const std::uint64_t promised = header_bytes + std::uint64_t{count} * triangle_bytes, size = bytes.size();
  const std::uint64_t room = (size - header_bytes) / triangle_bytes;
  if (promised == size || promised / 1000 > size || (count > 0 && size / 1000 > promised)) return std::nullopt;
  if (promised > size)
    return fmt::format("binary STL cut off in triangle {} of {} (byte {} of {})", room + 1, count, size, promised);
  return fmt::format("binary STL with a wrong count: {} triangles are {} bytes, but it has {}, room for {} triangles",
                     count, promised, size, room);
}

Contents read_binary_stl(const Source& source) {
  const std::size_t count = count_of(source.bytes);
  refuse_too_many(count, source.path);
  std::string_view rest = source.bytes.substr(header_bytes);
  const auto next = [&](char*, std::size_t bytes) {
    const auto block = rest.substr(0, bytes);
    rest.remove_prefix(bytes);
    return block;
  };
  auto contents = Triangles(count, source.path, source.scale).read(next, {});
  if (!rest.empty())
    contents.notices.push_back(
        {"mesh_bytes_behind",
         fmt::format("{}: {} bytes behind the last of {} triangles were left out", source.path, rest.size(), count)});
  return contents;
}

Contents read_binary_stl(InputFile& file, const std::string& path, double scale, const See& see) {
  const auto fetch = [&](char* room, std::size_t size) {
    const std::string_view bytes(room, file.read(room, size));
    if (bytes.size() < size) file.check_whole();  // it was longer
    return bytes;
  };
  char header[header_bytes];
  const auto front = fetch(header, header_bytes);
  see(front);
  const std::size_t count = count_of(front);
  refuse_too_many(count, path);
  try {
    auto contents = Triangles(count, path, scale).read(fetch, see);
    file.check_whole();
    return contents;
  } catch (const Error&) {
    file.check_unchanged();  // then it is not the model's fault
    throw;
  }
}

}  // namespace weft::mesh
