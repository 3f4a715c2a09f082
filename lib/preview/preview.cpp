// SPDX-License-Identifier: GPL-3.0-or-later
#include "preview/preview.h"

namespace weft::preview {

std::optional<Kind> kind_of(std::string_view file_name) {
  if (file_name.ends_with(".svg")) return Kind::svg;
  if (file_name.ends_with(".png")) return Kind::png;
  if (file_name.ends_with(".html")) return Kind::html;
  return std::nullopt;
}

std::string draw(Kind kind, const Toolpaths& paths, const View& view, const std::optional<Overlay>& overlay) {
  if (kind == Kind::svg) return svg(paths, view, overlay);
  if (kind == Kind::html) return html(paths, view, overlay);
  const auto bytes = png(paths, view, overlay);
  return {bytes.begin(), bytes.end()};
}

}  // namespace weft::preview
