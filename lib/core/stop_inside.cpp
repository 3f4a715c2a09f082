// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/stop_inside.h"

namespace weft {

void StopInside::begin() {
  steps_left_ = StopWhen::current() ? often : 0;
  state_ = State::goes_on;
}

void StopInside::ask() {
  if (state_ == State::goes_on) {
    steps_left_ = 0;  // who is asked may take memory as well
    const bool stop = (*StopWhen::current())();
    steps_left_ = stop ? 1 : often;
    if (!stop) return;
    state_ = State::is_to_stop, row_ = 0;
  }
  steps_left_ = 1;  // what is tried instead ends, too
  if (state_ == State::is_to_stop && ++row_ < only_takes) return;
  state_ = State::stopped;
  throw NoneForWhoIsToStop{};
}

}  // namespace weft
