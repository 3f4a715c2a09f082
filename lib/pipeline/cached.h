// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "cache/stage_cache.h"
#include "core/build_id.h"
#include "core/hash.h"
#include "core/stop.h"
#include "pipeline/codec.h"
#include "pipeline/pipeline.h"
#include "pipeline/sample.h"
#include "pipeline/stage_table.h"
#include "pipeline/stopwatch.h"
#include "settings/exact.h"

#include <memory>
#include <optional>
#include <type_traits>

namespace weft::pipeline {

/// A stage's result: the caller's own, or one that a cache keeps for others as well.
template <class T>
class Result {
 public:
  explicit Result(T own) : own_(std::move(own)) {}
  explicit Result(std::shared_ptr<const T> kept) : kept_(std::move(kept)) {}
  const T& operator*() const { return kept_ ? *kept_ : *own_; }
  /// The value to do with as one likes: moved out when it is one's own, else a copy.
  T take() && { return kept_ ? *kept_ : std::move(*own_); }

 private:
  std::optional<T> own_;
  std::shared_ptr<const T> kept_;
};

/// What a stage reads, as bytes: its name and version, then every input. A stage's result is a function of them.
class StageKey {
 public:
  StageKey(std::string_view stage, int version) : stage_(stage) {
    exact::add(bytes_, build_id());
    exact::add(bytes_, codec_version);
    exact::add(bytes_, std::string(stage));
    exact::add(bytes_, version);
  }
  template <class T, class Reads>
  explicit StageKey(const StageRow<T, Reads>& row) : StageKey(row.name, row.version) {}
  template <class T>
  StageKey& with(const T& v) {
    exact::add(bytes_, v);
    return *this;
  }
  std::string_view stage() const { return stage_; }
  std::string hash() const { return sha256(bytes_); }

 private:
  std::string_view stage_;
  std::string bytes_;
};

/// The result of a stage: made, or what the cache has of that key. Without a cache neither key nor copy is made.
/// @param key  returns a StageKey  @param make returns the result
template <class Key, class Make>
auto cached(StageCache* cache, Key key, Make make) -> Result<std::invoke_result_t<Make&>> {
  using T = std::invoke_result_t<Make&>;
  if (!cache) return Result<T>(make());
  static constexpr StageCache::Kind kind{
      [](const void* v) { return encode(*static_cast<const T*>(v)); },
      [](std::string_view bytes) -> std::shared_ptr<const void> {
        auto value = std::make_shared<T>();
        decode(bytes, *value);
        return value;
      },
      [](const void* v) { return memory_of(*static_cast<const T*>(v)); },
  };
  const StageKey k = key();
  return Result<T>(std::static_pointer_cast<const T>(cache->get(
      k.stage(), k.hash(), kind, [&]() -> std::shared_ptr<const void> { return std::make_shared<const T>(make()); })));
}

/// A job on its way through the stages.
struct Running {
  const Watch& watch;
  Report& report;
  StageCache* cache;                 ///< may be null
  Sample sample{};                   ///< which layers get beads
  SampleMeasure* measure = nullptr;  ///< of a sample that is not all: what its layers stand for is added
};

/// Says that a stage begins. @throws Stopped
template <Stage stage>
void begin(const Watch& watch) {
  stop_if_asked();
  constexpr const auto& row = row_of<stage>();
  if (!row.says.empty()) watch.progress(row.says, row.share);
}

/// One stage of a job: announced, timed, and taken from the cache where that has it. (A return type in words would put
/// the whole table of stages into the function's name, and into whatever compilers say of it.)
/// @return the Result of what its row says
template <Stage stage, class Key, class Make>
auto run_stage(const Running& job, Key key, Make make) {
  static_assert(std::is_same_v<std::invoke_result_t<Make&>, ResultOf<stage>>, "a stage makes what its row says");
  begin<stage>(job.watch);
  const Stopwatch stopwatch(job.report.timings_ms[stage]);
  return cached(job.cache, key, make);
}

}  // namespace weft::pipeline
