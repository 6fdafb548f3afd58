// SPDX-License-Identifier: Apache-2.0
// The words of a pbrt-v4 file, as pbrt's own lexer divides them. Apart from the importer's, which reads more.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace vitrail::test::pbrt {

struct Token {
  std::string text;
  bool quoted = false;
  int line = 0;
};

// Throws std::runtime_error for a string that does not end in its line.
std::vector<Token> tokens(std::string_view text);

// "type name" and its values.
struct Parameter {
  std::string type, name;
  std::vector<Token> values;
  int line = 0;
};

}  // namespace vitrail::test::pbrt
