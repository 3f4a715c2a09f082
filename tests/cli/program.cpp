// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/program.h"

#include "cuboid.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace {
std::string contents(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

Run run(const char* program, const std::vector<std::string>& words, const std::filesystem::path& folder) {
  const Scratch streams;
  const std::string out = (streams.path() / "out").string(), err = (streams.path() / "err").string();
  std::vector<std::string> arguments{program};
  arguments.insert(arguments.end(), words.begin(), words.end());
  std::vector<char*> pointers;
  for (auto& a : arguments) pointers.push_back(a.data());
  pointers.push_back(nullptr);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 1, out.c_str(), O_WRONLY | O_CREAT, 0600);
  posix_spawn_file_actions_addopen(&actions, 2, err.c_str(), O_WRONLY | O_CREAT, 0600);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  pid_t pid = 0;
  const int error = posix_spawn(&pid, program, &actions, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) throw std::runtime_error(std::string("cannot run ") + program + ": " + std::strerror(error));
  int status = 0;
  ::waitpid(pid, &status, 0);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), contents(out), contents(err)};
}
}  // namespace

Run weft(const std::vector<std::string>& words, const std::filesystem::path& folder) {
  return run(WEFT_PROGRAM, words, folder);
}

Run shell(const std::string& script, const std::filesystem::path& folder) {
  ::setenv("WEFT", WEFT_PROGRAM, 1);
  return run("/bin/bash", {"-c", script}, folder);
}

Scratch::Scratch() {
  std::string name = (std::filesystem::temp_directory_path() / "weft-test-XXXXXX").string();
  if (!::mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
  path_ = name;
}
Scratch::~Scratch() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}
std::filesystem::path Scratch::write(const std::string& name, const std::string& bytes) const {
  std::filesystem::create_directories((path_ / name).parent_path());
  std::ofstream(path_ / name, std::ios::binary) << bytes;
  return path_ / name;
}
std::string Scratch::read(const std::string& name) const {
  return contents(path_ / name);
}
std::vector<std::string> Scratch::names() const {
  std::vector<std::string> out;
  for (const auto& entry : std::filesystem::directory_iterator(path_)) out.push_back(entry.path().filename().string());
  std::sort(out.begin(), out.end());
  return out;
}

std::string boxes_stl(float x, float y, float z, int side, float pitch) {
  std::string out(80, '\0');
  const auto add = [&](const void* data, std::size_t size) { out.append(static_cast<const char*>(data), size); };
  const auto count = static_cast<std::uint32_t>(cuboid_faces.size()) * static_cast<std::uint32_t>(side * side);
  add(&count, 4);
  for (int i = 0; i < side * side; ++i) {
    const float left = pitch * static_cast<float>(i % side), front = pitch * static_cast<float>(i / side),
                right = left + x, back = front + y;
    const std::array<std::array<float, 3>, 8> corner{{{left, front, 0},
                                                      {right, front, 0},
                                                      {right, back, 0},
                                                      {left, back, 0},
                                                      {left, front, z},
                                                      {right, front, z},
                                                      {right, back, z},
                                                      {left, back, z}}};
    for (const auto& face : cuboid_faces) {
      out.append(12, '\0');
      for (const int v : face) add(corner[static_cast<std::size_t>(v)].data(), 12);
      out.append(2, '\0');
    }
  }
  return out;
}

std::string box_stl(float x, float y, float z) {
  return boxes_stl(x, y, z, 1, 0);
}
