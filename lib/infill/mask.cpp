// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/mask.h"

#include "core/stop.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

namespace weft::infill {
namespace {

using Word = std::uint64_t;

constexpr std::size_t word_of(int column) {
  return static_cast<std::size_t>(column) / 64;
}
constexpr Word bit_of(int column) {
  return Word{1} << (static_cast<unsigned>(column) % 64);
}

/// Calls f(word, cells of it) for the words of a row that hold some of [from, to), until it returns false.
template <class F>
void for_each_word(int from, int to, F&& f) {
  const std::size_t first = word_of(from), last = word_of(to - 1);
  for (std::size_t i = first; i <= last; ++i) {
    Word cells = ~Word{0};
    if (i == first) cells &= ~(bit_of(from) - 1);
    if (i == last) cells &= bit_of(to - 1) | (bit_of(to - 1) - 1);
    if (!f(i, cells)) return;
  }
}

/// Turns the bits where an area begins or ends into the bits between them.
void fill_between_flips(Word* row, std::size_t words) {
  Word inside = 0;
  for (std::size_t i = 0; i < words; ++i) {
    Word v = row[i];
    if (v == 0) {
      row[i] = inside;
      continue;
    }
    v ^= v << 1, v ^= v << 2, v ^= v << 4, v ^= v << 8, v ^= v << 16, v ^= v << 32;
    v ^= inside;
    row[i] = v;
    inside = (v >> 63) != 0 ? ~Word{0} : 0;
  }
}

}  // namespace

Grid Grid::over(const Box& box, Um finest, Um margin, double most_cells) {
  Grid grid;
  if (box.empty()) return grid;
  const Box all = box.grown(margin);
  const double width = all.size().x, height = all.size().y;
  grid.cell = std::max(finest, static_cast<Um>(std::ceil(std::sqrt(width * height / most_cells))));
  grid.columns = static_cast<int>(all.size().x / grid.cell) + 1;
  grid.rows = static_cast<int>(all.size().y / grid.cell) + 1;
  // as far beyond on either side: what is symmetric is symmetric on the grid
  grid.origin = {all.min.x - (grid.columns * grid.cell - all.size().x) / 2,
                 all.min.y - (grid.rows * grid.cell - all.size().y) / 2};
  return grid;
}

Grid Grid::window(const Box& box, Um margin) const {
  Grid part{origin, cell, 0, 0};
  if (box.empty()) return part;
  const Box all = box.grown(margin);
  const auto cells = [&](Um from, Um to) {
    return static_cast<int>(std::floor((to - from) / static_cast<double>(cell)));
  };
  const int first_column = cells(origin.x, all.min.x), first_row = cells(origin.y, all.min.y);
  part.origin = {origin.x + first_column * cell, origin.y + first_row * cell};
  part.columns = cells(part.origin.x, all.max.x) + 1;
  part.rows = cells(part.origin.y, all.max.y) + 1;
  return part;
}

Mask::Mask(const Grid& grid)
    : grid_(grid),
      words_((static_cast<std::size_t>(grid.columns) + 63) / 64),
      bits_(words_ * static_cast<std::size_t>(grid.rows)) {}

Mask::Mask(const Grid& grid, std::span<const Region> regions) : Mask(grid) {
  if (bits_.empty()) return;
  const double cell = grid.cell, left = grid.origin.x + cell / 2, bottom = grid.origin.y + cell / 2;
  const auto flip_along = [&](Point a, Point b) {
    if (a.y > b.y) std::swap(a, b);
    // rows whose centre y satisfies a.y <= y < b.y
    const int first = std::max(0, static_cast<int>(std::ceil((a.y - bottom) / cell)));
    const int last = std::min(grid.rows - 1, static_cast<int>(std::ceil((b.y - bottom) / cell)) - 1);
    if (first > last) return;
    const double slope = (static_cast<double>(b.x) - a.x) / (static_cast<double>(b.y) - a.y);
    const double step = slope;  // columns a row: the cell cancels
    // Counted from the column that the edge begins in: where it goes through the middle of a cell, rounding says the
    // same in every window of a grid.
    const double begins = std::floor((a.x - left) / cell);
    double column = (a.x - left - begins * cell + slope * (bottom + first * cell - a.y)) / cell;
    for (int r = first; r <= last; ++r, column += step) {
      const int whole = static_cast<int>(column);  // towards 0: what is below is rounded up by that
      const int c = std::max(0, static_cast<int>(begins) + whole + static_cast<int>(whole < column));
      if (c < grid.columns) row(r)[word_of(c)] ^= bit_of(c);
    }
  };
  const auto flip_ring = [&](const Ring& ring) {
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) flip_along(ring[j], ring[i]);
  };
  StopNowAndThen stop(64);
  for (const Region& region : regions) {
    stop.step();
    flip_ring(region.outer);
    for (const Ring& hole : region.holes) flip_ring(hole);
  }
  for (int r = 0; r < grid.rows; ++r) fill_between_flips(row(r), words_);
  clear_beyond_columns();
}

