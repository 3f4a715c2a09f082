#pragma once
#include <string>
#include <string_view>

namespace weft {

/// SHA-256 of the bytes, 64 lower-case hexadecimal digits. Cost: linear, about 0.5 ms a megabyte.
std::string sha256(std::string_view bytes);

}  // namespace weft
