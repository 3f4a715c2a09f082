// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "preview/image.h"
#include "preview/preview.h"

namespace weft::preview {

/// Beads as solids, seen along parallel rays: what a spheroid as wide and as high as the bead sweeps along its piece,
/// which is what page/beads.js draws. Nothing but beads is drawn, custom G-code not; transparent where there is none.
/// Four samples a pixel, fitted to the picture. The same bytes whatever the number of threads. No bead: an empty
/// picture.
/// @param view  of it: colour, eye, layers
/// Pre: view.eye is no zero vector. Cost: linear in beads and in the pixels they cover; rows of the picture side by
/// side.
Image solid(const Toolpaths& paths, const View& view, PixelSize size);

/// The size of a picture whose longer side has so many pixels, and that what is printed just fits.
PixelSize fitting_size(const Toolpaths& paths, const View& view, int longer);

}  // namespace weft::preview
