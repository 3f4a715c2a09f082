// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>

namespace weft {

/// What work ends with that was told to stop. No std::exception: who catches those on the way, to do without what a
/// library could not make, must not take it for one of them.
struct Stopped {};

/// For as long as it lives, work on this thread asks `whether` it is to stop; lib/tasks hands that on to the tasks it
/// begins. It goes by the thread and not by the signatures, from the pipeline down to the loops that ask, because
/// nothing that is made depends on it: work ends with what it would have made, or with Stopped.
class StopWhen {
 public:
  /// @param whether asked often and from any thread; lives longer than this. Null: nobody is asked
  explicit StopWhen(const std::function<bool()>* whether);
  ~StopWhen();
  StopWhen(const StopWhen&) = delete;
  StopWhen& operator=(const StopWhen&) = delete;

  /// Whom work on this thread asks.
  static const std::function<bool()>* current();

 private:
  const std::function<bool()>* outer_;
};

/// To be called where a loop may have run for some 10 µs since the last time: costs a call of the function that is
/// asked. @throws Stopped
void stop_if_asked();

/// The same for loops of shorter steps: asks at one of so many.
class StopNowAndThen {
 public:
  /// Pre: steps > 0
  explicit StopNowAndThen(unsigned steps) : steps_(steps), left_(steps) {}
  /// @throws Stopped
  void step() {
    if (--left_ > 0) return;
    left_ = steps_;
    stop_if_asked();
  }

 private:
  unsigned steps_, left_;
};

}  // namespace weft
