// SPDX-License-Identifier: GPL-3.0-or-later
// From text to statements: what stands outside braces, and how branches hang together.
#include "core/error.h"
#include "macro/macro.h"
#include "macro/program.h"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

namespace weft::macro {
namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

/// Reads a whole text into a program.
class Reading {
 public:
  explicit Reading(Program& program) : program_(program), text_(program.text) {}

  void all() {
    while (at_ < text_.size()) {
      const auto special = std::min(text_.find_first_of("{[", at_), text_.size());
      plain(special);
      if (at_ == text_.size()) break;
      if (text_[at_] == '{')
        code();
      else if (!legacy())
        plain(at_ + 1);
    }
    if (!open_.empty())
      program_.refuse(program_.statements[open_.back().first].at, "{if} without {endif}",
                      "write {endif} where the condition ends");
  }

 private:
  struct Open {
    std::size_t first, branch;  ///< the `if`, and the branch of it that is open
    std::vector<std::size_t> branches{};
    bool otherwise = false;
  };

  void plain(std::size_t end) {
    if (end == at_) return;
    auto piece = text_.substr(at_, end - at_);
    if (!program_.statements.empty() && program_.statements.back().op == Op::text)
      program_.statements.back().text += piece;
    else
      program_.statements.push_back(
          {.op = Op::text, .at = static_cast<std::uint32_t>(at_), .text = std::string(piece)});
    at_ = end;
  }

  void skip_blanks() {
    while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
  }

  /// `{statement; statement}`
  void code() {
    const auto brace = static_cast<std::uint32_t>(at_++);
    const std::size_t before = open_.size();
    skip_blanks();
    if (at_ < text_.size() && text_[at_] == '}') program_.refuse(brace, "'{}' holds nothing", "write {name}");
    bool separated = true;
    for (;;) {
      skip_blanks();
      if (at_ == text_.size())
        program_.refuse(brace, "'{' without '}'", "close the placeholder; {\"{\"} writes a brace");
      if (text_[at_] == '}') break;
      if (text_[at_] == ';') {
        ++at_;
        separated = true;
        continue;
      }
      const auto at = static_cast<std::uint32_t>(at_);
      auto statement = parse_statement(program_, at_);
      statement.at = at;
      const bool branch = statement.op == Op::begin_if || statement.op == Op::else_if ||
                          statement.op == Op::otherwise || statement.op == Op::end_if;
      if (!separated && !branch) program_.refuse(at, "expected '}' or ';'", "statements are separated by ';'");
      separated = branch;  // stock profiles write none behind endif
      add(std::move(statement));
    }
    ++at_;
    if (open_.size() > before && program_.statements[open_.back().branch].in_code)
      program_.refuse(program_.statements[open_.back().first].at, "if … then without endif before '}'",
                      "write endif, or leave 'then' out and write {endif} after the text");
  }

  /// Keeps the branches together.
  void add(Statement statement) {
    const auto here = program_.statements.size();
    const auto op = statement.op;
    if (op == Op::begin_if) {
      open_.push_back({here, here, {here}});
    } else if (op == Op::else_if || op == Op::otherwise || op == Op::end_if) {
      if (open_.empty()) program_.refuse(statement.at, "there is no {if} before this");
      auto& open = open_.back();
      if (open.otherwise && op != Op::end_if) program_.refuse(statement.at, "only {endif} may follow {else}");
      if (op == Op::otherwise) statement.in_code = program_.statements[open.branch].in_code;
      open.otherwise = op == Op::otherwise;
      program_.statements[open.branch].next = here;
      open.branch = here;
      if (op != Op::end_if) open.branches.push_back(here);
      if (op == Op::end_if) {
        for (const auto branch : open.branches) program_.statements[branch].end = here;
        statement.end = here;
        open_.pop_back();
      }
    }
    program_.statements.push_back(std::move(statement));
  }

  /// `[name]`, `[name_0]`, `[name[other]]`, `[name_[other]]`, `[name][0]`. False: the '[' stands for itself.
  bool legacy() {
    std::size_t p = at_ + 1;
    const auto skip = [&] {
      while (p < text_.size() && (text_[p] == ' ' || text_[p] == '\t')) ++p;
    };
    skip();
    if (p == text_.size() || !starts_name(text_[p])) return false;
    const auto begin = p;
    p = end_of_name(text_, p);
    Statement statement{
        .op = Op::legacy, .at = static_cast<std::uint32_t>(begin), .text = std::string(text_.substr(begin, p - begin))};
    if (p < text_.size() && text_[p] == '[') {
      const auto index = p + 1;
      p = end_of_name(text_, index);
      if (p == index || !starts_name(text_[index]) || p == text_.size() || text_[p] != ']') return false;
      statement.index = variable_at(index, p);
      if (statement.text.size() > 1 && statement.text.back() == '_') statement.text.pop_back();
      ++p;
    }
    skip();
    if (p == text_.size() || text_[p] != ']') return false;
    at_ = p + 1;
    program_.statements.push_back(std::move(statement));
    return true;
  }

  Id variable_at(std::size_t begin, std::size_t end) {
    program_.nodes.push_back({.kind = Kind::variable,
                              .at = static_cast<std::uint32_t>(begin),
                              .name = std::string(text_.substr(begin, end - begin))});
    return static_cast<Id>(program_.nodes.size() - 1);
  }

  Program& program_;
  std::string_view text_;
  std::size_t at_ = 0;
  std::vector<Open> open_;
};

void collect_names(Program& program) {
  for (const auto& s : program.statements)
    if (s.op == Op::legacy) program.names.push_back(s.text);
  for (const auto& n : program.nodes)
    if (n.kind == Kind::variable) program.names.push_back(n.name);
}

constexpr std::size_t most_text = std::size_t{1} << 24;

std::shared_ptr<Program> begun(std::string_view text, std::string_view setting) {
  auto program = std::make_shared<Program>();
  if (text.size() > most_text)
    throw Error{Error::Kind::settings, "custom G-code of more than 16 MB", std::string(setting), "print it as a file"};
  program->text = std::string(text);
  program->setting = std::string(setting);
  return program;
}

}  // namespace

bool starts_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
std::size_t end_of_name(std::string_view text, std::size_t at) {
  while (at < text.size() && (starts_name(text[at]) || (text[at] >= '0' && text[at] <= '9'))) ++at;
  return at;
}

void Program::refuse(std::uint32_t at, std::string what, std::string hint) const {
  const auto before = std::string_view(text).substr(0, at);
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const auto last = before.rfind('\n');
  const auto column = last == std::string_view::npos ? at + 1 : at - last;
  throw Error{Error::Kind::settings, std::move(what), fmt::format("{}:{}:{}", setting, line, column), std::move(hint)};
}

Template::Template(std::string_view text, std::string_view setting) {
  auto program = begun(text, setting);
  Reading(*program).all();
  collect_names(*program);
  program_ = std::move(program);
}

const std::vector<std::string>& Template::names() const {
  return program_->names;
}

std::shared_ptr<const Program> condition(std::string_view text, std::string_view where, Id& root) {
  auto program = begun(text, where);
  std::size_t at = 0;
  root = parse_expression(*program, at);
  while (at < text.size() && is_blank(text[at])) ++at;
  if (at < text.size())
    program->refuse(static_cast<std::uint32_t>(at), fmt::format("'{}' is left over", text.substr(at, 12)),
                    "conditions are joined by 'and' or 'or'");
  return program;
}

}  // namespace weft::macro
