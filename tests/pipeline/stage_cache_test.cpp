// SPDX-License-Identifier: GPL-3.0-or-later
#include "cache/stage_cache.h"

#include "cuboid.h"
#include "pipeline/cached.h"
#include "pipeline/pipeline.h"
#include "profile/profile.h"
#include "settings/catalogue.h"

#include <array>
#include <atomic>
#include <fstream>
#include <iterator>
#include <thread>

#include <catch2/catch.hpp>
#include <unistd.h>

using namespace weft;
namespace fs = std::filesystem;

namespace {

struct Folder {
  fs::path path;
  Folder() {
    std::string name = (fs::temp_directory_path() / "weft-cache-XXXXXX").string();
    path = ::mkdtemp(name.data());
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  std::vector<fs::path> entries() const {
    std::vector<fs::path> out;
    for (const auto& e : fs::recursive_directory_iterator(path))
      if (e.is_regular_file() && e.path().filename() != "lock") out.push_back(e.path());
    return out;
  }
};

/// A pyramid with steps: it has walls, skins, sparse infill, bridges and an overhang in few layers.
std::string model() {
  std::string out = "solid s\n";
  const auto box = [&](double x0, double y0, double z0, double x1, double y1, double z1) {
    const std::array<std::array<double, 3>, 8> c{{{x0, y0, z0},
                                                  {x1, y0, z0},
                                                  {x1, y1, z0},
                                                  {x0, y1, z0},
                                                  {x0, y0, z1},
                                                  {x1, y0, z1},
                                                  {x1, y1, z1},
                                                  {x0, y1, z1}}};
    for (const auto& f : cuboid_faces) {
      out += "facet normal 0 0 0\nouter loop\n";
      for (const int v : f) {
        const auto& p = c[static_cast<std::size_t>(v)];
        out += "vertex " + std::to_string(p[0]) + " " + std::to_string(p[1]) + " " + std::to_string(p[2]) + "\n";
      }
      out += "endloop\nendfacet\n";
    }
  };
  box(0, 0, 0, 14, 12, 1.1);
  box(2, 2, 1.1, 4, 10, 2.1);
  box(10, 2, 1.1, 10.7, 10, 2.1);
  box(2, 2, 2.1, 11, 10, 3.2);
  return out + "endsolid s\n";
}

struct Made {
  std::string gcode, error;
  Notices warnings;
  friend bool operator==(const Made&, const Made&) = default;
};

Made make(const std::string& path, const Settings& settings, StageCache* cache) {
  Job job;
  job.models = {path};
  job.settings = settings;
  job.audit = audit::Mode::annotate;
  Report report;
  try {
    const auto gcode = run(job, {}, report, cache);
    return {gcode ? std::string(gcode->gcode()) : "", report.error, report.warnings};
  } catch (const Error& error) {
    return {"", error.what(), {}};
  }
}

std::size_t made(const StageCache& cache, std::string_view stage) {
  for (const auto& c : cache.counts())
    if (c.stage == stage) return c.made;
  return 0;
}
std::size_t from_disk(const StageCache& cache) {
  std::size_t sum = 0;
  for (const auto& c : cache.counts()) sum += c.from_disk;
  return sum;
}

/// Another valid value of a setting, or nothing where none was found.
std::optional<Settings> changed(const Settings& base, const CatalogueEntry& entry) {
  std::vector<std::string> tries;
  for (const auto choice : entry.choices) tries.emplace_back(choice);
  if (entry.type == "flag") tries = {"true", "false"};
  if (entry.key == "thumbnails")
    tries = {"16x16"};
  else if (entry.type == "text")
    tries = {"M117 x"};
  else if (entry.type == "points")
    tries = {"1x1", "0x0, 230x0, 230x230, 0x230"};
  else if (entry.type == "polygons")
    tries = {"200x200, 210x200, 210x210, 200x210"};
  if (tries.empty()) {
    for (const auto* v : {"0.15", "0.3", "2", "3", "7", "17", "35", "60", "210", "1", "0", "120%", "400"})
      tries.emplace_back(v);
    tries.push_back(entry.most), tries.push_back(entry.least);
  }
  for (const auto& text : tries) {
    Profile profile;
    profile.settings = base;
    try {
      entry.parse(profile.settings, text);
      check_consistency(profile);
      if (entry.print(profile.settings) != entry.print(base)) return profile.settings;
    } catch (const std::exception&) {
    }
  }
  return std::nullopt;
}

}  // namespace

TEST_CASE("cache: whatever setting is changed, a warm cache gives the bytes of no cache", "[law]") {
  // The proof that no key forgets an input: one cache sees every setting changed in turn, over the results of all
  // others.
  const Folder folder;
  const auto path = (folder.path / "steps.stl").string();
  std::ofstream(path, std::ios::binary) << model();
  StageCache cache({});
  const Settings base;
  REQUIRE(make(path, base, &cache) == make(path, base, nullptr));
  REQUIRE(!make(path, base, nullptr).gcode.empty());
  std::size_t tried = 0;
  for (const auto& entry : catalogue()) {
    const auto settings = changed(base, entry);
    if (!settings) continue;
    ++tried;
    INFO(entry.key << " = " << entry.print(*settings));
    CHECK(make(path, *settings, &cache) == make(path, *settings, nullptr));
  }
  INFO("settings tried: " << tried << " of " << catalogue().size());
  CHECK(tried * 10 > catalogue().size() * 9);
}

TEST_CASE("cache: a stage is made again when a setting of its group changes, and its followers with it, and no other") {
  const Folder folder;
  const auto path = (folder.path / "steps.stl").string();
  std::ofstream(path, std::ios::binary) << model();
  struct Stage {
    std::string_view section;
    std::size_t read, slice, walls, infill;  // made again
  };
  for (const auto& stage : {Stage{"layers", 0, 1, 1, 1}, Stage{"walls", 0, 0, 1, 1}, Stage{"shells", 0, 0, 0, 1},
                            Stage{"infill", 0, 0, 0, 1}, Stage{"travel", 0, 0, 0, 0}, Stage{"speeds", 0, 0, 0, 0},
                            Stage{"cooling", 0, 0, 0, 0}, Stage{"material", 0, 0, 0, 0}}) {
    for (const auto& entry : catalogue()) {
      if (entry.section != stage.section) continue;
      if (entry.key == "infill_density_image" || entry.key == "infill_density_field") continue;  // of a file there is
      const Settings base;
      const auto settings = changed(base, entry);
      if (!settings) continue;
      StageCache cache({});
      make(path, base, &cache);
      make(path, *settings, &cache);
      INFO(entry.key << " = " << entry.print(*settings));
      // A model that is put down in another size is cut anew.
      const std::size_t resized = entry.key.starts_with("material_shrinkage") ? 1 : 0;
      CHECK(made(cache, "read") == 1 + stage.read);
      CHECK(made(cache, "slice") == 1 + stage.slice + resized);
      CHECK(made(cache, "walls") == 1 + stage.walls + resized);
      CHECK(made(cache, "infill") == 1 + stage.infill + resized);
    }
  }
}

TEST_CASE("cache: settings that print alike and differ have different keys") {
  Settings a, b;
  b.infill.infill_sparse_density = a.infill.infill_sparse_density + 1e-9;
  const auto& reads = pipeline::row_of<pipeline::Stage::infill>().reads;
  const auto key = [&](const Settings& s) { return pipeline::StageKey("x", 1).with(reads.bytes_of(s)).hash(); };
  CHECK(key(a) != key(b));
  CHECK(key(a) == key(Settings{}));
  CHECK(pipeline::StageKey("x", 1).hash() != pipeline::StageKey("x", 2).hash());
  CHECK(pipeline::StageKey("x", 1).hash() != pipeline::StageKey("y", 1).hash());
}

TEST_CASE("cache: on disk it serves the next process, and every damage is found and mended") {
  const Folder folder;
  const auto path = (folder.path / "steps.stl").string();
  std::ofstream(path, std::ios::binary) << model();
  const auto store = folder.path / "store";
  const Settings settings;
  const auto plain = make(path, settings, nullptr);
  {
    StageCache first({.folder = store});
    CHECK(make(path, settings, &first) == plain);
  }
  {
    StageCache second({.folder = store});
    CHECK(make(path, settings, &second) == plain);
    CHECK(from_disk(second) == 4);
  }
  const auto spoil = [&](auto change) {
    std::size_t spoiled = 0;
    for (const auto& e : fs::recursive_directory_iterator(store)) {
      if (!e.is_regular_file() || e.path().filename() == "lock") continue;
      std::ifstream in(e.path(), std::ios::binary);
      std::string bytes{std::istreambuf_iterator<char>(in), {}};
      change(bytes);
      std::ofstream(e.path(), std::ios::binary | std::ios::trunc) << bytes;
      ++spoiled;
    }
    CHECK(spoiled == 4);
    StageCache cache({.folder = store});
    CHECK(make(path, settings, &cache) == plain);
    CHECK(cache.damaged() == 4);
    StageCache again({.folder = store});
    CHECK(make(path, settings, &again) == plain);
    CHECK(again.damaged() == 0);
    CHECK(from_disk(again) == 4);
  };
  spoil([](std::string& bytes) { bytes[bytes.size() / 2] ^= 1; });
  spoil([](std::string& bytes) { bytes.resize(bytes.size() - 1); });
  spoil([](std::string& bytes) { bytes.clear(); });
  spoil([](std::string& bytes) { bytes[2] = 'x'; });
  spoil([](std::string& bytes) { bytes += "more"; });
}

TEST_CASE("cache: the folder stays within its bounds") {
  const Folder folder;
  StageCache cache({.folder = folder.path, .max_disk = 100'000, .max_memory = 1});
  constexpr StageCache::Kind kind{
      [](const void* v) { return *static_cast<const std::string*>(v); },
      [](std::string_view b) -> std::shared_ptr<const void> { return std::make_shared<std::string>(b); },
      [](const void* v) { return static_cast<const std::string*>(v)->size(); }};
  for (int i = 0; i < 200; ++i) {
    const auto key = sha256(std::to_string(i));
    cache.get("test", key, kind, [&] { return std::make_shared<const std::string>(3000, 'x'); });
    std::uintmax_t total = 0;
    for (const auto& e : folder.entries()) total += fs::file_size(e);
    CHECK(total <= 100'000);
  }
  CHECK(folder.entries().size() > 20);
}

TEST_CASE("cache: several threads that want one result make it once, when the first gives up the next makes it") {
  StageCache cache({});
  constexpr StageCache::Kind kind{[](const void*) { return std::string(); },
                                  [](std::string_view) -> std::shared_ptr<const void> { return nullptr; },
                                  [](const void*) { return std::size_t{8}; }};
  std::atomic<int> calls = 0, failures = 0;
  std::vector<std::thread> threads;
  for (int i = 0; i < 8; ++i)
    threads.emplace_back([&] {
      try {
        const auto v = cache.get("test", std::string(64, 'a'), kind, [&]() -> std::shared_ptr<const void> {
          if (calls++ == 0) throw Error{Error::Kind::interrupted, "stopped"};
          return std::make_shared<const int>(42);
        });
        CHECK(*std::static_pointer_cast<const int>(v) == 42);
      } catch (const Error&) {
        ++failures;
      }
    });
  for (auto& t : threads) t.join();
  CHECK(calls == 2);
  CHECK(failures == 1);
}

TEST_CASE("cache: a folder that takes nothing costs the entries, not the job") {
  const Folder folder;
  const auto path = (folder.path / "steps.stl").string();
  std::ofstream(path, std::ios::binary) << model();
  StageCache cache({.folder = folder.path / "store"});
  fs::remove_all(folder.path / "store");
  std::ofstream(folder.path / "store") << "a file where the folder was";
  CHECK(make(path, {}, &cache) == make(path, {}, nullptr));
  CHECK(cache.unwritten() == 4);
}
