// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <string>
#include <string_view>

namespace weft::field {

/// How an array's bytes stand in VTK's XML formats.
struct Packing {
  bool wide = false;        ///< numbers of the head have eight bytes, not four
  bool big_endian = false;  ///< also of them
  bool compressed = false;  ///< in blocks, by zlib
};

/// Up to the first character that is none of it; pieces that end in '=' may follow each other.
std::string from_base64(std::string_view text);

/// An array's bytes behind its head, no more than wanted; fewer where there are not as many.
/// @throws Error{settings} with path for a head that cannot be, and for blocks that zlib does not know
std::string unpacked(std::string_view packed, const Packing& packing, std::size_t wanted, const std::string& path);

}  // namespace weft::field
