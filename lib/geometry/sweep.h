// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/stop_inside.h"

#include <new>

#include <polyclipping/clipper.hpp>

namespace weft::geometry::clipper {

/// Clipper's sweep, which gives up where work is to stop: millions of crossings are one call to it. Private to
/// geometry/. Who sees it fail calls stop_if_asked().
class Sweep : public ClipperLib::Clipper {
 protected:
  // Clipper takes memory for each crossing and each corner, and answers false where that ends while it sweeps; what
  // ends behind that is made the same here, so that it takes back what it has made.
  bool ExecuteInternal() override {
    const StopInside here;
    try {
      return Clipper::ExecuteInternal();
    } catch (const std::bad_alloc&) {
      return false;
    }
  }
};

}  // namespace weft::geometry::clipper