void Mask::clear_beyond_columns() {
  const int used = grid_.columns % 64;
  if (used == 0) return;
  for (int r = 0; r < grid_.rows; ++r) row(r)[words_ - 1] &= bit_of(used) - 1;
}

bool Mask::any() const {
  return std::any_of(bits_.begin(), bits_.end(), [](Word w) { return w != 0; });
}

std::size_t Mask::count() const {
  std::size_t n = 0;
  for (const Word w : bits_) n += static_cast<std::size_t>(std::popcount(w));
  return n;
}

void Mask::set(int column, int row_number) {
  if (column < 0 || row_number < 0 || column >= grid_.columns || row_number >= grid_.rows) return;
  row(row_number)[word_of(column)] |= bit_of(column);
}

void Mask::set(const CellRun& run) {
  Word* const words = row(run.row);
  for_each_word(run.from, run.to, [&](std::size_t i, Word cells) {
    words[i] |= cells;
    return true;
  });
}

bool Mask::any_around(const CellRun& run) const {
  const int from = std::max(0, run.from - 1), to = std::min(grid_.columns, run.to + 1);
  bool found = false;
  for (int r = std::max(0, run.row - 1); r <= std::min(grid_.rows - 1, run.row + 1) && !found; ++r) {
    const Word* const words = row(r);
    for_each_word(from, to, [&](std::size_t i, Word cells) {
      found = (words[i] & cells) != 0;
      return !found;
    });
  }
  return found;
}

std::vector<CellRun> Mask::runs() const {
  stop_if_asked();
  std::vector<CellRun> out;
  for (int r = 0; r < grid_.rows; ++r) {
    bool open = false;
    for (std::size_t i = 0; i < words_; ++i) {
      // Each step goes to where the row changes next: from set to not set, or back.
      Word ahead = ~Word{0};
      while (const Word changes = (open ? ~row(r)[i] : row(r)[i]) & ahead) {
        const int bit = std::countr_zero(changes), column = static_cast<int>(i) * 64 + bit;
        if (open)
          out.back().to = column;
        else
          out.push_back({r, column, grid_.columns});
        open = !open;
        ahead = ~((Word{1} << bit) - 1);
      }
    }
  }
  return out;
}

Mask& Mask::operator&=(const Mask& other) {
  const Mask* const one = &other;
  return *this &= std::span(&one, 1);
}
Mask& Mask::operator&=(std::span<const Mask* const> others) {
  constexpr std::size_t block = 1024;  // words, that stay near while all others pass over them
  for (std::size_t from = 0, to = 0; from < bits_.size(); from = to) {
    to = std::min(bits_.size(), from + block);
    for (const Mask* other : others)
      for (std::size_t i = from; i < to; ++i) bits_[i] &= other->bits_[i];
  }
  return *this;
}
Mask& Mask::operator|=(const Mask& other) {
  for (std::size_t i = 0; i < bits_.size(); ++i) bits_[i] |= other.bits_[i];
  return *this;
}
Mask& Mask::operator-=(const Mask& other) {
  for (std::size_t i = 0; i < bits_.size(); ++i) bits_[i] &= ~other.bits_[i];
  return *this;
}

bool Mask::meets(const Mask& other, const Box& within) const {
  if (bits_.empty() || within.empty()) return false;
  const int first = std::max(0, grid_.row_of(within.min.y)),
            last = std::min(grid_.rows - 1, grid_.row_of(within.max.y));
  const int left = std::clamp(grid_.column_of(within.min.x), 0, grid_.columns - 1),
            right = std::clamp(grid_.column_of(within.max.x), 0, grid_.columns - 1);
  const std::size_t from = word_of(left), to = word_of(right);
  const Word from_left = ~Word{0} << (left % 64), to_right = ~Word{0} >> (63 - right % 64);
  for (int r = first; r <= last; ++r)
    for (std::size_t i = from; i <= to; ++i) {
      const Word asked = (i == from ? from_left : ~Word{0}) & (i == to ? to_right : ~Word{0});
      if ((row(r)[i] & other.row(r)[i] & asked) != 0) return true;
    }
  return false;
}

