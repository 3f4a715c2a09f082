// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace weft::tasks {

/// How many threads of so many can be had, the one that asks included: a user, a container or the memory may have no
/// more. TBB would end the program at the first that cannot be begun. Those that nobody has begun before are begun,
/// and ended, to know it (30 µs each). Post: 1 … wanted. Pre: wanted > 0
unsigned obtainable(unsigned wanted);

}  // namespace weft::tasks
