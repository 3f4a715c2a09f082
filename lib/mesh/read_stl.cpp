#include "core/error.h"
#include "mesh/formats.h"
#include "mesh/weld.h"

#include <bit>
#include <cstring>

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

[[noreturn]] void refuse_corner(const Source& source, std::size_t triangle, const float (&corners)[9]) {
  for (std::size_t i = 0; i < 9; ++i) {
    const double mm = double{corners[i]} * source.scale;
    if (placeable(mm)) continue;
    const std::size_t at = header_bytes + triangle * triangle_bytes + corners_offset + i * sizeof(float);
    throw Error(Error::Kind::model,
                fmt::format("triangle {} (byte {}): {} of its corner {} {}", triangle + 1, at, "xyz"[i % 3], i / 3 + 1,
                            fault_of(mm)),
                source.path,
                std::abs(mm) > max_coordinate_mm ? "check the unit and --scale" : "export the model again");
  }
  std::abort();  // only called when one of them is not placeable
}

}  // namespace

bool is_binary_stl(std::string_view bytes) {
  return bytes.size() >= header_bytes && bytes.size() == header_bytes + std::uint64_t{count_of(bytes)} * triangle_bytes;
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
  if (count > max_triangles)
    throw Error(Error::Kind::model, fmt::format("{} triangles, more than {}", count, max_triangles), source.path,
                "reduce the mesh");
  Weld weld(count / 2 + 16);  // Euler: a closed surface has half as many vertices as triangles
  std::vector<Triangle> triangles;
  triangles.reserve(count);
  const char* at = source.bytes.data() + header_bytes + corners_offset;
  for (std::size_t i = 0; i < count; ++i, at += triangle_bytes) {
    float corners[9];
    std::memcpy(corners, at, sizeof corners);
    double mm[9];
    bool sound = true;
    for (std::size_t k = 0; k < 9; ++k) {
      mm[k] = double{corners[k]} * source.scale;
      sound &= placeable(mm[k]);
    }
    if (!sound) refuse_corner(source, i, corners);
    Um um[9];
    for (std::size_t k = 0; k < 9; ++k) um[k] = lattice(mm[k]);
    const auto a = weld.index({um[0], um[1], um[2]});
    const auto b = weld.index({um[3], um[4], um[5]});
    const auto c = weld.index({um[6], um[7], um[8]});
    triangles.push_back({a, b, c});
  }
  Contents contents;
  contents.bodies.push_back({"", {weld.take_vertices(), std::move(triangles)}});
  return contents;
}

}  // namespace weft::mesh
