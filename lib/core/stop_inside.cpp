// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/stop_inside.h"

namespace weft {

void StopInside::ask() {
  steps_left_ = 0;  // who is asked may take memory as well
  if ((*StopWhen::current())()) {
    steps_left_ = 1;  // what is tried instead ends, too
    throw NoneForWhoIsToStop{};
  }
  steps_left_ = often;
}

}  // namespace weft
