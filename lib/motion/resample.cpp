// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/resample.h"

#include "core/tolerances.h"
#include "model/simplify.h"

#include <algorithm>
#include <cmath>

namespace weft::motion {
namespace {

/// Lines of infill are laid over each other's ends and nobody sees them: a move is worth as much as along a whole
/// shortest piece.
constexpr double worth_inside = 2;

}  // namespace

Coarseness coarseness(Role role) {
  // Much of support is small rounds, at whose corners the nozzle slows down: with as many as an offset makes it does
  // not.
  if (row_of(role).kind == RoleKind::support) return {static_cast<double>(tolerances::arc) / tolerances::path, 1};
  if (role != Role::solid_infill && role != Role::overhang_skin && row_of(role).kind != RoleKind::fill) return {};
  return {static_cast<double>(tolerances::path_inside) / tolerances::path,
          static_cast<double>(tolerances::band_inside) / tolerances::band_step, worth_inside};
}

void thin_out(std::vector<Junction>& path, Coarseness times) {
  if (path.size() < 3) return;
  VertexPath vertices;
  vertices.reserve(path.size());
  for (const Junction& j : path)
    vertices.push_back({j.at.x / times.path, j.at.y / times.path, j.width * static_cast<double>(j.flow) / times.band});
  const auto before = simplify(vertices, false, times.worth * worth_of_a_bead_move);
  if (before.size() == path.size()) return;
  const bool even_flow =
      std::all_of(path.begin(), path.end(), [&](const Junction& j) { return j.flow == path[0].flow; });
  std::vector<Junction> out;
  out.reserve(before.size());
  for (std::size_t k = 0; k < before.size(); ++k) {
    Junction j = path[before[k]];
    const double x = times.path * vertices[k].x, y = times.path * vertices[k].y, band = times.band * vertices[k].band;
    if (even_flow && j.flow > 0)
      j.width = rounded(band / static_cast<double>(j.flow));
    else if (j.width > 0)
      j.flow = static_cast<float>(band / static_cast<double>(j.width));
    j.at = {rounded(x), rounded(y)};
    out.push_back(j);
  }
  path = std::move(out);
}

void cut_where_width_changes(std::vector<Junction>& path, Coarseness times) {
  const auto pieces_of = [times](const Junction& a, const Junction& b) {
    const double change_um = std::abs(a.width * static_cast<double>(a.flow) - b.width * static_cast<double>(b.flow));
    return ramp_pieces(change_um / times.band, distance(a.at, b.at) / times.band);
  };
  std::size_t count = path.empty() ? 0 : 1;
  for (std::size_t i = 1; i < path.size(); ++i) count += static_cast<std::size_t>(pieces_of(path[i - 1], path[i]));
  if (count == path.size()) return;
  std::vector<Junction> out;
  out.reserve(count);
  out.push_back(path.front());
  for (std::size_t i = 1; i < path.size(); ++i) {
    const auto &a = path[i - 1], &b = path[i];
    const int pieces = pieces_of(a, b);
    for (int k = 1; k < pieces; ++k) {
      const double t = static_cast<double>(k) / pieces;
      out.push_back({lerp(a.at, b.at, t), rounded(a.width + t * (b.width - a.width)),
                     static_cast<float>(a.flow + t * static_cast<double>(b.flow - a.flow))});
    }
    out.push_back(b);
  }
  path = std::move(out);
}

}  // namespace weft::motion
