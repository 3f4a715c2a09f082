// SPDX-License-Identifier: GPL-3.0-or-later
// libFuzzer target for everything that reads settings: ini text of weft's own, configurations and bundles of
// PrusaSlicer's family, G-code that holds one in its comments, and custom G-code. What is wrong is refused with an
// Error that names settings; what is taken can be written out and read again to the same settings.
//   build/fuzz/tests/fuzz_settings -max_total_time=900 -max_len=8192 corpus/ profiles tests/fuzz/seeds/settings
#include "core/error.h"
#include "gcode/writer.h"
#include "profile/profile.h"
#include "settings/catalogue.h"

#include <cstdint>
#include <cstdlib>
#include <string>

namespace {

using namespace weft;

void require(bool holds) {
  if (!holds) std::abort();
}

Profile applied(const std::string& text) {
  Profile profile;
  apply_text(profile, text, "fuzz.ini");
  check_consistency(profile);
  return profile;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    const auto profile = applied(text);
    const std::string written = as_text(profile.settings);
    require(as_text(applied(written).settings) == written);
    gcode::check_custom_code(profile.settings);
  } catch (const Error& error) {
    require(error.kind() == Error::Kind::settings);
  }
  return 0;
}