bool Mask::meets(const Mask& other) const {
  const int right = (other.grid_.origin.x - grid_.origin.x) / grid_.cell,
            up = (other.grid_.origin.y - grid_.origin.y) / grid_.cell;
  for (int r = std::max(0, -up); r < other.grid_.rows && r + up < grid_.rows; ++r) {
    const Word* theirs = other.row(r);
    const Word* ours = row(r + up);
    for (std::size_t i = 0; i < other.words_; ++i) {
      if (theirs[i] == 0) continue;
      // the 64 cells of ours under that word
      const int column = static_cast<int>(i) * 64 + right;
      Word under = 0;
      const int word = column >= 0 ? column / 64 : -((63 - column) / 64), part = column - word * 64;
      const auto value = [&](int w) { return w >= 0 && static_cast<std::size_t>(w) < words_ ? ours[w] : Word{0}; };
      under = value(word) >> part;
      if (part != 0) under |= value(word + 1) << (64 - part);
      if ((theirs[i] & under) != 0) return true;
    }
  }
  return false;
}

Mask::Rows Mask::rows_set() const {
  const auto is_set = [](Word w) { return w != 0; };
  const auto lowest = std::find_if(bits_.begin(), bits_.end(), is_set);
  if (lowest == bits_.end()) return {};
  const auto highest = std::find_if(bits_.rbegin(), bits_.rend(), is_set).base() - 1;
  const auto row_of_word = [&](auto word) { return static_cast<std::size_t>(word - bits_.begin()) / words_; };
  return {row_of_word(lowest), row_of_word(highest) + 1};
}

Mask::Grown Mask::grown_rows(Rows of, int cells, bool outside) const {
  stop_if_asked();
  const auto reach = static_cast<std::size_t>(cells), across = 2 * reach;
  const std::size_t before = (across + 63) / 64, stride = before + words_;
  const std::size_t margin = across * stride, size = margin + (of.to - of.from) * stride;
  Grown grown{reach, before, stride, std::make_unique_for_overwrite<Word[]>(size + 1)};
  Word* const to = grown.words.get();
  std::fill_n(to, margin, 0);
  const Word* from = bits_.data() + of.from * words_;
  const Word in_last = grid_.columns % 64 == 0 ? ~Word{0} : bit_of(grid_.columns) - 1;
  for (std::size_t at = margin; at < size; at += stride, from += words_) {
    std::fill_n(to + at, before, 0);
    Word* const row = to + at + before;
    if (outside) {
      for (std::size_t i = 0; i < words_; ++i) row[i] = ~from[i];
      row[words_ - 1] &= in_last;
    } else {
      std::copy_n(from, words_, row);
    }
  }
  to[size] = 0;
  // Each cell takes what is up to twice `cells` further along its row, and then above it. What it has of n cells it has
  // of 2 n by one more look, n cells on.
  for (std::size_t done = 1, by = 0; done < across + 1; done += by) {
    by = std::min({done, std::size_t{32}, across + 1 - done});
    for (std::size_t i = margin; i < size; ++i) to[i] |= to[i] >> by | to[i + 1] << (64 - by);
  }
  for (std::size_t done = 1, by = 0; done < across + 1; done += by) {
    by = std::min(done, across + 1 - done);
    const Word* const above = to + by * stride;
    for (std::size_t i = 0, end = size - by * stride; i < end; ++i) to[i] |= above[i];
  }
  return grown;
}

/// Calls f(i, word) for the words of a row.
template <class F>
void Mask::Grown::for_each_word(std::size_t row, F&& f) const {
  const std::size_t part = reach % 64;
  const Word* from = &words[row * stride + before - reach / 64];
  for (std::size_t i = 0; i + before < stride; ++i, ++from)
    f(i, part == 0 ? *from : *from << part | *(from - 1) >> (64 - part));
}

Mask Mask::grown(int cells) const {
  if (cells <= 0) return *this;
  Mask out(grid_);
  const Rows set = rows_set();
  if (set.empty()) return out;
  const Grown rows = grown_rows(set, cells, false);
  const std::size_t from = set.from - std::min(set.from, rows.reach),
                    to = std::min(set.to + rows.reach, static_cast<std::size_t>(grid_.rows));
  for (std::size_t r = from; r < to; ++r) {
    Word* const row = out.row(static_cast<int>(r));
    rows.for_each_word(r + rows.reach - set.from, [&](std::size_t i, Word w) { row[i] = w; });
  }
  out.clear_beyond_columns();
  return out;
}

