// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/stop.h"

#include <utility>

namespace weft {
namespace {

constinit thread_local const std::function<bool()>* asked = nullptr;

}  // namespace

StopWhen::StopWhen(const std::function<bool()>* whether) : outer_(std::exchange(asked, whether)) {}
StopWhen::~StopWhen() {
  asked = outer_;
}
const std::function<bool()>* StopWhen::current() {
  return asked;
}

void stop_if_asked() {
  if (asked && (*asked)()) throw Stopped{};
}

}  // namespace weft
