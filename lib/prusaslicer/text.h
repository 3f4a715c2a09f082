// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <string_view>
#include <vector>

/// How PrusaSlicer writes lists in its ini: numbers between commas, texts between semicolons, quoted where they hold
/// what would split them.
namespace weft::prusaslicer {

/// Is the key's value a text or a list of texts (and not a number, a flag or a choice)?
bool is_text(std::string_view key);

/// Is it a list of texts, an element an extruder?
bool is_text_list(std::string_view key);

/// Is it 0 or 1 and nothing else?
bool is_flag(std::string_view key);

/// The value in the words of macro::variable_of and of `gcode_variables`: texts in quotes, flags as true and false.
std::string in_macro_words(std::string_view key, std::string_view text);

/// The elements of a list of texts, unquoted: `\"` and `\\` are decoded in quotes, `\n` and `\r` stay as they are, for
/// weft's own ini means the same by them.
std::vector<std::string> texts_of(std::string_view list);

/// The elements of the key's value, whatever it is a list of; a value that is no list is its own only element.
std::vector<std::string> elements_of(std::string_view key, std::string_view text);

/// Does each element of the key's value say one of the things between `|`? `0`, `0.0` and `0%` are the same.
bool says_one_of(std::string_view things, std::string_view key, std::string_view text);

/// The sizes of those `thumbnails` that are PNG ("16x16/PNG, 220x124" gives "16x16, 220x124"). Others go to `left_out`.
std::string png_sizes(std::string_view thumbnails, std::vector<std::string>& left_out);

}  // namespace weft::prusaslicer
