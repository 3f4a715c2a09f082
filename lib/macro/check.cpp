// SPDX-License-Identifier: GPL-3.0-or-later
// What is wrong with a program whatever the values are: unknown names, functions called wrongly, patterns that are
// none.
#include "core/join.h"
#include "macro/functions.h"
#include "macro/macro.h"
#include "macro/program.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

namespace weft::macro {
namespace {

/// Names, arities and where assignments go, known without any value.
class Checking {
 public:
  Checking(const Program& program, const Variables& variables, Variables& globals)
      : program_(program), variables_(variables), globals_(globals) {}

  void all() {
    for (const auto& s : program_.statements) {
      if (s.op == Op::legacy) {
        const auto split = known(s.text) ? std::nullopt : numbered(s.text);
        if (!known(split ? split->name : s.text)) unknown(s.at, s.text);
      }
      if (s.index != none) expression(s.index);
      if (s.expression != none) expression(s.expression);
      if (s.op == Op::local) locals_.insert(s.text);
      if (s.op == Op::global) globals_.emplace(s.text, Variable{});
      if ((s.op == Op::local || s.op == Op::global) && variables_.contains(s.text))
        program_.refuse(s.at, fmt::format("'{}' is a name that weft gives a value", s.text), "choose another name");
      if (s.op == Op::assign && !locals_.contains(s.text) && !globals_.contains(s.text)) {
        const auto found = variables_.find(s.text);
        if (found != variables_.end() && found->second.writable) {
          locals_.insert(s.text);
          continue;
        }
        if (found != variables_.end())
          program_.refuse(s.at, fmt::format("'{}' cannot be changed", s.text),
                          fmt::format("write {{local my_{} = …}}", s.text));
        unknown(s.at, s.text);
      }
    }
  }

  void expression(Id id) {
    const auto& node = program_.nodes[id];
    if (node.kind == Kind::variable && !known(node.name)) unknown(node.at, node.name);
    if (node.kind == Kind::call) call(node);
    if (node.kind == Kind::matches || node.kind == Kind::differs) pattern(program_.nodes[node.kids[1]]);
    for (const Id kid : node.kids) expression(kid);
  }

 private:
  bool known(const std::string& name) const {
    return locals_.contains(name) || globals_.contains(name) || variables_.contains(name);
  }

  void pattern(const Node& regex) const {
    try {
      matches("", regex.name);
    } catch (const std::invalid_argument& e) {
      program_.refuse(regex.at, e.what());
    }
  }

  void call(const Node& node) const {
    const auto all = signatures();
    const auto found = std::find_if(all.begin(), all.end(), [&](const Signature& s) { return s.name == node.name; });
    if (found == all.end()) {
      std::vector<std::string_view> names;
      for (const auto& s : all) names.push_back(s.name);
      const auto near = nearest_name(node.name, names);
      program_.refuse(node.at, fmt::format("unknown function '{}'", node.name),
                      near.empty() ? "there are " + joined(names) : fmt::format("did you mean '{}'?", near));
    }
    if (node.kids.size() < found->least || node.kids.size() > found->most)
      program_.refuse(node.at, fmt::format("{} takes {} arguments, not {}", node.name,
                                           found->least == found->most ? fmt::format("{}", found->least)
                                           : found->most > 10          ? fmt::format("{} or more", found->least)
                                                              : fmt::format("{} or {}", found->least, found->most),
                                           node.kids.size()));
    for (const Id kid : node.kids)
      if (program_.nodes[kid].kind == Kind::regex) pattern(program_.nodes[kid]);
  }

  [[noreturn]] void unknown(std::uint32_t at, const std::string& name) const {
    std::vector<std::string_view> names;
    for (const auto& [n, v] : variables_) names.push_back(n);
    for (const auto& [n, v] : globals_) names.push_back(n);
    for (const auto& n : locals_) names.push_back(n);
    const auto near = nearest_name(name, names);
    program_.refuse(
        at, fmt::format("unknown placeholder '{}'", name),
        near.empty() ? "`weft settings` lists the names of settings" : fmt::format("did you mean '{}'?", near));
  }

  const Program& program_;
  const Variables& variables_;
  Variables& globals_;
  std::set<std::string, std::less<>> locals_;
};

}  // namespace

std::optional<Numbered> numbered(std::string_view text) {
  const auto tail = text.rfind('_');
  if (tail == std::string_view::npos || tail + 1 == text.size() || text.size() - tail > 6) return std::nullopt;
  std::size_t index = 0;
  for (const char c : text.substr(tail + 1)) {
    if (c < '0' || c > '9') return std::nullopt;
    index = 10 * index + static_cast<std::size_t>(c - '0');
  }
  return Numbered{std::string(text.substr(0, tail)), index};
}

void Template::check(const Variables& variables, Variables& globals) const {
  Checking(*program_, variables, globals).all();
}

void check_condition(const Program& program, const Variables& variables, Id root) {
  Variables globals;
  Checking(program, variables, globals).expression(root);
}

}  // namespace weft::macro
