// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"

#include <cstddef>
#include <span>
#include <vector>

/// Things put close together on the bed by their true outlines.
namespace weft::plate {

/// One kind of thing to be placed.
struct NestKind {
  std::vector<Regions> outlines;  ///< as it may be turned, each around (0, 0); the first is how it lies
  std::size_t copies = 1;         ///< 0: as many as there is room for, in turns with others of 0
  bool high = false;              ///< a bar over the bed meets it, where there is one
};

/// A bar that spans the bed and goes with the nozzle: two things that it meets may not stand beside each other along
/// it.
enum class Bar { none, along_x, along_y };

struct NestBed {
  Ring surface{};                ///< simple, counter-clockwise, maybe concave
  std::vector<Ring> keep_out{};  ///< that nothing may lie in
  Point middle{};                ///< what everything is near to
  Um spacing = 0;                ///< between outlines, at least
  Um beside = 0;                 ///< what lies around an outline, as a brim: on the bed, too
  Bar bar = Bar::none;
};

/// Where a thing stands, and how it is turned.
struct Nested {
  Point at;
  std::size_t turn = 0;  ///< index into NestKind::outlines
  friend bool operator==(const Nested&, const Nested&) = default;
};

/// No-fit polygon: where `b` may not be, so as not to meet `a` in more than their edges. Convex ones are the sums of
/// corners; of others, the edges of one are swept along those of the other, and what that encloses counts as not free.
/// Source: Art, "An approach to the two dimensional irregular cutting stock problem"; Milenkovic, Daniels and Li.
Regions no_fit(const Ring& a, const Ring& b);

/// Places of each kind, as many as fit and are asked for; larger ones come first. Around the middle and not turned,
/// where that has room for all; else as low, or as far left, as each can lie, turned and not: what places most.
/// Deterministic. Law: outlines are at least `spacing` apart, high ones across the bar, and lie on the surface and off
/// what is kept out.
/// Cost: a Boolean a turn and placed thing, some milliseconds where hundreds stand.
std::vector<std::vector<Nested>> nest(std::span<const NestKind> kinds, const NestBed& bed);

}  // namespace weft::plate
