// SPDX-License-Identifier: GPL-3.0-or-later
// libFuzzer target for everything that reads models: any bytes, in the format that their content says. What is not a
// model is refused with an Error; what is read keeps the promises of Mesh, and gives the same twice, an OBJ also in
// pieces.
//   build/fuzz/tests/fuzz_mesh -max_total_time=900 -max_len=65536 corpus/ tests/fuzz/seeds/mesh
#include "core/error.h"
#include "mesh/formats.h"
#include "mesh/read.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string_view>

namespace {

using namespace weft;

void require(bool holds) {
  if (!holds) std::abort();
}

void check(const Mesh& mesh) {
  require(!mesh.triangles.empty());
  std::vector<bool> used(mesh.vertices.size(), false);
  for (const auto& t : mesh.triangles) {
    for (const auto corner : t) {
      require(corner < mesh.vertices.size());
      used[corner] = true;
    }
    require(t[0] != t[1] && t[1] != t[2] && t[2] != t[0]);
  }
  require(std::all_of(used.begin(), used.end(), [](bool u) { return u; }));
  auto sorted = mesh.vertices;
  std::sort(sorted.begin(), sorted.end());
  require(std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end());
}

/// What comes of an OBJ in pieces of so many bytes: its name and mesh, or what is said of it.
struct Outcome {
  std::string said;
  Mesh mesh;
  friend bool operator==(const Outcome&, const Outcome&) = default;
};

Outcome outcome_of_obj(std::string_view text, std::size_t piece_bytes) {
  const std::string path = "fuzz";
  try {
    auto contents = mesh::read_obj({text, path}, piece_bytes);
    return {std::move(contents.bodies.front().name), std::move(contents.bodies.front().mesh)};
  } catch (const Error& error) {
    return {std::string(error.where()) + error.what(), {}};
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  if (mesh::is_obj(bytes)) {
    const auto whole = outcome_of_obj(bytes, size);
    for (const std::size_t piece_bytes : {1U, 40U}) require(outcome_of_obj(bytes, piece_bytes) == whole);
  }
  try {
    const auto loaded = mesh::read(bytes, "fuzz");
    require(!loaded.objects.empty());
    for (const auto& object : loaded.objects) check(object.mesh);
    const auto again = mesh::read(bytes, "fuzz");
    require(again.objects.size() == loaded.objects.size() && again.objects.front().mesh == loaded.objects.front().mesh);
  } catch (const Error& error) {
    require(error.kind() == Error::Kind::model);
  }
  return 0;
}
