// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/error.h"

#include <string>

#include <catch2/catch.hpp>

namespace weft::test {

/// What a call says that must refuse its settings.
template <class F>
std::string settings_error(F&& f) {
  try {
    f();
  } catch (const Error& e) {
    CHECK(e.kind() == Error::Kind::settings);
    return e.what();
  }
  return "nothing was thrown";
}

}  // namespace weft::test
