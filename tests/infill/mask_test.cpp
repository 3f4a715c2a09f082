// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/mask_parts.h"

#include <random>

#include <catch2/catch.hpp>

using namespace weft;
using infill::Grid;
using infill::Mask;

namespace {

Grid grid_of(int columns, int rows) {
  return {{0, 0}, 100, columns, rows};
}

/// Scattered rectangles, as cells.
Mask scattered(const Grid& grid, unsigned seed, int count) {
  std::mt19937 random(seed);
  const auto below = [&](int end) { return static_cast<Um>(random() % static_cast<unsigned>(end)); };
  Mask all(grid);
  for (int i = 0; i < count; ++i) {
    const Point a{below(grid.columns) * grid.cell, below(grid.rows) * grid.cell};
    const Point b{a.x + (1 + below(90)) * grid.cell, a.y + (1 + below(6)) * grid.cell};
    const Region box{{a, {b.x, a.y}, b, {a.x, b.y}}, {}};
    all |= Mask(grid, {&box, 1});
  }
  return all;
}

/// Whether a cell so near in x and in y is `wanted`; none is beyond the grid.
bool any_near(const Mask& mask, int column, int row, int cells, bool wanted) {
  for (int r = std::max(0, row - cells); r <= std::min(mask.grid().rows - 1, row + cells); ++r)
    for (int c = std::max(0, column - cells); c <= std::min(mask.grid().columns - 1, column + cells); ++c)
      if (mask.at(c, r) == wanted) return true;
  return false;
}

}  // namespace

TEST_CASE(
    "mask: grown by some cells it holds all cells so near to one of its own, shrunk those so far from all others") {
  for (const int columns : {64, 130, 200})
    for (const int cells : {1, 2, 4, 7, 63, 64, 100}) {
      const Grid grid = grid_of(columns, 40);
      const Mask mask = scattered(grid, static_cast<unsigned>(columns + cells), cells < 60 ? 9 : 3);
      const Mask grown = mask.grown(cells), shrunk = mask.shrunk(cells);
      int wrong = 0;
      for (int r = 0; r < grid.rows; ++r)
        for (int c = 0; c < grid.columns; ++c) {
          wrong += static_cast<int>(grown.at(c, r) != any_near(mask, c, r, cells, true));
          wrong += static_cast<int>(shrunk.at(c, r) == any_near(mask, c, r, cells, false));
        }
      INFO(columns << " columns, grown and shrunk by " << cells);
      CHECK(wrong == 0);
    }
}

TEST_CASE("mask: grown to all sides alike it holds all cells that are no further from one of its own") {
  for (const int columns : {64, 130, 200})
    for (const double cells : {0.7, 1.0, 1.5, 2.25, 4.5, 9.0}) {
      const Grid grid = grid_of(columns, 40);
      const Mask mask = scattered(grid, static_cast<unsigned>(columns), 9);
      const Mask grown = mask.grown_round(cells);
      Mask expected(grid);
      const int reach = static_cast<int>(cells);
      for (int r = 0; r < grid.rows; ++r)
        for (int c = 0; c < grid.columns; ++c)
          for (int y = -reach; y <= reach; ++y)
            for (int x = -reach; x <= reach; ++x)
              if (x * x + y * y <= cells * cells && mask.at(c + x, r + y)) expected.set(c, r);
      INFO(columns << " columns, grown by " << cells);
      CHECK(grown == expected);
      CHECK(mask.within(grown));
      CHECK(grown.within(mask) == (grown == mask));
    }
}

TEST_CASE("mask: what is empty stays so, and nothing is set beyond the columns") {
  const Grid grid = grid_of(70, 10);
  CHECK_FALSE(Mask(grid).grown(3).any());
  CHECK_FALSE(Mask(grid).grown_round(3).any());
  const Region all{{{0, 0}, {7000, 0}, {7000, 1000}, {0, 1000}}, {}};
  const Mask full(grid, {&all, 1});
  CHECK(full.count() == 700);
  CHECK(full.grown(5) == full);
  CHECK(full.grown_round(5) == full);
  CHECK(full.shrunk(5) == full);
}

