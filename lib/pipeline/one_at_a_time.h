// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "model/sequence.h"
#include "pipeline/stages.h"
#include "settings/head_profile.h"

#include <string>
#include <vector>

/// Objects printed one after the other: each is finished before the next begins on the bed, and neither the head nor
/// the bar that carries it meets what stands already.
namespace weft::pipeline {

/// One copy, as it stands on the bed.
struct Standing {
  std::string name;
  Point by;                                  ///< where the layers are moved to
  std::vector<const PrintedLayers*> layers;  ///< of the object, and of its support
  Um height = 0;                             ///< of what is printed
  Um beside = 0;                             ///< how far skirt and brim reach beyond it
  ToolId tool = any_tool;                    ///< that it is printed with
};

/// may[i][j]: may j be printed when i stands? Not where the path of a layer of j, widened by a slab, meets what of i
/// lies above the slab's underside there. Of paths and slabs the convex hulls are taken, and layers of j in bands:
/// where that differs from the truth it refuses.
std::vector<std::vector<char>> may_follow(const std::vector<Standing>& copies, const std::vector<HeadSlab>& head);

/// An order in which every copy may follow all before it: of those that may be next one of the tool that is loaded,
/// then the lowest, then the nearest to the last. Empty: there is none. Source: Kahn, "Topological sorting of large
/// networks".
std::vector<std::size_t> order_of(const std::vector<Standing>& copies, const std::vector<std::vector<char>>& may);

/// One pass and one rise a copy. @throws Error{settings} where nothing is known of the head; Error{audit} where there
/// is no order, naming two that are in each other's way, and how much further apart they would have to be
Sequence one_at_a_time(const Settings& settings, const std::vector<Standing>& copies);

}  // namespace weft::pipeline
