// SPDX-License-Identifier: GPL-3.0-or-later
#include "cache/stage_cache.h"

#include "cache/disk_store.h"
#include "tasks/tasks.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <optional>

namespace weft {

namespace {
/// A result in memory, or the place where it will be.
struct Cell {
  tasks::Once once;
  std::shared_ptr<const void> value;
  std::size_t bytes = 0;        // 0 until it is made; guarded by the cache's mutex
  std::uint64_t last_used = 0;  // the same
};
}  // namespace

struct StageCache::State {
  CacheOptions options;
  std::optional<cache::DiskStore> disk;
  mutable std::mutex mutex;
  std::map<std::string, std::shared_ptr<Cell>, std::less<>> cells;
  std::map<std::string, Counts, std::less<>> counts;
  std::uint64_t held = 0, uses = 0;

  std::shared_ptr<Cell> cell_of(const std::string& name) {
    const std::lock_guard lock(mutex);
    auto& cell = cells[name];
    if (!cell) cell = std::make_shared<Cell>();
    cell->last_used = ++uses;
    return cell;
  }

  /// From disk or made; in the latter case kept on disk.
  std::shared_ptr<const void> fetch(std::string_view stage, const std::string& key, const Kind& kind, const Make& make,
                                    bool& from_disk) {
    if (disk) {
      if (const auto bytes = disk->read(stage, key)) try {
          auto value = kind.decode(*bytes);
          from_disk = true;
          return value;
        } catch (const std::exception&) {
          disk->discard(stage, key);
        }
    }
    auto value = make();
    if (disk) disk->write(stage, key, kind.encode(value.get()));
    return value;
  }

  /// Lets go of what was used longest ago. Pre: the mutex is held.
  void shrink(std::uint64_t to) {
    while (held > to) {
      auto oldest = cells.end();
      for (auto at = cells.begin(); at != cells.end(); ++at)
        if (at->second->bytes > 0 && (oldest == cells.end() || at->second->last_used < oldest->second->last_used))
          oldest = at;
      if (oldest == cells.end()) return;
      held -= oldest->second->bytes;
      cells.erase(oldest);
    }
  }
};

StageCache::StageCache(CacheOptions options) : state_(std::make_unique<State>()) {
  state_->options = std::move(options);
  if (!state_->options.folder.empty()) state_->disk.emplace(state_->options.folder, state_->options.max_disk);
}
StageCache::~StageCache() = default;

std::shared_ptr<const void> StageCache::get(std::string_view stage, const std::string& key, const Kind& kind,
                                            const Make& make) {
  auto& s = *state_;
  const auto cell = s.cell_of(std::string(stage) + " " + key);
  bool mine = false, from_disk = false;
  cell->once.run([&] {
    cell->value = s.fetch(stage, key, kind, make, from_disk);
    mine = true;
  });
  const std::lock_guard lock(s.mutex);
  auto at = s.counts.find(stage);
  if (at == s.counts.end()) at = s.counts.emplace(stage, Counts{std::string(stage)}).first;
  auto& counts = at->second;
  ++(!mine ? counts.from_memory : from_disk ? counts.from_disk : counts.made);
  auto value = cell->value;
  if (mine) {
    cell->bytes = std::max<std::size_t>(1, kind.memory(value.get()));
    s.held += cell->bytes;
    s.shrink(s.options.max_memory);
  }
  return value;
}

std::vector<StageCache::Counts> StageCache::counts() const {
  const std::lock_guard lock(state_->mutex);
  std::vector<Counts> out;
  for (const auto& [name, counts] : state_->counts) out.push_back(counts);
  return out;
}
std::size_t StageCache::damaged() const {
  return state_->disk ? state_->disk->damaged() : 0;
}
std::size_t StageCache::unwritten() const {
  return state_->disk ? state_->disk->unwritten() : 0;
}

void StageCache::forget() {
  const std::lock_guard lock(state_->mutex);
  state_->shrink(0);
}

}  // namespace weft
