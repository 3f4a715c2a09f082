// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "geometry/medial_axis.h"

#include <vector>

namespace weft::geometry {

/// Nodes between the ends of an edge of the axis, so that straight pieces between them follow it where it is curved.
/// @param half_edge whose order they are in; its twin's are the same where it is the even one of both that is asked for
/// @param chord pieces subtend at most the angle at which a chord stands off an arc of the clearance by that, µm
/// @param reach … or off one of that radius, where the clearance is more: nothing is asked for further off the outline
/// Post: the narrowest place within the edge is a node; appended to `out`.
void add_nodes_between(const MedialAxis& axis, std::uint32_t half_edge, double chord, double reach,
                       std::vector<MedialAxis::Node>& out);

/// The place of a site that is nearest to p.
Place foot_on(const MedialAxis::Site& site, Place p);

}  // namespace weft::geometry
