// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/file_place.h"

#include <map>
#include <string>
#include <string_view>

namespace weft::app {

/// The files of a run, by what they are: none that is read is written, and none is written twice.
class Files {
 public:
  /// A file that is read. What is not there is left to who reads it.
  /// @throws Error{usage} when it is written
  void reads(const std::string& path);
  /// A file that is written, or "-" for standard output.
  /// @param option   that names it
  /// @param profiles may it be one? A model never is
  /// @throws Error{usage} when it is read, or written already, or named like a model or a profile
  void writes(const std::string& path, std::string_view option, bool profiles = false);

 private:
  struct Output {
    std::string path, option;
  };
  std::map<FilePlace, std::string> read_;  // and how the user calls it
  std::map<FilePlace, Output> written_;
};

/// While it is not known yet all that a run reads: could what is there be read? What begins as JSON does is a report of
/// before; what is not there, or empty, is nothing.
bool may_be_input(const std::string& destination);

/// What is known to be in the way of writing there is told before the work, not after it. @throws Error{file}
void check_writable(const std::string& destination);

}  // namespace weft::app
