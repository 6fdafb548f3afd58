// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/read/text_file.h"

#include <fast_float/fast_float.h>

namespace vitrail::pov {

void OpenFile::skip_blanks() {
  const auto found = content.find_first_not_of(" \t\r\n,;", at);
  at = found == std::string::npos ? content.size() : found;
}

bool OpenFile::at_end() {
  skip_blanks();
  return at >= content.size();
}

bool OpenFile::number(double& value) {
  skip_blanks();
  const char* const begin = content.data() + at + (at < content.size() && content[at] == '+' ? 1 : 0);
  const auto parsed = fast_float::from_chars(begin, content.data() + content.size(), value);
  if (parsed.ec != std::errc{}) return false;
  at = static_cast<std::size_t>(parsed.ptr - content.data());
  return true;
}

Value OpenFile::next() {
  if (at_end()) return {};
  if (content[at] == '"') {
    const auto close = content.find('"', at + 1);
    const auto end = close == std::string::npos ? content.size() : close;
    std::string text = content.substr(at + 1, end - at - 1);
    at = close == std::string::npos ? end : end + 1;
    return text;
  }
  Numbers numbers;
  if (content[at] == '<') {
    ++at;
    for (numbers.terms = 0; numbers.terms < 5 && number(numbers.v[static_cast<std::size_t>(numbers.terms)]);)
      ++numbers.terms;
    skip_blanks();
    if (at < content.size() && content[at] == '>') ++at;
    return numbers;
  }
  if (number(numbers.v[0])) return numbers;
  at = content.size();
  return {};
}

}  // namespace vitrail::pov
