// SPDX-License-Identifier: GPL-3.0-or-later
#include "prusaslicer/text.h"

#include "core/join.h"
#include "core/parts.h"
#include "prusaslicer/keys.h"
#include "settings/gcode_variables.h"
#include "settings/value.h"

#include <algorithm>
#include <stdexcept>

namespace weft::prusaslicer {
namespace {

Written written(std::string_view key) {
  const auto* row = find_key(key);
  return row ? row->written : Written::plain;
}

}  // namespace

bool is_text_list(std::string_view key) {
  return written(key) == Written::texts;
}
bool is_flag(std::string_view key) {
  return written(key) == Written::flag;
}
bool is_text(std::string_view key) {
  return is_text_list(key) || written(key) == Written::text;
}

std::vector<std::string> texts_of(std::string_view list) {
  std::vector<std::string> out;
  list = value::trimmed(list);
  while (!list.empty()) {
    std::string element;
    std::size_t i = 0;
    if (list.front() == '"') {
      for (i = 1; i < list.size() && list[i] != '"'; ++i) {
        if (list[i] == '\\' && i + 1 < list.size()) {
          const char c = list[++i];
          if (c != '"') element += '\\';
          element += c;
        } else {
          element += list[i];
        }
      }
      i = std::min(list.find(';', std::min(i + 1, list.size())), list.size());
    } else {
      i = std::min(list.find(';'), list.size());
      element = std::string(value::trimmed(list.substr(0, i)));
    }
    out.push_back(std::move(element));
    list = value::trimmed(list.substr(std::min(i + 1, list.size())));
  }
  return out;
}

std::vector<std::string> elements_of(std::string_view key, std::string_view text) {
  if (is_text_list(key)) return texts_of(text);
  if (is_text(key)) {
    if (text.size() >= 2 && text.front() == '"' && text.back() == '"') return texts_of(text);
    std::string out;  // a quote may be escaped in a single text as well
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (text[i] == '\\' && i + 1 < text.size() && text[i + 1] != '"')
        out += text[i++];
      else if (text[i] == '\\' && i + 1 < text.size())
        ++i;
      out += text[i];
    }
    return {out};
  }
  std::vector<std::string> out;
  for (const auto part : parts(text, ',')) out.emplace_back(value::trimmed(part));
  return out;
}

std::string in_macro_words(std::string_view key, std::string_view text) {
  auto elements = elements_of(key, text);
  for (auto& element : elements) {
    if (is_text(key)) {
      std::string decoded;
      value::parse(element, Unit::none, decoded);
      element = quoted_variable(decoded);
    } else if (is_flag(key)) {
      element = element == "1" ? "true" : element == "0" ? "false" : element;
    }
  }
  return joined(elements);
}

bool says_one_of(std::string_view things, std::string_view key, std::string_view text) {
  const auto canonical = [](std::string_view t) {
    if (!t.empty() && t.back() == '%') t.remove_suffix(1);
    double v = 0;
    try {
      value::parse(t, Unit::none, v);
    } catch (const std::invalid_argument&) {
      return std::string(t);
    }
    return value::number(v);
  };
  const auto is_one = [&](const std::string& element) {
    for (std::string_view rest = things;;) {
      const auto bar = rest.find('|');
      if (canonical(element) == canonical(rest.substr(0, bar))) return true;
      if (bar == std::string_view::npos) return false;
      rest.remove_prefix(bar + 1);
    }
  };
  const auto elements = elements_of(key, text);
  return std::all_of(elements.begin(), elements.end(), is_one);
}

std::string png_sizes(std::string_view thumbnails, std::vector<std::string>& left_out) {
  std::string sizes;
  for (const auto& part : elements_of("thumbnails", thumbnails)) {
    const auto slash = part.find('/');
    if (slash != std::string::npos && part.substr(slash + 1) != "PNG")
      left_out.push_back(part);
    else if (!part.empty())
      sizes += (sizes.empty() ? "" : ", ") + part.substr(0, slash);
  }
  return sizes;
}

}  // namespace weft::prusaslicer
