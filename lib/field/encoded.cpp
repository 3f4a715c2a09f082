// SPDX-License-Identifier: GPL-3.0-or-later
#include "field/encoded.h"

#include "core/error.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <zlib.h>

namespace weft::field {
namespace {

constexpr std::array<int, 256> base64_values() {
  std::array<int, 256> out{};
  for (int& v : out) v = -1;
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (std::size_t i = 0; i < digits.size(); ++i) out[static_cast<unsigned char>(digits[i])] = static_cast<int>(i);
  return out;
}

[[noreturn]] void refuse(const std::string& path, std::string problem) {
  throw Error{Error::Kind::settings, std::move(problem), path, {}};
}

/// Numbers of the head, one after the other.
class Numbers {
 public:
  Numbers(std::string_view bytes, const Packing& packing, const std::string& path)
      : rest_(bytes), packing_(packing), path_(path) {}
  std::uint64_t next() {
    const std::size_t size = packing_.wide ? 8 : 4;
    if (rest_.size() < size) refuse(path_, "an array ends within its head");
    std::uint64_t v = 0;
    for (std::size_t i = 0; i < size; ++i)
      v = v << 8U | static_cast<std::uint8_t>(rest_[packing_.big_endian ? i : size - 1 - i]);
    rest_.remove_prefix(size);
    return v;
  }
  std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
  const Packing& packing_;
  const std::string& path_;
};

}  // namespace

std::string from_base64(std::string_view text) {
  static constexpr auto values = base64_values();
  std::string out;
  out.reserve(text.size() / 4 * 3);
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    if (c == ' ' || (c >= '\t' && c <= '\r')) continue;
    if (c == '=') {  // ends a piece
      bits = 0, count = 0;
      continue;
    }
    const int v = values[static_cast<unsigned char>(c)];
    if (v < 0) break;
    bits = bits << 6U | static_cast<std::uint32_t>(v), count += 6;
    if (count < 8) continue;
    count -= 8;
    out += static_cast<char>(bits >> static_cast<unsigned>(count) & 0xFFU);
  }
  return out;
}

std::string unpacked(std::string_view packed, const Packing& packing, std::size_t wanted, const std::string& path) {
  Numbers head(packed, packing, path);
  const std::uint64_t first = head.next();
  if (!packing.compressed) return std::string(head.rest().substr(0, std::min<std::uint64_t>(first, wanted)));
  const std::uint64_t blocks = first, block = head.next(), last = head.next();
  if (blocks > packed.size() || block > (std::uint64_t{1} << 31U)) refuse(path, "an array's head is none");
  std::vector<std::uint64_t> sizes;
  for (std::uint64_t i = 0; i < blocks; ++i) sizes.push_back(head.next());
  std::string out;
  std::string_view rest = head.rest();
  for (std::uint64_t i = 0; i < blocks && out.size() < wanted; ++i) {
    const std::uint64_t size = i + 1 == blocks && last != 0 ? last : block;
    if (sizes[i] > rest.size()) refuse(path, "an array ends within a block");
    // zlib presses nothing to less than a thousandth: what says so is no block of this array
    if (size / 1100 > sizes[i] + 64) refuse(path, "a block cannot be decompressed");
    std::string data(size, '\0');
    uLongf length = size;
    if (uncompress(reinterpret_cast<Bytef*>(data.data()), &length, reinterpret_cast<const Bytef*>(rest.data()),
                   sizes[i]) != Z_OK)
      refuse(path, "a block cannot be decompressed");
    out.append(data, 0, length);
    rest.remove_prefix(sizes[i]);
  }
  out.resize(std::min<std::size_t>(out.size(), wanted));
  return out;
}

}  // namespace weft::field
