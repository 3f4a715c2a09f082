// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>
#include <zip.h>

namespace fixtures {

/// A zip archive of the parts (name, content), packed.
inline std::string zipped(const std::vector<std::pair<std::string, std::string>>& parts) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* archive = zip_source_buffer_create(nullptr, 0, 0, &error);
  REQUIRE(archive);
  zip_source_keep(archive);
  zip_t* zip = zip_open_from_source(archive, ZIP_TRUNCATE, &error);
  REQUIRE(zip);
  for (const auto& [name, content] : parts)
    REQUIRE(zip_file_add(zip, name.c_str(), zip_source_buffer(zip, content.data(), content.size(), 0), 0) >= 0);
  REQUIRE(zip_close(zip) == 0);
  REQUIRE(zip_source_open(archive) == 0);
  zip_stat_t status;
  REQUIRE(zip_source_stat(archive, &status) == 0);
  std::string bytes(status.size, '\0');
  REQUIRE(zip_source_read(archive, bytes.data(), bytes.size()) == static_cast<zip_int64_t>(bytes.size()));
  zip_source_close(archive);
  zip_source_free(archive);
  zip_error_fini(&error);
  return bytes;
}

inline const std::string relationships =
    R"(<?xml version="1.0" encoding="UTF-8"?>
<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">
  <Relationship Target="/3D/3dmodel.model" Id="rel0" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>
</Relationships>)";

/// A 3MF with this model part.
inline std::string three_mf(const std::string& model, std::vector<std::pair<std::string, std::string>> more = {}) {
  more.insert(more.begin(), {{"_rels/.rels", relationships}, {"3D/3dmodel.model", model}});
  return zipped(more);
}

}  // namespace fixtures
