// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

namespace weft::infill {

/// The least of squared distance and what stands there, over all places of a row: f[q] becomes min over p of
/// (q − p)² + f[p]. Applied along each axis in turn, squared distances to where f is zero.
/// Source: Felzenszwalb & Huttenlocher 2012, "Distance transforms of sampled functions". Cost: O(n).
void lower_envelope(const std::vector<double>& f, std::vector<double>& out);

}  // namespace weft::infill
