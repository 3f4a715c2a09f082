// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

/// Areas as bits on a grid: what shells compare layers with. A Boolean of two layers costs microseconds here; exact
/// outlines are restored afterwards, in the few places where a boundary between two kinds of fill runs (shells.cpp).
namespace weft::infill {

/// Where the cells lie. The centre of cell (column, row) is what is sampled.
struct Grid {
  Point origin;
  Um cell = 100;
  int columns = 0, rows = 0;
  friend bool operator==(const Grid&, const Grid&) = default;

  /// A grid over the box and `margin` around it, of at most `most_cells` cells no finer than `finest`.
  static Grid over(const Box& box, Um finest, Um margin, double most_cells);
  /// The part of this grid that covers the box and `margin` around it: the same cells, fewer of them.
  Grid window(const Box& box, Um margin) const;
  int column_of(Um x) const { return (x - origin.x) / cell; }
  int row_of(Um y) const { return (y - origin.y) / cell; }
};

/// That length in whole cells, at least one.
inline int cells(double um, const Grid& grid) {
  return std::max(1, static_cast<int>(std::lround(um / grid.cell)));
}

/// Cells [from, to) of a row.
struct CellRun {
  int row = 0, from = 0, to = 0;
  friend bool operator==(const CellRun&, const CellRun&) = default;
};

/// One bit a cell. All binary operations need operands of the same grid.
class Mask {
 public:
  explicit Mask(const Grid& grid);
  /// Cells whose centre is inside the regions (even-odd over all rings). Cost: 5 ns for each edge and row it crosses.
  Mask(const Grid& grid, std::span<const Region> regions);

  const Grid& grid() const { return grid_; }
  bool any() const;
  std::size_t count() const;
  bool at(int column, int r) const {
    if (column < 0 || r < 0 || column >= grid_.columns || r >= grid_.rows) return false;
    return (row(r)[static_cast<unsigned>(column) / 64] >> (static_cast<unsigned>(column) % 64) & 1) != 0;
  }
  void set(int column, int row);
  void set(const CellRun& run);               ///< Pre: within the grid
  bool any_around(const CellRun& run) const;  ///< of its cells, and of those that touch them. Pre: within the grid
  /// What is set, rows ascending, and columns in a row; no run goes on where another ends.
  std::vector<CellRun> runs() const;
  /// The cell of that point; false outside of the grid.
  bool at(Point p) const {
    return p.x >= grid_.origin.x && p.y >= grid_.origin.y && at(grid_.column_of(p.x), grid_.row_of(p.y));
  }

  Mask& operator&=(const Mask& other);
  Mask& operator&=(std::span<const Mask* const> others);  ///< all of them in one pass. Pre: grids are the same
  Mask& operator|=(const Mask& other);
  Mask& operator-=(const Mask& other);  ///< and not
  // The operand that is a copy already is what is returned: `return a &= b` would copy it once more.
  friend Mask operator&(Mask a, const Mask& b) { return std::move(a &= b); }
  friend Mask operator|(Mask a, const Mask& b) { return std::move(a |= b); }
  friend Mask operator-(Mask a, const Mask& b) { return std::move(a -= b); }
  friend bool operator==(const Mask&, const Mask&) = default;

  /// Grown or shrunk by `cells` in x and in y (a square). Beyond the grid nothing is set.
  Mask grown(int cells) const;
  Mask shrunk(int cells) const;
  Mask opened(int cells) const { return shrunk(cells).grown(cells); }
  /// Grown by `cells` in all directions alike (a disc): to where the middle of a cell is no further away than that.
  Mask grown_round(double cells) const;

  /// Whether all that is set is set in the other as well. Pre: grids are the same
  bool within(const Mask& other) const;

  /// Whether any cell of the box is set in both. Pre: they have the same grid, and the box reaches into it.
  bool meets(const Mask& other, const Box& within) const;

  /// Whether any cell is set in both; the grids may be different windows of one.
  bool meets(const Mask& other) const;

  /// The outlines of the set cells, along cell borders: outer rings counter-clockwise, holes clockwise. Cells that only
  /// touch at a corner are not joined. Cost: by the length of the outlines.
  std::vector<Ring> outlines() const;

 private:
  std::uint64_t* row(int r) { return bits_.data() + static_cast<std::size_t>(r) * words_; }
  const std::uint64_t* row(int r) const { return bits_.data() + static_cast<std::size_t>(r) * words_; }
  void clear_beyond_columns();
  /// Rows [from, to).
  struct Rows {
    std::size_t from = 0, to = 0;
    bool empty() const { return from == to; }
  };
  Rows rows_set() const;  ///< from the first to the last in which a cell is set
  /// Rows that are grown by `reach`, as they are made: each lies `reach` too far back and too low, behind words that
  /// take what grows out of it.
  struct Grown {
    std::size_t reach, before, stride;
    std::unique_ptr<std::uint64_t[]> words;
    template <class F>
    void for_each_word(std::size_t row, F&& f) const;
  };
  /// What is set in these rows, or what is not (`outside`), grown by so many cells; with as many rows more below and
  /// above.
  Grown grown_rows(Rows of, int cells, bool outside) const;

  Grid grid_;
  std::size_t words_ = 0;  // of a row
  std::vector<std::uint64_t> bits_;
};

}  // namespace weft::infill
