// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <string_view>

/// Text of others inside a language: one rule a language, for every file that the program writes. Whatever the bytes,
/// the result says nothing but text there; in XML, HTML, JSON and tables what is no UTF-8 stands byte for byte as %XX.
namespace weft::escape {

/// The text as UTF-8: itself, but for bytes that are none, which stand as %XX. So names of files remain apart.
std::string utf8(std::string_view text);

/// Content or a value in double quotes, in XML and SVG. Tabs and line ends stay what they are, also in a value; XML
/// cannot write other control characters, and they become question marks. Source: XML 1.0, 2.2 and 3.3.3.
std::string xml(std::string_view text);

/// Content or a quoted value in HTML, not inside `<script>`. Source: WHATWG HTML, 13.1.2.
std::string html(std::string_view text);

/// A string of JSON with its quotes, which may also stand inside `<script>`. Source: RFC 8259, 7.
std::string json(std::string_view text);

/// A whole text of JSON inside `<script>`: no `<` in it can end the script.
std::string script(std::string_view json_text);

/// One cell of a table, in quotes where it needs them. One that a spreadsheet would reckon as a formula begins with an
/// apostrophe. Sources: RFC 4180, 2; OWASP, "CSV injection".
std::string csv(std::string_view text);

/// A value in a comment of G-code: one line, in which line ends, tabs and backslashes are `\n`, `\r`, `\t`, `\\`.
std::string gcode_comment(std::string_view text);

/// A value that is one line: control characters become `_`.
std::string one_line(std::string_view text);

/// A name (a file's, an object's) that commands, macros and comments of G-code can all hold: control characters and
/// those that end a comment or begin an expression become `_`.
std::string gcode_name(std::string_view text);

/// A word of a file in a message, in single quotes: at most 40 bytes of it, control characters as question marks.
std::string message(std::string_view word);

}  // namespace weft::escape
