// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>
#include <string>
#include <string_view>

namespace weft {

/// SHA-256 of bytes that come in pieces. Cost: linear, 0.7 ms a megabyte.
class Sha256 {
 public:
  Sha256();
  ~Sha256();
  void add(std::string_view bytes);
  /// Of all that was added, 64 lower-case hexadecimal digits. Post: nothing is.
  std::string digest();

 private:
  struct Context;
  std::unique_ptr<Context> context_;
};

/// SHA-256 of the bytes.
std::string sha256(std::string_view bytes);

}  // namespace weft
