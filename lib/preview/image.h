// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/rgb.h"

#include <cstdint>
#include <string>
#include <vector>

namespace weft::preview {

struct PixelSize {
  int width = 0, height = 0;
  friend bool operator==(PixelSize, PixelSize) = default;
};

/// A picture: rows from the top, four bytes a pixel, red green blue alpha, not premultiplied.
struct Image {
  PixelSize size;
  std::vector<std::uint8_t> rgba;
  explicit Image(PixelSize s)
      : size(s), rgba(4 * static_cast<std::size_t>(s.width) * static_cast<std::size_t>(s.height)) {}
  std::uint8_t* pixel(int x, int y) {
    return &rgba[4 *
                 (static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width) + static_cast<std::size_t>(x))];
  }
};

/// A PNG file's bytes. The same image gives the same bytes with the same libpng and zlib.
std::vector<std::uint8_t> encode_png(const Image& image);

}  // namespace weft::preview
