// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "preview/toolpaths.h"

#include <string>

namespace weft::preview {

/// Length that places, widths and heights of a page are multiples of, µm: a tenth of what a printer's steps are.
inline constexpr Um page_grain = 5;

/// All strokes and events as the page's script reads them (page/unpack.js): columns of numbers of seven bits a byte,
/// signed ones folded; each column behind its length in bytes; all of it compressed (zlib, RFC 1950). What rarely
/// changes from stroke to stroke is a column of runs. Columns, in their order: x, y (steps), width (steps, 0 of a
/// travel), then in runs z (steps), height, speed (0.1 mm/s), feature · 2 + compensated, tool, fan, nozzle, support,
/// lines (steps); strokes of each layer; kind and place (steps) of each event.
/// Cost: linear, some 20 MB of G-code a second.
std::string packed(const Toolpaths& paths);

/// How zlib packs it, as the page's DecompressionStream reads it. Pre: bytes fit in memory twice.
std::string deflated(const std::string& bytes);

/// Numbers as the page reads them: seven bits a byte, least first; signed ones folded (0, −1, 1, −2, …).
class Numbers {
 public:
  void add(std::uint64_t v) {
    for (; v >= 128; v >>= 7) bytes_.push_back(static_cast<char>(v | 128));
    bytes_.push_back(static_cast<char>(v));
  }
  void step(std::int64_t v) { add(static_cast<std::uint64_t>(v < 0 ? -2 * v - 1 : 2 * v)); }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

}  // namespace weft::preview
