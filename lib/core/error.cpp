// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/error.h"

namespace weft {
namespace {
std::string sentence(const std::string& what, const std::string& where, const std::string& hint) {
  std::string out = where.empty() ? what : where + ": " + what;
  if (!hint.empty()) out += "; " + hint;
  return out;
}
}  // namespace

Error::Error(Kind kind, std::string what, std::string where, std::string hint)
    : std::runtime_error(sentence(what, where, hint)),
      kind_(kind),
      problem_(std::move(what)),
      where_(std::move(where)),
      hint_(std::move(hint)) {}

}  // namespace weft
