// SPDX-License-Identifier: GPL-3.0-or-later
#include "preview/raster.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace weft::preview {
namespace {

/// Pre: the image is opaque there.
void blend(std::uint8_t* pixel, Rgb colour, double share) {
  auto mix = [share](std::uint8_t& to, std::uint8_t from) {
    to = static_cast<std::uint8_t>(to + (from - to) * share + 0.5);
  };
  mix(pixel[0], colour.r), mix(pixel[1], colour.g), mix(pixel[2], colour.b);
}

int clamped(double v, int least, int most) {
  return v <= least ? least : v >= most ? most : static_cast<int>(v);
}

/// Columns of a dot-matrix letter, five bits to the right, the lowest bit on top.
struct Glyph {
  char letter;
  std::uint8_t columns[5];
};
constexpr Glyph font[] = {
    {'a', {0x20, 0x54, 0x54, 0x54, 0x78}}, {'b', {0x7F, 0x48, 0x44, 0x44, 0x38}}, {'c', {0x38, 0x44, 0x44, 0x44, 0x20}},
    {'d', {0x38, 0x44, 0x44, 0x48, 0x7F}}, {'e', {0x38, 0x54, 0x54, 0x54, 0x18}}, {'f', {0x08, 0x7E, 0x09, 0x01, 0x02}},
    {'g', {0x0C, 0x52, 0x52, 0x52, 0x3E}}, {'h', {0x7F, 0x08, 0x04, 0x04, 0x78}}, {'i', {0x00, 0x44, 0x7D, 0x40, 0x00}},
    {'j', {0x20, 0x40, 0x44, 0x3D, 0x00}}, {'k', {0x7F, 0x10, 0x28, 0x44, 0x00}}, {'l', {0x00, 0x41, 0x7F, 0x40, 0x00}},
    {'m', {0x7C, 0x04, 0x18, 0x04, 0x78}}, {'n', {0x7C, 0x08, 0x04, 0x04, 0x78}}, {'o', {0x38, 0x44, 0x44, 0x44, 0x38}},
    {'p', {0x7C, 0x14, 0x14, 0x14, 0x08}}, {'q', {0x08, 0x14, 0x14, 0x18, 0x7C}}, {'r', {0x7C, 0x08, 0x04, 0x04, 0x08}},
    {'s', {0x48, 0x54, 0x54, 0x54, 0x20}}, {'t', {0x04, 0x3F, 0x44, 0x40, 0x20}}, {'u', {0x3C, 0x40, 0x40, 0x20, 0x7C}},
    {'v', {0x1C, 0x20, 0x40, 0x20, 0x1C}}, {'w', {0x3C, 0x40, 0x30, 0x40, 0x3C}}, {'x', {0x44, 0x28, 0x10, 0x28, 0x44}},
    {'y', {0x0C, 0x50, 0x50, 0x50, 0x3C}}, {'z', {0x44, 0x64, 0x54, 0x4C, 0x44}}, {'0', {0x3E, 0x51, 0x49, 0x45, 0x3E}},
    {'1', {0x00, 0x42, 0x7F, 0x40, 0x00}}, {'2', {0x42, 0x61, 0x51, 0x49, 0x46}}, {'3', {0x21, 0x41, 0x45, 0x4B, 0x31}},
    {'4', {0x18, 0x14, 0x12, 0x7F, 0x10}}, {'5', {0x27, 0x45, 0x45, 0x45, 0x39}}, {'6', {0x3C, 0x4A, 0x49, 0x49, 0x30}},
    {'7', {0x01, 0x71, 0x09, 0x05, 0x03}}, {'8', {0x36, 0x49, 0x49, 0x49, 0x36}}, {'9', {0x06, 0x49, 0x49, 0x29, 0x1E}},
    {'.', {0x00, 0x60, 0x60, 0x00, 0x00}}, {',', {0x00, 0x50, 0x30, 0x00, 0x00}}, {'-', {0x08, 0x08, 0x08, 0x08, 0x08}},
    {'_', {0x40, 0x40, 0x40, 0x40, 0x40}}, {'/', {0x20, 0x10, 0x08, 0x04, 0x02}}, {':', {0x00, 0x36, 0x36, 0x00, 0x00}},
    {'(', {0x00, 0x1C, 0x22, 0x41, 0x00}}, {')', {0x00, 0x41, 0x22, 0x1C, 0x00}}, {'%', {0x23, 0x13, 0x08, 0x64, 0x62}},
};

}  // namespace

