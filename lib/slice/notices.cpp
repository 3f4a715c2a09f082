// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/tolerances.h"
#include "slice/slice.h"

#include <fmt/format.h>

namespace weft::slice {
namespace {

void add(std::vector<PlacedNotice>& notices, std::span<const Cut> cuts, Gaps Cut::*kind, const char* code,
         const char* what, const std::string& of) {
  std::size_t gaps = 0, layers = 0, widest = 0;
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    const Gaps& here = cuts[i].*kind;
    if (here.count == 0) continue;
    gaps += here.count;
    if (layers++ == 0 || here.widest_um > (cuts[widest].*kind).widest_um) widest = i;
  }
  if (gaps == 0) return;
  const Gaps& worst = cuts[widest].*kind;
  notices.push_back(
      {code,
       fmt::format("{}: {}: {} on {} {}; the widest, {:.3f} mm, is on layer {} (z {:.3f})", of, what, gaps, layers,
                   layers == 1 ? "layer" : "layers", worst.widest_um / 1000, widest, to_mm(cuts[widest].layer.z)),
       worst.at});
}
}  // namespace

std::vector<PlacedNotice> notices_of(std::span<const Cut> cuts, const std::string& of) {
  std::vector<PlacedNotice> out;
  add(out, cuts, &Cut::closed, "open_contour_closed", "small gaps in outlines were closed", of);
  add(out, cuts, &Cut::bridged, "open_contour_bridged",
      "the mesh has holes; gaps in outlines were closed with straight lines", of);
  return out;
}

}  // namespace weft::slice