Mask Mask::grown_round(double cells) const {
  if (cells < 1) return *this;
  Mask out(grid_);
  const Rows set = rows_set();
  if (set.empty()) return out;
  stop_if_asked();
  const auto reach = static_cast<std::size_t>(cells);
  // Rows behind words that take what grows out of them, and none set before and behind them all: so each step is one
  // pass over all words, whatever row they are in.
  const std::size_t stride = words_ + (2 * reach + 63) / 64, rows = set.to - set.from, up = reach * stride;
  const std::size_t size = rows * stride + 2 * up;  // of what comes out
  const auto words = [](std::size_t count) { return std::make_unique_for_overwrite<Word[]>(count); };
  auto along = words(size + 2 * up), next = words(size + 2 * up), round = words(size);
  for (Word* const to : {along.get(), next.get()}) std::fill_n(to, 2 * up, 0), std::fill_n(to + size, 2 * up, 0);
  std::fill_n(round.get(), size, 0);
  for (std::size_t r = 0; r < rows; ++r) {
    Word* const to = along.get() + 2 * up + r * stride;
    std::copy_n(bits_.data() + (set.from + r) * words_, words_, to);
    std::fill_n(to + words_, stride - words_, 0);
  }
  std::size_t grown = 0;
  for (std::size_t away = reach + 1; away-- > 0;) {  // from the disc's ends to its middle: each row at least as long
    const auto a = static_cast<double>(away);
    for (const auto half = static_cast<std::size_t>(std::sqrt(cells * cells - a * a)); grown < half; ++grown) {
      const Word* const from = along.get() + 2 * up;
      Word* const to = next.get() + 2 * up;
      for (std::size_t i = 0; i < rows * stride; ++i) {
        const Word* const w = from + i;
        to[i] = w[0] | w[0] << 1 | w[-1] >> 63 | w[0] >> 1 | w[1] << 63;
      }
      std::swap(along, next);
    }
    const Word *const below = along.get() + up - away * stride, *const above = along.get() + up + away * stride;
    for (std::size_t i = 0; i < size; ++i) round[i] |= below[i] | above[i];
  }
  const std::size_t from = set.from - std::min(set.from, reach),
                    to = std::min(set.to + reach, static_cast<std::size_t>(grid_.rows));
  for (std::size_t r = from; r < to; ++r)
    std::copy_n(round.get() + (r + reach - set.from) * stride, words_, out.row(static_cast<int>(r)));
  out.clear_beyond_columns();
  return out;
}

bool Mask::within(const Mask& other) const {
  for (std::size_t i = 0; i < bits_.size(); ++i)
    if ((bits_[i] & ~other.bits_[i]) != 0) return false;
  return true;
}

Mask Mask::shrunk(int cells) const {
  if (cells <= 0) return *this;
  Mask out(grid_);
  const Rows set = rows_set();
  if (set.empty()) return out;
  const auto reach = static_cast<std::size_t>(cells);
  const Rows around{set.from - std::min(set.from, reach),
                    std::min(set.to + reach, static_cast<std::size_t>(grid_.rows))};
  const Grown outside = grown_rows(around, cells, true);
  for (std::size_t r = set.from; r < set.to; ++r) {
    Word* const to = out.row(static_cast<int>(r));
    const Word* const here = row(static_cast<int>(r));
    outside.for_each_word(r + reach - around.from, [&](std::size_t i, Word w) { to[i] = here[i] & ~w; });
  }
  return out;
}

std::vector<Ring> Mask::outlines() const {
  stop_if_asked();
  std::vector<Ring> rings;
  // Every ring has a lower edge: a set cell over one that is not set. Each is walked once, the area on its left.
  Mask lower = *this;
  for (int r = 1; r < grid_.rows; ++r)
    for (std::size_t i = 0; i < words_; ++i) lower.row(r)[i] &= ~row(r - 1)[i];
  struct Step {
    int x, y;
  };
  constexpr Step ahead[4] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  // the cells ahead of a walker at a corner, on its left and on its right
  constexpr Step left_cell[4] = {{0, 0}, {-1, 0}, {-1, -1}, {0, -1}};
  constexpr Step right_cell[4] = {{0, -1}, {0, 0}, {-1, 0}, {-1, -1}};
  for (int r = 0; r < grid_.rows; ++r) {
    for (std::size_t w = 0; w < words_; ++w) {
      while (lower.row(r)[w] != 0) {
        const int first = static_cast<int>(w) * 64 + std::countr_zero(lower.row(r)[w]);
        Ring ring;
        int x = first, y = r, d = 0;
        do {
          if (d == 0) lower.row(y)[word_of(x)] &= ~bit_of(x);
          x += ahead[d].x, y += ahead[d].y;
          const bool left = at(x + left_cell[d].x, y + left_cell[d].y);
          const bool right = at(x + right_cell[d].x, y + right_cell[d].y);
          const int turn = !left ? 1 : right ? 3 : 0;
          if (turn != 0) ring.push_back({grid_.origin.x + x * grid_.cell, grid_.origin.y + y * grid_.cell});
          d = (d + turn) % 4;
        } while (x != first || y != r || d != 0);
        rings.push_back(std::move(ring));
      }
    }
  }
  return rings;
}

}  // namespace weft::infill
