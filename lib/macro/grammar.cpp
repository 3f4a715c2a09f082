// SPDX-License-Identifier: GPL-3.0-or-later
// The grammar of expressions and statements: the only file that sees Boost.Spirit, which takes long to compile.
#include "core/number.h"
#include "macro/program.h"

#include <algorithm>
#include <functional>

#include <boost/spirit/home/x3.hpp>
#include <fmt/format.h>

namespace weft::macro {
namespace {
namespace x3 = boost::spirit::x3;

struct reader_tag;

/// What the parsers write to.
struct Reader {
  Program& program;
  const char* begin;
  int nesting = 0;

  std::uint32_t place(const char* p) const { return static_cast<std::uint32_t>(p - begin); }
  Id add(Node node) {
    for (const Id kid : node.kids) node.depth = std::max(node.depth, program.nodes[kid].depth + 1);
    if (node.depth > most_depth) program.refuse(node.at, "the expression is too long", "divide it with {local x = …}");
    program.nodes.push_back(std::move(node));
    return static_cast<Id>(program.nodes.size() - 1);
  }
};
Reader& reader(const auto& context) {
  return x3::get<reader_tag>(context).get();
}
/// Where the text begins that `raw` has found.
std::uint32_t place(const auto& context) {
  return reader(context).place(x3::_attr(context).begin());
}
std::uint32_t place_of(const auto& context, Id id) {
  return reader(context).program.nodes[id].at;
}
std::string text_at(const auto& context) {
  return {x3::_attr(context).begin(), x3::_attr(context).end()};
}

/// Counts how deep the parser calls itself.
template <class Subject>
struct Deeper : x3::unary_parser<Subject, Deeper<Subject>> {
  using x3::unary_parser<Subject, Deeper<Subject>>::unary_parser;
  template <class Iterator, class Context, class RContext, class Attribute>
  bool parse(Iterator& first, const Iterator& last, const Context& context, RContext& rcontext,
             Attribute& attribute) const {
    auto& r = reader(context);
    if (r.nesting >= most_nesting)
      r.program.refuse(r.place(first), "parentheses are nested too deeply", "divide it with {local x = …}");
    ++r.nesting;
    const bool found = this->subject.parse(first, last, context, rcontext, attribute);
    --r.nesting;
    return found;
  }
};
struct DeeperGenerator {
  template <class Subject>
  auto operator[](const Subject& subject) const {
    return Deeper<typename x3::extension::as_parser<Subject>::value_type>(x3::as_parser(subject));
  }
};
constexpr DeeperGenerator deeper{};

/// Whole unless it has a point or an exponent.
Scalar number_in(const Reader& r, const std::string& text, std::uint32_t at) {
  const auto parsed = [&](auto of_type) {
    const auto value = as_number<decltype(of_type)>(text);
    if (!value) r.program.refuse(at, fmt::format("'{}' is not a number that can be reckoned with", text));
    return *value;
  };
  return text.find_first_of(".eE") == std::string::npos ? Scalar(parsed(std::int64_t{})) : Scalar(parsed(double{}));
}

// Actions: what has been read becomes a node.
const auto same = [](auto& ctx) { x3::_val(ctx) = x3::_attr(ctx); };
const auto binary = [](Kind kind) {
  return [kind](auto& ctx) {
    x3::_val(ctx) =
        reader(ctx).add({.kind = kind, .at = place_of(ctx, x3::_val(ctx)), .kids = {x3::_val(ctx), x3::_attr(ctx)}});
  };
};
const auto unary = [](Kind kind) {
  return [kind](auto& ctx) {
    x3::_val(ctx) = reader(ctx).add({.kind = kind, .at = place_of(ctx, x3::_attr(ctx)), .kids = {x3::_attr(ctx)}});
  };
};
const auto choose = [](auto& ctx) {
  using boost::fusion::at_c;
  const Id yes = at_c<0>(x3::_attr(ctx)), no = at_c<1>(x3::_attr(ctx));
  x3::_val(ctx) =
      reader(ctx).add({.kind = Kind::choose, .at = place_of(ctx, x3::_val(ctx)), .kids = {x3::_val(ctx), yes, no}});
};
const auto number = [](auto& ctx) {
  x3::_val(ctx) = reader(ctx).add({.at = place(ctx), .value = number_in(reader(ctx), text_at(ctx), place(ctx))});
};
const auto flag = [](auto& ctx) {
  x3::_val(ctx) = reader(ctx).add({.at = place(ctx), .value = Scalar(text_at(ctx) == "true")});
};
const auto string = [](auto& ctx) {
  x3::_val(ctx) = reader(ctx).add({.at = place(ctx), .value = Scalar(text_at(ctx))});
};
const auto pattern = [](auto& ctx) {
  x3::_val(ctx) = reader(ctx).add({.kind = Kind::regex, .at = place(ctx), .name = text_at(ctx)});
};
const auto group = [](auto& ctx) {
  if (x3::_attr(ctx).size() == 1)
    x3::_val(ctx) = x3::_attr(ctx)[0];
  else
    x3::_val(ctx) =
        reader(ctx).add({.kind = Kind::list, .at = place_of(ctx, x3::_attr(ctx)[0]), .kids = x3::_attr(ctx)});
};
const auto variable_name = [](auto& ctx) {
  x3::_val(ctx) = reader(ctx).add({.kind = Kind::variable, .at = place(ctx), .name = text_at(ctx)});
};
const auto index_of = [](auto& ctx) {
  x3::_val(ctx) = reader(ctx).add({.kind = Kind::index,
                                   .at = reader(ctx).program.nodes[x3::_val(ctx)].at,
                                   .kids = {x3::_val(ctx), x3::_attr(ctx)}});
};
const auto call_begins = [](auto& ctx) { reader(ctx).program.nodes[x3::_val(ctx)].kind = Kind::call; };
const auto argument = [](auto& ctx) {
  auto& nodes = reader(ctx).program.nodes;
  auto& call = nodes[x3::_val(ctx)];
  call.kids.push_back(x3::_attr(ctx));
  call.depth = std::max(call.depth, nodes[x3::_attr(ctx)].depth + 1);
};

using x3::char_;
using x3::lexeme;
using x3::lit;
using x3::raw;

const auto blank = char_(" \t\r\n");
const auto name_char = char_("a-zA-Z0-9_");
const auto word = [](const char* text) { return lexeme[lit(text) >> !name_char]; };
const auto reserved = word("and") | word("or") | word("not") | word("if") | word("then") | word("elsif") |
                      word("else") | word("endif") | word("local") | word("global") | word("true") | word("false");
const auto name = lexeme[!reserved >> raw[char_("a-zA-Z_") >> *name_char]];
const auto digits = +char_("0-9.") >> -(char_("eE") >> -char_("+-") >> +char_("0-9"));
const auto quoted = lexeme['"' > raw[*(('\\' > char_) | ~char_("\"\\"))] > '"'];
const auto slashed = lexeme['/' > raw[+(('\\' > char_) | ~char_("/\\"))] > '/'];

#define WEFT_RULE(id) const x3::rule<struct id##_rule, Id> id = "a value"
WEFT_RULE(expression);
WEFT_RULE(either);
WEFT_RULE(both);
WEFT_RULE(equality);
WEFT_RULE(relation);
WEFT_RULE(sum);
WEFT_RULE(product);
WEFT_RULE(sign);
WEFT_RULE(factor);
WEFT_RULE(reference);
const x3::rule<struct regex_rule, Id> regex = "a /regular expression/";
WEFT_RULE(argument_value);
#undef WEFT_RULE
const x3::rule<struct values_rule, std::vector<Id>> values = "a value";

const auto expression_def = deeper[either[same] >> -(('?' > expression > ':' > expression)[choose])];
const auto either_def = both[same] >> *(((lit("||") | word("or")) > both)[binary(Kind::either)]);
const auto both_def = equality[same] >> *(((lit("&&") | word("and")) > equality)[binary(Kind::both)]);
const auto equality_def = relation[same] >>
                          *((lit("==") > relation)[binary(Kind::equal)] |
                            ((lit("!=") | "<>") > relation)[binary(Kind::unequal)] |
                            (lit("=~") > regex)[binary(Kind::matches)] | (lit("!~") > regex)[binary(Kind::differs)]);
const auto relation_def = sum[same] >>
                          *((lit("<=") > sum)[binary(Kind::at_most)] | (lit(">=") > sum)[binary(Kind::at_least)] |
                            ((lit('<') >> !lit('>')) > sum)[binary(Kind::less)] |
                            (lit('>') > sum)[binary(Kind::greater)]);
const auto sum_def = product[same] >> *(('+' > product)[binary(Kind::add)] | ('-' > product)[binary(Kind::subtract)]);
const auto product_def = sign[same] >> *(('*' > sign)[binary(Kind::multiply)] | ('/' > sign)[binary(Kind::divide)] |
                                         ('%' > sign)[binary(Kind::modulo)]);
const auto sign_def = deeper[('-' > sign)[unary(Kind::negate)] | ('+' > sign)[unary(Kind::identity)] |
                             (((lit('!') >> !char_("=~")) | word("not")) > sign)[unary(Kind::invert)] | factor[same]];
const auto factor_def = (&char_("0-9.") >> lexeme[raw[digits][number] >> !name_char]) | quoted[string] |
                        lexeme[raw[lit("true") | "false"][flag] >> !name_char] | ('(' > values > ')')[group] |
                        reference[same];
const auto reference_def = name[variable_name] >> -((lit('(')[call_begins] > -(argument_value[argument] % ',') > ')') |
                                                    ('[' > expression > ']')[index_of]);
const auto regex_def = slashed[pattern];
const auto values_def = expression % ',';
const auto argument_value_def = slashed[pattern] | ('~' > expression)[same] | expression[same];

BOOST_SPIRIT_DEFINE(expression, either, both, equality, relation, sum, product, sign, factor, reference, regex, values,
                    argument_value)

// Statements: each action fills the one that is being read.
struct statement_tag;
Statement& statement_of(const auto& ctx) {
  return x3::get<statement_tag>(ctx).get();
}
const auto is = [](Op op) { return [op](auto& ctx) { statement_of(ctx).op = op; }; };
const auto named = [](auto& ctx) { statement_of(ctx).text = text_at(ctx); };
const auto with_index = [](auto& ctx) { statement_of(ctx).index = x3::_attr(ctx); };
const auto with_value = [](auto& ctx) { statement_of(ctx).expression = x3::_attr(ctx); };
const auto with_then = [](auto& ctx) { statement_of(ctx).in_code = true; };

/// What an assignment that turned out to be none has left is wiped.
const auto is_print = [](auto& ctx) { statement_of(ctx) = {.op = Op::print}; };

const x3::rule<struct given_rule> given = "a value";
const auto given_def = expression[with_value];
const x3::rule<struct chosen_rule> chosen = "a name";
const auto chosen_def = name[named];
BOOST_SPIRIT_DEFINE(given, chosen)

const auto value = '=' > given;
const auto then = -(word("then")[with_then]);
const auto target = name[named] >> -('[' >> expression[with_index] >> ']') >> '=' >> !char_("=~");
const auto declaration = word("local")[is(Op::local)] | word("global")[is(Op::global)];
const x3::rule<struct statement_rule> statement = "a statement";
const auto statement_def = (word("if")[is(Op::begin_if)] > given > then) |
                           (word("elsif")[is(Op::else_if)] > given > then) | word("else")[is(Op::otherwise)] |
                           word("endif")[is(Op::end_if)] | (declaration > chosen > value) |
                           ((target >> x3::eps[is(Op::assign)]) > given) | (x3::eps[is_print] > given);
BOOST_SPIRIT_DEFINE(statement)

/// Runs a parser at `at`, which moves behind what was read; what is missing becomes an error with its place.
template <class Parser>
void run(Program& program, std::size_t& at, Parser&& parser_of) {
  const char* const begin = program.text.data();
  const char *first = begin + at, *const last = begin + program.text.size();
  Reader reader{program, begin};
  try {
    if (!parser_of(reader, first, last)) program.refuse(static_cast<std::uint32_t>(at), "a value is missing here");
  } catch (const x3::expectation_failure<const char*>& e) {
    const char* p = e.where();
    while (p != last && static_cast<unsigned char>(*p) <= ' ') ++p;
    const auto rest = std::string_view(p, static_cast<std::size_t>(last - p)).substr(0, 12);
    const auto shown = rest.substr(0, rest.find_first_of("\r\n"));
    program.refuse(reader.place(p), fmt::format("expected {}, found {}", e.which(),
                                                shown.empty() ? "the end of the line" : fmt::format("'{}'", shown)));
  }
  at = static_cast<std::size_t>(first - begin);
}

}  // namespace

Statement parse_statement(Program& program, std::size_t& at) {
  Statement out;
  run(program, at, [&](Reader& r, const char*& first, const char* last) {
    return x3::phrase_parse(first, last,
                            x3::with<reader_tag>(std::ref(r))[x3::with<statement_tag>(std::ref(out))[statement]], blank,
                            x3::skip_flag::dont_post_skip);
  });
  return out;
}

Id parse_expression(Program& program, std::size_t& at) {
  Id out = none;
  run(program, at, [&](Reader& r, const char*& first, const char* last) {
    return x3::phrase_parse(first, last, x3::with<reader_tag>(std::ref(r))[x3::eps > expression], blank, out,
                            x3::skip_flag::dont_post_skip);
  });
  return out;
}

}  // namespace weft::macro
