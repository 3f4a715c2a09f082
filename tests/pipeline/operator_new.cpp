// SPDX-License-Identifier: GPL-3.0-or-later
/// operator new of these tests: as the program's (app/small_memory.cpp), it is where a library that works in one go
/// asks whether to go on. Without it one call to Clipper is the longest that a job is deaf.
#include "core/stop_inside.h"

#include <cstdlib>
#include <new>

void* operator new(std::size_t bytes) {
  weft::StopInside::step();
  if (void* const p = std::malloc(bytes > 0 ? bytes : 1)) return p;
  throw std::bad_alloc();
}
// A sanitizer's own would not go through the one above, but its memory through the operator delete below.
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  return std::malloc(bytes > 0 ? bytes : 1);
}
void operator delete(void* p) noexcept {
  std::free(p);
}
void operator delete(void* p, std::size_t) noexcept {
  std::free(p);
}
