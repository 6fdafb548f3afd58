// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/read/lexer.h"

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <cmath>

#include "importers/bytes/plain_decimal.h"

namespace vitrail::pov {

namespace {

bool starts_word(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool in_word(char c) { return starts_word(c) || is_digit(c); }

// UTF-8 of a code point of the basic plane.
void append_utf8(std::string& text, unsigned code) {
  if (code < 0x80) {
    text += static_cast<char>(code);
  } else if (code < 0x800) {
    text += static_cast<char>(0xC0 | code >> 6);
    text += static_cast<char>(0x80 | (code & 0x3F));
  } else {
    text += static_cast<char>(0xE0 | code >> 12);
    text += static_cast<char>(0x80 | (code >> 6 & 0x3F));
    text += static_cast<char>(0x80 | (code & 0x3F));
  }
}

}  // namespace

Lexer::Lexer(Symbols& symbols, std::deque<std::string>& texts, const char* begin, const char* end,
             std::uint16_t file)
    : symbols_(symbols), texts_(texts), at_(begin), end_(end), line_begin_(begin), file_(file) {
  if (std::string_view(begin, static_cast<std::size_t>(end - begin)).starts_with("\xEF\xBB\xBF"))
    line_begin_ = at_ += 3;
}

Place Lexer::place() const {
  const std::ptrdiff_t column = at_ - line_begin_ + 1;
  return {line_, file_, static_cast<std::uint16_t>(std::min<std::ptrdiff_t>(column, 65535))};
}

void Lexer::skip_blanks() {
  while (at_ != end_) {
    const char c = *at_;
    if (c == '\n') {
      ++line_, line_begin_ = ++at_;
    } else if (c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f' || c == '\x1A') {
      ++at_;
    } else if (c == '/' && at_ + 1 != end_ && at_[1] == '/') {
      while (at_ != end_ && *at_ != '\n') ++at_;
    } else if (c == '/' && at_ + 1 != end_ && at_[1] == '*') {
      const Place start = place();
      int depth = 0;
      do {
        if (end_ - at_ < 2) throw LexicalError("a comment is not closed by */", start);
        const bool open = at_[0] == '/' && at_[1] == '*', close = at_[0] == '*' && at_[1] == '/';
        depth += open ? 1 : close ? -1 : 0;
        if (*at_ == '\n') ++line_, line_begin_ = at_ + 1;
        at_ += open || close ? 2 : 1;
      } while (depth > 0);
    } else if (*at_ == '#') {  // one without a directive means nothing
      const char* const behind = behind_sign(at_);
      if (behind != end_ && starts_word(*behind)) return;
      at_ = behind;
    } else {
      return;
    }
  }
}

// Where the word of a directive begins.
const char* Lexer::behind_sign(const char* sign) const {
  do {
    ++sign;
  } while (sign != end_ && (*sign == ' ' || *sign == '\t'));
  return sign;
}

Token Lexer::next() {
  skip_blanks();
  Token token;
  token.place = place();
  if (at_ == end_) return token;
  const char c = *at_;
  const char after = at_ + 1 != end_ ? at_[1] : '\0';
  if (is_digit(c) || (c == '.' && is_digit(after))) return number(token);
  if (starts_word(c)) return word(token, TokenKind::word);
  if (c == '"') return text(token);
  if (c == '#') {
    at_ = behind_sign(at_);
    return word(token, TokenKind::directive);
  }
  token.kind = TokenKind::sign;
  token.sign = c;
  ++at_;
  if (after == '=' && (c == '<' || c == '>' || c == '!'))
    ++at_, token.sign = c == '<' ? 'l' : c == '>' ? 'g' : 'n';
  constexpr std::string_view signs = "{}()[]<>,;=+-*/!&|?:.@$%^~`'";
  if (signs.find(c) == std::string_view::npos)
    throw LexicalError(
        fmt::format("a character of code {} does not belong here", static_cast<unsigned char>(c)),
        token.place);
  return token;
}

Token Lexer::number(Token token) {
  token.kind = TokenKind::number;
  const char* stop = plain_decimal(at_, end_, token.number);
  if (!stop || stop == at_) {
    const auto parsed = fast_float::from_chars(at_, end_, token.number);
    if (parsed.ec != std::errc{} || !std::isfinite(token.number))
      throw LexicalError("a number is not finite", token.place);
    stop = parsed.ptr;
  }
  at_ = stop;
  return token;
}

Token Lexer::word(Token token, TokenKind kind) {
  const char* const begin = at_;
  while (at_ != end_ && in_word(*at_)) ++at_;
  token.kind = kind;
  token.symbol = symbols_.find({begin, static_cast<std::size_t>(at_ - begin)});
  return token;
}

Token Lexer::text(Token token) {
  std::string result;
  for (++at_; at_ != end_ && *at_ != '"'; ++at_) {
    if (*at_ == '\n') ++line_, line_begin_ = at_ + 1;
    if (*at_ != '\\' || at_ + 1 == end_) {
      result += *at_;
      continue;
    }
    constexpr std::string_view letters = "abfnrtv0\\'\"", meanings("\a\b\f\n\r\t\v\0\\'\"", 11);
    const char escape = *++at_;
    unsigned code = 0;
    if (escape == 'u' && end_ - at_ > 4) {
      const std::string digits(at_ + 1, at_ + 5);
      if (digits.find_first_not_of("0123456789abcdefABCDEF") != std::string::npos)
        throw LexicalError("\\u is not followed by four hexadecimal digits", place());
      code = static_cast<unsigned>(std::stoul(digits, nullptr, 16));
      append_utf8(result, code);
      at_ += 4;
    } else if (const auto letter = letters.find(escape); letter != std::string_view::npos) {
      result += meanings[letter];
    } else {
      (result += '\\') += escape;  // names of files with backslashes
    }
  }
  if (at_ == end_) throw LexicalError("a string has no closing quote", token.place);
  ++at_;
  token.kind = TokenKind::text;
  token.text = &texts_.emplace_back(std::move(result));
  return token;
}

bool Lexer::skip_to_directive() {
  for (skip_blanks(); at_ != end_; skip_blanks()) {
    if (*at_ == '#') return true;
    if (*at_ == '"') {
      for (++at_; at_ != end_ && *at_ != '"'; ++at_) {
        if (*at_ == '\\' && at_ + 1 != end_) ++at_;
        if (*at_ == '\n') ++line_, line_begin_ = at_ + 1;
      }
      if (at_ == end_) return false;
    }
    ++at_;
  }
  return false;
}

}  // namespace vitrail::pov
