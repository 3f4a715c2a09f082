// SPDX-License-Identifier: GPL-3.0-or-later
#include "preview/raster.h"
#include "preview/scene.h"
#include "preview/solid.h"

#include <algorithm>

namespace weft::preview {
namespace {

constexpr Rgb paper{255, 255, 255}, text_colour{40, 40, 40};

/// Draws a scene on an image of that frame.
class Painter {
 public:
  Painter(Image& image, const Scene& scene, const Frame& frame) : image_(image), scene_(scene), frame_(frame) {}

  void line(const Line& line, double pixels, Rgb colour) {
    for (std::size_t i = 1; i < line.path.size(); ++i)
      draw_line(image_, spot(line.path[i - 1]), spot(line.path[i]), pixels, {colour});
  }
  void outline(const Ring& ring, Rgb colour, double opacity) {
    std::vector<Spot> corners;
    for (const Point p : ring) corners.push_back(spot(p));
    fill_polygon(image_, corners, {colour, opacity});
    for (std::size_t i = 0; i < corners.size(); ++i)
      draw_line(image_, corners[i], corners[(i + 1) % corners.size()], 1.5, {colour});
  }
  double pixels(Um length) const { return to_mm(length) * frame_.pixels_per_mm; }

 private:
  Spot spot(Point p) const { return {frame_.x(p.x, scene_), frame_.y(p.y, scene_)}; }
  Image& image_;
  const Scene& scene_;
  const Frame& frame_;
};

void draw_legend(Image& image, const Scene& scene, int left) {
  for (int y = 0; y < image.size.height; ++y)  // what the drawing's round ends have left over its border
    for (int x = left; x < image.size.width; ++x)
      std::copy_n(std::array{paper.r, paper.g, paper.b}.begin(), 3, image.pixel(x, y));
  int top = 20;
  for (const auto& text : scene.title) {
    draw_text(image, left + 16, top, text.substr(0, 24), text_colour);
    top += 24;
  }
  for (const auto& row : scene.legend) {
    for (int y = top; y < std::min(top + 14, image.size.height); ++y)
      for (int x = left + 16; x < left + 38; ++x) {
        const bool border = y == top || y == top + 13 || x == left + 16 || x == left + 37;
        const Rgb c = border ? text_colour : row.colour;
        std::copy_n(std::array{c.r, c.g, c.b}.begin(), 3, image.pixel(x, y));
      }
    draw_text(image, left + 46, top, row.text, text_colour);
    top += 24;
  }
}

}  // namespace

namespace {

/// Solids on paper, with their legend.
std::vector<std::uint8_t> png_of_solids(const Toolpaths& paths, const View& view) {
  Image drawn = solid(paths, view, fitting_size(paths, view, view.size));
  constexpr int least_height = 420;
  Image image(view.legend ? PixelSize{drawn.size.width + Frame::legend_width, std::max(drawn.size.height, least_height)}
                          : drawn.size);
  fill(image, paper);
  for (int y = 0; y < drawn.size.height; ++y)
    for (int x = 0; x < drawn.size.width; ++x) {
      const std::uint8_t* from = drawn.pixel(x, y);
      std::uint8_t* to = image.pixel(x, y);
      for (int c = 0; c < 3; ++c)
        to[c] = static_cast<std::uint8_t>((from[c] * from[3] + to[c] * (255 - from[3])) / 255);
    }
  if (view.legend) draw_legend(image, words_of(paths, view), drawn.size.width);
  return encode_png(image);
}

}  // namespace

std::vector<std::uint8_t> thumbnail(const Toolpaths& paths, int width, int height) {
  View view;
  view.eye = from_above;
  return encode_png(solid(paths, view, {width, height}));
}

std::vector<std::uint8_t> png(const Toolpaths& paths, const View& view, const std::optional<Overlay>& overlay) {
  if (view.eye) return png_of_solids(paths, view);
  const Scene scene = scene_of(paths, view, overlay);
  const Frame frame = frame_of(scene, view.size);
  constexpr int least_height = 420;  // room for the legend
  Image image(view.legend ? PixelSize{frame.width + Frame::legend_width, std::max(frame.height, least_height)}
                          : PixelSize{frame.width, frame.height});
  fill(image, paper);
  Painter painter(image, scene, frame);
  painter.outline(scene.reach, reach_colour, 0.08);
  painter.outline(scene.bed, bed_colour, 0.10);
  for (const Ring& area : scene.no_go) painter.outline(area, no_go_colour, 0.25);
  // As svg(): all edges in a darker tone, then the bodies a little narrower, so that each line stays visible.
  constexpr Um edge = 30;
  for (const Line& line : scene.beads) painter.line(line, painter.pixels(line.width), darker(line.colour));
  for (const Line& line : scene.beads)
    painter.line(line, painter.pixels(std::max(line.width - 2 * edge, line.width / 2)), line.colour);
  for (const Line& line : scene.marks) painter.line(line, 1, line.colour);
  for (const Line& line : scene.travels) painter.line(line, 1, line.colour);
  for (const Line& line : scene.offending) painter.line(line, 3, line.colour);
  if (view.legend) draw_legend(image, scene, frame.width);
  return encode_png(image);
}

}  // namespace weft::preview
