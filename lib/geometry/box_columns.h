// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace weft::geometry {

/// Which boxes hold a box or a point: they are kept by columns, so that thousands of islands are not looked at for each
/// of them.
class BoxColumns {
 public:
  explicit BoxColumns(std::vector<Box> boxes) : boxes_(std::move(boxes)) {
    for (const Box& b : boxes_) all_.add(b);
    if (all_.empty()) return;
    const auto count = static_cast<std::int64_t>(std::sqrt(static_cast<double>(boxes_.size()))) + 1;
    width_ = std::int64_t{all_.size().x} / count + 1;
    columns_.resize(static_cast<std::size_t>(count));
    for (std::uint32_t i = 0; i < boxes_.size(); ++i)
      if (!boxes_[i].empty())
        for (std::size_t c = column_of(boxes_[i].min.x); c <= column_of(boxes_[i].max.x); ++c) columns_[c].push_back(i);
  }

  const Box& operator[](std::size_t i) const { return boxes_[i]; }

  /// Calls visit(k), k rising, for the boxes that hold p.
  template <class Visit>
  void each_around(Point p, const Visit& visit) const {
    if (!all_.contains(p)) return;
    for (const std::uint32_t k : columns_[column_of(p.x)])
      if (boxes_[k].contains(p)) visit(k);
  }

  /// Calls visit(k), k rising, for the other boxes that hold box i.
  template <class Visit>
  void each_around(std::size_t i, const Visit& visit) const {
    const Box& box = boxes_[i];
    if (box.empty()) return;
    for (const std::uint32_t k : columns_[column_of(box.min.x)])
      if (k != i && boxes_[k].contains(box.min) && boxes_[k].contains(box.max)) visit(k);
  }

 private:
  std::size_t column_of(Um x) const { return static_cast<std::size_t>((std::int64_t{x} - all_.min.x) / width_); }

  std::vector<Box> boxes_;
  Box all_;
  std::int64_t width_ = 1;
  std::vector<std::vector<std::uint32_t>> columns_;
};

}  // namespace weft::geometry
