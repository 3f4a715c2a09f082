// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "source.h"

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include <catch2/catch.hpp>

/// A file or folder of the optional corpus of real models, by its path inside it: "models/benchy.stl". The corpus is
/// the folder that the environment names in WEFT_CORPUS, else ../shared/corpus beside the source. Absent: a loud WARN
/// and nullopt, and the test ends early:
///   const auto path = corpus("models/benchy.stl");
///   if (!path) return;
/// Pre: inside a TEST_CASE.
inline std::optional<std::filesystem::path> corpus(std::string_view relative) {
  const char* named = std::getenv("WEFT_CORPUS");
  const std::filesystem::path root =
      named && *named ? std::filesystem::path(named) : tests::source / "../shared/corpus";
  auto path = root / relative;
  std::error_code error;
  if (std::filesystem::exists(path, error)) return path;
  WARN("SKIPPED: no " << relative << " in the corpus at " << root.string() << "; set WEFT_CORPUS to its folder");
  return std::nullopt;
}
