// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base64.h"

#include <cstddef>
#include <cstdint>

namespace weft {

std::string base64(std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) {
      return i + k < bytes.size() ? std::uint32_t{static_cast<unsigned char>(bytes[i + k])} : 0U;
    };
    const std::uint32_t v = byte(0) << 16U | byte(1) << 8U | byte(2);
    out += digits[v >> 18U];
    out += digits[v >> 12U & 63U];
    out += i + 1 < bytes.size() ? digits[v >> 6U & 63U] : '=';
    out += i + 2 < bytes.size() ? digits[v & 63U] : '=';
  }
  return out;
}

}  // namespace weft
