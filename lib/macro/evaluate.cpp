// SPDX-License-Identifier: GPL-3.0-or-later
// The text that a program gives.
#include "core/stop.h"
#include "macro/functions.h"
#include "macro/macro.h"
#include "macro/program.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace weft::macro {

namespace {

class Evaluation {
 public:
  Evaluation(const Program& program, const Variables& variables, Scope& scope)
      : program_(program), variables_(variables), scope_(scope) {}

  /// What its own variables held is given back.
  std::string text() {
    auto out = expanded();
    for (const auto& [name, variable] : locals_) scope_.held -= bytes_of(variable.values);
    return out;
  }

  std::string expanded() {
    std::string out;
    bool jumped = false;  // to the next branch, because the one before was not taken
    for (std::size_t i = 0; i < program_.statements.size();) {
      const auto& s = program_.statements[i];
      const bool arrived = std::exchange(jumped, false);
      switch (s.op) {
        case Op::text:
          out += s.text;
          break;
        case Op::legacy:
          out += legacy(s);
          break;
        case Op::print:
          out += printed(s);
          break;
        case Op::else_if:
        case Op::otherwise:
          if (!arrived) {
            i = s.end;
            continue;
          }
          if (s.op == Op::otherwise) break;
          [[fallthrough]];
        case Op::begin_if:
          if (truth(s.expression)) break;
          jumped = true;
          i = s.next;
          continue;
        case Op::end_if:
          break;
        case Op::local:
          keep(s.at, locals_[s.text].values, list_or_scalar(s.expression));
          break;
        case Op::global:
          keep(s.at, scope_.globals[s.text].values, list_or_scalar(s.expression));
          break;
        case Op::assign:
          assign(s);
          break;
      }
      ++i;
      if (out.size() > most_output + program_.text.size())
        program_.refuse(s.at, "custom G-code becomes longer than 1 MB");
    }
    return out;
  }

  bool truth(Id id) {
    const auto v = scalar(id);
    const auto* b = std::get_if<bool>(&v);
    if (!b)
      program_.refuse(program_.nodes[id].at, fmt::format("'{}' is neither true nor false", text_of(v)),
                      "compare it: x == 1");
    return *b;
  }

 private:
  // A variable can be doubled again and again, and a list made of long texts: without limits a few lines fill any
  // memory and take any time.
  static constexpr std::size_t most_output = std::size_t{1} << 20, most_elements = 100'000;
  static constexpr std::size_t most_held = std::size_t{16} << 20;   ///< bytes, in all variables
  static constexpr std::size_t most_made = std::size_t{256} << 20;  ///< bytes, of all values of one template: its steps

  static std::size_t bytes_of(const Scalar& v) {
    const auto* text = std::get_if<std::string>(&v);
    return sizeof(Scalar) + (text ? text->size() : 0);
  }
  static std::size_t bytes_of(const std::vector<Scalar>& values) {
    std::size_t sum = 0;
    for (const auto& v : values) sum += bytes_of(v);
    return sum;
  }

  /// To be told before so many bytes of values are made.
  void make(std::uint32_t at, std::size_t bytes) {
    const std::size_t before = std::exchange(made_, made_ + bytes);
    if ((before ^ made_) >> 20 != 0) stop_if_asked();
    if (made_ > most_made)
      program_.refuse(at, "custom G-code takes too many steps", "make shorter lists and texts, or fewer of them");
  }

  /// Puts values where others were.
  void keep(std::uint32_t at, std::vector<Scalar>& where, std::vector<Scalar> values) {
    const std::size_t before = bytes_of(where), after = bytes_of(values);
    make(at, before);
    scope_.held = scope_.held + after - before;
    where = std::move(values);
    if (scope_.held > most_held)
      program_.refuse(at, fmt::format("variables hold more than {} MB", most_held >> 20),
                      "make shorter lists and texts, or fewer of them");
  }

  const Variable* find(const std::string& name) const {
    const Variables& locals = locals_;
    const Variables& globals = scope_.globals;
    for (const auto* where : {&locals, &globals, &variables_})
      if (const auto found = where->find(name); found != where->end()) return &found->second;
    return nullptr;
  }

  const Variable& variable(std::uint32_t at, const std::string& name) const {
    const auto* found = find(name);
    if (!found ||
        (found->values.empty() && found->missing.empty() && !locals_.contains(name) && !scope_.globals.contains(name)))
      program_.refuse(at, fmt::format("'{}' has no value here", name));
    if (!found->missing.empty())
      program_.refuse(at, fmt::format("'{}' {}: it has no value to write", name, found->missing),
                      "give the setting a value");
    return *found;
  }

