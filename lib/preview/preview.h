// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "preview/toolpaths.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace weft::preview {

/// What the colour of a bead tells.
enum class Colour : std::uint8_t { feature, width, speed, flow };

/// How toolpaths are shown.
struct View {
  Colour colour = Colour::feature;
  bool travels = false;
  int size = 1600;                        ///< pixels of the longer side of the drawing; the legend stands beside it
  std::optional<std::size_t> layer = {};  ///< from 0; absent: the middle one, and the last one of a page
  std::optional<Box> window = {};         ///< what a picture shows; absent: all of the layer
  std::string title = {};                 ///< above the legend
  bool legend = true;                     ///< of a PNG; without one the picture is the drawing alone
};

/// The machine under the toolpaths, and the moves that an audit found outside.
struct Overlay {
  Ring bed;
  std::vector<Ring> no_go;
  Ring reach;
  std::vector<std::uint32_t> lines;  ///< of the file, ascending: their moves are drawn in red
};

/// Pictures of a layer: beads in their true width, legend, compensated beads marked by their centreline (not over a
/// machine, where only what is outside is red).
/// Pre: paths has a layer, view.layer is one of them, size in 16 … 8192.
std::string svg(const Toolpaths& paths, const View& view, const std::optional<Overlay>& overlay = {});
std::vector<std::uint8_t> png(const Toolpaths& paths, const View& view, const std::optional<Overlay>& overlay = {});

/// A page with all layers that needs no network: slider, zoom, colours, travels. Points are rounded to 5 µm.
/// Pre: paths has a layer.
std::string html(const Toolpaths& paths, const View& view, const std::optional<Overlay>& overlay = {});

enum class Kind : std::uint8_t { svg, png, html };

/// The kind that a file's name asks for by its extension; nullopt for another one.
std::optional<Kind> kind_of(std::string_view file_name);

/// The bytes of a preview of that kind. Pre: as of that kind.
std::string draw(Kind kind, const Toolpaths& paths, const View& view, const std::optional<Overlay>& overlay = {});

}  // namespace weft::preview
