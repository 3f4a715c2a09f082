#pragma once
#include <string>
#include <string_view>

namespace weft::mesh {

/// The bytes of a file, mapped where that is possible: nothing is copied, and only what is read is loaded.
class FileBytes {
 public:
  /// Throws: Error::Kind::file for what cannot be opened or is a directory.
  explicit FileBytes(const std::string& path);
  ~FileBytes();
  FileBytes(const FileBytes&) = delete;
  FileBytes& operator=(const FileBytes&) = delete;

  std::string_view view() const { return mapped_.empty() ? std::string_view(copy_) : mapped_; }

 private:
  std::string_view mapped_;
  std::string copy_;
};

}  // namespace weft::mesh
