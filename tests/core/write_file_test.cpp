// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/write_file.h"

#include "core/error.h"

#include <filesystem>
#include <fstream>
#include <iterator>

#include <catch2/catch.hpp>
#include <unistd.h>

using namespace weft;
namespace fs = std::filesystem;

namespace {
struct Folder {
  fs::path path = fs::temp_directory_path() / ("weft-write-test-" + std::to_string(::getpid()));
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
  std::string read(const char* name) const {
    std::ifstream in(path / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  std::ptrdiff_t files() const { return std::distance(fs::directory_iterator(path), fs::directory_iterator()); }
};
}  // namespace

TEST_CASE("write_file: a file is replaced whole, and nothing is left beside it") {
  Folder folder;
  write_file(folder.path / "a", "first");
  write_file(folder.path / "a", "second");
  CHECK(folder.read("a") == "second");
  CHECK(folder.files() == 1);
}

TEST_CASE("write_file: a missing folder is an error of the file, naming it") {
  Folder folder;
  try {
    write_file(folder.path / "none" / "a", "x");
    FAIL("nothing was thrown");
  } catch (const Error& e) {
    CHECK(e.kind() == Error::Kind::file);
    CHECK(e.where() == (folder.path / "none" / "a").string());
  }
  CHECK(folder.files() == 0);
}

TEST_CASE("write_file: a disk that is full is an error") {
  if (!fs::exists("/dev/full")) {
    WARN("no /dev/full here: the test is skipped");
    return;
  }
  CHECK_THROWS_AS(write_file("/dev/full", "x"), Error);
  CHECK(fs::is_character_file("/dev/full"));
}

TEST_CASE("write_file: a device is written to, not replaced") {
  write_file("/dev/null", "x");
  CHECK(fs::is_character_file("/dev/null"));
}

TEST_CASE("write_file: a folder is refused") {
  Folder folder;
  CHECK_THROWS_AS(write_file(folder.path, "x"), Error);
}
