// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "cuboid.h"

#include <array>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <unistd.h>

namespace weft::test {

/// Two opposite corners, mm.
using Corners = std::array<double, 6>;

/// Boxes that stand on each other, as a file.
class ModelOfBoxes {
 public:
  explicit ModelOfBoxes(const std::vector<Corners>& boxes) {
    std::string name = (std::filesystem::temp_directory_path() / "weft-boxes-XXXXXX.stl").string();
    ::close(::mkstemps(name.data(), 4));
    path_ = name;
    std::ofstream out(path_);
    out << "solid s\n";
    for (const auto& b : boxes) box(b, out);
    out << "endsolid s\n";
  }
  ModelOfBoxes(const ModelOfBoxes&) = delete;
  ModelOfBoxes& operator=(const ModelOfBoxes&) = delete;
  ~ModelOfBoxes() { std::filesystem::remove(path_); }
  const std::string& path() const { return path_; }

 private:
  static void box(const Corners& b, std::ofstream& out) {
    for (const auto& f : cuboid_faces) {
      out << "facet normal 0 0 0\nouter loop\n";
      for (const int v : f) {
        const bool right = v % 4 == 1 || v % 4 == 2, behind = v % 4 >= 2;
        out << "vertex " << (right ? b[3] : b[0]) << ' ' << (behind ? b[4] : b[1]) << ' ' << (v >= 4 ? b[5] : b[2])
            << '\n';
      }
      out << "endloop\nendfacet\n";
    }
  }
  std::string path_;
};

}  // namespace weft::test
