// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>

/// The twelve triangles of a cuboid, seen from outside counter-clockwise, by corner: 0 to 3 go around the bottom,
/// counter-clockwise from above, 4 to 7 stand over them. (In no namespace: tests of the command line have a function
/// `weft`.)
inline constexpr std::array<std::array<int, 3>, 12> cuboid_faces{{{0, 2, 1},
                                                                  {0, 3, 2},
                                                                  {4, 5, 6},
                                                                  {4, 6, 7},
                                                                  {0, 1, 5},
                                                                  {0, 5, 4},
                                                                  {1, 2, 6},
                                                                  {1, 6, 5},
                                                                  {2, 3, 7},
                                                                  {2, 7, 6},
                                                                  {3, 0, 4},
                                                                  {3, 4, 7}}};
