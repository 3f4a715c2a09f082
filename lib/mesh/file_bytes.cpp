#include "mesh/file_bytes.h"

#include "core/error.h"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
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
  struct stat status {};
  if (file.number < 0 || ::fstat(file.number, &status) != 0) throw unreadable(path, errno);
  if (S_ISDIR(status.st_mode)) throw unreadable(path, EISDIR);
  if (S_ISREG(status.st_mode) && status.st_size > 0) {
    const auto size = static_cast<std::size_t>(status.st_size);
    void* const at = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE | MAP_POPULATE, file.number, 0);
    if (at != MAP_FAILED) mapped_ = {static_cast<const char*>(at), size};
  }
  if (!mapped_.empty()) return;
  char buffer[1 << 16];  // a pipe, or a file system that cannot map
  while (const ssize_t got = ::read(file.number, buffer, sizeof buffer)) {
    if (got > 0) copy_.append(buffer, static_cast<std::size_t>(got));
    if (got < 0 && errno != EINTR) throw unreadable(path, errno);
  }
}

FileBytes::~FileBytes() {
  if (!mapped_.empty()) ::munmap(const_cast<char*>(mapped_.data()), mapped_.size());
}

}  // namespace weft::mesh