TEST_CASE("mask: runs are its cells, and parts are what sides join, not corners") {
  for (const int columns : {60, 64, 130, 200}) {
    const Grid grid = grid_of(columns, 40);
    const Mask mask = scattered(grid, static_cast<unsigned>(columns), 25);
    Mask again(grid);
    for (const auto& run : mask.runs()) again.set(run);
    CHECK(again == mask);

    const infill::MaskParts parts(mask);
    std::vector<int> part_of(static_cast<std::size_t>(columns) * 40, -1);
    const auto at = [&](int column, int row) -> int& {
      return part_of[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                     static_cast<std::size_t>(column)];
    };
    double mm2 = 0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      mm2 += parts.mm2(i);
      for (const auto& run : parts.runs(i))
        for (int c = run.from; c < run.to; ++c) at(c, run.row) = static_cast<int>(i);
    }
    CHECK(mm2 == Approx(static_cast<double>(mask.count()) * 0.01));
    // Neighbours are of one part; and of each part all cells are reached from one of them.
    int apart = 0, reached = 0;
    for (int r = 0; r < 40; ++r)
      for (int c = 0; c < columns; ++c) {
        if (at(c, r) < 0) continue;
        if (c > 0 && at(c - 1, r) >= 0) apart += static_cast<int>(at(c - 1, r) != at(c, r));
        if (r > 0 && at(c, r - 1) >= 0) apart += static_cast<int>(at(c, r - 1) != at(c, r));
      }
    CHECK(apart == 0);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      std::vector<std::pair<int, int>> open{{parts.runs(i).front().from, parts.runs(i).front().row}};
      at(open.front().first, open.front().second) = -1;
      while (!open.empty()) {
        const auto [c, r] = open.back();
        open.pop_back(), ++reached;
        const std::pair<int, int> beside[] = {{c - 1, r}, {c + 1, r}, {c, r - 1}, {c, r + 1}};
        for (const auto& [x, y] : beside)
          if (x >= 0 && y >= 0 && x < columns && y < 40 && at(x, y) == static_cast<int>(i))
            at(x, y) = -1, open.push_back({x, y});
      }
    }
    CHECK(static_cast<std::size_t>(reached) == mask.count());
  }
}

TEST_CASE("mask: around a run are the cells that touch it, at corners too") {
  for (const int columns : {64, 130}) {
    const Grid grid = grid_of(columns, 30);
    const Mask mask = scattered(grid, 7, 6);
    int wrong = 0;
    for (int r = 0; r < grid.rows; ++r)
      for (int from = 0; from < columns; from += 3)
        for (const int length : {1, 2, 65}) {
          const infill::CellRun run{r, from, std::min(columns, from + length)};
          bool any = false;
          for (int c = run.from; c < run.to; ++c) any = any || any_near(mask, c, r, 1, true);
          wrong += static_cast<int>(mask.any_around(run) != any);
        }
    CHECK(wrong == 0);
  }
}

TEST_CASE("mask: what two masks share within a box is asked of its cells, and of none beside it") {
  const Grid grid = grid_of(300, 5);
  std::mt19937 random(8);
  const auto below = [&](int end) { return static_cast<int>(random() % static_cast<unsigned>(end)); };
  int met = 0;
  for (int i = 0; i < 500; ++i) {
    const int column = below(grid.columns), row = below(grid.rows), left = below(grid.columns), low = below(grid.rows);
    const int right = std::min(grid.columns - 1, left + below(130)), high = std::min(grid.rows - 1, low + below(3));
    Mask one(grid);
    one.set(column, row);
    const Um half = grid.cell / 2;
    Box box;
    box.add(Point{left * grid.cell + half, low * grid.cell + half}),
        box.add(Point{right * grid.cell + half, high * grid.cell + half});
    const bool within = left <= column && column <= right && low <= row && row <= high;
    met += within ? 1 : 0;
    CHECK(one.meets(one, box) == within);
  }
  CHECK(met > 20);
}

TEST_CASE("mask: a region has the same cells in every window of a grid") {
  const Grid whole = grid_of(700, 700);
  std::mt19937 random(4);
  const auto at = [&](Um from, Um end) {
    return from + static_cast<Um>(random() % static_cast<unsigned>(end - from)) / 50 * 50;
  };
  for (int i = 0; i < 300; ++i) {  // corners on cells' middles and borders, so that edges go through many others
    const Region region{{{at(20000, 50000), at(20000, 50000)},
                         {at(20000, 50000), at(20000, 50000)},
                         {at(20000, 50000), at(20000, 50000)}},
                        {}};
    const Mask here(whole, {&region, 1});
    const Grid window = whole.window(box_of(region.outer), at(200, 15000));
    const Mask there(window, {&region, 1});
    const int right = (window.origin.x - whole.origin.x) / whole.cell,
              up = (window.origin.y - whole.origin.y) / whole.cell;
    CAPTURE(i, right, up);
    auto moved = there.runs();
    for (auto& run : moved) run.row += up, run.from += right, run.to += right;
    CHECK(moved == here.runs());
  }
}
