// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "mesh/layer_profile.h"
#include "mesh/mark.h"
#include "mesh/mesh.h"
#include "mesh/repair.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace weft::mesh {

enum class Format { stl_binary, stl_ascii, obj, three_mf };
std::string_view name_of(Format format);

/// A body of the file. Of an STL or OBJ there is one, whatever number of solids or groups it lists: they are shells of
/// one body. Of a 3MF there is one for each item of its build.
struct Object {
  std::string name;           ///< as the file has it; may be empty
  Mesh mesh;                  ///< welded and repaired, in the coordinates of the file (of the build, for 3MF)
  Repairs repairs;            ///< what was done to it and what is still odd
  std::vector<Mark> marks{};  ///< what of the file is no part of it, but says something of it
  std::size_t item = 0;       ///< what it is a part of: index into Loaded::items
  std::vector<ForeignSetting> settings{};  ///< its own, where the item has several parts
};

/// Settings of the layers whose bottoms lie in [from, to).
struct RangeOfItem {
  Um from = 0, to = 0;
  std::vector<ForeignSetting> settings{};
};

/// What is printed as one: its objects are its parts, of which the later one wins where they overlap.
struct ItemOfFile {
  std::string name{};
  std::vector<ForeignSetting> settings{};
  std::vector<RangeOfItem> ranges{};
  std::vector<HeightAt> heights{};  ///< of its layers; empty: nothing is said of them
};

/// One of the plates of a project.
struct PlateOfFile {
  int number = 0;  ///< from 1
  std::string name{};
  std::size_t objects = 0;  ///< that stand on it, copies counted
};

struct Loaded {
  std::string path;  ///< as typed
  Format format = Format::stl_binary;
  std::string sha256{};               ///< of the file's bytes
  std::string unit = "millimeter";    ///< what the file says, in 3MF's words; STL and OBJ do not say
  std::size_t triangles_in_file = 0;  ///< before any repair; every copy in a 3MF's build counts
  std::vector<Object> objects{};      ///< not empty, and each has a triangle
  Notices notices{};                  ///< what of the file was left out; repairs are noticed with each object
  Author author = Author::unknown;
  std::vector<ItemOfFile> items{};    ///< not empty; an item whose parts were all left out has no object
  std::vector<PlateOfFile> plates{};  ///< of a project that has them
};

struct ReadOptions {
  /// Multiplies every coordinate. Belongs here and not to the placement: a part drawn in metres or inches would
  /// lose its detail if it met the lattice before it is scaled. Pre: finite, > 0.
  double scale = 1.0;
  /// Millimetres that a unit of the file is, where the file does not say (STL, OBJ). Pre: finite, > 0.
  double mm_per_unit = 1.0;
  /// Of the bytes, from who knows it; empty: it is found out. Of a file it is not asked.
  std::string sha256{};
  int plate = 0;  ///< of a project of several plates, the one that is meant, from 1; 0: there is one; -1: all of them
};

/// The model in `bytes`. Its format is told by its content, never by its name.
/// Throws: Error::Kind::model, naming the triangle, byte or line, for what is not a model, is damaged (truncated, wrong
/// count, bad index, not a finite number, beyond ±16 m) or holds nothing to print.
/// Error::Kind::usage, for a project of several plates of which none is named, or one that it does not have.
/// Cost: linear.
Loaded read(std::string_view bytes, const std::string& path_as_typed, const ReadOptions& options = {});

/// The same of a file. Throws: Error::Kind::file as well, for what cannot be opened or is a directory.
Loaded read_file(const std::string& path_as_typed, const ReadOptions& options = {});

}  // namespace weft::mesh
