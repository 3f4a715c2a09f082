// SPDX-License-Identifier: GPL-3.0-or-later
#include "preview/scene.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <span>

#include <fmt/format.h>

namespace weft::preview {
namespace {

constexpr Um margin = 2000;  // free border of a picture, µm

bool custom(const Toolpaths& paths, const Stroke& stroke) {
  return paths.features[stroke.feature] == "custom";
}

Box box_of_prints(const Toolpaths& paths, const PathLayer& layer) {
  Box all, printed;
  for (const Stroke& stroke : layer.strokes) {
    all.add(stroke.from), all.add(stroke.to);
    if (!stroke.extrudes() || custom(paths, stroke)) continue;
    printed.add(stroke.from), printed.add(stroke.to);
  }
  if (!printed.empty()) return printed;
  return all.empty() ? Box{{0, 0}, {0, 0}} : all;
}

/// Appends the stroke to the last line when it goes on where that ends and looks the same.
void append(std::vector<Line>& lines, const Stroke& stroke, Um width, Rgb colour) {
  if (!lines.empty()) {
    Line& last = lines.back();
    if (last.path.back() == stroke.from && last.width == width && last.colour == colour) {
      last.path.push_back(stroke.to);
      return;
    }
  }
  lines.push_back({{stroke.from, stroke.to}, width, colour});
}

void add_legend(Scene& scene, const Toolpaths& paths, const View& view, std::span<const PathLayer> layers,
                Range range) {
  if (view.colour == Colour::feature) {
    std::vector<bool> present(paths.features.size());
    for (const PathLayer& layer : layers)
      for (const Stroke& stroke : layer.strokes)
        if (stroke.extrudes()) present[stroke.feature] = true;
    for (std::size_t i = 0; i < present.size(); ++i)
      if (present[i]) {
        std::string name = paths.features[i].empty() ? "other" : paths.features[i];
        std::replace(name.begin(), name.end(), '_', ' ');
        scene.legend.push_back({colour_of(paths.features[i]), std::move(name)});
      }
  } else if (view.colour == Colour::tool) {
    std::set<int> present;
    for (const PathLayer& layer : layers)
      for (const Stroke& stroke : layer.strokes)
        if (stroke.extrudes()) present.insert(stroke.tool);
    for (const int tool : present)
      scene.legend.push_back(
          {tool_colours[static_cast<std::size_t>(tool) % tool_colours.size()], fmt::format("tool {}", tool)});
  } else {
    constexpr int steps = 6;
    const int rows = range.most > range.least ? steps : 1;
    for (int i = rows - 1; i >= 0; --i) {
      const double share = rows > 1 ? static_cast<double>(i) / (rows - 1) : 0.5;
      const double value = range.least + share * (range.most - range.least);
      scene.legend.push_back(
          {ramp(share), fmt::format("{:.{}f} {}", value, view.colour == Colour::speed ? 0 : 2, unit_of(view.colour))});
    }
  }
  if (!scene.marks.empty()) scene.legend.push_back({compensated_colour, "flow reduced"});
  if (!scene.travels.empty()) scene.legend.push_back({travel_colour, "travel"});
  if (!scene.offending.empty()) scene.legend.push_back({offending_colour, "outside"});
  if (!scene.no_go.empty()) scene.legend.push_back({no_go_colour, "no-go area"});
}

}  // namespace

std::size_t layer_shown(const Toolpaths& paths, const View& view) {
  return view.layer.value_or(paths.layers.size() / 2);
}

Scene scene_of(const Toolpaths& paths, const View& view, const std::optional<Overlay>& overlay) {
  const std::size_t index = layer_shown(paths, view);
  const PathLayer& layer = paths.layers[index];
  Scene scene;
  scene.box = box_of_prints(paths, layer);
  if (overlay) {
    scene.bed = overlay->bed, scene.reach = overlay->reach, scene.no_go = overlay->no_go;
    scene.box.add(box_of(scene.bed)), scene.box.add(box_of(scene.reach));
    for (const Ring& area : scene.no_go) scene.box.add(box_of(area));
  }
  const Range range = range_of(paths, index, index, view.colour);
  for (const Stroke& stroke : layer.strokes) {
    if (overlay && std::binary_search(overlay->lines.begin(), overlay->lines.end(), stroke.line)) {
      append(scene.offending, stroke, 0, offending_colour);
      scene.box.add(stroke.from), scene.box.add(stroke.to);
    }
    if (!stroke.extrudes()) {
      if (view.travels && stroke.from != stroke.to) append(scene.travels, stroke, 0, travel_colour);
      continue;
    }
    const Rgb colour = names_kinds(view.colour) ? colour_of(paths, stroke, view.colour)
                       : custom(paths, stroke)  ? colour_of(paths.features[stroke.feature])
                                                : ramp(range.share(measure(stroke, view.colour)));
    append(scene.beads, stroke, stroke.width, colour);
    // marks are nearly as red as what is outside, which is what a picture with an overlay is asked about
    if (stroke.compensated && !overlay) append(scene.marks, stroke, 0, compensated_colour);
  }
  scene.box = view.window.value_or(scene.box.grown(margin));
  if (!view.title.empty()) scene.title.push_back(view.title);
  scene.title.push_back(fmt::format("layer {} of {}", index, paths.layers.size()));
  scene.title.push_back(fmt::format("z {:.2f}, height {:.2f}", to_mm(layer.z), to_mm(layer.height)));
  add_legend(scene, paths, view, {&layer, 1}, range);
  return scene;
}

Scene words_of(const Toolpaths& paths, const View& view) {
  Scene scene;
  const auto [first, last] = view.layers.value_or(std::pair<std::size_t, std::size_t>{0, paths.layers.size() - 1});
  if (!view.title.empty()) scene.title.push_back(view.title);
  scene.title.push_back(fmt::format("layers {} to {} of {}", first, last, paths.layers.size()));
  const auto shown = std::span(paths.layers).subspan(first, last - first + 1);
  const auto lies = [](const auto& layer) { return layer.z != 0; };  // a part's last tips may be too thin to be laid
  const auto lowest = std::find_if(shown.begin(), shown.end(), lies);
  const auto highest = std::find_if(shown.rbegin(), shown.rend(), lies);
  if (lowest != shown.end())
    scene.title.push_back(fmt::format("z {:.2f} to {:.2f}", to_mm(lowest->z), to_mm(highest->z)));
  add_legend(scene, paths, view, shown, range_of(paths, first, last, view.colour));
  return scene;
}

Frame frame_of(const Scene& scene, int size) {
  const double across = to_mm(scene.box.size().x), along = to_mm(scene.box.size().y);
  const double scale = size / std::max(across, along);
  return {scale, std::max(1, static_cast<int>(std::ceil(across * scale))),
          std::max(1, static_cast<int>(std::ceil(along * scale)))};
}

}  // namespace weft::preview
