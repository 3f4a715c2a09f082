// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>

namespace tests {

/// The folder of weft's sources: examples, profiles, tests/data. Told to one file (main.cpp), so that all others
/// compile to the same objects wherever the sources lie, and a compiler cache finds them.
extern const std::filesystem::path source;

}  // namespace tests
