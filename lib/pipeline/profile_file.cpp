// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/profile_file.h"

#include "core/error.h"
#include "mesh/archive.h"

namespace weft {

std::string profile_text(const std::filesystem::path& path, const ImportOptions& options) {
  auto bytes = read_profile(path, options);
  if (!bytes.starts_with("PK\3\4")) return bytes;
  const auto name = path.string();
  try {
    mesh::Archive archive(bytes, name);
    constexpr auto part = "Metadata/Slic3r_PE.config";
    if (!archive.has(part)) {
      const bool orca = archive.has("Metadata/project_settings.config");
      throw Error{Error::Kind::settings, "is a 3MF without a configuration of PrusaSlicer's", name,
                  orca ? "its settings are those of Orca or Bambu, which weft does not read" : "name an ini file"};
    }
    return archive.text(part);
  } catch (const Error& error) {
    if (error.kind() != Error::Kind::model) throw;
    throw Error{Error::Kind::settings, error.what(), {}, {}};
  }
}

void apply_profile(Profile& profile, const std::filesystem::path& path, const ImportOptions& options) {
  const auto found = profile_file(path, {}, options.folders);
  apply_text(profile, profile_text(found, options), found, options);
}

}  // namespace weft
