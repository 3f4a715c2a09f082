// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "preview/image.h"

#include <cstring>
#include <vector>

#include <catch2/catch.hpp>
#include <png.h>

/// The picture in PNG bytes, read back by libpng's other half.
inline weft::preview::Image decoded(const std::vector<std::uint8_t>& bytes) {
  png_image png;
  std::memset(&png, 0, sizeof png);
  png.version = PNG_IMAGE_VERSION;
  REQUIRE(png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()) != 0);
  png.format = PNG_FORMAT_RGBA;
  weft::preview::Image image({static_cast<int>(png.width), static_cast<int>(png.height)});
  REQUIRE(png_image_finish_read(&png, nullptr, image.rgba.data(), 0, nullptr) != 0);
  return image;
}
