// SPDX-License-Identifier: GPL-3.0-or-later
#include "profile/named_profiles.h"

#include "core/error.h"
#include "core/join.h"
#include "settings/near.h"
#include "settings/value.h"

#include <algorithm>
#include <fstream>

#include <fmt/format.h>

namespace weft {
namespace fs = std::filesystem;
namespace {

/// Can it be a name, and not only a path?
bool is_name(const fs::path& typed) {
  if (typed.empty() || !typed.has_filename() || typed.is_absolute()) return false;
  return std::none_of(typed.begin(), typed.end(), [](const fs::path& part) { return part == "." || part == ".."; });
}

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

/// Folders right in a folder, sorted; none when it cannot be read.
std::vector<fs::path> folders_in(const fs::path& folder) {
  std::vector<fs::path> out;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
    if (at->is_directory(error)) out.push_back(at->path());
  std::sort(out.begin(), out.end());
  return out;
}

/// Where in a folder a profile of that name is.
std::vector<fs::path> places_of(const fs::path& name, const fs::path& folder) {
  fs::path with_ending = name;
  with_ending += ".ini";
  for (const auto& spelled : {name, with_ending})
    if (is_file(folder / spelled)) return {folder / spelled};
  std::vector<fs::path> out;
  for (const auto& inner : folders_in(folder))
    for (const auto& spelled : {name, with_ending})
      if (is_file(inner / spelled)) {
        out.push_back(inner / spelled);
        break;
      }
  return out;
}

std::string about(const fs::path& file) {
  std::ifstream in(file);
  std::string line;
  if (!std::getline(in, line) || line.empty() || (line[0] != '#' && line[0] != ';')) return {};
  return std::string(value::trimmed(std::string_view(line).substr(1)));
}

void add(std::vector<NamedProfile>& to, const fs::path& folder, const std::string& prefix) {
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
    if (at->path().extension() == ".ini" && is_file(at->path()))
      to.push_back({prefix + at->path().stem().string(), at->path(), about(at->path())});
}

}  // namespace

std::optional<fs::path> find_profile(const fs::path& typed, const fs::path& base, const ProfileFolders& folders) {
  const auto path = base.empty() || typed.is_absolute() ? typed : base / typed;
  std::error_code ignored;
  if (fs::exists(path, ignored)) return path;
  if (!is_name(typed)) return std::nullopt;
  for (const auto& folder : folders) {
    const auto places = places_of(typed, folder);
    if (places.size() == 1) return places.front();
    if (places.empty()) continue;
    std::vector<std::string> names;
    for (const auto& place : places) names.push_back(place.lexically_relative(folder).replace_extension().string());
    throw Error{Error::Kind::settings, fmt::format("is the name of {} profiles in {}", places.size(), folder.string()),
                typed.string(), "which of them: " + joined(names, ", ") + "?"};
  }
  return std::nullopt;
}

fs::path profile_file(const fs::path& typed, const fs::path& base, const ProfileFolders& folders) {
  if (const auto found = find_profile(typed, base, folders)) return *found;
  const auto path = base.empty() || typed.is_absolute() ? typed : base / typed;
  if (!is_name(typed)) return path;
  std::vector<std::string> names;
  for (const auto& folder : folders)
    for (const auto& profile : profiles_in(folder))
      names.push_back(typed.has_parent_path() ? profile.name : profile.file.stem().string());
  if (names.empty()) return path;
  auto wanted = typed;
  if (wanted.extension() == ".ini") wanted.replace_extension();
  throw Error{Error::Kind::file, "cannot be read: there is neither a file nor a profile of that name", path.string(),
              did_you_mean(wanted.string(), names) + " `weft profile list` names them all"};
}

std::vector<NamedProfile> profiles_in(const fs::path& folder) {
  std::vector<NamedProfile> out;
  add(out, folder, {});
  for (const auto& inner : folders_in(folder)) add(out, inner, inner.filename().string() + "/");
  std::sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return out;
}

}  // namespace weft
