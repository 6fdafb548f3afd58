// SPDX-License-Identifier: Apache-2.0
// A Lexer reads the words of a pbrt file: quoted strings, brackets, and words (directives, numbers, true,
// false).
#pragma once

#include <string>
#include <string_view>

#include "importers/bytes/plain_decimal.h"
#include "scene/system/diagnostics.h"

namespace vitrail::pbrt {

// A Place is where a token begins. The name outlives every place: it belongs to the TokenStream.
struct Place {
  const std::string* file = nullptr;
  int line = 0;
  int column = 0;
};

SourceLocation location(const Place& place);

// Throws Error with the place and the line of the file that is there.
[[noreturn]] void fail(const std::string& message, const Place& place);

enum class TokenKind { word, text, open, close, end_of_import, end };

struct Token {
  TokenKind kind = TokenKind::end;
  std::string_view text;  // without quotes, escapes replaced; valid until the next token is read
  Place place;
};

// Returns the name of a token in a message: the text itself, shortened, or "the end of the file".
std::string describe(const Token& token);

// It reads one buffer. Comments run from # to the end of the line.
class Lexer {
 public:
  Lexer(const std::string* file, const char* begin, const char* end);

  Token next();
  // Reads a number if one comes next. Numbers that are malformed or not finite throw Error.
  bool next_number(double& value);
  // Reads numbers of the most frequent form alone: plain decimals (plain_decimal.h) behind and before spaces,
  // line feeds and brackets. Returns false for others, and may have skipped some blanks.
  bool next_plain_number(double& value) {
    for (; at_ != end_ && (*at_ == ' ' || *at_ == '\n'); ++at_)
      if (*at_ == '\n') new_line();
    const char* const stop = plain_decimal(at_, end_, value);
    if (!stop || stop == end_ || (*stop != ' ' && *stop != '\n' && *stop != ']')) return false;
    at_ = stop;
    return true;
  }
  // Skips blanks and comments. Returns the next character, or 0 at the end.
  char peek();
  // Skips to after the next ] that is not in a comment. Places are not kept.
  void skip_list();

  const char* position() const { return at_; }
  Place place() const { return {file_, line_, static_cast<int>(at_ - line_begin_) + 1}; }

 private:
  void skip_blanks();
  void new_line() { ++line_, line_begin_ = at_ + 1; }
  Token quoted();

  const std::string* file_;
  const char* at_;
  const char* end_;
  const char* line_begin_;
  int line_ = 1;
  std::string unescaped_;
};

}  // namespace vitrail::pbrt
