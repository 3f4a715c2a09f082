// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/escape.h"

#include "core/utf8.h"

#include <catch2/catch.hpp>

using namespace weft;
using namespace std::string_literals;

TEST_CASE("core: UTF-8 is told from bytes that are none") {
  CHECK(is_utf8(""));
  CHECK(is_utf8("wall \u00e9 \u58c1 \U0001F9F5"));
  CHECK(utf8_length("\U0001F9F5") == 4);
  CHECK(utf8_length("") == 0);
  for (const std::string_view bad : {"\x80", "\xc3", "\xc0\xaf", "\xe0\x80\x80", "\xed\xa0\x80", "\xf4\x90\x80\x80"})
    CHECK_FALSE(is_utf8(bad));
}

TEST_CASE("core: text in XML brings neither tags nor values of its own, and keeps its lines") {
  CHECK(escape::xml("a < b & \"c\" > 'd'") == "a &lt; b &amp; &quot;c&quot; &gt; 'd'");
  CHECK(escape::xml("one\ntwo\tthree\r") == "one&#10;two&#9;three&#13;");
  CHECK(escape::xml("bell\a, escape\x1b, delete\x7f, nul"s + '\0') == "bell?, escape?, delete?, nul?");
  CHECK(escape::xml("Gehäuse 壁") == "Gehäuse 壁");
  CHECK(escape::xml("\xff\xfe|\uFFFE|\uFFFF|\xed\xa0\x80") == "%FF%FE|\uFFFD|\uFFFD|%ED%A0%80");
}

TEST_CASE("core: text in HTML ends neither an element nor a value in either kind of quotes") {
  CHECK(escape::html("<b onclick='x(\"&\")'>") == "&lt;b onclick=&#39;x(&quot;&amp;&quot;)&#39;&gt;");
  CHECK(escape::html("\x01\xc3") == "?%C3");
}

TEST_CASE("core: a string of JSON keeps every character, and cannot end the script that it stands in") {
  CHECK(escape::json("a \"b\" \\ c\n\t\r") == R"("a \"b\" \\ c\n\t\r")");
  CHECK(escape::json("\x01\x7f") == "\"\\u0001\\u007f\"");
  CHECK(escape::json("</script>") == "\"\\u003c/script>\"");
  CHECK(escape::json("\xffß") == "\"%FFß\"");
  CHECK(escape::script(R"({"a":"</script><!--"})") == R"({"a":"\u003c/script>\u003c!--"})");
}

TEST_CASE("core: a cell of a table is quoted where it holds a comma, a quote or a line end") {
  CHECK(escape::csv("plain text") == "plain text");
  CHECK(escape::csv("a,b") == "\"a,b\"");
  CHECK(escape::csv("say \"yes\"") == "\"say \"\"yes\"\"\"");
  CHECK(escape::csv("two\r\nlines") == "\"two\r\nlines\"");
}

TEST_CASE("core: text in a comment of G-code stays in its line and can be read back") {
  CHECK(escape::gcode_comment("G28\nG1 X5 ; home\t\\") == "G28\\nG1 X5 ; home\\t\\\\");
  CHECK(escape::one_line("a\nM104 S300\x7f") == "a_M104 S300_");
}

TEST_CASE("core: a name in G-code can end no comment and begin no expression") {
  CHECK(escape::gcode_name("part\nM104 S300;\"x\"{y}") == "part_M104 S300__x__y_");
  CHECK(escape::gcode_name("[a]*'b'\\") == "_a___b__");
}

TEST_CASE("core: a word of a file in a message is short and shows no control characters") {
  CHECK(escape::message("fcaet") == "'fcaet'");
  CHECK(escape::message("\x1b[31m") == "'?[31m'");
  CHECK(escape::message(std::string(50, 'x')) == "'" + std::string(40, 'x') + "...'");
}

TEST_CASE("escape: a cell that a spreadsheet would reckon is text there, and a number stays one", "[core]") {
  CHECK(escape::csv("=cmd|' /C calc'!A0") == "\"'=cmd|' /C calc'!A0\"");
  CHECK(escape::csv("+1+1") == "\"'+1+1\"");
  CHECK(escape::csv("-2+3") == "\"'-2+3\"");
  CHECK(escape::csv("@SUM(A1)") == "\"'@SUM(A1)\"");
  CHECK(escape::csv("\t=1") == "\"'\t=1\"");
  CHECK(escape::csv("-0.25") == "-0.25");
  CHECK(escape::csv("a=b") == "a=b");
}
