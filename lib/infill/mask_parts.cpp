// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/mask_parts.h"

#include "core/disjoint_sets.h"

#include <limits>

namespace weft::infill {
namespace {

/// Joins the runs of each row with those of the row before that lie beside them.
DisjointSets joined(const std::vector<CellRun>& runs) {
  DisjointSets sets(runs.size());
  std::size_t below = 0;  // the first run of the row before that may still lie beside
  for (std::size_t i = 0; i < runs.size(); ++i) {
    while (runs[below].row + 1 < runs[i].row || (runs[below].row + 1 == runs[i].row && runs[below].to <= runs[i].from))
      ++below;
    for (std::size_t k = below; runs[k].row + 1 == runs[i].row && runs[k].from < runs[i].to; ++k) sets.join(k, i);
  }
  return sets;
}

}  // namespace

MaskParts::MaskParts(const Mask& mask) : cell2_(std::int64_t{mask.grid().cell} * mask.grid().cell) {
  constexpr auto none = std::numeric_limits<std::uint32_t>::max();
  const std::vector<CellRun> runs = mask.runs();
  DisjointSets sets = joined(runs);
  std::vector<std::uint32_t> part(runs.size(), none);
  first_.push_back(0);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::size_t least = sets.of(i);
    if (least == i) part[i] = static_cast<std::uint32_t>(first_.size() - 1), first_.push_back(0);
    part[i] = part[least];
    ++first_[part[i] + 1];
  }
  for (std::size_t k = 1; k < first_.size(); ++k) first_[k] += first_[k - 1];
  runs_.resize(runs.size());
  std::vector<std::uint32_t> at(first_.begin(), first_.end() - 1);
  for (std::size_t i = 0; i < runs.size(); ++i) runs_[at[part[i]]++] = runs[i];
}

double MaskParts::mm2(std::size_t part) const {
  std::int64_t cells = 0;
  for (const CellRun& run : runs(part)) cells += run.to - run.from;
  return static_cast<double>(cells * cell2_) / 1e6;
}

}  // namespace weft::infill
