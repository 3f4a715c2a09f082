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

/// Takes triangles as they lie in the file, in pieces of any number.
class Triangles {
 public:
  Triangles(std::size_t count, const std::string& path, double scale)
      : path_(path),
        scale_(scale),
        weld_(count / 2 + 16) {  // Euler: a closed surface has half as many vertices as triangles
    triangles_.reserve(count);
  }

  void add(std::string_view bytes) {
    for (; bytes.size() >= triangle_bytes; bytes.remove_prefix(triangle_bytes)) add_one(bytes.data() + corners_offset);
  }

  Contents take() {
    Contents contents;
    contents.bodies.push_back({"", {weld_.take_vertices(), std::move(triangles_)}});
    return contents;
  }

 private:
  void add_one(const char* at) {
    float corners[9];
    std::memcpy(corners, at, sizeof corners);
    double mm[9];
    bool sound = true;
    for (std::size_t k = 0; k < 9; ++k) {
      mm[k] = double{corners[k]} * scale_;
      sound &= placeable(mm[k]);
    }
    if (!sound) refuse_corner(path_, scale_, triangles_.size(), corners);
    Um um[9];
    for (std::size_t k = 0; k < 9; ++k) um[k] = lattice(mm[k]);
    const auto a = weld_.index({um[0], um[1], um[2]});
    const auto b = weld_.index({um[3], um[4], um[5]});
    const auto c = weld_.index({um[6], um[7], um[8]});
    triangles_.push_back({a, b, c});
  }

  const std::string& path_;
  double scale_;
  Weld weld_;
  std::vector<Triangle> triangles_;
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
  Triangles triangles(count, source.path, source.scale);
  triangles.add(source.bytes.substr(header_bytes));
  return triangles.take();
}

Contents read_binary_stl(InputFile& file, const std::string& path, double scale,
                         const std::function<void(std::string_view)>& see) {
  std::vector<char> block(1200 * triangle_bytes);
  const auto next = [&](std::size_t most) {
    const std::string_view bytes(block.data(), file.read(block.data(), most));
    see(bytes);
    return bytes;
  };
  const auto header = next(header_bytes);
  if (header.size() < header_bytes) file.check_unchanged();  // it was longer
  const std::size_t count = count_of(header);
  refuse_too_many(count, path);
  Triangles triangles(count, path, scale);
  try {
    for (auto bytes = next(block.size()); !bytes.empty(); bytes = next(block.size())) triangles.add(bytes);
  } catch (const Error&) {
    file.check_unchanged();  // then it is not the model's fault
    throw;
  }
  file.check_unchanged();
  return triangles.take();
}

}  // namespace weft::mesh
