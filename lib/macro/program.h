// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "macro/value.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// A template that has been read: a flat list of statements, and the expressions in them.
namespace weft::macro {

enum class Kind : std::uint8_t {
  literal,
  regex,
  variable,
  index,
  list,
  call,
  negate,
  identity,
  invert,
  add,
  subtract,
  multiply,
  divide,
  modulo,
  equal,
  unequal,
  less,
  greater,
  at_most,
  at_least,
  matches,
  differs,
  both,
  either,
  choose,
};

using Id = std::uint32_t;
inline constexpr Id none = ~Id{0};

/// Part of an expression. `kids` are indices into Program::nodes.
struct Node {
  Kind kind = Kind::literal;
  std::uint32_t at = 0;     ///< where it stands in the text
  std::uint32_t depth = 1;  ///< of the tree below
  std::string name{};       ///< of a variable or function; the pattern of a regex
  Scalar value{};           ///< of a literal
  std::vector<Id> kids{};
};

enum class Op : std::uint8_t { text, legacy, print, begin_if, else_if, otherwise, end_if, local, global, assign };

/// One step. Branches know where the next branch begins (`next`) and where all of them end (`end`).
struct Statement {
  Op op = Op::text;
  std::uint32_t at = 0;
  Id expression = none, index = none;
  bool in_code = false;  ///< `if … then` within braces
  std::string text{};    ///< of Op::text; else the name of the variable
  std::size_t next = 0, end = 0;
};

struct Program {
  std::string text, setting;
  std::vector<Node> nodes;
  std::vector<Statement> statements;
  std::vector<std::string> names;

  /// @throws Error{settings} with setting:line:column
  [[noreturn]] void refuse(std::uint32_t at, std::string what, std::string hint = {}) const;
};

/// Expressions deeper than this are refused, so that no text exhausts the stack.
inline constexpr std::uint32_t most_depth = 1000;
/// Likewise parentheses within parentheses, which are read by recursion.
inline constexpr int most_nesting = 64;

/// Reads one statement between braces, beginning at `at`, which moves behind it. Expressions go to `program.nodes`.
/// @throws Error{settings}
Statement parse_statement(Program& program, std::size_t& at);
/// Reads an expression, as parse_statement.
Id parse_expression(Program& program, std::size_t& at);

/// A name with a number behind: `temperature_0`.
struct Numbered {
  std::string name;
  std::size_t index;
};
std::optional<Numbered> numbered(std::string_view text);

/// An expression alone; `root` is where it is in the program's nodes.
std::shared_ptr<const Program> condition(std::string_view text, std::string_view where, Id& root);
void check_condition(const Program& program, const Variables& variables, Id root);

/// Does a name begin here, and where does it end?
bool starts_name(char c);
std::size_t end_of_name(std::string_view text, std::size_t at);

}  // namespace weft::macro
