// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/write_file.h"

#include "core/error.h"
#include "core/file_place.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

namespace weft {
namespace {

/// A file descriptor that closes itself, and removes its file unless told to keep it.
class Descriptor {
 public:
  Descriptor(int fd, std::string remove_path) : fd_(fd), remove_path_(std::move(remove_path)) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
    if (!remove_path_.empty()) ::unlink(remove_path_.c_str());
  }
  int get() const { return fd_; }
  int close() { return ::close(std::exchange(fd_, -1)); }
  void keep() { remove_path_.clear(); }

 private:
  int fd_;
  std::string remove_path_;
};

[[noreturn]] void fail(const std::filesystem::path& path, int error) {
  const char* hint = error == ENOSPC || error == EDQUOT ? "free some space"
                     : error == ENOENT                  ? "does the folder exist?"
                     : error == EPIPE                   ? "the reader went away"
                     : error == EFBIG                   ? "the system's limit for the size of a file is reached"
                                                        : "check the path and its permissions";
  throw Error{Error::Kind::file, fmt::format("cannot be written ({})", std::strerror(error)), path.string(), hint};
}

void write_all(int fd, std::string_view bytes, const std::filesystem::path& path) {
  while (!bytes.empty()) {
    const auto n = ::write(fd, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail(path, errno);
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
}

}  // namespace

void write_file(const std::filesystem::path& destination, std::string_view bytes) {
  struct stat status {};
  if (::stat(destination.c_str(), &status) == 0 && !S_ISREG(status.st_mode)) {
    if (S_ISDIR(status.st_mode))
      throw Error{Error::Kind::file, "is a folder", destination.string(), "name a file in it"};
    Descriptor file(::open(destination.c_str(), O_WRONLY | O_CLOEXEC), {});
    if (file.get() < 0) fail(destination, errno);
    return write_all(file.get(), bytes, destination);
  }
  const auto target = followed(destination);  // a link stays what it is
  const std::string mark = ".weft-XXXXXX";
  std::string temporary = (target.parent_path() / (target.filename().string().substr(0, most_of_name) + mark)).string();
  const int fd = ::mkostemp(temporary.data(), O_CLOEXEC);  // by itself: it writes the name that is to be removed
  if (fd < 0) fail(destination, errno);
  Descriptor file(fd, temporary);
  write_all(file.get(), bytes, destination);
  const mode_t mask = ::umask(0);  // mkostemp makes 0600; a result is as readable as any new file
  ::umask(mask);
  ::fchmod(file.get(), 0666 & ~mask);
  if (file.close() != 0) fail(destination, errno);
  if (::rename(temporary.c_str(), target.c_str()) != 0) fail(destination, errno);
  file.keep();
}

void write_standard_output(std::string_view bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size() || std::fflush(stdout) != 0)
    throw Error{Error::Kind::file, fmt::format("cannot be written ({})", std::strerror(errno)), "standard output",
                errno == EPIPE ? "was the pipe closed?" : "free some space, or name a file"};
}

}  // namespace weft
