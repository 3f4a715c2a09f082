// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/weld_parts.h"

#include "core/stop.h"
#include "tasks/tasks.h"

#include <algorithm>
#include <exception>

namespace weft::mesh {
namespace {

struct Place {
  Part part;
  std::size_t first = 0;               ///< of its triangles in the mesh
  std::vector<std::uint32_t> numbers;  ///< what its vertices have in the mesh
  std::exception_ptr failed;
};

template <class F>
void guarded(Place& place, F step) {
  if (place.failed) return;
  try {
    step();
  } catch (...) {
    place.failed = std::current_exception();
  }
}

}  // namespace

Mesh welded(const PartReader& reader) {
  Weld weld(reader.expected_vertices);
  Mesh mesh;
  mesh.triangles.reserve(reader.most_triangles);
  std::vector<Place> places(std::min(reader.parts, tasks::most_in_flight()));
  const auto fetch = [&](std::size_t i) {
    const std::size_t at = i % places.size();
    guarded(places[at], [&] { reader.fetch(i, at); });
  };
  const auto read = [&](std::size_t i) {
    const std::size_t at = i % places.size();
    Part& part = places[at].part;
    part.weld.clear();
    part.triangles.clear();
    guarded(places[at], [&] { stop_if_asked(), reader.read(i, at, part); });
  };
  const auto take = [&](std::size_t i) {
    Place& place = places[i % places.size()];
    if (place.failed) std::rethrow_exception(place.failed);
    place.first = mesh.triangles.size();
    place.numbers = weld.indices(place.part.weld.vertices());
    mesh.triangles.insert(mesh.triangles.end(), place.part.triangles.begin(), place.part.triangles.end());
  };
  const auto renumber = [&](std::size_t i) {
    const Place& place = places[i % places.size()];
    const auto to =
        mesh.triangles.begin() + static_cast<std::ptrdiff_t>(place.first);  // which does not move: see reserve
    std::transform(place.part.triangles.begin(), place.part.triangles.end(), to, [&](const Triangle& t) {
      return Triangle{place.numbers[t[0]], place.numbers[t[1]], place.numbers[t[2]]};
    });
  };
  tasks::for_each_in_order(reader.parts, places.size(),
                           {.begin = fetch, .make = read, .take = take, .finish = renumber});
  mesh.vertices = weld.take_vertices();
  return mesh;
}

}  // namespace weft::mesh