void fill(Image& image, Rgb colour) {
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
    image.rgba[i] = colour.r, image.rgba[i + 1] = colour.g, image.rgba[i + 2] = colour.b, image.rgba[i + 3] = 255;
  }
}

void draw_line(Image& image, Spot a, Spot b, double thickness, Ink ink) {
  const double radius = std::max(thickness, 1.0) / 2, strength = ink.opacity * std::min(thickness, 1.0);
  const double reach = radius + 0.5;  // where the soft edge ends
  const double reach2 = reach * reach, full2 = strength >= 1 && reach > 1 ? (reach - 1) * (reach - 1) : -1;
  const double dx = b.x - a.x, dy = b.y - a.y, length2 = dx * dx + dy * dy;
  const double along_x = length2 > 0 ? dx / length2 : 0, along_y = length2 > 0 ? dy / length2 : 0;
  const int y0 = clamped(std::min(a.y, b.y) - reach, 0, image.size.height);
  const int y1 = clamped(std::max(a.y, b.y) + reach + 1, 0, image.size.height);
  const double least_x = std::min(a.x, b.x) - reach, most_x = std::max(a.x, b.x) + reach;
  for (int y = y0; y < y1; ++y) {
    const double py = y + 0.5;
    double from = least_x, to = most_x;
    if (std::abs(dy) > 1e-9) {  // the row's part of the strip of that width along the line
      const double middle = a.x + (py - a.y) * dx / dy, half = reach * std::sqrt(length2) / std::abs(dy);
      from = std::max(from, middle - half), to = std::min(to, middle + half);
    }
    const int x1 = clamped(to + 1, 0, image.size.width);
    for (int x = clamped(from, 0, image.size.width); x < x1; ++x) {
      const double px = x + 0.5;
      const double t = std::clamp((px - a.x) * along_x + (py - a.y) * along_y, 0.0, 1.0);
      const double ex = px - a.x - t * dx, ey = py - a.y - t * dy, off2 = ex * ex + ey * ey;
      if (off2 >= reach2) continue;
      std::uint8_t* const pixel = image.pixel(x, y);
      if (off2 <= full2)
        pixel[0] = ink.colour.r, pixel[1] = ink.colour.g, pixel[2] = ink.colour.b;
      else
        blend(pixel, ink.colour, strength * std::min(reach - std::sqrt(off2), 1.0));
    }
  }
}

void fill_polygon(Image& image, std::span<const Spot> corners, Ink ink) {
  std::vector<double> crossings;
  for (int y = 0; y < image.size.height; ++y) {
    const double py = y + 0.5;
    crossings.clear();
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Spot a = corners[i], b = corners[(i + 1) % corners.size()];
      if ((a.y <= py) != (b.y <= py)) crossings.push_back(a.x + (py - a.y) * (b.x - a.x) / (b.y - a.y));
    }
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
      const int x1 = clamped(crossings[i + 1] + 0.5, 0, image.size.width);
      for (int x = clamped(crossings[i] + 0.5, 0, image.size.width); x < x1; ++x)
        blend(image.pixel(x, y), ink.colour, ink.opacity);
    }
  }
}

void draw_text(Image& image, int left, int top, std::string_view text, Rgb colour) {
  constexpr int dot = 2, advance = 12;  // pixels
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char letter = text[i] >= 'A' && text[i] <= 'Z' ? static_cast<char>(text[i] - 'A' + 'a') : text[i];
    const auto* glyph =
        std::find_if(std::begin(font), std::end(font), [&](const Glyph& g) { return g.letter == letter; });
    if (glyph == std::end(font)) continue;
    const int x0 = left + advance * static_cast<int>(i);
    for (int column = 0; column < 5 * dot; ++column)
      for (int row = 0; row < 8 * dot; ++row) {
        const int x = x0 + column, y = top + row;
        if (!(glyph->columns[column / dot] >> (row / dot) & 1)) continue;
        if (x >= 0 && y >= 0 && x < image.size.width && y < image.size.height) blend(image.pixel(x, y), colour, 1);
      }
  }
}

}  // namespace weft::preview
