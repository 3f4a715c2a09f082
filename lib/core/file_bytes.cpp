// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/file_bytes.h"

#include "core/error.h"
#include "core/stop.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <new>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

namespace weft {
namespace {

Error unreadable(const std::string& path, int error) {
  if (error == EISDIR) return {Error::Kind::file, "is a directory, not a model", path, "name the files in it"};
  return {Error::Kind::file, fmt::format("cannot be read: {}", std::strerror(error)), path,
          error == ENOENT   ? "check the path"
          : error == EACCES ? "check the path and its permissions"
                            : ""};
}

/// Of what would be waited for, or has no end.
Error no_file(const std::string& path, mode_t mode) {
  return {Error::Kind::file,
          fmt::format("is a {}, not a file", S_ISFIFO(mode)   ? "pipe"
                                             : S_ISSOCK(mode) ? "socket"
                                                              : "device"),
          path, "write what it gives to a file first"};
}

Error changed(const std::string& path) {
  return {Error::Kind::file, "changed while it was read", path, "is another program still writing it?"};
}

}  // namespace

InputFile::InputFile(std::string path)
    : path_(std::move(path)), descriptor_(::open(path_.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY)) {
  if (descriptor_ < 0) throw errno == ENXIO ? no_file(path_, S_IFSOCK) : unreadable(path_, errno);
  const int error = ::fstat(descriptor_, &before_) != 0 ? errno : S_ISDIR(before_.st_mode) ? EISDIR : 0;
  if (error == 0 && regular()) return;
  ::close(descriptor_);
  throw error != 0 ? unreadable(path_, error) : no_file(path_, before_.st_mode);
}

InputFile::~InputFile() {
  ::close(descriptor_);
}

std::size_t InputFile::front(char* to, std::size_t most) const {
  const ssize_t got = ::pread(descriptor_, to, most, 0);
  return got < 0 ? 0 : static_cast<std::size_t>(got);
}

std::size_t InputFile::read(char* to, std::size_t most) {
  std::size_t size = 0;
  constexpr std::size_t piece = 1 << 24;  // some milliseconds, of what the system has in memory
  while (size < most) {
    stop_if_asked();
    const ssize_t got = ::read(descriptor_, to + size, std::min(most - size, piece));
    if (got == 0) break;
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw unreadable(path_, errno);
    size += static_cast<std::size_t>(got);
  }
  read_ += size;
  return size;
}

void InputFile::check_unchanged() const {
  struct stat after {};
  if (!regular() || ::fstat(descriptor_, &after) != 0) return;
  const auto same = [](const timespec& s, const timespec& t) { return s.tv_sec == t.tv_sec && s.tv_nsec == t.tv_nsec; };
  if (after.st_size != before_.st_size || !same(before_.st_mtim, after.st_mtim)) throw changed(path_);
}

void InputFile::check_whole() const {
  check_unchanged();
  if (regular() && size() != read_) throw changed(path_);
}

void FileBytes::take(InputFile& file) {
  std::size_t room = file.regular() ? file.size() + 1 : 1 << 16;  // one more, to see the end
  for (;;) {
    bytes_.reset(static_cast<char*>(std::realloc(bytes_.release(), room)));
    if (!bytes_) throw std::bad_alloc();
    size_ += file.read(bytes_.get() + size_, room - size_);
    if (size_ < room) break;
    room *= 2;
  }
  file.check_whole();
}

}  // namespace weft
