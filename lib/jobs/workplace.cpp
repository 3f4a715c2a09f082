// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/workplace.h"

#include "core/error.h"
#include "core/write_file.h"

#include <cerrno>
#include <cstring>
#include <set>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace weft::jobs {
namespace fs = std::filesystem;
namespace {

void make(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw Error{Error::Kind::file, "cannot be made (" + error.message() + ")", folder.string(),
                "check the path and its permissions"};
}

/// Removes what write_file leaves when it is killed: NAME.weft-XXXXXX beside NAME.
void clear_debris(const fs::path& folder, const std::set<std::string>& of, bool any) {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const auto name = entry.path().filename().string();
    const auto at = name.rfind(".weft-");
    if (at == std::string::npos || name.size() != at + 12) continue;
    if (any || of.contains(name.substr(0, at))) fs::remove(entry.path(), ignored);
  }
}

}  // namespace

Workplace::Workplace(const fs::path& folder, std::span<const std::string> outputs) {
  make(folder / ".weft" / "jobs");
  std::set<fs::path> folders{folder};
  std::set<std::string> names{"report.jsonl", "summary.csv", "junit.xml", "index.html"};
  for (const auto& output : outputs) {
    folders.insert((folder / output).parent_path());
    names.insert(fs::path(output).filename().string().substr(0, most_of_name));
  }
  for (const auto& needed : folders) make(needed);
  const auto path = folder / ".weft" / "lock";
  lock_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (lock_ < 0)
    throw Error{Error::Kind::file, std::string("cannot be written (") + std::strerror(errno) + ")", path.string(),
                "check its permissions"};
  if (::flock(lock_, LOCK_EX | LOCK_NB) == 0) {
    for (const auto& used : folders) clear_debris(used, names, false);
    clear_debris(folder / ".weft" / "jobs", {}, true);
  }
  ::flock(lock_, LOCK_SH);
}

Workplace::~Workplace() {
  if (lock_ >= 0) ::close(lock_);
}

}  // namespace weft::jobs
