// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "pipeline/pipeline.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// What G-code of weft says of its own making, so that it can be made again and compared.
namespace weft {

struct Provenance {
  /// A file, without its folder: G-code does not tell of the machine it was made on.
  struct File {
    std::string sha256, name;
    std::optional<int> tool{};  ///< that was named behind it
  };
  struct Model : File {
    std::vector<File> further{};  ///< parts of the same object
  };
  /// What marks something of a model for support.
  struct Mark {
    std::size_t model = 0;  ///< index into `models`
    mesh::MarkKind kind = mesh::MarkKind::support_enforcer;
    std::string sha256, name;                                     ///< of the file; of a box only its text, as name
    std::vector<std::pair<std::string, std::string>> settings{};  ///< of a modifier
  };
  std::string version;
  std::vector<Model> models;
  std::vector<Mark> marks;
  std::vector<Report::InfillFile> infill_files;  ///< without their folders
  Placement placement;
  ByName by_name{};
  Settings settings;
  audit::Mode audit = audit::Mode::reject;
};

/// The lines that say it, each a comment: `; weft_model = SHA256 NAME`, with `; weft_part = SHA256 NAME` for each
/// further part of the same object and `; weft_tool = N` after a file that names one; and `; weft_placement = …` where
/// it is not the default. Settings stand in a block of their own. Marks are `; weft_support_enforcer = NUMBER SHA256
/// NAME`, or `NUMBER box:…`; the number is that of the model.
/// `; weft_infill_file = KEY SHA256 NAME` is a file that a setting names.
/// `; weft_modifier_set = KEY=VALUE` belongs to the modifier above it; `; weft_objects = JSON` is what is said by name.
std::string provenance_lines(const std::vector<Report::Model>& models, const std::vector<Report::Mark>& marks,
                             const Placement& placement, const ByName& by_name = {},
                             const std::vector<Report::InfillFile>& laid_by = {});

/// How a mark is called in options, jobs and files: support_enforcer, support_blocker, support_mesh,
/// modifier, negative.
std::string_view mark_key(mesh::MarkKind kind);

/// Reads them back. @param path for messages
/// @throws Error{file} when the text is not weft's, or lacks what is needed; Error{settings} for settings that this
/// version
///         does not know
Provenance provenance_of(std::string_view gcode, const std::string& path);

}  // namespace weft
