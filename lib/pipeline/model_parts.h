// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>
#include <vector>

namespace weft::pipeline {

/// One file of a model as it is typed, and the tool that it is printed with.
struct ModelPart {
  std::string file;
  std::optional<int> tool{};
};

/// `body.stl@T0+logo.stl@T1`: files that are parts of one object, each with its tool. Where a file has the whole name,
/// or what stands before `@`, that is its name. @throws Error{usage} for a part without a name
std::vector<ModelPart> parts_of(const std::string& typed);

/// The files of models as they are typed. @throws Error{usage} as above
std::vector<std::string> files_of(const std::vector<std::string>& typed);

}  // namespace weft::pipeline
