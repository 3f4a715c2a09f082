// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/stop.h"

#include <new>

namespace weft {

/// For as long as it lives, what a library does in one go on this thread can be stopped where it takes memory: there is
/// none for who is to stop. For libraries that say nothing of how far they are and take memory all the time.
///
/// In a program whose operator new calls step(), as that of the command line does; elsewhere nothing is stopped. Pre:
/// the library leaves nothing broken behind where memory ends. Post: who catches what it then throws, or sees it fail,
/// calls stop_if_asked().
class StopInside {
 public:
  StopInside() { steps_left_ = StopWhen::current() ? often : 0; }
  ~StopInside() { steps_left_ = 0; }
  StopInside(const StopInside&) = delete;
  StopInside& operator=(const StopInside&) = delete;

  /// Thrown instead of the memory.
  struct NoneForWhoIsToStop : std::bad_alloc {
    const char* what() const noexcept override { return "stopped"; }
  };

  /// One piece of memory is wanted. Costs a look at a number of the thread's own. @throws NoneForWhoIsToStop
  static void step() {
    if (steps_left_ != 0 && --steps_left_ == 0) [[unlikely]]
      ask();
  }

 private:
  static constexpr unsigned often = 512;  ///< pieces, taken in some 10 µs
  static void ask();

  inline static constinit thread_local unsigned steps_left_ = 0;  ///< 0: nobody is asked
};

}  // namespace weft
