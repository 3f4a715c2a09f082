// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/read.h"

#include "core/error.h"
#include "core/file_bytes.h"
#include "core/hash.h"
#include "core/stop.h"
#include "mesh/formats.h"
#include "tasks/tasks.h"

#include <cmath>
#include <cstring>

#include <fmt/format.h>

namespace weft::mesh {
namespace {

/// What is not text has a zero byte among its first ones: a binary STL in its header or in its count.
bool is_text(std::string_view bytes) {
  return bytes.substr(0, 4096).find('\0') == bytes.npos;
}

std::string_view without_byte_order_mark(std::string_view text) {
  return text.starts_with("\xEF\xBB\xBF") ? text.substr(3) : text;
}

Error unknown(const Source& source) {
  const std::size_t size = source.bytes.size();
  const auto error = [&](std::string what, std::string hint) {
    return Error(Error::Kind::model, std::move(what), source.path, std::move(hint));
  };
  if (size == 0) return error("the file is empty", "export the model again");
  if (const auto damage = damage_of_binary_stl(source.bytes); damage && !is_text(source.bytes))
    return error(*damage, "copy or export it again");
  return error("not a model: neither STL, OBJ nor 3MF", "export the model as one of these");
}

struct Reader {
  Format format;
  Contents (*read)(const Source&);
};

Reader reader_for(const Source& source) {
  if (is_binary_stl(source.bytes)) return {Format::stl_binary, read_binary_stl};
  if (is_text(source.bytes) && is_ascii_stl(source.bytes)) return {Format::stl_ascii, read_ascii_stl};
  if (is_text(source.bytes) && is_obj(source.bytes))
    return {Format::obj, [](const Source& obj) { return read_obj(obj); }};
  if (is_3mf(source.bytes)) return {Format::three_mf, read_3mf};
  if (!is_text(source.bytes) && bytes_behind_binary_stl(source.bytes)) return {Format::stl_binary, read_binary_stl};
  throw unknown(source);
}

}  // namespace

std::string_view name_of(Format format) {
  switch (format) {
    case Format::stl_binary:
      return "binary STL";
    case Format::stl_ascii:
      return "ASCII STL";
    case Format::obj:
      return "OBJ";
    case Format::three_mf:
      return "3MF";
  }
  return "";
}

std::string fault_of(double mm) {
  if (std::isnan(mm)) return "is not a number";
  if (std::isinf(mm)) return "is infinite";
  return fmt::format("is {:g} mm, beyond ±16 m", mm);
}

namespace {

/// Repairs the bodies of a file.
Loaded loaded_from(Contents contents, Format format, const std::string& path_as_typed) {
  Loaded loaded{.path = path_as_typed, .format = format};
  loaded.unit = std::move(contents.unit);
  loaded.notices = std::move(contents.notices);
  loaded.author = contents.author;
  loaded.items = std::move(contents.items);
  loaded.plates = std::move(contents.plates);
  const bool bodies_are_items = loaded.items.empty();
  for (Body& body : contents.bodies) {
    stop_if_asked();
    loaded.triangles_in_file += body.mesh.triangles.size();
    if (bodies_are_items) {
      body.item = loaded.items.size();
      loaded.items.push_back({body.name, {}, {}, {}});
    }
    Repaired repaired = repair(std::move(body.mesh));
    if (!repaired.mesh.triangles.empty())
      loaded.objects.push_back({std::move(body.name), std::move(repaired.mesh), repaired.repairs, std::move(body.marks),
                                body.item, std::move(body.settings)});
    else
      loaded.notices.push_back({"mesh_object_empty", fmt::format("{}: an object '{}' without a triangle was left out",
                                                                 path_as_typed, body.name)});
  }
  if (loaded.objects.empty())
    throw Error(Error::Kind::model,
                loaded.triangles_in_file == 0
                    ? fmt::format("{} without a triangle", name_of(loaded.format))
                    : fmt::format("none of its {} triangles has a size of a micron or encloses anything",
                                  loaded.triangles_in_file),
                path_as_typed, loaded.triangles_in_file == 0 ? "export the model again" : "check the unit and --scale");
  return loaded;
}

}  // namespace

Loaded read(std::string_view bytes, const std::string& path_as_typed, const ReadOptions& options) {
  Source source{without_byte_order_mark(bytes), path_as_typed, options.scale, options.plate};
  const Reader reader = reader_for(source);
  const bool says_unit = reader.format == Format::three_mf;
  if (!says_unit) source.scale *= options.mm_per_unit;
  std::string hash = options.sha256;
  tasks::Beside beside([&] {
    if (hash.empty()) hash = sha256(bytes);
  });
  auto loaded = loaded_from(reader.read(source), reader.format, path_as_typed);
  beside.wait();
  loaded.sha256 = std::move(hash);
  if (says_unit && options.mm_per_unit != 1)
    loaded.notices.push_back(
        {"unit_ignored", fmt::format("{}: the file says that its unit is a {}, and --unit has no effect; --scale has",
                                     path_as_typed, loaded.unit)});
  return loaded;
}

Loaded read_file(const std::string& path_as_typed, const ReadOptions& options) {
  InputFile file(path_as_typed);
  char bytes[128];
  const std::string_view front(bytes, file.regular() ? file.front(bytes, sizeof bytes) : 0);
  if (!is_binary_stl(front, file.size()) || without_byte_order_mark(front) != front)
    return read(FileBytes(file).view(), path_as_typed,
                {.scale = options.scale, .mm_per_unit = options.mm_per_unit, .sha256 = {}, .plate = options.plate});
  Sha256 hash;  // of the largest files, which are not needed as a whole
  auto contents = read_binary_stl(file, path_as_typed, options.scale * options.mm_per_unit,
                                  [&](std::string_view block) { hash.add(block); });
  auto loaded = loaded_from(std::move(contents), Format::stl_binary, path_as_typed);
  loaded.sha256 = hash.digest();
  return loaded;
}

}  // namespace weft::mesh
