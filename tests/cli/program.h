// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <string>
#include <vector>

/// What running the program did.
struct Run {
  int status = -1;
  std::string out, err;
};

/// Runs weft with these words, in `folder`, and waits for it. No shell is in between.
Run weft(const std::vector<std::string>& words, const std::filesystem::path& folder = ".");

/// Runs a script of the shell in `folder`, for what needs one: limits, pipes, signals. `$WEFT` in it is the program.
Run shell(const std::string& script, const std::filesystem::path& folder = ".");

/// A folder of its own for a test, gone with it.
class Scratch {
 public:
  Scratch();
  ~Scratch();
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path write(const std::string& name, const std::string& bytes) const;
  std::string read(const std::string& name) const;
  bool has(const std::string& name) const { return std::filesystem::exists(path_ / name); }
  /// Names of the files in it, sorted.
  std::vector<std::string> names() const;

 private:
  std::filesystem::path path_;
};

/// A watertight binary STL of a box from the origin, mm.
std::string box_stl(float x, float y, float z);
/// The same box side × side times, in rows, their corners `pitch` apart.
std::string boxes_stl(float x, float y, float z, int side, float pitch);
