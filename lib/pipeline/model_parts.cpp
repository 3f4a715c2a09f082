// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/model_parts.h"

#include "core/error.h"
#include "core/number.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include <fmt/format.h>

namespace weft::pipeline {
namespace {

bool is_file(const std::string& name) {
  std::error_code unknown;
  return std::filesystem::exists(name, unknown);
}

ModelPart part_of(const std::string& typed) {
  const auto at = typed.rfind("@T");
  if (at == std::string::npos || is_file(typed)) return {typed};
  const auto tool = as_number<int>(std::string_view(typed).substr(at + 2));
  if (!tool || *tool < 0 || *tool > 31) return {typed};
  return {typed.substr(0, at), tool};
}

}  // namespace

std::vector<ModelPart> parts_of(const std::string& typed) {
  auto whole = part_of(typed);
  if (is_file(whole.file) || typed.find('+') == std::string::npos) return {std::move(whole)};
  std::vector<ModelPart> out;
  for (std::size_t begin = 0; begin <= typed.size();) {
    const auto plus = std::min(typed.find('+', begin), typed.size());
    out.push_back(part_of(typed.substr(begin, plus - begin)));
    if (out.back().file.empty())
      throw Error{Error::Kind::usage, fmt::format("'{}': a part has no name", typed), {}, "as in body.stl+logo.stl@T1"};
    begin = plus + 1;
  }
  return out;
}

std::vector<std::string> files_of(const std::vector<std::string>& typed) {
  std::vector<std::string> out;
  for (const auto& model : typed)
    for (auto& part : parts_of(model)) out.push_back(std::move(part.file));
  return out;
}

}  // namespace weft::pipeline
