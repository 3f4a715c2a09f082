// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/thumbnails.h"

#include "preview/thumbnail.h"
#include "tasks/parallel.h"

namespace weft::pipeline {

std::vector<gcode::Thumbnail> thumbnails_of(const Settings& settings, const Plate& plate) {
  const auto& sizes = settings.gcode.thumbnails;
  if (sizes.empty() || plate.objects.empty()) return {};
  std::vector<preview::Standing> standing;
  for (const auto& object : plate.objects)
    for (const auto& volume : object.volumes)
      if (volume.kind == VolumeKind::model) standing.push_back({&volume.mesh, object.copies.front()});
  return tasks::parallel_map(sizes.size(), [&](std::size_t i) {
    const auto size = sizes[i];
    const auto png = preview::thumbnail(standing, {size.width, size.height});
    return gcode::Thumbnail{size.width, size.height, std::string(png.begin(), png.end())};
  });
}

}  // namespace weft::pipeline