  const Scalar& element(std::uint32_t at, const std::string& name, const Variable& v, std::int64_t index) const {
    // One element: every index names it, as with PrusaSlicer's lists of one extruder.
    if (index >= 0 && v.values.size() == 1) return v.values[0];
    if (index < 0 || static_cast<std::size_t>(index) >= v.values.size())
      program_.refuse(at, fmt::format("'{}' has {} values, there is no [{}]", name, v.values.size(), index),
                      "count from 0");
    return v.values[static_cast<std::size_t>(index)];
  }

  std::int64_t index_value(Id id) {
    const auto v = scalar(id);
    const auto* i = std::get_if<std::int64_t>(&v);
    if (!i)
      program_.refuse(program_.nodes[id].at, fmt::format("'{}' is not a whole number", text_of(v)),
                      "an index counts from 0");
    return *i;
  }

  /// In brackets PrusaSlicer writes 1 and 0.
  static std::string in_brackets(const Scalar& value) {
    const auto* flag = std::get_if<bool>(&value);
    return flag == nullptr ? text_of(value) : *flag ? "1" : "0";
  }
  /// Of a list without an index: that of the filament in question, or the extruder that prints, or the first.
  const Scalar& of_current(const Variable& v) const {
    const auto* current = find("filament_extruder_id");
    if (!current) current = find("current_extruder");
    const auto* index = current && !current->values.empty() ? std::get_if<std::int64_t>(&current->values[0]) : nullptr;
    const auto i = index && *index >= 0 ? static_cast<std::size_t>(*index) : 0;
    return v.values[i < v.values.size() ? i : 0];
  }

  static std::string joined(const std::vector<Scalar>& values) {
    std::string out;
    for (const auto& value : values) out += (out.empty() ? "" : ",") + in_brackets(value);
    return out;
  }

  std::string legacy(const Statement& s) {
    if (s.index != none) return in_brackets(element(s.at, s.text, variable(s.at, s.text), index_value(s.index)));
    if (!find(s.text))
      if (const auto split = numbered(s.text))
        return in_brackets(
            element(s.at, split->name, variable(s.at, split->name), static_cast<std::int64_t>(split->index)));
    const auto& v = variable(s.at, s.text);
    if (locals_.contains(s.text) || scope_.globals.contains(s.text)) return joined(v.values);
    if (v.values.size() > 1) return in_brackets(of_current(v));
    if (!v.text.empty() || v.values.empty()) return v.text;
    return in_brackets(v.values[0]);
  }

  std::string printed(const Statement& s) {
    const auto v = scalar(s.expression);
    if (std::holds_alternative<Nil>(v)) program_.refuse(s.at, "the value is nil", "test it: {if is_nil(x)}…{endif}");
    return text_of(v);
  }

  void assign(const Statement& s) {
    const auto own = variables_.find(s.text);
    if (own != variables_.end() && own->second.writable && !locals_.contains(s.text))
      keep(s.at, locals_[s.text].values, own->second.values);
    auto& where = locals_.contains(s.text) ? locals_ : scope_.globals;
    const auto found = where.find(s.text);
    if (found == where.end())
      program_.refuse(s.at, fmt::format("'{}' has no value here", s.text),
                      fmt::format("write {{local {} = …}} before", s.text));
    if (s.index == none) return keep(s.at, found->second.values, list_or_scalar(s.expression));
    const auto index = index_value(s.index);
    auto& values = found->second.values;
    if (index < 0 || static_cast<std::size_t>(index) >= values.size())
      program_.refuse(s.at, fmt::format("'{}' has {} values, there is no [{}]", s.text, values.size(), index),
                      "count from 0");
    auto value = scalar(s.expression);  // which may read the element
    std::vector<Scalar> one{std::move(values[static_cast<std::size_t>(index)])};
    keep(s.at, one, {std::move(value)});
    values[static_cast<std::size_t>(index)] = std::move(one.front());
  }

