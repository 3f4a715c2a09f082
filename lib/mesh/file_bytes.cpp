#include "mesh/file_bytes.h"

#include "core/error.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <new>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

namespace weft::mesh {
namespace {

struct Descriptor {
  int number;
  ~Descriptor() {
    if (number >= 0) ::close(number);
  }
};

Error unreadable(const std::string& path, int error) {
  if (error == EISDIR) return {Error::Kind::file, "is a directory, not a model", path, "name the files in it"};
  return {Error::Kind::file, fmt::format("cannot be read: {}", std::strerror(error)), path,
          error == ENOENT ? "check the path" : ""};
}

}  // namespace

FileBytes::FileBytes(const std::string& path) {
  const Descriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC)};
  struct stat before {}, after {};
  if (file.number < 0 || ::fstat(file.number, &before) != 0) throw unreadable(path, errno);
  if (S_ISDIR(before.st_mode)) throw unreadable(path, EISDIR);
  const bool regular = S_ISREG(before.st_mode);
  std::size_t room = regular ? static_cast<std::size_t>(before.st_size) + 1 : 1 << 16;  // one more, to see the end
  bytes_.reset(static_cast<char*>(std::malloc(room)));
  for (;;) {
    if (!bytes_) throw std::bad_alloc();
    const ssize_t got = ::read(file.number, bytes_.get() + size_, room - size_);
    if (got == 0) break;
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw unreadable(path, errno);
    size_ += static_cast<std::size_t>(got);
    if (size_ < room) continue;
    room *= 2;
    bytes_.reset(static_cast<char*>(std::realloc(bytes_.release(), room)));
  }
  if (!regular || ::fstat(file.number, &after) != 0) return;
  const auto same = [](const timespec& s, const timespec& t) { return s.tv_sec == t.tv_sec && s.tv_nsec == t.tv_nsec; };
  if (static_cast<std::size_t>(after.st_size) != size_ || !same(before.st_mtim, after.st_mtim))
    throw Error{Error::Kind::file, "changed while it was read", path, "is another program still writing it?"};
}

}  // namespace weft::mesh
