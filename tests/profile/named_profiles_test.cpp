// SPDX-License-Identifier: GPL-3.0-or-later
#include "profile/named_profiles.h"

#include "profile/profile.h"
#include "settings_error.h"

#include <filesystem>
#include <fstream>

#include <catch2/catch.hpp>
#include <unistd.h>

using namespace weft;
using Catch::Matchers::Contains;
using weft::test::settings_error;
namespace fs = std::filesystem;

namespace {

/// Two folders of profiles and one where somebody works, gone with the test.
struct Shelves {
  fs::path root = fs::temp_directory_path() / ("weft-named-profiles-" + std::to_string(::getpid()));
  fs::path own = root / "own", installed = root / "installed", work = root / "work";
  ProfileFolders folders{own, installed};
  Shelves() {
    write(installed / "printers/one.ini", "# A printer.\nmachine_width = 100\n");
    write(installed / "printers/two.ini", "inherits = one.ini\nmachine_depth = 110\n");
    write(installed / "materials/pla.ini", "[material]\nmaterial_type = PLA\n");
    fs::create_directories(own);
    fs::create_directories(work);
  }
  ~Shelves() { fs::remove_all(root); }
  static void write(const fs::path& path, const std::string& text) {
    fs::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << text;
  }
  std::optional<fs::path> found(const char* typed) const { return find_profile(typed, work, folders); }
};

}  // namespace

TEST_CASE("profiles by name: with or without folder and ending, and the file that is typed comes first") {
  const Shelves s;
  for (const auto* typed : {"one", "one.ini", "printers/one", "printers/one.ini"}) {
    INFO(typed);
    CHECK(s.found(typed) == s.installed / "printers/one.ini");
  }
  Shelves::write(s.work / "one.ini", "machine_width = 50\n");
  CHECK(s.found("one.ini") == s.work / "one.ini");
  CHECK(s.found("one") == s.installed / "printers/one.ini");
}

TEST_CASE("profiles by name: one's own folder comes before the installed one") {
  const Shelves s;
  Shelves::write(s.own / "one.ini", "machine_width = 60\n");
  CHECK(s.found("one") == s.own / "one.ini");
  CHECK(s.found("printers/one") == s.installed / "printers/one.ini");
}

TEST_CASE("profiles by name: paths that go elsewhere are no names") {
  const Shelves s;
  Shelves::write(s.root / "secret.ini", "machine_width = 60\n");
  for (const auto* typed : {"../secret", "printers/../one", "./one", "/one", "", "printers/"}) {
    INFO(typed);
    CHECK_FALSE(s.found(typed) == s.root / "secret.ini");
    CHECK_FALSE(s.found(typed) == s.installed / "printers/one.ini");
  }
}

TEST_CASE("profiles by name: of two with the same name in a folder neither is taken") {
  const Shelves s;
  Shelves::write(s.installed / "materials/one.ini", "material_type = ABS\n");
  const auto error = settings_error([&] { (void)s.found("one"); });
  CHECK_THAT(error, Contains("2 profiles") && Contains("materials/one") && Contains("printers/one"));
  CHECK(s.found("materials/one") == s.installed / "materials/one.ini");
}

TEST_CASE("profiles by name: what is inherited is found by name, too, and beside the file first") {
  const Shelves s;
  Shelves::write(s.work / "mine.ini", "inherits = printers/two\nmachine_height = 120\n");
  Profile profile;
  apply_file(profile, s.work / "mine.ini", {.folders = s.folders, .options = {}});
  CHECK(profile.settings.machine.machine_width == 100'000);
  CHECK(profile.settings.machine.machine_depth == 110'000);
  CHECK(profile.settings.machine.machine_height == 120'000);
  Profile other;
  CHECK_THAT(settings_error([&] { apply_file(other, s.work / "mine.ini"); }), Contains("which is not there"));
}

TEST_CASE("profiles by name: a name that nobody has is told with the nearest ones") {
  const Shelves s;
  try {
    (void)profile_file("printers/on", s.work, s.folders);
    FAIL("it was found");
  } catch (const Error& error) {
    CHECK(error.kind() == Error::Kind::file);
    CHECK_THAT(error.what(), Contains("did you mean 'printers/one'"));
  }
}

TEST_CASE("profiles by name: the list has each with its first comment") {
  const Shelves s;
  const auto listed = profiles_in(s.installed);
  REQUIRE(listed.size() == 3);
  CHECK(listed[0].name == "materials/pla");
  CHECK(listed[0].about.empty());
  CHECK(listed[1].name == "printers/one");
  CHECK(listed[1].about == "A printer.");
  CHECK(profiles_in(s.root / "nowhere").empty());
}
