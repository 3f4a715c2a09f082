// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/error.h"
#include "macro/macro.h"
#include "macro/variables.h"
#include "settings_error.h"

#include <random>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::macro;
using Catch::Matchers::Contains;
using weft::test::variables;

namespace {

std::string expanded(std::string_view text) {
  Scope scope;
  Variables globals;
  const Template read(text, "start_gcode");
  read.check(variables(), globals);
  return read.expand(variables(), scope);
}

std::string message(std::string_view text) {
  return weft::test::settings_error([&] { expanded(text); });
}

}  // namespace

TEST_CASE("macro: variables are kept until the end of the text") {
  CHECK(expanded("{local a = 1}{a + 1}") == "2");
  CHECK(expanded("{local a = 1; a = a + 1; a = a * 10}{a}") == "20");
  CHECK(expanded("{local s = \"x\"}{s = s + 1}{s}") == "x1");
  CHECK(expanded("{local v = (1, 2.5, \"c\")}{v[0]} {v[1]} {v[2]} {size(v)}") == "1 2.5 c 3");
  CHECK(expanded("{local v = repeat(3, 7); v[1] = 8}{v[0]}{v[1]}{v[2]}") == "787");
  CHECK(expanded("{local v = retract}{v[2]}") == "1.2");
  CHECK(expanded("{local v = (1, 2)}[v_1] [v]") == "2 1,2");
  CHECK(expanded("{local a = 1 == 1}{if a}yes{endif}") == "yes");
}

TEST_CASE("macro: global variables are shared by the texts that come later") {
  Scope scope;
  Variables globals;
  const Template first("{global count = 0}", "start_gcode"), each("{count = count + 1}{count}", "layer_gcode");
  first.check(variables(), globals);
  each.check(variables(), globals);
  CHECK(first.expand(variables(), scope) == "");
  CHECK(each.expand(variables(), scope) == "1");
  CHECK(each.expand(variables(), scope) == "2");
  Variables none;
  CHECK_THROWS_WITH(each.check(variables(), none), Contains("layer_gcode:1:10: unknown placeholder 'count'"));
}

TEST_CASE("macro: conditions stand around text, or within braces") {
  CHECK(expanded("{if layer_num == 3 then \"three\" elsif layer_num == 4 then \"four\" else \"other\" endif}") ==
        "three");
  CHECK(expanded("{local x = 0; if layer_num > 2 then x = 1; else x = 2; endif; x}") == "1");
  CHECK(expanded("{local x = 0}\n{\n  if notes =~ /.*MK3.*/ then\n    x = 5;\n  endif\n}{x}") == "\n5");
  CHECK(expanded("{\nlocal x = 1;\nif x > 0 then\n x = 2;\nelse\nendif\n\"x\" + x;\n}") == "x2");
  CHECK(expanded("{if false}a{elsif false}b{elsif true}c{elsif true}d{else}e{endif}") == "c");
  CHECK(expanded("{if true}{if false}a{else}b{endif}{else}{if true}c{endif}{endif}") == "b");
}

TEST_CASE("macro: a branch that is not taken is not evaluated") {
  CHECK(expanded("{if false}{1/0}{endif}ok") == "ok");
  CHECK(expanded("{false and 1/0 == 1 ? 1 : 2}") == "2");
  CHECK(expanded("{true ? 1 : 1/0}") == "1");
  CHECK_THAT(message("{if false}{tempratur[0]}{endif}"),
             Contains("start_gcode:1:12: unknown placeholder 'tempratur'") && Contains("'temperature'"));
}

TEST_CASE("macro: functions of later PrusaSlicers") {
  CHECK(expanded("{floor(2.7)} {floor(-2.2)} {ceil(2.2)} {ceil(-2.7)}") == "2 -3 3 -2");
  CHECK(expanded("{is_nil(override)} {is_nil(temperature)} {is_nil(retract[1])} {is_nil(retract[0])}") ==
        "true false true false");
  CHECK(expanded("{size(retract)} {empty(retract)} {size(temperature)}") == "3 false 1");
  CHECK(expanded("{one_of(\"b\", \"a\", \"b\")} {one_of(\"b\", \"a\")} {one_of(\"abc\", /a.*/)} {one_of(\"abc\", "
                 "~\"x.*\")}") == "true false true false");
  CHECK(expanded("{interpolate_table(5, (0, 0), (10, 100))}") == "50");
  CHECK(expanded("{interpolate_table(-1, (0, 7), (10, 100))} {interpolate_table(11, (0, 7), (10, 100))} "
                 "{interpolate_table(10, (0, 7), (10, 100))}") == "7 100 100");
  CHECK(expanded("{interpolate_table(15, (0, 0), (10, 100), (20, 0))}") == "50");
  CHECK(expanded("{regex_replace(\"a-b-c\", /-/, \"_\")}") == "a_b_c");
  CHECK(expanded("{max(1, 2.5, 3)} {min(3, 2, 1.5)}") == "3 1.5");
}

