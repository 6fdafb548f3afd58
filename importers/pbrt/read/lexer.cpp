// SPDX-License-Identifier: Apache-2.0
#include "importers/pbrt/read/lexer.h"

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "importers/bytes/input_bytes.h"

namespace vitrail::pbrt {

namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f'; }

bool ends_word(char c) { return is_blank(c) || c == '"' || c == '[' || c == ']' || c == '#'; }

// The line of a place, at most `width` characters around the column.
std::string excerpt(const Place& place) {
  constexpr std::ptrdiff_t width = 100;
  try {
    const InputBytes bytes(*place.file);
    const char* line = bytes.begin();
    for (int n = 1; n < place.line && line != bytes.end(); ++line)
      if (*line == '\n' || (*line == '\r' && (line + 1 == bytes.end() || line[1] != '\n'))) ++n;
    const char* stop = std::find_if(line, bytes.end(), [](char c) { return c == '\n' || c == '\r'; });
    const std::ptrdiff_t length = stop - line, at = std::min<std::ptrdiff_t>(place.column - 1, length);
    return {line + std::max<std::ptrdiff_t>(0, at - width / 2), line + std::min(length, at + width / 2)};
  } catch (const Error&) {
    return {};  // the file has gone meanwhile: the message goes without its excerpt
  }
}

}  // namespace

SourceLocation location(const Place& place) {
  return {place.file ? *place.file : std::string{}, place.line, place.column};
}

void fail(const std::string& message, const Place& place) {
  throw Error(message, location(place), place.file && place.line > 0 ? excerpt(place) : std::string{});
}

std::string describe(const Token& token) {
  constexpr std::size_t limit = 40;
  std::string shown(token.text.substr(0, limit));
  if (token.text.size() > limit) shown += "…";
  switch (token.kind) {
    case TokenKind::open:
      return "'['";
    case TokenKind::close:
      return "']'";
    case TokenKind::word:
      return fmt::format("'{}'", shown);
    case TokenKind::text:
      return fmt::format("\"{}\"", shown);
    default:
      return "the end of the file";
  }
}

Lexer::Lexer(const std::string* file, const char* begin, const char* end)
    : file_(file), at_(begin), end_(end), line_begin_(begin) {
  if (std::string_view(begin, static_cast<std::size_t>(end - begin)).starts_with("\xEF\xBB\xBF"))
    line_begin_ = at_ += 3;
}

void Lexer::skip_blanks() {
  for (; at_ != end_; ++at_) {
    const char c = *at_;
    if (c == '\n' || (c == '\r' && (at_ + 1 == end_ || at_[1] != '\n')))
      new_line();
    else if (c == '#')
      at_ = std::find_if(at_, end_, [](char d) { return d == '\n' || d == '\r'; }) - 1;
    else if (!is_blank(c))
      return;
  }
}

char Lexer::peek() {
  skip_blanks();
  return at_ == end_ ? '\0' : *at_;
}

Token Lexer::next() {
  skip_blanks();
  Token token{TokenKind::end, {}, place()};
  if (at_ == end_) return token;
  if (*at_ == '"') return quoted();
  const char* begin = at_;
  if (*at_ == '[' || *at_ == ']') {
    token.kind = *at_++ == '[' ? TokenKind::open : TokenKind::close;
  } else {
    token.kind = TokenKind::word;
    at_ = std::find_if(at_, end_, ends_word);
  }
  token.text = {begin, static_cast<std::size_t>(at_ - begin)};
  return token;
}

Token Lexer::quoted() {
  const Place start = place();
  const char* begin = ++at_;
  at_ = std::find_if(at_, end_, [](char c) { return c == '"' || c == '\\' || c == '\n' || c == '\r'; });
  Token token{TokenKind::text, {begin, static_cast<std::size_t>(at_ - begin)}, start};
  if (at_ != end_ && *at_ == '\\') {
    constexpr std::string_view letters = "bfnrt\\'\"", meanings = "\b\f\n\r\t\\'\"";
    unescaped_.assign(begin, at_);
    for (; at_ != end_ && *at_ != '"' && *at_ != '\n' && *at_ != '\r'; ++at_) {
      if (*at_ != '\\') {
        unescaped_ += *at_;
        continue;
      }
      // Before another character it stands for itself: paths of Windows.
      const auto letter = at_ + 1 == end_ ? std::string_view::npos : letters.find(at_[1]);
      if (letter != std::string_view::npos) ++at_;
      unescaped_ += letter == std::string_view::npos ? '\\' : meanings[letter];
    }
    token.text = unescaped_;
  }
  if (at_ == end_ || *at_ != '"') fail("a string has no closing quote on its line", start);
  ++at_;
  return token;
}

bool Lexer::next_number(double& value) {
  const char c = peek();
  if (!((c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.')) {
    const bool word = c != '\0' && !ends_word(c);
    if (word && fast_float::from_chars(at_, end_, value).ec == std::errc{})
      fail("a number is not finite", place());
    return false;
  }
  const char* begin = at_ + (c == '+' ? 1 : 0);
  const auto parsed = fast_float::from_chars(begin, end_, value);
  const bool complete = parsed.ptr != begin && (parsed.ptr == end_ || ends_word(*parsed.ptr));
  if (!complete || (c == '+' && *begin == '-')) {
    const Place here = place();
    fail(fmt::format("malformed number {}", describe(next())), here);
  }
  if (!std::isfinite(value)) fail("a number is not finite", place());
  at_ = parsed.ptr;
  return true;
}

void Lexer::skip_list() {
  for (peek(); at_ != end_; peek()) {
    at_ = std::find_if(at_, end_, [](char c) { return c == ']' || c == '#'; });
    if (at_ == end_ || *at_++ == ']') return;
    at_ = std::find_if(at_, end_, [](char c) { return c == '\n' || c == '\r'; });
  }
}

}  // namespace vitrail::pbrt
