// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/stop.h"

#include <new>

namespace weft {

/// For as long as it lives, what a library does in one go on this thread can be stopped where it takes memory: there is
/// none for who is to stop. For libraries that say nothing of how far they are and take memory all the time.
///
/// In a program whose operator new calls step() and whose operator delete calls gave_back(), as those of the command
/// line do; elsewhere nothing is stopped. Pre: the library leaves nothing broken behind where memory ends while it only
/// takes; while it gives back between a few pieces, it is let go on. Post: who catches what it then throws, or sees it
/// fail, calls stop_if_asked().
class StopInside {
 public:
  StopInside() { begin(); }
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
  /// A piece of memory is given back.
  static void gave_back() noexcept { row_ = 0; }

 private:
  static constexpr unsigned often = 512;  ///< pieces, taken in some 10 µs
  /// So many pieces in a row, and none given back between them, are taken by who only takes. Clipper throws away its
  /// list of crossings one by one as it makes corners of them, at most eight pieces each; if memory ends there, it
  /// throws the same ones away again.
  static constexpr unsigned only_takes = 16;
  enum class State : unsigned char { goes_on, is_to_stop, stopped };

  static void begin();
  static void ask();

  inline static constinit thread_local unsigned steps_left_ = 0;  ///< 0: nobody is asked
  inline static constinit thread_local unsigned row_ = 0;         ///< pieces taken since the last was given back
  inline static constinit thread_local State state_ = State::goes_on;
};

}  // namespace weft