TEST_CASE("macro: random numbers are within their limits, and the same for the same seed") {
  const Template read("{random(1, 6)} {random(0.0, 1.0)}", "x");
  Scope a{.globals = {}, .random = 7}, b = a;
  const auto first = read.expand({}, a);
  CHECK(first == read.expand({}, b));
  CHECK(first != read.expand({}, a));
  const Template die("{random(1, 3)}", "x");
  std::string seen;
  for (int i = 0; i < 100; ++i) seen += die.expand({}, a);
  CHECK(seen.find_first_not_of("123") == std::string::npos);
  CHECK((seen.find('1') != std::string::npos && seen.find('2') != std::string::npos &&
         seen.find('3') != std::string::npos));
}

TEST_CASE("macro: numbers have no exponent, which no firmware reads") {
  CHECK(expanded("{100000.0 * 1000} {1234567.891} {0.00001} {0.0000123456} {-1e-5}") ==
        "100000000 1234567.891 0.00001 0.0000123456 -0.00001");
  CHECK(expanded("{0.1 + 0.2} {1.0 / 3} {-0.0}") == "0.3 0.333333 0");
}

TEST_CASE("macro: brackets that hold no name stand for themselves") {
  CHECK(expanded("POLYGON=[[1,2],[3,4]] [ [a") == "POLYGON=[[1,2],[3,4]] [ [a");
  CHECK(expanded("[[1,2]] [] [ [") == "[[1,2]] [] [ [");
  CHECK(expanded("a}b ; 'quoted' \\n") == "a}b ; 'quoted' \\n");
  CHECK(expanded("") == "");
}

TEST_CASE("macro: what is wrong is told with line, column and what to try") {
  CHECK(message("G28\nM109 S{first_layer_temprature[0]}") ==
        "start_gcode:2:8: unknown placeholder 'first_layer_temprature'; did you mean 'first_layer_temperature'?");
  CHECK_THAT(message("[nonsense_and_more_nonsense]"), Contains("start_gcode:1:2: unknown placeholder"));
  CHECK_THAT(message("G1 X{1 +}"), Contains("start_gcode:1:9: expected a value, found '}'"));
  CHECK_THAT(message("G1 X{1 + * 2}"), Contains("start_gcode:1:10: expected a value"));
  CHECK_THAT(message("G1 X{(1 + 2}"), Contains("start_gcode:1:12: expected ')'"));
  CHECK_THAT(message("G1 X{1"), Contains("start_gcode:1:5: '{' without '}'"));
  CHECK_THAT(message("{}"), Contains("'{}' holds nothing"));
  CHECK_THAT(message("{1 2}"), Contains("start_gcode:1:4: expected '}' or ';'"));
  CHECK_THAT(message("{maxx(1, 2)}"), Contains("unknown function 'maxx'") && Contains("did you mean 'max'"));
  CHECK_THAT(message("{round(1, 2)}"), Contains("round takes 1 arguments, not 2"));
  CHECK_THAT(message("{if layer_num}x{endif}"), Contains("neither true nor false"));
  CHECK_THAT(message("{if layer_num == 3}x"), Contains("start_gcode:1:2: {if} without {endif}"));
  CHECK_THAT(message("[_[layer_num]]"), Contains("start_gcode:1:2: unknown placeholder '_'"));
  const std::string long_text =
      "{local s = \"" + std::string(1000, 'a') + "\"; s = s + s; s = s + s; s = s + s; s = s + s}";
  CHECK_THAT(message(long_text + "{s =~ /(a|aa|.){900}x/ ? 1 : 2}"), Contains("would take too long"));
  CHECK_THAT(message(long_text + "{regex_replace(s, /a*b/, \"\")}"), Contains("would take too long"));
  CHECK(expanded(long_text + "{s =~ /a+/ ? 1 : 2}") == "1");
  CHECK_THAT(message("x{endif}"), Contains("start_gcode:1:3: there is no {if} before this"));
  CHECK_THAT(message("{if true}{else}{elsif true}{endif}"), Contains("only {endif} may follow {else}"));
  CHECK_THAT(message("{if true then 1}x{endif}"), Contains("without endif before '}'"));
  CHECK_THAT(message("{1/0}"), Contains("start_gcode:1:2: division by zero"));
  CHECK_THAT(message("{1%0}"), Contains("division by zero"));
  CHECK_THAT(message("{retract[3]}"), Contains("'retract' has 3 values, there is no [3]") && Contains("count from 0"));
  CHECK_THAT(message("{retract}"), Contains("is a list of 3 values") && Contains("{retract[0]}"));
  CHECK_THAT(message("{override}"), Contains("nil"));
  CHECK_THAT(message("{travel_z}"), Contains("'travel_z' is auto"));
  CHECK_THAT(message("{\"a\" * 2}"), Contains("'a' is not a number"));
  CHECK_THAT(message("{if not layer_num == 3}{endif}"), Contains("not (a == b)"));
  CHECK_THAT(message("{true == 1}"), Contains("cannot be compared"));
  CHECK_THAT(message("{\"a\" =~ /(/}"), Contains("is not a regular expression"));
  CHECK_THAT(message("{temperature = 5}"), Contains("'temperature' cannot be changed"));
  CHECK_THAT(message("{local temperature = 5}"), Contains("choose another name"));
  CHECK_THAT(message("{x = 5}"), Contains("unknown placeholder 'x'"));
  CHECK_THAT(message("{9223372036854775807 + 1}"), Contains("too large"));
  CHECK_THAT(message("{99999999999999999999}"), Contains("start_gcode:1:2: '99999999999999999999' is not a number"));
  CHECK_THAT(message("{digits(1, 1000)}"), Contains("whole number from 0 to 64"));
  CHECK_THAT(message("{interpolate_table(1, (2, 2), (1, 1))}"), Contains("must rise"));
}

