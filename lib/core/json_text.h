// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/escape.h"
#include "core/utf8.h"

#include <string>
#include <utility>

namespace weft {

/// Texts in it become UTF-8 (escape::utf8): a JSON library writes nothing else. Names of fields are the program's own.
template <class Json>
void make_utf8(Json& json) {
  if (json.is_string()) {
    auto& text = json.template get_ref<typename Json::string_t&>();
    if (!is_utf8(text)) text = escape::utf8(text);
  } else if (json.is_structured()) {
    for (auto& part : json) make_utf8(part);
  }
}

/// The text of JSON in which names of files may stand. @param indent spaces a level; -1: all on one line
template <class Json>
std::string json_text(Json json, int indent = -1) {
  make_utf8(json);
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace weft
