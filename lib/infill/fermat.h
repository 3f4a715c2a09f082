// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "infill/sparse.h"

namespace weft::infill {

/// Rings at even distances from the edge, each opened beside the next one inwards and joined with it: one closed line
/// for all rings of a region. Rings within each other become a double spiral, whose one arm leads in and whose other
/// leads out; where the region branches, the line does.
/// Source: Zhao, Gu, Huang, Garcia, Chen, Tu, Benes, Zhang, Cohen-Or, Chen 2016, "Connected Fermat spirals for layered
///         fabrication". There rings are followed smoothly; here the line changes rings in one step.
void fill_fermat(const Region& region, const SparseStyle& style, Beads& beads);

/// The outlines of nested regions, from outside inwards, opened towards each other and joined: one closed line for each
/// region of the first level, where no two outlines are farther apart than 1.6 × spacing.
/// @param tolerance  of its points, as few_points has it
std::vector<Ring> spirals_through(std::vector<Regions> levels, double spacing, Um tolerance);

}  // namespace weft::infill