TEST_CASE("macro: no text exhausts the stack or takes forever") {
  CHECK_THAT(message("{" + std::string(100'000, '(') + "1"), Contains("nested too deeply"));
  CHECK_THAT(message("{" + std::string(100'000, '-') + "1}"), Contains("nested too deeply"));
  std::string sum = "{1";
  for (int i = 0; i < 100'000; ++i) sum += "+1";
  CHECK_THAT(message(sum + "}"), Contains("too long"));
  std::string choices = "{";
  for (int i = 0; i < 10'000; ++i) choices += "true?1:";
  CHECK_THAT(message(choices + "2}"), Contains("nested too deeply"));
  std::string ifs, ends;
  for (int i = 0; i < 20'000; ++i) ifs += "{if true}", ends += "{endif}";
  CHECK(expanded(ifs + "x" + ends) == "x");
  CHECK(expanded("{local s = \"" + std::string(3'000, 'a') + "\"}{if s =~ /(a|a|aa)*b/}T{else}F{endif}") == "F");
  CHECK_THAT(message("{local s = repeat(1000000000, 1)}"), Contains("repeat takes"));
}

TEST_CASE("macro: no text fills the memory") {
  std::string doubled = "{local s = \"0123456789\"";
  for (int i = 0; i < 60; ++i) doubled += "; s = s + s";
  CHECK_THAT(message(doubled + "}"), Contains("longer than 1 MB"));
  std::string printed = "{local s = \"" + std::string(100'000, 'x') + "\"}";
  for (int i = 0; i < 100; ++i) printed += "{s}";
  CHECK_THAT(message(printed), Contains("longer than 1 MB"));
  CHECK_THAT(message("{\"a\" =~ /" + std::string(5'000, '(') + "/}"), Contains("more than 1000 characters"));
  CHECK_THAT(message("{\"a\" =~ /(a{900}){900}/}"), Contains("is not a regular expression"));
}

TEST_CASE("macro: no bytes whatever crash the reader") {
  std::mt19937 random(11);
  const std::string_view parts[] = {
      "{", "}",  "[",  "]",    "if ", "endif", "else",   "elsif ",  "1",     "2.5",         "\"",      "/",
      "(", ")",  "+",  "-",    "*",   "%",     "<",      ">",       "=",     "!",           "~",       "?",
      ":", ";",  ",",  "and ", "or ", "not ",  "local ", "global ", "then ", "temperature", "retract", "_0",
      " ", "\n", "\\", "\x80", "é",   "max",   "size",   "nil",     "true",  "1e999",       "\0"};
  std::size_t fine = 0;
  for (int i = 0; i < 20'000; ++i) {
    std::string text;
    for (std::size_t n = random() % 14; n > 0; --n) text += parts[random() % std::size(parts)];
    try {
      expanded(text);
      ++fine;
    } catch (const Error& e) {
      CHECK(e.where().rfind("start_gcode:", 0) == 0);
    }
  }
  CHECK(fine > 100);
}

TEST_CASE("macro: a condition alone") {
  CHECK(holds("", variables(), "compatible_printers_condition"));
  CHECK(holds("  ", variables(), "compatible_printers_condition"));
  CHECK(holds("notes=~/.*MK3.*/ and temperature[0]<240", variables(), "x"));
  CHECK(!holds("notes!~/.*MK3.*/ or layer_num!=3", variables(), "x"));
  CHECK_THROWS_WITH(holds("notess=~/a/", variables(), "compatible_printers_condition"),
                    Contains("compatible_printers_condition:1:1: unknown placeholder 'notess'"));
  CHECK_THROWS_WITH(holds("true true", variables(), "x"), Contains("x:1:6") && Contains("left over"));
  CHECK_THROWS_WITH(holds("1", variables(), "x"), Contains("neither true nor false"));
}

TEST_CASE("macro: values in the words of an ini have types") {
  CHECK(variable_of("215").values == std::vector<Scalar>{std::int64_t{215}});
  CHECK(variable_of("0.5, 1").values == std::vector<Scalar>{0.5, std::int64_t{1}});
  CHECK(variable_of("true").values == std::vector<Scalar>{true});
  CHECK(variable_of("nil,x").values == std::vector<Scalar>{Nil{}, std::string("x")});
  CHECK(variable_of("15%").values == std::vector<Scalar>{std::int64_t{15}});
  CHECK(variable_of("15%").text == "15%");
  CHECK(variable_of("\"a, \\\"b\\\"\",c").values == std::vector<Scalar>{std::string("a, \"b\""), std::string("c")});
  CHECK(variable_of("\"a b\"").text == "a b");
  CHECK(variable_of("inf").values == std::vector<Scalar>{std::string("inf")});
  CHECK(variable_of("").values == std::vector<Scalar>{std::string()});
}

TEST_CASE("macro: a back-reference of many digits is refused, not read beyond what a number holds") {
  // It can fail under the undefined-behaviour sanitizer only (preset asan): elsewhere the library, having overflowed,
  // refuses it as well. The fuzz seed `back-reference` is such a pattern in a condition.
  CHECK(message("{\"a\" =~ /x\\55555555555555555555555/}").find("is not a regular expression") != std::string::npos);
}

TEST_CASE("macro: a count of many digits in a regular expression is refused, not read beyond what a number holds") {
  const std::string refused = "is not a regular expression";
  // On an empty text nothing else refuses it.
  for (const std::string count : {"18446744073709551614", "18446744073709551617", "0,18446744073709551617"})
    CHECK(message("{\"\" =~ /a{" + count + "}/}").find(refused) != std::string::npos);
  CHECK(expanded("{\"a{1\" =~ /a\\{1/}") == "true");
  CHECK(expanded("{\"aa\" =~ /a{1,2}/}") == "true");
}

TEST_CASE("macro: lists of long texts and texts of long lists meet a limit of memory, with line and column",
          "[macro]") {
  const std::string text = "{local t = \"0123456789abcdef\"}" + [] {
    std::string doubled;
    for (int i = 0; i < 15; ++i) doubled += "{t = t + t}";  // 512 kB
    return doubled;
  }();
  CHECK_THAT(message("\n" + text + "{local l = repeat(100000, t)}"), Contains("start_gcode:2:"));
  CHECK_THAT(message(text + "{local l = repeat(100000, t)}"), Contains("the list takes more than 16 MB"));
  std::string many = text + "{local l = repeat(20, t)}";
  for (const std::string name : {"a", "b", "c"}) many += "{local " + name + " = l}";
  CHECK_THAT(message(many), Contains("variables hold more than 16 MB"));
  std::string elements = text + "{local l = repeat(50, 0)}";
  for (int i = 0; i < 50; ++i) elements += "{l[" + std::to_string(i) + "] = t}";
  CHECK_THAT(message(elements), Contains("variables hold more than 16 MB"));
}

TEST_CASE("macro: what globals hold is limited over all templates, and what is given up is free again", "[macro]") {
  Scope scope;
  Variables globals;
  const Template grows("{global l = repeat(1000, \"\")}{l[0] = l[0] + \"0123456789\"}", "layer_gcode");
  grows.check(variables(), globals);
  for (int layer = 0; layer < 2000; ++layer) grows.expand(variables(), scope);
  CHECK(scope.held < 100'000);
  const Template own("{local own = repeat(100000, 1)}", "layer_gcode");
  own.check(variables(), globals);
  const auto before = scope.held;
  for (int layer = 0; layer < 20; ++layer) own.expand(variables(), scope);
  CHECK(scope.held == before);
}

TEST_CASE("macro: a template of more steps than anyone waits for is refused with line and column", "[macro]") {
  std::string long_one = "{local l = repeat(100000, 1)}{local n = 0}";
  for (int i = 0; i < 200; ++i) long_one += "{n = size(l)}";
  CHECK_THAT(message(long_one), Contains("takes too many steps"));
  CHECK_THAT(message(long_one), Contains("start_gcode:1:"));
  CHECK(expanded("{local x = (1, 2, 3)}{x[1] = x[1] + 5}{x[1]}") == "7");
}
