// SPDX-License-Identifier: Apache-2.0
// A Lexer makes the tokens of one file.
#pragma once

#include <deque>
#include <stdexcept>

#include "importers/povray/read/token.h"

namespace vitrail::pov {

// It says what cannot be a token, with its place; the reader makes an Error of it.
struct LexicalError : std::runtime_error {
  LexicalError(const std::string& message, Place where) : std::runtime_error(message), place(where) {}
  Place place;
};

// Comments run from // to the end of the line, or from /* to */, which may lie within each other.
class Lexer {
 public:
  Lexer(Symbols& symbols, std::deque<std::string>& texts, const char* begin, const char* end,
        std::uint16_t file);

  Token next();
  // Goes to the next # of a block that is left out, not in strings and comments; returns false at the end.
  bool skip_to_directive();
  const char* position() const { return at_; }

 private:
  void skip_blanks();
  const char* behind_sign(const char* sign) const;
  Place place() const;
  Token number(Token token);
  Token word(Token token, TokenKind kind);
  Token text(Token token);

  Symbols& symbols_;
  std::deque<std::string>& texts_;
  const char *at_, *end_, *line_begin_;
  std::uint32_t line_ = 1;
  std::uint16_t file_;
};

}  // namespace vitrail::pov
