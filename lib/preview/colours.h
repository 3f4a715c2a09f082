// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "preview/image.h"
#include "preview/preview.h"

#include <array>
#include <string_view>

namespace weft::preview {

/// The colour of a feature; grey for one that weft has no name for.
Rgb colour_of(std::string_view feature);

/// Of tools, apart also for the colour-blind; after the last the first again.
/// Source: Okabe and Ito 2008, "Color universal design".
inline constexpr std::array<Rgb, 8> tool_colours{{{230, 159, 0},
                                                  {86, 180, 233},
                                                  {0, 158, 115},
                                                  {240, 228, 66},
                                                  {0, 114, 178},
                                                  {213, 94, 0},
                                                  {204, 121, 167},
                                                  {120, 120, 120}}};

/// Does the colour name a kind, and tell no number?
inline bool names_kinds(Colour colour) {
  return colour == Colour::feature || colour == Colour::tool;
}

/// The colour of a bead by its kind. Pre: names_kinds(colour)
Rgb colour_of(const Toolpaths& paths, const Stroke& stroke, Colour colour);

/// From dark violet (0) over green to yellow (1), even to the eye and for the colour-blind. Source: the viridis map.
Rgb ramp(double share);

/// A darker tone of the same colour: the edge of a bead.
Rgb darker(Rgb colour);

std::string css(Rgb colour);  ///< "#e8722e"

inline constexpr Rgb travel_colour{110, 150, 200};
inline constexpr Rgb compensated_colour{235, 0, 190};
inline constexpr Rgb offending_colour{230, 0, 30};
inline constexpr Rgb no_go_colour{200, 90, 90};
inline constexpr Rgb bed_colour{120, 120, 130};
inline constexpr Rgb reach_colour{170, 175, 190};

/// Least and greatest of what the colour tells, over the beads of these layers that are not custom G-code; equal when
/// there is nothing to tell apart.
struct Range {
  double least = 0, most = 0;
  double share(double v) const { return most > least ? (v - least) / (most - least) : 0.5; }
};
Range range_of(const Toolpaths& paths, std::size_t first_layer, std::size_t last_layer, Colour colour);
double measure(const Stroke& stroke, Colour colour);  ///< mm, mm/s or mm³/s
std::string_view unit_of(Colour colour);

}  // namespace weft::preview
