// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>

#include <sys/stat.h>

namespace weft {

/// A file that is read from its beginning to its end, as it was at one moment. It is not mapped: one that another
/// program cuts short meanwhile would take the job down (SIGBUS).
class InputFile {
 public:
  /// Throws: Error::Kind::file for what cannot be opened, at once for what is no file: a directory, pipe or device.
  explicit InputFile(std::string path);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  bool regular() const { return S_ISREG(before_.st_mode); }
  /// In bytes; of what is not regular it says nothing.
  std::size_t size() const { return static_cast<std::size_t>(before_.st_size); }

  /// The bytes at the beginning, at most so many; what is read next is the same as without it. Pre: regular.
  std::size_t front(char* to, std::size_t most) const;
  /// The next bytes: fewer than `most` only at the end. Throws: Error::Kind::file.
  std::size_t read(char* to, std::size_t most);
  /// Throws: Error::Kind::file when a regular file is not as it was.
  void check_unchanged() const;
  /// The same, or when it is not of the size of what was read.
  void check_whole() const;

 private:
  std::string path_;
  int descriptor_;
  struct stat before_ {};
  std::size_t read_ = 0;
};

/// All bytes of a file: what is hashed is what is read.
class FileBytes {
 public:
  /// Throws: Error::Kind::file for what cannot be opened, is a directory, or changes while it is read.
  explicit FileBytes(const std::string& path) {
    InputFile file(path);
    take(file);
  }
  explicit FileBytes(InputFile& file) { take(file); }

  std::string_view view() const { return {bytes_.get(), size_}; }

 private:
  void take(InputFile& file);

  struct Free {
    void operator()(char* p) const { std::free(p); }
  };
  std::unique_ptr<char, Free> bytes_;  // not zeroed before it is filled
  std::size_t size_ = 0;
};

}  // namespace weft
