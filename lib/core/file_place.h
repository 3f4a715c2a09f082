// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <compare>
#include <filesystem>
#include <optional>
#include <string>

#include <sys/types.h>

namespace weft {

/// Where a file lies, whatever it is called: two paths of one place are one file, through links and folders of any
/// spelling.
struct FilePlace {
  dev_t device = 0;  ///< of the file; of the folder where the file is not there yet
  ino_t inode = 0;   ///< the same
  std::string name;  ///< in that folder; empty when the file is there
  friend auto operator<=>(const FilePlace&, const FilePlace&) = default;
};

/// The place of what is written to or read from that path; links are followed, also one to a file that is not there
/// yet. Nothing for what holds no bytes of its own: folders, devices, and files in folders that are not there.
std::optional<FilePlace> place_of(const std::filesystem::path& path);

/// The same of an open descriptor.
std::optional<FilePlace> place_of(int descriptor);

/// The path that a symbolic link leads to in the end, also when nothing is there; the path itself when it is no link,
/// or one of a circle.
std::filesystem::path followed(std::filesystem::path path);

}  // namespace weft
