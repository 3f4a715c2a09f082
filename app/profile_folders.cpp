// SPDX-License-Identifier: GPL-3.0-or-later
#include "profile_folders.h"

#include <algorithm>
#include <cstdlib>
#include <set>
#include <sstream>

#include <fmt/format.h>

namespace weft::app {
namespace fs = std::filesystem;

ProfileFolders profile_folders() {
  ProfileFolders out;
  std::error_code error;
  if (const char* own = std::getenv("WEFT_PROFILES")) {
    std::istringstream folders(own);
    for (std::string folder; std::getline(folders, folder, ':');)
      if (!folder.empty() && fs::is_directory(folder, error)) out.emplace_back(folder);
  }
  const auto program = fs::read_symlink("/proc/self/exe", error);
  const auto installed = (program.parent_path() / WEFT_PROFILES_FROM_PROGRAM).lexically_normal();
  if (!program.empty() && fs::is_directory(installed, error)) out.push_back(installed);
  return out;
}

std::string list_of_profiles(const ProfileFolders& folders) {
  std::string out;
  std::set<std::string> listed;
  for (const auto& folder : folders) {
    auto profiles = profiles_in(folder);
    std::erase_if(profiles, [&](const NamedProfile& profile) { return !listed.insert(profile.name).second; });
    std::size_t width = 0;
    for (const auto& profile : profiles) width = std::max(width, profile.name.size());
    out += fmt::format("# {}\n", folder.string());
    for (const auto& profile : profiles)
      out +=
          profile.about.empty() ? profile.name + "\n" : fmt::format("{:<{}}  {}\n", profile.name, width, profile.about);
  }
  return out;
}

}  // namespace weft::app
