// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "mesh/read.h"

#include <optional>
#include <string>
#include <vector>

namespace weft::mesh {

/// What happens at a height, as PrusaSlicer and its relatives number it.
enum class AtHeight { colour_change = 0, pause = 1, tool_change = 2, template_code = 3, custom_code = 4 };

struct ProjectChange {
  double z_mm = 0;   ///< top of the first layer that comes after it
  int kind = 0;      ///< AtHeight, or a number that is none
  int extruder = 0;  ///< counted from 1
  std::string text;  ///< a message, or G-code
  int plate = 0;     ///< from 1; 0: of the only one
};

/// What a project says of the whole plate.
struct Project {
  Author author = Author::unknown;
  std::string configuration{};       ///< PrusaSlicer's, as comments of G-code hold it; empty: there is none
  std::string json_configuration{};  ///< OrcaSlicer's and BambuStudio's; empty: there is none
  std::vector<ProjectChange> changes{};
  /// Where the prime tower stands, mm and degrees.
  struct Tower {
    double x_mm = 0, y_mm = 0, angle_deg = 0;
  };
  std::optional<Tower> tower{};
};

/// @return nothing for what is no 3MF. Throws: Error::Kind::file, Error::Kind::model.
/// Cost: of those parts alone; of what is no 3MF four bytes are read.
std::optional<Project> read_project(const std::string& path);

}  // namespace weft::mesh
