#pragma once
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>

namespace weft::mesh {

/// The bytes of a file as they were at one moment: what is hashed is what is read, and a file that another program cuts
/// short meanwhile cannot take the job down, as a mapped one would (SIGBUS).
class FileBytes {
 public:
  /// Throws: Error::Kind::file for what cannot be opened, is a directory, or changes while it is read.
  explicit FileBytes(const std::string& path);

  std::string_view view() const { return {bytes_.get(), size_}; }

 private:
  struct Free {
    void operator()(char* p) const { std::free(p); }
  };
  std::unique_ptr<char, Free> bytes_;  // not zeroed before it is filled
  std::size_t size_ = 0;
};

}  // namespace weft::mesh
