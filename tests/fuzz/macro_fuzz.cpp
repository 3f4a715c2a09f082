// SPDX-License-Identifier: GPL-3.0-or-later
// libFuzzer target for the macro language of custom G-code: texts of one print, parted by bytes of 1, that share their
// globals; and each as a condition. What is wrong is refused with an Error that names settings; what is taken gives the
// same twice, and no text that a few lines can make fills the memory.
//   build/fuzz/tests/fuzz_macro -max_total_time=900 -max_len=4096 corpus/ tests/fuzz/seeds/macro
#include "core/error.h"
#include "macro/macro.h"
#include "macro/variables.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>

namespace {

using namespace weft;
using namespace weft::macro;

void require(bool holds) {
  if (!holds) std::abort();
}

const Variables& figures() {
  static const Variables all = [] {
    Variables v = test::variables();
    v["temperature"] = variable_of("215,220");
    v["fill_density"] = variable_of("20%");
    v["layer_z"] = variable(0.65);
    v["soluble"] = variable(true);
    return v;
  }();
  return all;
}

/// What the texts give, one after the other.
std::string expanded(const std::string& bytes, bool lenient) {
  Scope scope{.globals = {}, .random = 1, .lenient = lenient};
  Variables globals;
  std::string out;
  for (std::size_t begin = 0; begin <= bytes.size();) {
    const auto end = std::min(bytes.find('\1', begin), bytes.size());
    const Template text(std::string_view(bytes).substr(begin, end - begin), "fuzz_gcode");
    for (const auto& name : text.names()) require(!name.empty());
    text.check(figures(), globals);
    out += text.expand(figures(), scope);
    require(out.size() < bytes.size() + (std::size_t{64} << 20));
    begin = end + 1;
  }
  return out;
}

/// What `f` gives, or nothing when it refuses as it may.
template <class F>
auto taken(F f) -> std::optional<decltype(f())> {
  try {
    return f();
  } catch (const Error& error) {
    require(error.kind() == Error::Kind::settings);
    return std::nullopt;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  const auto strict = taken([&] { return expanded(bytes, false); });
  if (strict) {
    require(taken([&] { return expanded(bytes, false); }) == strict);
    require(taken([&] { return expanded(bytes, true); }) == strict);  // leniency changes only what would be refused
  }
  taken([&] { return holds(bytes, figures(), "fuzz_condition"); });
  return 0;
}
