// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/toolpath_pictures.h"

#include "pipeline/plan_moves.h"
#include "preview/preview.h"
#include "tasks/parallel.h"

#include <utility>

namespace weft::pipeline {
namespace {

/// The diameter of filament that makes E what the G-code means: of 1 mm² where E is in mm³.
Um diameter_of_e(const Settings& settings) {
  constexpr Um of_a_square_mm = 1128;
  return settings.gcode.volumetric_extrusion ? of_a_square_mm : settings.material.filament_diameter;
}

}  // namespace

std::vector<gcode::Thumbnail> pictures_of_toolpaths(const gcode::Job& job, PrintPlan& plan,
                                                    const std::vector<std::string>& packed) {
  const auto& sizes = job.settings.gcode.thumbnails;
  if (job.settings.gcode.thumbnail_content != ThumbnailContent::toolpaths || sizes.empty()) return {};
  const gcode::Writer writer(job);
  std::string text = writer.head();
  const auto write = [&](std::size_t i) {
    unpack_steps(packed[i], plan.layers[i]);
    auto block = writer.layer(i);
    std::exchange(plan.layers[i].steps, {});
    return block;
  };
  tasks::parallel_in_order(plan.layers.size(), write, [&](std::size_t, const std::string& block) { text += block; });
  text += writer.tail();
  const auto paths = preview::read(text, diameter_of_e(job.settings));
  std::vector<gcode::Thumbnail> out;
  for (const auto size : sizes) {
    const auto png = preview::thumbnail(paths, size.width, size.height);
    out.push_back({size.width, size.height, std::string(png.begin(), png.end())});
  }
  return out;
}

}  // namespace weft::pipeline
