// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace weft::cache {

/// A folder of entries by name, bounded in size, shared by processes. An entry is a file that appears by renaming and
/// carries the hash of its bytes.
class DiskStore {
 public:
  /// @throws Error{file} when the folder cannot be made
  DiskStore(std::filesystem::path folder, std::uint64_t max_bytes);

  /// The bytes of an entry; nullopt when there is none. A damaged one is removed and counted.
  std::optional<std::string> read(std::string_view stage, const std::string& key);
  /// Keeps an entry, and throws out what was used longest ago when there is too much. Never throws: what the disk does
  /// not take is counted.
  void write(std::string_view stage, const std::string& key, std::string_view bytes);
  /// To be told when the bytes were whole and yet no result.
  void discard(std::string_view stage, const std::string& key);

  std::size_t damaged() const { return damaged_; }
  std::size_t unwritten() const { return unwritten_; }

 private:
  std::filesystem::path path_of(std::string_view stage, const std::string& key) const;
  void trim();

  std::filesystem::path folder_;
  std::uint64_t max_bytes_;
  std::atomic<std::int64_t> until_trim_ = 0;  // bytes that may be written before the folder is looked through again
  std::atomic<std::size_t> damaged_ = 0, unwritten_ = 0;
};

}  // namespace weft::cache
