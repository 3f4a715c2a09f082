// SPDX-License-Identifier: GPL-3.0-or-later
// libFuzzer target for the readers of pictures, grids of densities and fields of directions. What is wrong is refused
// with an Error that names settings; what is taken has as many numbers as nodes, all of them within 0 … 1.
//   build/fuzz/tests/fuzz_field -max_total_time=900 -max_len=4096 corpus/ tests/fuzz/seeds/field
#include "core/error.h"
#include "field/grid.h"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

namespace {

using namespace weft;

void require(bool holds) {
  if (!holds) std::abort();
}

template <class Read>
void take(const Read& read) {
  try {
    read();
  } catch (const Error& e) {
    require(e.kind() == Error::Kind::settings && !e.problem().empty());
  }
}

void look_at(const field::Grid& grid) {
  require(!grid.values.empty() && grid.values.size() == grid.columns * grid.rows * grid.slices);
  for (const float v : grid.values) require(v >= 0 && v <= 1);
  const double v = grid.at(grid.x0 + 0.3 * grid.dx, grid.y0 + 0.7 * grid.dy, grid.z0 + 1e3 * grid.dz);
  require(v >= 0 && v <= 1.000001);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  take([&] { look_at(field::read_picture(bytes, "a.png")); });
  for (const char* path : {"a.vtk", "a.csv"}) {
    take([&] { look_at(field::read_grid(bytes, path, 1)); });
    take([&] { look_at(field::read_grid(bytes, path, 100)); });
    take([&] {
      const field::TensorGrid t = field::read_tensors(bytes, path);
      require(t.xx.values.size() == t.xy.values.size() && t.xx.values.size() == t.yy.values.size());
      const auto angle = t.direction_at(t.xx.x0, t.xx.y0, t.xx.z0);
      require(!angle || (std::abs(*angle) <= 1.6));
    });
  }
  return 0;
}
