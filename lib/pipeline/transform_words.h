// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "pipeline/pipeline.h"

#include <span>
#include <string>
#include <string_view>

namespace weft::pipeline {

/// A word for what is done with models before they are placed: an option of the command line (with dashes), a field of
/// a job's line (with underscores), and what a G-code says of how it was made.
struct TransformWord {
  std::string_view key;    ///< with underscores
  std::string_view value;  ///< what the help calls it; empty: a flag
  std::string_view help;
  std::string_view example;  ///< for the hint
  /// @throws std::invalid_argument with one clause
  void (*set)(Placement&, std::string_view text);
  /// As `set` takes it; empty where it is as usual.
  std::string (*text)(const Placement&);
};

/// In the order in which they act.
std::span<const TransformWord> transform_words();

/// Null: there is none.
const TransformWord* find_transform_word(std::string_view key);

/// Whether anything is turned, mirrored, stretched, fitted, cut, split or merged.
bool transforms(const Transform& transform);

/// @throws std::invalid_argument for what contradicts another word
void check_transform(const Placement& placement);

}  // namespace weft::pipeline
