// SPDX-License-Identifier: GPL-3.0-or-later
#include "outputs.h"

#include "core/error.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>
#include <unistd.h>

namespace weft::app {
namespace {

std::string extension_of(const std::string& path) {
  auto out = std::filesystem::path(path).extension().string();
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return out;
}

std::string shown(const std::string& path) {
  return path == "-" ? "standard output" : path;
}

Error would_be_lost(const std::string& input, const std::string& output, std::string option) {
  return {Error::Kind::usage,
          input == output ? fmt::format("{} is read, and would be lost", input)
                          : fmt::format("{} is the file {}, which is read and would be lost", shown(output), input),
          std::move(option), "name another file"};
}

}  // namespace

void Files::reads(const std::string& path) {
  const auto place = place_of(path);
  if (!place || !place->name.empty()) return;
  if (const auto at = written_.find(*place); at != written_.end())
    throw would_be_lost(path, at->second.path, at->second.option);
  read_.emplace(*place, path);
}

void Files::writes(const std::string& path, std::string_view option, bool profiles) {
  const auto extension = extension_of(path);
  const bool model = extension == ".stl" || extension == ".obj" || extension == ".3mf";
  if (model || (extension == ".ini" && !profiles))
    throw Error{Error::Kind::usage,
                fmt::format("{} is named like a {}, which is never written", path, model ? "model" : "profile"),
                std::string(option), "name the result otherwise"};
  const auto place = path == "-" ? place_of(STDOUT_FILENO) : place_of(path);
  if (!place) return;
  if (const auto at = read_.find(*place); at != read_.end()) throw would_be_lost(at->second, path, std::string(option));
  if (const auto [at, is_new] = written_.try_emplace(*place, Output{path, std::string(option)}); !is_new)
    throw Error{Error::Kind::usage,
                fmt::format("{} is the file of {} {}", shown(path), at->second.option, shown(at->second.path)),
                std::string(option), "give each a file of its own"};
}

bool may_be_input(const std::string& destination) {
  std::error_code unknown;
  if (destination == "-" || !std::filesystem::is_regular_file(destination, unknown)) return false;
  const int first = std::ifstream(destination, std::ios::binary).get();
  return first != '{' && first != std::ifstream::traits_type::eof();
}

void check_writable(const std::string& destination) {
  if (destination == "-") return;
  namespace fs = std::filesystem;
  std::error_code unknown;
  const auto target = followed(destination);
  const auto folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  if (fs::is_directory(target, unknown))
    throw Error{Error::Kind::file, "is a folder", destination, "name a file in it"};
  const bool replaced = fs::is_regular_file(target, unknown) || !fs::exists(target, unknown);  // by its neighbour
  if (::access(replaced ? folder.c_str() : target.c_str(), W_OK) != 0)
    throw Error{Error::Kind::file, fmt::format("cannot be written ({})", std::strerror(errno)), destination,
                errno == ENOENT ? "does the folder exist?" : "check the path and its permissions"};
}

}  // namespace weft::app
