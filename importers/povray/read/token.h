// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "importers/povray/read/symbols.h"

namespace vitrail::pov {

// It is where a token begins; `file` is an index into the files of the reader. Line 0: nowhere.
struct Place {
  std::uint32_t line = 0;
  std::uint16_t file = 0, column = 0;
};

enum class TokenKind : std::uint8_t { end, number, word, text, sign, directive };

struct Token {
  TokenKind kind = TokenKind::end;
  // It is a sign's character; 'l', 'g', 'n' are <=, >= and !=.
  char sign = 0;
  Place place;
  // It is set in a TokenBuffer, for a directive that opens or parts a block: the index of the directive that
  // parts or ends the block next.
  std::uint32_t match = 0;
  union {
    double number = 0;
    Symbol* symbol;           // of a word or a directive
    const std::string* text;  // of a string
  };

  bool is(char c) const { return kind == TokenKind::sign && sign == c; }
  bool is(Word word) const { return kind == TokenKind::word && symbol->word == word; }
  bool is_directive(Word word) const { return kind == TokenKind::directive && symbol->word == word; }
};

// It stores the tokens of a macro or a loop.
using TokenBuffer = std::vector<Token>;

// Returns the token as messages show it.
std::string describe(const Token& token);

// Returns whether a directive opens a block that #end closes.
bool opens_block(Word directive);
// Returns whether it parts or ends one.
bool parts_block(Word directive);

}  // namespace vitrail::pov
