// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/read/token.h"

#include <fmt/format.h>

namespace vitrail::pov {

std::string describe(const Token& token) {
  switch (token.kind) {
    case TokenKind::number:
      return fmt::format("'{}'", token.number);
    case TokenKind::word:
      return fmt::format("'{}'", token.symbol->name);
    case TokenKind::directive:
      return fmt::format("'#{}'", token.symbol->name);
    case TokenKind::text:
      return fmt::format("\"{}\"", token.text->substr(0, 40));
    case TokenKind::sign:
      return token.sign == 'l'   ? "'<='"
             : token.sign == 'g' ? "'>='"
             : token.sign == 'n' ? "'!='"
                                 : fmt::format("'{}'", token.sign);
    case TokenKind::end:
      break;
  }
  return "the end of the file";
}

bool opens_block(Word directive) {
  switch (directive) {
    case Word::if_:
    case Word::ifdef_:
    case Word::ifndef_:
    case Word::while_:
    case Word::for_:
    case Word::switch_:
    case Word::macro_:
      return true;
    default:
      return false;
  }
}

bool parts_block(Word directive) {
  switch (directive) {
    case Word::else_:
    case Word::elseif_:
    case Word::case_:
    case Word::range_:
    case Word::end_:
      return true;
    default:
      return false;
  }
}

}  // namespace vitrail::pov
