// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/hash.h"

#include "core/stop.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include <nettle/sha2.h>

namespace weft {

struct Sha256::Context : sha256_ctx {};

Sha256::Sha256() : context_(std::make_unique<Context>()) {
  sha256_init(context_.get());
}
Sha256::~Sha256() = default;

void Sha256::add(std::string_view bytes) {
  constexpr std::size_t piece = 1 << 20;  // some milliseconds
  for (; !bytes.empty(); bytes.remove_prefix(std::min(bytes.size(), piece))) {
    const auto next = bytes.substr(0, piece);
    stop_if_asked();
    sha256_update(context_.get(), next.size(), reinterpret_cast<const std::uint8_t*>(next.data()));
  }
}

std::string Sha256::digest() {
  std::array<std::uint8_t, SHA256_DIGEST_SIZE> digest;
  sha256_digest(context_.get(), digest.size(), digest.data());  // which begins anew
  constexpr std::string_view hex = "0123456789abcdef";
  std::string out;
  out.reserve(2 * digest.size());
  for (const auto byte : digest) {
    out += hex[byte >> 4];
    out += hex[byte & 15];
  }
  return out;
}

std::string sha256(std::string_view bytes) {
  Sha256 hash;
  hash.add(bytes);
  return hash.digest();
}

}  // namespace weft