  std::vector<Scalar> list_or_scalar(Id id) {
    const auto& node = program_.nodes[id];
    if (node.kind == Kind::list) {
      std::vector<Scalar> out;
      for (const Id kid : node.kids) out.push_back(scalar(kid));
      return out;
    }
    if (node.kind == Kind::variable) {
      const auto& values = variable(node.at, node.name).values;
      make(node.at, bytes_of(values));
      return values;
    }
    if (node.kind == Kind::call && node.name == "repeat") {
      const auto count = index_value(node.kids[0]);
      if (count < 0 || static_cast<std::size_t>(count) > most_elements)
        program_.refuse(node.at, fmt::format("repeat takes 0 to {} elements", most_elements));
      const auto each = scalar(node.kids[1]);
      const auto bytes = static_cast<std::size_t>(count) * bytes_of(each);
      if (bytes > most_held) program_.refuse(node.at, fmt::format("the list takes more than {} MB", most_held >> 20));
      make(node.at, bytes);
      return std::vector<Scalar>(static_cast<std::size_t>(count), each);
    }
    return {scalar(id)};
  }

  Scalar scalar(Id id) {
    auto out = value_of(id);
    make(program_.nodes[id].at, bytes_of(out));
    return out;
  }

  Scalar value_of(Id id) {
    const auto& node = program_.nodes[id];
    switch (node.kind) {
      case Kind::literal:
        return node.value;
      case Kind::regex:
        program_.refuse(node.at, "a /regular expression/ is not a value");
      case Kind::list:
        program_.refuse(node.at, "a list stands where one value is expected");
      case Kind::variable:
        return only(node);
      case Kind::index:
        return indexed(node);
      case Kind::call:
        return called(node);
      case Kind::negate:
      case Kind::identity:
      case Kind::invert:
        return unary(node);
      case Kind::both:
        return truth(node.kids[0]) && truth(node.kids[1]);
      case Kind::either:
        return truth(node.kids[0]) || truth(node.kids[1]);
      case Kind::choose:
        return scalar(truth(node.kids[0]) ? node.kids[1] : node.kids[2]);
      case Kind::matches:
      case Kind::differs:
        return matched(node);
      default:
        break;
    }
    const auto a = scalar(node.kids[0]);
    const auto b = scalar(node.kids[1]);
    try {
      const bool divides = node.kind == Kind::divide || node.kind == Kind::modulo;
      if (scope_.lenient && divides && number_of(b) == 0) return std::int64_t{1};
      return node.kind >= Kind::equal ? Scalar(compared(node.kind, a, b)) : arithmetic(node.kind, a, b);
    } catch (const std::invalid_argument& e) {
      program_.refuse(node.at, e.what());
    }
  }

  Scalar only(const Node& node) const {
    const auto& v = variable(node.at, node.name);
    if (v.values.size() != 1)
      program_.refuse(node.at, fmt::format("'{}' is a list of {} values", node.name, v.values.size()),
                      fmt::format("write {{{}[0]}}", node.name));
    return v.values[0];
  }

  Scalar indexed(const Node& node) {
    const auto& name = program_.nodes[node.kids[0]];
    const auto index = index_value(node.kids[1]);
    return element(node.at, name.name, variable(name.at, name.name), index);
  }

  Scalar matched(const Node& node) {
    const auto v = scalar(node.kids[0]);
    const auto* text = std::get_if<std::string>(&v);
    if (!text)
      program_.refuse(node.at, fmt::format("'{}' is not a text to compare with a regular expression", text_of(v)));
    try {
      return matches(*text, program_.nodes[node.kids[1]].name) == (node.kind == Kind::matches);
    } catch (const std::invalid_argument& e) {
      program_.refuse(node.at, e.what());
    }
  }

  Scalar unary(const Node& node) {
    const auto v = scalar(node.kids[0]);
    if (node.kind == Kind::invert) {
      if (const auto* b = std::get_if<bool>(&v)) return !*b;
      program_.refuse(node.at, fmt::format("'{}' is neither true nor false", text_of(v)),
                      "'not' binds closer than '==': write not (a == b)");
    }
    if (const auto* i = std::get_if<std::int64_t>(&v)) {
      if (*i == std::numeric_limits<std::int64_t>::min()) program_.refuse(node.at, "the number is too large");
      return node.kind == Kind::negate ? -*i : *i;
    }
    if (const auto* d = std::get_if<double>(&v)) return node.kind == Kind::negate ? -*d : *d;
    program_.refuse(node.at, fmt::format("'{}' is not a number", text_of(v)));
  }

  static std::string joined(std::string a, const std::string& b) {
    if (a.size() + b.size() > most_output) throw std::invalid_argument("the text becomes longer than 1 MB");
    return a += b;
  }

