// SPDX-License-Identifier: Apache-2.0
// Expressions of numbers, vectors and colours.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "importers/povray/read/function.h"
#include "importers/povray/read/reader.h"
#include "importers/povray/read/spline.h"
#include "importers/povray/read/truth.h"
#include "scene/spectra/color.h"

namespace vitrail::pov {

namespace {

// The two of as many terms; a colour stays one.
void match(Numbers& a, Numbers& b) {
  const int terms = std::max(a.terms, b.terms);
  const bool color = a.is_color || b.is_color;
  if (a.terms != terms) a = a.promoted(terms);
  if (b.terms != terms) b = b.promoted(terms);
  a.is_color = b.is_color = color;
}

template <class Operation>
Numbers combined(Numbers a, Numbers b, Operation&& operation) {
  match(a, b);
  for (std::size_t i = 0; i < static_cast<std::size_t>(a.terms); ++i) a.v[i] = operation(a.v[i], b.v[i]);
  return a;
}

// The sign of an operator that goes on behind an operand; 0: the expression ends there.
bool is_operator(const Token& token, const char* signs) {
  return token.kind == TokenKind::sign && std::string_view(signs).find(token.sign) != std::string_view::npos;
}

}  // namespace

Token Reader::peek_operator() {
  const bool declaring = declaring_;
  declaring_ = false;
  const Token token = next();
  declaring_ = declaring;
  put_back(token);
  return token;
}

Numbers Reader::numbers() {
  const bool comparing = comparing_;
  comparing_ = false;
  const Numbers result = conditional();
  comparing_ = comparing;
  return result;
}

Numbers Reader::conditional() {
  Numbers value = disjunction();
  if (!is_operator(peek_operator(), "?")) return value;
  next();
  const Numbers yes = conditional();
  expect(':', "between the values of a condition");
  const Numbers no = conditional();
  return is_true(value.v[0]) ? yes : no;
}

Numbers Reader::disjunction() {
  Numbers value = conjunction();
  while (is_operator(peek_operator(), "|")) {
    next();
    value = combined(value, conjunction(),
                     [](double a, double b) { return is_true(a) || is_true(b) ? 1.0 : 0.0; });
  }
  return value;
}

Numbers Reader::conjunction() {
  Numbers value = relation();
  while (is_operator(peek_operator(), "&")) {
    next();
    value =
        combined(value, relation(), [](double a, double b) { return is_true(a) && is_true(b) ? 1.0 : 0.0; });
  }
  return value;
}

// Texts are compared by their bytes.
std::optional<Numbers> Reader::relation_of_texts() {
  const Token first = peek();
  const Value* held = first.kind == TokenKind::word ? first.symbol->value() : nullptr;
  const bool is_text = first.kind == TokenKind::text || (held && std::holds_alternative<std::string>(*held));
  if (!is_text) return std::nullopt;
  const std::string a = text("a text");
  const Token sign = next();
  if (!is_operator(sign, "<>=lgn")) unexpected(sign, "a comparison of texts");
  const int order = a.compare(text("a text"));
  const bool holds = sign.is('<')   ? order < 0
                     : sign.is('>') ? order > 0
                     : sign.is('l') ? order <= 0
                     : sign.is('g') ? order >= 0
                     : sign.is('n') ? order != 0
                                    : order == 0;
  return Numbers(holds ? 1.0 : 0.0);
}

Numbers Reader::relation() {
  if (comparing_ && !first_)
    if (const auto texts = relation_of_texts()) return *texts;
  Numbers value = sum();
  if (!comparing_) return value;
  for (Token token = peek_operator(); is_operator(token, "<>=lgn"); token = peek_operator()) {
    next();
    const Numbers other = sum();
    value = combined(value, other, [&](double a, double b) {
      const bool equal = are_equal(a, b);
      switch (token.sign) {
        case '<':
          return double(a < b);
        case '>':
          return double(a > b);
        case 'l':
          return double(a < b || equal);
        case 'g':
          return double(a > b || equal);
        case 'n':
          return double(!equal);
        default:
          return double(equal);
      }
    });
  }
  return value;
}

Numbers Reader::sum() {
  Numbers value = product();
  for (Token token = peek_operator(); is_operator(token, "+-"); token = peek_operator()) {
    next();
    const Numbers other = product();
    value = token.sign == '+' ? combined(value, other, [](double a, double b) { return a + b; })
                              : combined(value, other, [](double a, double b) { return a - b; });
  }
  return value;
}

Numbers Reader::product() {
  Numbers value = unary();
  for (Token token = peek_operator(); is_operator(token, "*/"); token = peek_operator()) {
    next();
    const Numbers other = unary();
    if (token.sign == '/') {
      for (std::size_t i = 0; i < static_cast<std::size_t>(other.terms); ++i)
        if (other.v[i] == 0 && other.terms == 1) fail("a number is divided by 0", token.place);
      value = combined(value, other, [](double a, double b) { return b == 0 ? 0 : a / b; });
    } else {
      value = combined(value, other, [](double a, double b) { return a * b; });
    }
  }
  return value;
}

Numbers Reader::unary() {
  if (first_) return primary();
  const Token token = next();
  if (token.is('-')) {
    Numbers value = unary();
    for (double& v : value.v) v = -v;
    return value;
  }
  if (token.is('+')) return unary();
  if (token.is('!')) {
    Numbers value = unary();
    for (double& v : value.v) v = is_true(v) ? 0 : 1;
    return value;
  }
  put_back(token);
  return primary();
}

Numbers Reader::primary() {
  if (first_) {
    const Numbers value = *first_;
    first_.reset();
    return with_component(value);
  }
  const Token token = next();
  if (token.kind == TokenKind::number) return Numbers(token.number);
  const Deeper deeper(*this, token.place);
  if (token.is('<')) return with_component(bracketed_vector());
  if (token.is('(')) {
    const bool comparing = comparing_;
    comparing_ = true;
    const Numbers value = conditional();
    comparing_ = comparing;
    expect(')', "behind an expression in brackets");
    return with_component(value);
  }
  if (token.kind != TokenKind::word) unexpected(token, "a number");
  const Word word = token.symbol->word;
  if (word == Word::none) {
    const Value value = postfixed(token);
    const auto* held = std::get_if<Numbers>(&value);
    if (!held) fail(fmt::format("'{}' is {}, not a number", token.symbol->name, kind_of(value)), token.place);
    return with_component(*held);
  }
  if (word == Word::color_ || word == Word::colour_) return with_component(color());
  if (word >= Word::rgb_ && word <= Word::rgbt_) return color_of_terms(word);
  if (word >= Word::srgb_ && word <= Word::srgbt_) return color_of_terms(word);
  if (const auto constant = constant_of(word)) return with_component(*constant);
  if (const auto result = function_of(token)) return with_component(*result);
  if (const auto result = query_of(token)) return with_component(*result);
  unexpected(token, "a number");
}

Numbers Reader::with_component(Numbers n) {
  const Token dot = peek_operator();
  if (!dot.is('.')) return n;
  next();
  const Token name = next();
  if (name.kind != TokenKind::word) unexpected(name, "a component");
  n = n.terms == 1 ? n.promoted(5) : n;
  switch (name.symbol->word) {
    case Word::x_:
    case Word::u_:
    case Word::red_:
      return Numbers(n.v[0]);
    case Word::y_:
    case Word::v_:
    case Word::green_:
      return Numbers(n.v[1]);
    case Word::z_:
    case Word::blue_:
      return Numbers(n.v[2]);
    case Word::t_:
    case Word::filter_:
      return Numbers(n.v[3]);
    case Word::transmit_:
      return Numbers(n.v[4]);
    case Word::gray_:
      return Numbers(0.297 * n.v[0] + 0.589 * n.v[1] + 0.114 * n.v[2]);
    default:
      unexpected(name, "a component of a vector or colour");
  }
}

Numbers Reader::bracketed_vector() {
  const bool comparing = comparing_;
  comparing_ = false;
  Numbers value;
  value.terms = 0;
  do {
    if (value.terms == 5) fail("a vector has at most five components", last_);
    const Numbers component = conditional();
    value.v[static_cast<std::size_t>(value.terms++)] = component.v[0];
    comma();
  } while (!accept('>'));
  comparing_ = comparing;
  return value;
}

Numbers Reader::color_of_terms(Word word) {
  Numbers given = sum();
  const bool encoded = word >= Word::srgb_ && word <= Word::srgbt_;
  const bool filter =
      word == Word::rgbf_ || word == Word::rgbft_ || word == Word::srgbf_ || word == Word::srgbft_;
  const bool transmit =
      word == Word::rgbt_ || word == Word::rgbft_ || word == Word::srgbt_ || word == Word::srgbft_;
  const int wanted = 3 + filter + transmit;
  if (!given.is_color) {
    given = given.promoted(given.terms == 1 ? wanted : std::max(given.terms, wanted));
    if (transmit && !filter) given.v[4] = given.v[3], given.v[3] = 0;
    if (!filter && !transmit && given.terms == 3) given.v[3] = given.v[4] = 0;
  }
  // A scene whose numbers are the screen's takes these as they are.
  if (const auto exponent = gamma(); encoded && exponent)
    for (std::size_t i = 0; i < 3; ++i) {
      const double light = srgb_decode(given.v[i]);  // above 1 by the same curve
      given.v[i] = std::copysign(std::pow(std::abs(light), 1 / *exponent), light);
    }
  given.terms = 5, given.is_color = true;
  return given;
}

Numbers Reader::color() {
  Numbers result;
  result.terms = 5, result.is_color = true;
  for (bool any = false;;) {
    const Token token = any ? peek_operator() : peek();
    if (token.kind == TokenKind::word) {
      const Word word = token.symbol->word;
      if (!any && (word == Word::color_ || word == Word::colour_)) {
        next();
        continue;
      }
      std::optional<std::size_t> component;
      if (word == Word::red_) component = 0;
      if (word == Word::green_) component = 1;
      if (word == Word::blue_) component = 2;
      if (word == Word::filter_ || word == Word::alpha_) component = 3;
      if (word == Word::transmit_) component = 4;
      if (component) {
        next();
        result.v[*component] = number("a component of a colour");
        any = true;
        continue;
      }
    }
    if (any || !number_follows()) {
      if (!any) unexpected(next(), "a colour");
      return result;
    }
    Numbers value = sum();
    if (value.terms == 1) value = value.promoted(3);
    if (!value.is_color)
      for (auto i = static_cast<std::size_t>(value.terms); i < 5; ++i) value.v[i] = 0;
    value.terms = 5, value.is_color = true;
    result = value;
    any = true;
  }
}

bool Reader::number_follows() {
  const Token token = peek();
  switch (token.kind) {
    case TokenKind::number:
      return true;
    case TokenKind::sign:
      return is_operator(token, "<(+-!");
    case TokenKind::word: {
      const Word word = token.symbol->word;
      if (word == Word::none) {
        const Value* value = token.symbol->value();
        if (!value) return false;
        if (const auto* array = std::get_if<std::shared_ptr<Array>>(value)) {
          const auto& all = (*array)->elements;
          return std::any_of(all.begin(), all.end(),
                             [](const Value& v) { return std::holds_alternative<Numbers>(v); }) ||
                 std::any_of(all.begin(), all.end(), [](const Value& v) {
                   return std::holds_alternative<std::shared_ptr<Array>>(v);
                 });
        }
        return std::holds_alternative<Numbers>(*value) || std::holds_alternative<Shared<Function>>(*value) ||
               std::holds_alternative<std::shared_ptr<Spline>>(*value);
      }
      return word == Word::color_ || word == Word::colour_ || (word >= Word::rgb_ && word <= Word::rgbt_) ||
             (word >= Word::srgb_ && word <= Word::srgbt_) || names_number(word);
    }
    default:
      return false;
  }
}

// ---- What callers ask for

double Reader::number(const char* what) {
  const Token token = peek();
  const Numbers value = numbers();
  if (!std::isfinite(value.v[0])) fail(fmt::format("{} is not finite", what), token.place);
  return value.v[0];
}

int Reader::integer(const char* what) {
  const double value = number(what);
  if (std::abs(value) > 1e9) fail(fmt::format("{} is {}, which is too much", what, value), last_);
  return static_cast<int>(value);
}

bool Reader::flag() { return !number_follows() || numbers().v[0] != 0; }

Vector3d Reader::vector(const char* what) {
  const Token token = peek();
  const Numbers value = numbers().promoted(3);
  if (!std::isfinite(value.v[0]) || !std::isfinite(value.v[1]) || !std::isfinite(value.v[2]))
    fail(fmt::format("{} is not finite", what), token.place);
  return {value.v[0], value.v[1], value.v[2]};
}

Point3d Reader::point(const char* what) { return Point3d{} + vector(what); }

Point2d Reader::point2(const char* what) {
  const Vector3d value = vector(what);
  return {value.x, value.y};
}

}  // namespace vitrail::pov
