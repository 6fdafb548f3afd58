// SPDX-License-Identifier: Apache-2.0
#include "tests/conformance/gate/pbrt_tokens.h"

#include <fmt/format.h>

#include <cctype>
#include <stdexcept>

namespace vitrail::test::pbrt {

namespace {

bool ends_word(char c) {
  return std::isspace(static_cast<unsigned char>(c)) || c == '"' || c == '[' || c == ']';
}

// From behind the opening quote; leaves `at` behind the closing one.
std::string quoted(std::string_view text, std::size_t& at, int line) {
  std::string result;
  for (; at < text.size() && text[at] != '"'; ++at) {
    if (text[at] == '\n') break;
    if (text[at] == '\\' && at + 1 < text.size()) ++at;
    result += text[at];
  }
  if (at >= text.size() || text[at] != '"')
    throw std::runtime_error(fmt::format("line {}: a string that does not end", line));
  ++at;
  return result;
}

}  // namespace

std::vector<Token> tokens(std::string_view text) {
  std::vector<Token> result;
  int line = 1;
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    if (c == '\n') ++line;
    if (std::isspace(static_cast<unsigned char>(c))) {
      ++at;
    } else if (c == '#') {
      while (at < text.size() && text[at] != '\n') ++at;
    } else if (c == '"') {
      result.push_back({quoted(text, ++at, line), true, line});
    } else if (c == '[' || c == ']') {
      result.push_back({std::string(1, c), false, line});
      ++at;
    } else {
      const std::size_t start = at;
      while (at < text.size() && !ends_word(text[at])) ++at;
      result.push_back({std::string(text.substr(start, at - start)), false, line});
    }
  }
  return result;
}

}  // namespace vitrail::test::pbrt
