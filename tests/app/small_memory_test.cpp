// SPDX-License-Identifier: GPL-3.0-or-later
// This program is linked with app/small_memory.cpp: whatever is new here is its, but where a sanitizer watches, which
// has operators of its own. There it is reached by name, so that the sanitizer sees what it does.
#include "app/small_memory.h"

#include "jobs/memory.h"
#include "sanitized.h"

#include <algorithm>
#include <array>
#include <barrier>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <random>
#include <thread>
#include <vector>

#include <catch2/catch.hpp>

namespace {

/// A piece of memory, filled with a pattern of its own.
struct Filled {
  unsigned char* at = nullptr;
  std::size_t bytes = 0;
  unsigned char pattern = 0;
};

Filled filled(std::size_t bytes, unsigned char pattern) {
  void* const at = sanitized ? weft::small_memory::take(bytes) : ::operator new(bytes);
  const Filled piece{static_cast<unsigned char*>(at), bytes, pattern};
  std::memset(piece.at, pattern, bytes);
  return piece;
}

bool intact(const Filled& piece) {
  return std::all_of(piece.at, piece.at + piece.bytes, [&](unsigned char c) { return c == piece.pattern; });
}

/// With and without its size, which operator delete may be told.
void give(const Filled& piece, bool told) {
  if (sanitized)
    weft::small_memory::give(piece.at);
  else if (told)  // not `told ? … : …`: clang 14 calls both
    ::operator delete(piece.at, piece.bytes);
  else
    ::operator delete(piece.at);
}

constexpr double mb = 1e6;

}  // namespace

TEST_CASE("small memory: pieces of all sizes are aligned, lie apart and keep what is written into them", "[app]") {
  std::mt19937 random(5);
  std::vector<Filled> held;
  std::size_t bad = 0, misplaced = 0;
  for (int round = 0; round < 200'000; ++round) {
    if (held.size() < 3000 || random() % 2 == 0) {
      held.push_back(filled(random() % 600, static_cast<unsigned char>(random())));
      misplaced += reinterpret_cast<std::uintptr_t>(held.back().at) % alignof(std::max_align_t) != 0;
    } else {
      std::swap(held[random() % held.size()], held.back());
      bad += !intact(held.back());
      give(held.back(), random() % 2 == 0);
      held.pop_back();
    }
  }
  std::map<std::uintptr_t, std::size_t> places;
  for (const Filled& piece : held) places[reinterpret_cast<std::uintptr_t>(piece.at)] = piece.bytes;
  REQUIRE(places.size() == held.size());
  std::size_t overlapping = 0;
  std::uintptr_t end = 0;
  for (const auto& [at, bytes] : places) overlapping += at < end, end = at + bytes;
  for (const Filled& piece : held) bad += !intact(piece), give(piece, true);
  CHECK(bad == 0);
  CHECK(misplaced == 0);
  CHECK(overlapping == 0);
}

TEST_CASE("small memory: what threads take from each other and give back is intact, and used again", "[app]") {
  // In each round a thread makes pieces, while it checks and frees those that its neighbour made in the round before.
  constexpr std::size_t threads = 4, rounds = 1000, handed = 300;
  std::array<std::array<std::vector<Filled>, 2>, threads> made;
  std::array<std::size_t, threads> bad{};
  std::barrier together(threads);
  const auto work = [&](std::size_t me) {
    std::mt19937 random(static_cast<unsigned>(me));
    for (std::size_t round = 0; round < rounds; ++round) {
      auto& mine = made[me][round % 2];
      auto& theirs = made[(me + 1) % threads][(round + 1) % 2];
      for (std::size_t i = 0; i < handed; ++i) {
        if (i < theirs.size()) bad[me] += !intact(theirs[i]), give(theirs[i], random() % 2 == 0);
        mine.push_back(filled(1 + random() % 300, static_cast<unsigned char>(random())));
      }
      theirs.clear();
      together.arrive_and_wait();
    }
  };
  const double before = static_cast<double>(weft::jobs::resident_bytes());
  {
    std::vector<std::thread> all;
    for (std::size_t i = 0; i < threads; ++i) all.emplace_back(work, i);
    for (std::thread& thread : all) thread.join();
  }
  for (auto& of_thread : made)
    for (auto& of_round : of_thread)
      for (const Filled& piece : of_round) bad[0] += !intact(piece), give(piece, true);
  CHECK(bad == std::array<std::size_t, threads>{});
  // 1,200,000 pieces of 150 bytes were made: 180 MB if none of it were used again
  if (!sanitized) CHECK(static_cast<double>(weft::jobs::resident_bytes()) - before < 20 * mb);
}

TEST_CASE("small memory: what is given back goes to the system", "[app]") {
  const double before = static_cast<double>(weft::jobs::resident_bytes());
  std::vector<Filled> held(1'000'000);
  for (Filled& piece : held) piece = filled(64, 1);
  const double full = static_cast<double>(weft::jobs::resident_bytes());
  CHECK(full - before > 64 * mb);
  for (const Filled& piece : held) give(piece, true);
  if (!sanitized) CHECK(full - static_cast<double>(weft::jobs::resident_bytes()) > 60 * mb);
}

TEST_CASE("small memory: a thread takes up what one that has ended has left", "[app]") {
  const double before = static_cast<double>(weft::jobs::resident_bytes());
  std::vector<Filled> kept;
  for (int i = 0; i < 1000; ++i)
    std::thread([&] {
      for (std::size_t bytes = 16; bytes <= 256; bytes += 16)
        kept.push_back(filled(bytes, static_cast<unsigned char>(i)));
    }).join();
  // Of each of 16 sizes a thread leaves most of a page: 65 MB if the next one could not use it.
  if (!sanitized) CHECK(static_cast<double>(weft::jobs::resident_bytes()) - before < 20 * mb);
  std::size_t bad = 0;
  for (const Filled& piece : kept) bad += !intact(piece), give(piece, false);
  CHECK(bad == 0);
}
