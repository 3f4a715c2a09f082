// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "macro/macro.h"

#include <cstdint>
#include <string>

namespace weft::test {

/// A few variables of a print, one of each kind.
inline macro::Variables variables() {
  using macro::variable, macro::variable_of;
  macro::Variables out;
  out["temperature"] = variable_of("215");
  out["first_layer_temperature"] = variable_of("230");
  out["retract"] = variable_of("0.8,nil,1.2");
  out["override"] = variable_of("nil");
  out["notes"] = variable(std::string("a\nPRINTER_MODEL_MK3\nb"));
  out["layer_num"] = variable(std::int64_t{3});
  out["travel_z"] = {.values = {}, .text = {}, .missing = "is auto"};
  return out;
}

}  // namespace weft::test
