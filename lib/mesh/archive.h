// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace weft::mesh {

/// The parts of a zip archive in memory, unpacked as they are read and never whole.
class Archive {
 public:
  /// Throws: Error::Kind::model when it is no archive or a damaged one. Pre: `bytes` and `path` outlive this.
  Archive(std::string_view bytes, const std::string& path);
  ~Archive();

  bool has(const std::string& part) const;
  /// The names of all parts, in their order.
  std::vector<std::string> parts() const;

  /// Gives the part, of which the case of the name does not matter, to `take` piece by piece.
  /// Throws: Error::Kind::model when it is missing, damaged, encrypted, or larger than a model could be.
  void read(const std::string& part, const std::function<void(std::string_view piece)>& take);

  /// The part as a whole. Throws: as read; Error::Kind::model when it is more text than settings could be, 64 MB.
  std::string text(const std::string& part);

 private:
  struct Zip;
  std::unique_ptr<Zip> zip_;
  const std::string& path_;
  std::uint64_t packed_ = 0, unpacked_ = 0;  ///< of the parts read so far
};

}  // namespace weft::mesh
