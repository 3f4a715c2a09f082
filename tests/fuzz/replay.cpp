// SPDX-License-Identifier: GPL-3.0-or-later
// Runs a fuzz target without libFuzzer: over its seeds and over seeded mutations of them, so that every build tests
// what the fuzzers look for:  replay_NAME RUNS FOLDER-OR-FILE...
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

std::vector<std::string> seeds_in(const std::vector<std::filesystem::path>& places) {
  std::vector<std::filesystem::path> files;
  for (const auto& place : places) {
    if (!std::filesystem::is_directory(place)) files.push_back(place);
    if (std::filesystem::is_directory(place))
      for (const auto& entry : std::filesystem::recursive_directory_iterator(place))
        if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<std::string> out;
  for (const auto& path : files) {
    std::ifstream in(path, std::ios::binary);
    out.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
  }
  return out;
}

/// One to four small changes: a byte, a piece taken out, doubled or put in from another seed, a number made extreme.
std::string mutated(std::string bytes, const std::vector<std::string>& seeds, std::mt19937& random) {
  const auto pick = [&](std::size_t n) { return n == 0 ? 0 : random() % n; };
  static const std::vector<std::string> extremes{
      "-1",        "0", "1e999", "nan", "4294967295", "99999999999999999999", "\xff\xff\xff\xff",
      "0.0000001", "{", "}",     "\n",  "\""};
  for (std::size_t change = 1 + pick(4); change > 0; --change) {
    const std::size_t at = pick(bytes.size()), length = 1 + pick(std::min<std::size_t>(40, bytes.size() + 1));
    switch (pick(6)) {
      case 0:
        if (!bytes.empty()) bytes[at] = static_cast<char>(random());
        break;
      case 1:
        if (!bytes.empty()) bytes[at] = static_cast<char>(bytes[at] ^ (1 << pick(8)));
        break;
      case 2:
        bytes.erase(std::min(at, bytes.size()), length);
        break;
      case 3:
        bytes.insert(at, bytes.substr(at, length));
        break;
      case 4: {
        const auto& other = seeds[pick(seeds.size())];
        bytes.insert(at, other.substr(pick(other.size()), length));
        break;
      }
      default:
        bytes.replace(std::min(at, bytes.size()), pick(6), extremes[pick(extremes.size())]);
    }
  }
  return bytes;
}

void run(const std::string& bytes) {
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

}  // namespace

int main(int count, char** arguments) {
  if (count < 3) return std::fprintf(stderr, "usage: replay RUNS FOLDER-OR-FILE...\n"), 2;
  const auto seeds = seeds_in({arguments + 2, arguments + count});
  if (seeds.empty()) return std::fprintf(stderr, "no seeds\n"), 2;
  for (const auto& seed : seeds) run(seed);
  std::mt19937 random(1);
  const int runs = std::atoi(arguments[1]);
  for (int i = 0; i < runs; ++i) {
    const auto bytes = mutated(seeds[random() % seeds.size()], seeds, random);
    // what is run is on disk while it runs: after a crash it is the seed of a regression test
    std::ofstream("replay-last-input", std::ios::binary) << bytes;
    run(bytes);
  }
  std::filesystem::remove("replay-last-input");
  return std::printf("%zu seeds and %d mutations of them\n", seeds.size(), runs), 0;
}
