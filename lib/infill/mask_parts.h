// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "infill/mask.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace weft::infill {

/// The connected parts of a mask: cells that only touch at a corner are not joined. What is asked of each by its size
/// and by what lies beside it needs no outline of it. Cost: by the runs of its rows. Source: Rosenfeld & Pfaltz 1966,
/// "Sequential operations in digital picture processing" (labels by rows), on runs.
class MaskParts {
 public:
  explicit MaskParts(const Mask& mask);

  std::size_t size() const { return first_.size() - 1; }
  /// Rows ascending, and columns in a row. Pre: part < size().
  std::span<const CellRun> runs(std::size_t part) const {
    return std::span(runs_).subspan(first_[part], first_[part + 1] - first_[part]);
  }
  double mm2(std::size_t part) const;

 private:
  std::vector<CellRun> runs_;  // part by part
  std::vector<std::uint32_t> first_;
  std::int64_t cell2_;  // µm²
};

}  // namespace weft::infill
