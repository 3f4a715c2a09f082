// SPDX-License-Identifier: GPL-3.0-or-later
// libFuzzer target for the folder of --cache. The bytes are the file of an entry: it is what was written there, or it
// is made again. And, behind a first byte that says of which stage, they are a result whose hash is right: it is
// refused or read, in memory that its size bounds, and what is read can be written and read again.
#include "cache/disk_store.h"
#include "cache/stage_cache.h"
#include "core/hash.h"
#include "pipeline/codec.h"

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <string_view>

#include <unistd.h>

namespace {

using namespace weft;
namespace fs = std::filesystem;

void require(bool holds) {
  if (!holds) std::abort();
}

struct Folder {
  fs::path path = fs::temp_directory_path() / ("weft-cache-entry-fuzz-" + std::to_string(::getpid()));
  Folder() { fs::create_directories(path); }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
};

const std::string key(64, 'a');
constexpr std::string_view right = "what the stage has made";

std::string text_of(const void* value) {
  return *static_cast<const std::string*>(value);
}
std::shared_ptr<const void> text_from(std::string_view bytes) {
  return std::make_shared<const std::string>(bytes);
}
std::size_t size_of_text(const void* value) {
  return static_cast<const std::string*>(value)->size();
}

/// An entry whose file has these bytes.
void as_file(const fs::path& folder, std::string_view bytes) {
  const auto file = folder / key.substr(0, 2) / (key.substr(2) + ".walls");
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  StageCache cache({.folder = folder});
  const StageCache::Kind kind{text_of, text_from, size_of_text};
  const auto made = cache.get("walls", key, kind, [] { return std::make_shared<const std::string>(right); });
  require(*static_cast<const std::string*>(made.get()) == right);
  require(cache::DiskStore(folder, 1 << 20).read("walls", key) == right);  // mended
}

template <class T>
void as_result(std::string_view bytes) {
  T value;
  try {
    pipeline::decode(bytes, value);
  } catch (const std::runtime_error&) {
    return;
  }
  require(pipeline::memory_of(value) <= 1024 * (bytes.size() + 1));  // an item takes a byte at least
  const auto written = pipeline::encode(value);
  T again;
  pipeline::decode(written, again);
  require(pipeline::encode(again) == written);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Folder folder;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  if (bytes.empty()) return 0;
  const auto rest = bytes.substr(1);
  switch (bytes.front() % 5) {
    case 0:
      as_result<mesh::Loaded>(rest);
      break;
    case 1:
      as_result<std::vector<slice::Cut>>(rest);
      break;
    case 2:
      as_result<std::vector<WallLayer>>(rest);
      break;
    case 3:
      as_result<std::vector<pipeline::FilledLayer>>(rest);
      break;
    default:
      as_file(folder.path, rest);
  }
  return 0;
}
