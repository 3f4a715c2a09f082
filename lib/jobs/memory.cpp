// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/memory.h"

#include <algorithm>
#include <fstream>
#include <optional>
#include <string>

#include <malloc.h>
#include <unistd.h>

namespace weft::jobs {
namespace {

std::optional<std::uint64_t> number_in(const std::string& path) {
  std::ifstream in(path);
  std::uint64_t v = 0;
  if (in >> v) return v;  // "max" is no number: no limit
  return std::nullopt;
}

/// The folder of this process in the tree of control groups (version 2).
std::string control_group() {
  std::ifstream in("/proc/self/cgroup");
  for (std::string line; std::getline(in, line);)
    if (line.starts_with("0::")) return line.substr(3);
  return "/";
}

std::uint64_t available_in_control_groups() {
  std::uint64_t least = UINT64_MAX;
  for (std::string group = control_group();;
       group = group.substr(0, group.rfind('/'))) {  // a limit of any parent holds as well
    const std::string folder = "/sys/fs/cgroup" + (group == "/" ? "" : group);
    if (const auto limit = number_in(folder + "/memory.max")) {
      const auto used = number_in(folder + "/memory.current").value_or(0);
      least = std::min(least, *limit > used ? *limit - used : 0);
    }
    if (group.empty() || group == "/") return least;
  }
}

}  // namespace

std::uint64_t resident_bytes() {
  std::ifstream in("/proc/self/statm");
  std::uint64_t total = 0, resident = 0;
  if (!(in >> total >> resident)) return 0;
  return resident * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

std::uint64_t available_bytes() {
  std::ifstream in("/proc/meminfo");
  std::uint64_t available = 0;
  for (std::string line; available == 0 && std::getline(in, line);)
    if (line.starts_with("MemAvailable:")) available = std::stoull(line.substr(13)) * 1024;
  if (available == 0) return 0;
  return std::min(available, available_in_control_groups());
}

void release_freed_memory() {
  ::malloc_trim(0);
}

}  // namespace weft::jobs