  static Scalar arithmetic(Kind kind, const Scalar& a, const Scalar& b) {
    if (kind == Kind::add && (std::holds_alternative<std::string>(a) || std::holds_alternative<std::string>(b)))
      return joined(text_of(a), text_of(b));
    const auto *i = std::get_if<std::int64_t>(&a), *k = std::get_if<std::int64_t>(&b);
    if (i && k) return whole(kind, *i, *k);
    const double x = number_of(a), y = number_of(b);
    double out = 0;
    if ((kind == Kind::divide || kind == Kind::modulo) && y == 0) throw std::invalid_argument("division by zero");
    switch (kind) {
      case Kind::add:
        out = x + y;
        break;
      case Kind::subtract:
        out = x - y;
        break;
      case Kind::multiply:
        out = x * y;
        break;
      case Kind::divide:
        out = x / y;
        break;
      default:
        out = std::fmod(x, y);
        break;
    }
    if (!std::isfinite(out)) throw std::invalid_argument("the number is too large");
    return out;
  }

  static Scalar whole(Kind kind, std::int64_t a, std::int64_t b) {
    std::int64_t out = 0;
    bool over = false;
    switch (kind) {
      case Kind::add:
        over = __builtin_add_overflow(a, b, &out);
        break;
      case Kind::subtract:
        over = __builtin_sub_overflow(a, b, &out);
        break;
      case Kind::multiply:
        over = __builtin_mul_overflow(a, b, &out);
        break;
      default:
        if (b == 0) throw std::invalid_argument("division by zero");
        over = a == std::numeric_limits<std::int64_t>::min() && b == -1;
        if (!over) out = kind == Kind::divide ? a / b : a % b;
    }
    if (over) throw std::invalid_argument("the number is too large");
    return out;
  }

  /// Numbers with numbers, flags with flags, and anything with a text: as texts.
  static bool compared(Kind kind, const Scalar& a, const Scalar& b) {
    const auto ordered = [kind](const auto& x, const auto& y) {
      switch (kind) {
        case Kind::equal:
          return x == y;
        case Kind::unequal:
          return !(x == y);
        case Kind::less:
          return x < y;
        case Kind::greater:
          return y < x;
        case Kind::at_most:
          return !(y < x);
        default:
          return !(x < y);
      }
    };
    if (std::holds_alternative<std::string>(a) || std::holds_alternative<std::string>(b))
      return ordered(text_of(a), text_of(b));
    const auto *p = std::get_if<bool>(&a), *q = std::get_if<bool>(&b);
    if (p && q && (kind == Kind::equal || kind == Kind::unequal)) return ordered(*p, *q);
    if (p || q) throw std::invalid_argument(fmt::format("'{}' and '{}' cannot be compared", text_of(a), text_of(b)));
    return ordered(number_of(a), number_of(b));
  }

  Scalar called(const Node& node) {
    const auto& first = program_.nodes[node.kids[0]];
    if (node.name == "is_nil") {
      if (first.kind == Kind::variable) {
        const auto& values = variable(first.at, first.name).values;
        return !values.empty() && std::all_of(values.begin(), values.end(),
                                              [](const Scalar& v) { return std::holds_alternative<Nil>(v); });
      }
      return std::holds_alternative<Nil>(scalar(node.kids[0]));
    }
    if (node.name == "size" || node.name == "empty") {
      const auto size = static_cast<std::int64_t>(list_or_scalar(node.kids[0]).size());
      return node.name == "size" ? Scalar(size) : Scalar(size == 0);
    }
    if (node.name == "repeat") program_.refuse(node.at, "repeat gives a list", "write {local x = repeat(3, 0)}");
    std::vector<Argument> arguments;
    for (const Id kid : node.kids) {
      const auto& argument = program_.nodes[kid];
      if (argument.kind == Kind::regex)
        arguments.push_back({.values = {argument.name}, .regex = true});
      else if (argument.kind == Kind::list)
        arguments.push_back({.values = list_or_scalar(kid), .list = true});
      else
        arguments.push_back({.values = {scalar(kid)}});
    }
    try {
      return call(node.name, arguments, scope_.random);
    } catch (const std::invalid_argument& e) {
      program_.refuse(node.at, e.what());
    }
  }

  const Program& program_;
  const Variables& variables_;
  Scope& scope_;
  Variables locals_;
  std::size_t made_ = 0;  // bytes
};

}  // namespace

std::string Template::expand(const Variables& variables, Scope& scope) const {
  return Evaluation(*program_, variables, scope).text();
}

bool holds(std::string_view text, const Variables& variables, std::string_view where) {
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) return true;
  Id root = none;
  const auto program = condition(text, where, root);
  check_condition(*program, variables, root);
  Scope scope;
  return Evaluation(*program, variables, scope).truth(root);
}

}  // namespace weft::macro
