// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/file_place.h"

#include <sys/stat.h>

namespace weft {
namespace fs = std::filesystem;
namespace {

std::optional<FilePlace> place_of(const struct stat& status) {
  if (S_ISDIR(status.st_mode) || S_ISCHR(status.st_mode) || S_ISBLK(status.st_mode)) return std::nullopt;
  return FilePlace{status.st_dev, status.st_ino, {}};
}

}  // namespace

fs::path followed(fs::path path) {
  constexpr int most = 40;  // links that Linux follows
  const fs::path first = path;
  for (int links = 0; links < most; ++links) {
    std::error_code none;
    const auto target = fs::read_symlink(path, none);
    if (none) return path;
    path = path.parent_path() / target;  // an absolute target is all of it
  }
  return first;
}

std::optional<FilePlace> place_of(const fs::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0) return place_of(status);
  const auto target = followed(path);
  const auto folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  if (target.filename().empty() || ::stat(folder.c_str(), &status) != 0) return std::nullopt;
  return FilePlace{status.st_dev, status.st_ino, target.filename().string()};
}

std::optional<FilePlace> place_of(int descriptor) {
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) return std::nullopt;
  return place_of(status);
}

}  // namespace weft
