// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "geometry/graph_site.h"

#include <optional>

/// Private to medial_axis.
namespace weft::geometry::detail {

struct Centre {
  double x = 0, y = 0;
};

/// Centre of the circle that touches three sites in counter-clockwise order and crosses none of their edges, in double,
/// by closed forms: about a tenth of the cost of CGAL's interval arithmetic. Nothing where edges are so placed that the
/// side of them on which the circle lies is not plain. Post: without a bound of its error, and not proven to be that
/// circle; who relies on it checks.
std::optional<Centre> circle_centre(const GraphSite& a, const GraphSite& b, const GraphSite& c);

}  // namespace weft::geometry::detail
