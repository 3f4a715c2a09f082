// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "preview/image.h"

#include <span>
#include <string_view>

/// Drawing on an image in software, with soft edges. Coordinates in pixels, y down; the middle of the first pixel is
/// (0.5, 0.5).
namespace weft::preview {

struct Spot {
  double x = 0, y = 0;
};

struct Ink {
  Rgb colour;
  double opacity = 1;
};

void fill(Image& image, Rgb colour);

/// A line with round ends. `thickness` below one pixel fades instead of thinning.
void draw_line(Image& image, Spot a, Spot b, double thickness, Ink ink);

/// The inside of a closed polygon by the even-odd rule; its edges are not softened: draw its outline over it.
void fill_polygon(Image& image, std::span<const Spot> corners, Ink ink);

/// One line of text, capitals as small letters, of 10 × 14 pixels with its upper left corner there; what the font does
/// not know is a blank.
void draw_text(Image& image, int left, int top, std::string_view text, Rgb colour);

}  // namespace weft::preview
