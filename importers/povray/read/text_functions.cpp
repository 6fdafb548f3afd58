// SPDX-License-Identifier: Apache-2.0
// Values of any kind, and texts.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "importers/povray/read/function.h"
#include "importers/povray/read/number_words.h"
#include "importers/povray/read/numbers_text.h"
#include "importers/povray/read/reader.h"
#include "importers/povray/read/spline.h"
#include "importers/povray/read/whole.h"

namespace vitrail::pov {

Value* Reader::variable_of(const Token& name) {
  Value* value = name.symbol->value();
  if (!value || std::holds_alternative<std::monostate>(*value)) unexpected(name, "a value");
  return value;
}

Value Reader::postfixed(const Token& name) {
  Value* value = variable_of(name);
  if (auto* array = std::get_if<std::shared_ptr<Array>>(value)) {
    std::shared_ptr<Array> held = *array;
    while (at('[')) {
      std::size_t index = 0;
      for (const std::size_t size : held->sizes) {
        if (!accept('['))
          fail(fmt::format("'{}' has {} dimensions", name.symbol->name, held->sizes.size()), last_);
        const int i = integer("an index");
        expect(']', "behind an index");
        if (i < 0 || static_cast<std::size_t>(i) >= size)
          fail(fmt::format("index {} is not below {}, the size of '{}'", i, size, name.symbol->name), last_);
        index = index * size + static_cast<std::size_t>(i);
      }
      const Value& element = held->elements.at(index);
      if (std::holds_alternative<std::monostate>(element))
        fail(fmt::format("this element of '{}' has no value", name.symbol->name), name.place);
      const auto* const inner = std::get_if<std::shared_ptr<Array>>(&element);
      if (!inner) {
        const Value copy = element;
        return call(copy, name);
      }
      held = std::shared_ptr<Array>(*inner);
    }
    return held;
  }
  if (std::holds_alternative<Numbers>(*value)) return *value;
  const Value copy = *value;
  return call(copy, name);
}

// f(x, …) and spline(t); other values as they are.
Value Reader::call(const Value& callee, const Token& name) {
  const auto* const function = std::get_if<Shared<Function>>(&callee);
  const auto* const spline = std::get_if<std::shared_ptr<Spline>>(&callee);
  if ((!function && !spline) || !at('(')) return callee;
  next();
  if (spline) {
    const double at = argument(true);
    std::optional<Spline::Kind> kind;
    if (accept(',')) kind = spline_kind(next().symbol->word);
    expect(')', "behind the arguments of a spline");
    return (*spline)->at(at, kind);
  }
  std::vector<double> arguments;
  while (!accept(')')) {
    if (!arguments.empty()) comma();
    const Numbers given = vector_argument(true);
    // A vector stands for as many numbers.
    for (int i = 0; i < given.terms; ++i) arguments.push_back(given.v[static_cast<std::size_t>(i)]);
  }
  return call_function(*this, **function, arguments, name);
}

Value Reader::evaluate() {
  const Token token = next();
  if (token.kind == TokenKind::text) return *token.text;
  if (token.kind == TokenKind::word) {
    const Word word = token.symbol->word;
    if (names_text(word)) return *text_function(word);
    if (word == Word::none) {
      Value value = postfixed(token);
      const auto* const held = std::get_if<Numbers>(&value);
      if (!held) return value;
      first_ = *held;
      return numbers();
    }
  }
  put_back(token);
  return numbers();
}

std::string Reader::text(const char* what) {
  const Token token = next();
  if (token.kind == TokenKind::text) return *token.text;
  if (token.kind == TokenKind::word) {
    const Word word = token.symbol->word;
    if (names_text(word)) return *text_function(word);
    if (word == Word::none) {
      const Value value = postfixed(token);
      if (const auto* held = std::get_if<std::string>(&value)) return *held;
      fail(fmt::format("{} is expected, and '{}' is {}", what, token.symbol->name, kind_of(value)),
           token.place);
    }
  }
  unexpected(token, what);
}

std::optional<std::string> Reader::text_function(Word word) {
  constexpr std::size_t longest = 1 << 24;
  const Place place = last_;
  expect('(', "behind the name of a function");
  std::string result;
  switch (word) {
    case Word::chr_:
      result = std::string(1, static_cast<char>(integer("a character's code")));
      break;
    case Word::concat_:
      do {
        result += text("a text");
        if (result.size() > longest) fail("a text is too long", place);
      } while (accept(','));
      break;
    case Word::datetime_:  // no picture depends on the day
      argument(true);
      if (accept(',')) text("a format");
      break;
    case Word::str_: {
      const double value = argument(true);
      const double width = argument(), digits = argument();
      result = formatted(value, whole(width, -1000000, 1000000), whole(digits, -1000000, 1000000));
      break;
    }
    case Word::strlwr_:
    case Word::strupr_:
      result = text("a text");
      std::transform(result.begin(), result.end(), result.begin(), [&](unsigned char c) {
        return static_cast<char>(word == Word::strlwr_ ? std::tolower(c) : std::toupper(c));
      });
      break;
    case Word::substr_: {
      const std::string whole = text("a text");
      const double from = argument(), count = argument();
      if (!(from >= 1 && count >= 0 && from + count - 1 <= static_cast<double>(whole.size())))
        fail("substr() asks for characters that the text has not", place);
      result = whole.substr(static_cast<std::size_t>(from) - 1, static_cast<std::size_t>(count));
      break;
    }
    case Word::vstr_: {
      const int terms = whole(argument(true), 1, 5);
      const Numbers value = vector_argument().promoted(terms);
      expect(',', "between arguments");
      const std::string between = text("a text");
      const double width = argument(), digits = argument();
      for (int i = 0; i < terms; ++i)
        result +=
            (i ? between : "") + formatted(value.v[static_cast<std::size_t>(i)],
                                           whole(width, -1000000, 1000000), whole(digits, -1000000, 1000000));
      break;
    }
    default:
      break;
  }
  expect(')', "behind the arguments of a function");
  return result;
}

}  // namespace vitrail::pov
