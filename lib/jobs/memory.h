// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>

namespace weft::jobs {

/// Memory that this process holds now, bytes; 0 where the system does not say. About 5 µs.
std::uint64_t resident_bytes();

/// Memory that a process may still take before the system runs short: what is available, or what its control group
/// leaves, whichever is less. 0 where the system does not say.
std::uint64_t available_bytes();

/// Gives freed memory back to the system.
void release_freed_memory();

}  // namespace weft::jobs
