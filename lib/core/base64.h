// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <string_view>

namespace weft {

/// RFC 4648, section 4: padded with '=', in one line.
std::string base64(std::string_view bytes);

}  // namespace weft
