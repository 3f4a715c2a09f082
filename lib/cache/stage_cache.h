// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace weft {

struct CacheOptions {
  std::filesystem::path folder{};                       ///< made when it is not there; empty: in memory only
  std::uint64_t max_disk = std::uint64_t{4} << 30;      ///< bytes; what was used longest ago goes first
  std::uint64_t max_memory = std::uint64_t{256} << 20;  ///< bytes
};

/// Results of stages by the hash of what they were made from: this build of weft, the stage, its input, its settings. A
/// result is made once, also when several jobs ask for it at the same time: those that come later help to make it.
///
/// The folder may be shared by any number of processes: entries appear whole, each is verified by its own hash when it
/// is read, and a damaged one is made again. A disk that is full or not to be written to costs the entry, never the
/// job.
class StageCache {
 public:
  /// @throws Error{file} when the folder cannot be made
  explicit StageCache(CacheOptions options);
  ~StageCache();
  StageCache(const StageCache&) = delete;
  StageCache& operator=(const StageCache&) = delete;

  struct Counts {
    std::string stage;
    std::size_t from_memory = 0, from_disk = 0, made = 0;
  };
  /// Of each stage that was asked for, by name.
  std::vector<Counts> counts() const;
  std::size_t damaged() const;    ///< entries that were not what they should be
  std::size_t unwritten() const;  ///< entries that the disk did not take

  /// Lets go of what is held in memory and not in use.
  void forget();

  /// How a type is kept.
  struct Kind {
    std::string (*encode)(const void*);
    std::shared_ptr<const void> (*decode)(std::string_view);  ///< throws for bytes that are none
    std::size_t (*memory)(const void*);
  };
  using Make = std::function<std::shared_ptr<const void>()>;
  /// The result of that key (64 hexadecimal digits). What `make` throws is thrown, and the next to ask makes it.
  std::shared_ptr<const void> get(std::string_view stage, const std::string& key, const Kind& kind, const Make& make);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace weft
