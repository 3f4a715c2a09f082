// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "pipeline/pipeline.h"

#include <string>
#include <string_view>
#include <vector>

/// What G-code of weft says of its own making, so that it can be made again and compared.
namespace weft {

struct Provenance {
  struct Model {
    std::string sha256, name;  ///< of the file, without its folder: G-code does not tell of the machine it was made on
  };
  std::string version;
  std::vector<Model> models;
  Placement placement;
  Settings settings;
  audit::Mode audit = audit::Mode::reject;
};

/// The lines that say it, each a comment: `; weft_model = SHA256 NAME`, and `; weft_placement = …` where it is not the
/// default. Settings stand in a block of their own.
std::string provenance_lines(const std::vector<Report::Model>& models, const Placement& placement);

/// Reads them back. @param path for messages
/// @throws Error{file} when the text is not weft's, or lacks what is needed; Error{settings} for settings that this
/// version
///         does not know
Provenance provenance_of(std::string_view gcode, const std::string& path);

}  // namespace weft
