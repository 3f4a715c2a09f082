// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <string_view>

/// Text that comes from outside: file names, profiles, models.
namespace weft {

/// Length of the valid UTF-8 sequence at the front of `text`, 1 to 4; 0: the text is empty, or begins with none.
/// Source: RFC 3629, section 4.
std::size_t utf8_length(std::string_view text);

/// Is the text valid UTF-8?
bool is_utf8(std::string_view text);

}  // namespace weft
