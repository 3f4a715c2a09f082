// SPDX-License-Identifier: GPL-3.0-or-later
#include "cache/disk_store.h"

#include "core/error.h"
#include "core/file_bytes.h"
#include "core/hash.h"
#include "core/write_file.h"

#include <algorithm>
#include <chrono>
#include <vector>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace weft::cache {
namespace fs = std::filesystem;
namespace {

// An entry: this line, the hash of the rest behind the next line's end, the stage and key, then the bytes.
constexpr std::string_view magic = "weft stage 1\n";

std::string headed(std::string_view stage, const std::string& key, std::string_view bytes) {
  std::string body = std::string(stage) + " " + key + "\n";
  body += bytes;
  std::string out(magic);
  out += sha256(body);
  out += '\n';
  return out += body;
}

/// The bytes behind the header, or nothing when they are not what was written.
std::optional<std::string> checked(std::string_view stage, const std::string& key, std::string_view file) {
  constexpr std::size_t digits = 64;
  if (!file.starts_with(magic) || file.size() < magic.size() + digits + 1) return std::nullopt;
  const std::string_view hash = file.substr(magic.size(), digits);
  const std::string_view body = file.substr(magic.size() + digits + 1);
  const std::string head = std::string(stage) + " " + key + "\n";
  if (sha256(body) != hash || !body.starts_with(head)) return std::nullopt;
  return std::string(body.substr(head.size()));
}

struct Entry {
  fs::path path;
  std::uint64_t size = 0;
  fs::file_time_type used;
};

std::vector<Entry> entries_of(const fs::path& folder) {
  std::vector<Entry> out;
  std::error_code error;
  const auto now = fs::file_time_type::clock::now();
  for (const auto& sub : fs::directory_iterator(folder, error)) {
    if (!sub.is_directory(error)) continue;
    for (const auto& file : fs::directory_iterator(sub.path(), error)) {
      Entry entry{file.path(), 0, {}};
      entry.used = file.last_write_time(error);
      entry.size = error ? 0 : file.file_size(error);
      if (error) continue;  // another process was quicker
      const bool half_written = entry.path.filename().string().find(".weft-") != std::string::npos;
      if (half_written && now - entry.used > std::chrono::hours(1))
        fs::remove(entry.path, error);  // its writer was killed
      else
        out.push_back(std::move(entry));
    }
  }
  return out;
}

}  // namespace

DiskStore::DiskStore(fs::path folder, std::uint64_t max_bytes) : folder_(std::move(folder)), max_bytes_(max_bytes) {
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error)
    throw Error{Error::Kind::file, "cannot be made (" + error.message() + ")", folder_.string(),
                "check the path and its permissions"};
}

fs::path DiskStore::path_of(std::string_view stage, const std::string& key) const {
  return folder_ / key.substr(0, 2) / (key.substr(2) + "." + std::string(stage));
}

std::optional<std::string> DiskStore::read(std::string_view stage, const std::string& key) {
  const auto path = path_of(stage, key);
  std::error_code none;
  if (fs::symlink_status(path, none).type() == fs::file_type::not_found || none) return std::nullopt;
  std::optional<std::string> bytes;
  try {
    bytes = checked(stage, key, FileBytes(path.string()).view());
  } catch (const Error&) {  // what cannot be read is not there
  }
  if (bytes)
    ::utimensat(AT_FDCWD, path.c_str(), nullptr, 0);  // used now
  else
    discard(stage, key);
  return bytes;
}

void DiskStore::discard(std::string_view stage, const std::string& key) {
  ++damaged_;
  std::error_code ignored;
  fs::remove(path_of(stage, key), ignored);
}

void DiskStore::write(std::string_view stage, const std::string& key, std::string_view bytes) {
  const auto file = headed(stage, key, bytes);
  if (file.size() > max_bytes_) return;
  if ((until_trim_ -= static_cast<std::int64_t>(file.size())) < 0) trim();
  try {
    const auto path = path_of(stage, key);
    std::error_code ignored;
    fs::create_directory(path.parent_path(), ignored);
    write_file(path, file);
  } catch (const Error&) {
    ++unwritten_;
  }
}

void DiskStore::trim() {
  until_trim_ = static_cast<std::int64_t>(max_bytes_ / 16);
  const int lock = ::open((folder_ / "lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (lock < 0) return;
  if (::flock(lock, LOCK_EX | LOCK_NB) == 0) {  // another process at it: one is enough
    auto entries = entries_of(folder_);
    std::uint64_t total = 0;
    for (const auto& entry : entries) total += entry.size;
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.used < b.used; });
    const auto wanted = max_bytes_ - max_bytes_ / 16;  // room for what is written until the next look
    for (const auto& entry : entries) {
      if (total <= wanted) break;
      std::error_code ignored;
      if (fs::remove(entry.path, ignored)) total -= entry.size;
    }
  }
  ::close(lock);
}

}  // namespace weft::cache
