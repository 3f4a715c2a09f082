// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/escape.h"
#include "preview/scene.h"

#include <iterator>

#include <fmt/format.h>

namespace weft::preview {
namespace {

using Out = std::back_insert_iterator<std::string>;

/// Millimetres without trailing zeros, exact.
void number(std::string& out, Um um) {
  if (um < 0) out += '-', um = -um;
  fmt::format_to(Out(out), "{}", um / 1000);
  int rest = um % 1000;
  if (rest == 0) return;
  int digits = 3;
  while (rest % 10 == 0) rest /= 10, --digits;
  fmt::format_to(Out(out), ".{:0{}}", rest, digits);
}

void path(std::string& out, const Polyline& points, bool closed = false) {
  out += "<path d=\"M";
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i > 0) out += i == 1 ? 'L' : ' ';
    number(out, points[i].x);
    out += ' ';
    number(out, points[i].y);
  }
  if (closed) out += 'Z';
  out += '"';
}

/// Beads: first all edges in a darker tone, then the bodies a little narrower, so that each line stays visible.
void write_beads(std::string& out, const std::vector<Line>& beads, bool edges) {
  constexpr Um edge = 30;  // of each side, µm
  for (const Line& line : beads) {
    path(out, line.path);
    out += " stroke-width=\"";
    number(out, edges ? line.width : std::max(line.width - 2 * edge, line.width / 2));
    fmt::format_to(Out(out), "\" stroke=\"{}\"/>\n", css(edges ? darker(line.colour) : line.colour));
  }
}

void write_hairlines(std::string& out, const std::vector<Line>& lines, double pixels) {
  for (const Line& line : lines) {
    path(out, line.path);
    fmt::format_to(Out(out), " stroke=\"{}\" stroke-width=\"{}\" vector-effect=\"non-scaling-stroke\"/>\n",
                   css(line.colour), pixels);
  }
}

void write_outline(std::string& out, const Ring& ring, Rgb colour, double opacity) {
  if (ring.empty()) return;
  path(out, ring, true);
  fmt::format_to(
      Out(out),
      " stroke=\"{0}\" stroke-width=\"1.5\" vector-effect=\"non-scaling-stroke\" fill=\"{0}\" fill-opacity=\"{1}\"/>\n",
      css(colour), opacity);
}

void write_legend(std::string& out, const Scene& scene, int left) {
  int y = 34;
  for (const auto& text : scene.title) {
    fmt::format_to(Out(out), "<text x=\"{}\" y=\"{}\">{}</text>\n", left, y, escape::xml(text));
    y += 22;
  }
  for (const auto& row : scene.legend) {
    fmt::format_to(Out(out),
                   "<rect x=\"{}\" y=\"{}\" width=\"22\" height=\"14\" fill=\"{}\" stroke=\"#555\"/><text x=\"{}\" "
                   "y=\"{}\">{}</text>\n",
                   left, y, css(row.colour), left + 32, y + 13, escape::xml(row.text));
    y += 24;
  }
}

}  // namespace

std::string svg(const Toolpaths& paths, const View& view, const std::optional<Overlay>& overlay) {
  const Scene scene = scene_of(paths, view, overlay);
  const Frame frame = frame_of(scene, view.size);
  std::string out;
  const int width = frame.width + Frame::legend_width, height = std::max(frame.height, 420);
  fmt::format_to(Out(out),
                 "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\">\n"
                 "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
                 "<svg width=\"{6}\" height=\"{7}\"><g transform=\"scale({2:.6f} {3:.6f}) translate({4:.3f} {5:.3f})\" "
                 "fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n",
                 width, height, frame.pixels_per_mm, -frame.pixels_per_mm, -to_mm(scene.box.min.x),
                 -to_mm(scene.box.max.y), frame.width, frame.height);
  write_outline(out, scene.reach, reach_colour, 0.08);
  write_outline(out, scene.bed, bed_colour, 0.10);
  for (const Ring& area : scene.no_go) write_outline(out, area, no_go_colour, 0.25);
  write_beads(out, scene.beads, true);
  write_beads(out, scene.beads, false);
  write_hairlines(out, scene.marks, 1);
  write_hairlines(out, scene.travels, 1);
  write_hairlines(out, scene.offending, 3);
  out += "</g></svg>\n<g font-family=\"sans-serif\" font-size=\"15\" fill=\"#222\">\n";
  write_legend(out, scene, frame.width + 16);
  out += "</g>\n</svg>\n";
  return out;
}

}  // namespace weft::preview
