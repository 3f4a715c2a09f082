// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "preview/toolpaths.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace weft::preview {

/// What the colour of a bead tells.
enum class Colour : std::uint8_t { feature, tool, width, speed, flow };
std::string_view name_of(Colour colour);
std::optional<Colour> colour_named(std::string_view name);

/// How toolpaths are shown.
struct View {
  Colour colour = Colour::feature;
  bool travels = false;
  int size = 1600;                        ///< pixels of the longer side of the drawing; the legend stands beside it
  std::optional<std::size_t> layer = {};  ///< from 0; absent: the middle one, and the last one of a page
  std::optional<Box> window = {};         ///< what a picture shows; absent: all of the layer
  std::string title = {};                 ///< above the legend
  bool legend = true;                     ///< of a PNG; without one the picture is the drawing alone
  std::optional<std::array<double, 3>> eye = {};  ///< of a PNG: beads as solids, seen from there; absent: a layer
  std::optional<std::pair<std::size_t, std::size_t>> layers = {};  ///< first and last one of solids; absent: all
};

/// The layer that a picture shows: that of the view, or the middle one. Pre: paths has a layer.
std::size_t layer_shown(const Toolpaths& paths, const View& view);

/// A place that an audit found wrong.
struct Mark {
  std::string text;  ///< what is wrong there
  Point3 at;
  std::uint32_t line = 0;
};

/// The machine under the toolpaths, and the moves that an audit found outside.
struct Overlay {
  Ring bed;
  std::vector<Ring> no_go;
  Ring reach;
  std::vector<std::uint32_t> lines;  ///< of the file, ascending: their moves are drawn in red
  std::vector<Mark> marks = {};      ///< of a page: these are listed
};

/// Pictures of a layer: beads in their true width, legend, compensated beads marked by their centreline (not over a
/// machine, where only what is outside is red).
/// Pre: paths has a layer, view.layer is one of them, size in 16 … 8192.
std::string svg(const Toolpaths& paths, const View& view, const std::optional<Overlay>& overlay = {});
std::vector<std::uint8_t> png(const Toolpaths& paths, const View& view, const std::optional<Overlay>& overlay = {});

/// A picture of the toolpaths for the head of a file: solids from the front, right and above, by feature; transparent
/// around them. Pre: 1 <= width, height <= 4096. See solid.h.
std::vector<std::uint8_t> thumbnail(const Toolpaths& paths, int width, int height);

/// From the front, right and above.
inline constexpr std::array<double, 3> from_above{0.45, -0.75, 0.5};

/// A page with all layers in three dimensions that needs no network; see page.h. Places are rounded to 5 µm.
/// Pre: paths has a layer, and seconds and support (timing.h, coverage.h).
std::string html(const Toolpaths& paths, const View& view, const std::optional<Overlay>& overlay = {});

enum class Kind : std::uint8_t { svg, png, html };

/// The kind that a file's name asks for by its extension; nullopt for another one.
std::optional<Kind> kind_of(std::string_view file_name);

/// The bytes of a preview of that kind. Pre: as of that kind.
std::string draw(Kind kind, const Toolpaths& paths, const View& view, const std::optional<Overlay>& overlay = {});

}  // namespace weft::preview
