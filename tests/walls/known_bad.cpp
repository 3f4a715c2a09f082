// SPDX-License-Identifier: GPL-3.0-or-later
#include "walls/known_bad.h"

#include "geometry/boolean.h"
#include "source.h"
#include "walls/shapes.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <string_view>
#include <tuple>
#include <vector>

#include <catch2/catch.hpp>

namespace weft::test {
namespace {

constexpr std::array<unsigned, 8> seeds{20'240'601U, 1, 2, 3, 4, 5, 6, 7};

/// A random polygon: the seed, and which one of it.
using Polygon = std::pair<unsigned, int>;
using List = std::map<std::string, std::vector<Polygon>>;  // by law, in the order of seeds and polygons

const std::filesystem::path& list_file() {
  static const std::filesystem::path file = tests::source / "tests/data/walls/known_bad.txt";
  return file;
}

List read_list() {
  List out;
  std::ifstream in(list_file());
  REQUIRE(in);
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line.front() == '#') continue;
    std::istringstream words(line);
    std::string law;
    Polygon p;
    REQUIRE((words >> law >> p.first >> p.second));
    out[law].push_back(p);
  }
  return out;
}

void write_list(const List& list) {
  std::ofstream out(list_file());
  out << "# Random polygons for which a law of walls does not hold: the law, the seed, which one of it.\n"
         "# Lines may only be taken out (tests/walls/known_bad.h).\n";
  for (const auto& [law, bad] : list)
    for (const auto& [seed, index] : bad) out << law << ' ' << seed << ' ' << index << '\n';
}

Regions polygon_of(std::mt19937& random) {
  return geometry::regions_from_rings(std::vector<Ring>{random_ring(random)});
}

/// Looks at one polygon once more, so that a picture of what fails shows it and not the last one that was looked at.
void look_again(const Polygon& at, const std::function<double(const Regions&)>& missed_by) {
  std::mt19937 random(at.first);
  for (int i = 0; i < at.second; ++i) random_ring(random);
  missed_by(polygon_of(random));
}

}  // namespace

void check_law(const Law& law, double most, const std::function<double(const Regions&)>& missed_by) {
  auto list = read_list();
  const bool is_new = list.count(law.name) == 0;
  const auto known = list[law.name];
  std::vector<Polygon> bad;
  std::optional<Polygon> first_new;
  for (const unsigned seed : seeds) {
    std::mt19937 random(seed);
    for (int i = 0; i < law.polygons; ++i) {
      const double missed = missed_by(polygon_of(random));
      if (missed <= most) continue;
      bad.emplace_back(seed, i);
      if (std::find(known.begin(), known.end(), bad.back()) != known.end()) continue;
      if (!first_new) first_new = bad.back();
      UNSCOPED_INFO(law.name << ": polygon " << i << " of seed " << seed << " misses it now, by " << missed);
    }
  }
  for (const Polygon& p : known)
    if (std::find(bad.begin(), bad.end(), p) == bad.end())
      UNSCOPED_INFO(law.name << ": polygon " << p.second << " of seed " << p.first << " holds it now; take it out");
  const char* const mode = std::getenv("WEFT_KNOWN_BAD");
  if (mode != nullptr && std::string_view(mode) == "write") {
    CAPTURE(law.name, known.size());
    REQUIRE((is_new || bad.size() <= known.size()));
    list[law.name] = bad;
    write_list(list);
    WARN(law.name << ": " << bad.size() << " known bad polygons are written to " << list_file().string());
    return;
  }
  if (first_new) look_again(*first_new, missed_by);
  CHECK((bad == known));
}

}  // namespace weft::test
