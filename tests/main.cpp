// SPDX-License-Identifier: GPL-3.0-or-later
#define CATCH_CONFIG_MAIN
#include "picture.h"
#include "source.h"

#include <iostream>

#include <catch2/catch.hpp>

const std::filesystem::path tests::source = WEFT_SOURCE_DIR;

namespace {

/// Leaves a picture of what a test was looking at when an assertion failed: of the first few, for a law may fail often.
class Pictures : public Catch::TestEventListenerBase {
 public:
  using TestEventListenerBase::TestEventListenerBase;

  void testCaseStarting(const Catch::TestCaseInfo& test) override {
    name_ = test.name;
    left_ = 0;
    tests::new_picture();
  }

  bool assertionEnded(const Catch::AssertionStats& stats) override {
    constexpr int most = 5;
    if (stats.assertionResult.isOk() || left_ == most) return false;
    if (const auto path = tests::leave_picture(name_, left_ + 1); !path.empty()) {
      ++left_;
      std::cerr << "picture: " << path.string() << '\n';
    }
    return false;
  }

 private:
  std::string name_;
  int left_ = 0;
};
CATCH_REGISTER_LISTENER(Pictures)

}  // namespace
