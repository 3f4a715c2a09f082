// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>

/// What the program's operator new and delete do (small_memory.cpp); by these names tests reach it under sanitizers,
/// which have operators of their own.
namespace weft::small_memory {

/// Memory of at least that many bytes, aligned to 16. Throws std::bad_alloc where there is none.
void* take(std::size_t bytes);

/// Takes back what `take` gave, in any thread; nullptr is nothing.
void give(void* memory) noexcept;

}  // namespace weft::small_memory
