// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "mesh/archive.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace weft::mesh {

/// The attributes of an element. Their names are "name", or "namespace|name" when they have a prefix.
class XmlAttributes {
 public:
  explicit XmlAttributes(const char* const* list) : list_(list) {}
  std::optional<std::string_view> find(std::string_view name) const;

 private:
  const char* const* list_;  ///< name, value, name, value, ..., nullptr
};

/// What is called while a document is read; each may throw and each may be empty. Names are "namespace|name".
struct XmlEvents {
  std::function<void(std::string_view name, const XmlAttributes& attributes, std::size_t line)> start;
  std::function<void(std::string_view name)> end;
  std::function<void(std::string_view prefix, std::string_view of_namespace)> prefix;
  std::string_view text_in{};  ///< of elements that are called so, whatever their namespace, `text` is told the text
  std::function<void(std::string_view piece)> text{};  ///< in pieces
};

/// Reads a part of the archive as XML. Throws: Error::Kind::model, naming part and line, for what is no XML, declares a
/// document type (which a 3MF must not, and through which entities are multiplied) or nests deeper than any 3MF.
void parse_xml(Archive& archive, const std::string& part, const std::string& path, const XmlEvents& events);

}  // namespace weft::mesh
