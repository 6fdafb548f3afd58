// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/xml_text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>

namespace vitrail::mitsuba {

namespace {

void append_utf8(std::string& to, std::uint32_t c) {
  const auto put = [&](std::uint32_t byte) { to += static_cast<char>(byte); };
  if (c < 0x80) return put(c);
  if (c < 0x800) return put(0xC0 | c >> 6), put(0x80 | (c & 63));
  if (c < 0x10000) {
    put(0xE0 | c >> 12);
  } else {
    put(0xF0 | c >> 18), put(0x80 | (c >> 12 & 63));
  }
  put(0x80 | (c >> 6 & 63)), put(0x80 | (c & 63));
}

std::string from_utf16(std::string_view text, bool is_little) {
  const auto unit = [&](std::size_t i) {
    const auto first = static_cast<unsigned char>(text[i]), second = static_cast<unsigned char>(text[i + 1]);
    return static_cast<std::uint32_t>(is_little ? first | second << 8 : first << 8 | second);
  };
  std::string result;
  for (std::size_t i = 0; i + 1 < text.size(); i += 2) {
    std::uint32_t c = unit(i);
    const bool is_high = c >= 0xD800 && c < 0xDC00, is_low = c >= 0xDC00 && c < 0xE000;
    const std::uint32_t next = is_high && i + 3 < text.size() ? unit(i + 2) : 0;
    if (next >= 0xDC00 && next < 0xE000)
      c = 0x10000 + ((c - 0xD800) << 10) + (next - 0xDC00), i += 2;
    else if (is_high || is_low)
      c = 0xFFFD;
    append_utf8(result, c);
  }
  return result;
}

// The value of `encoding` in <?xml …?>, in small letters.
std::string declared_encoding(std::string_view text) {
  if (!text.starts_with("<?xml")) return "";
  const std::string_view declaration = text.substr(0, text.find("?>"));
  const std::size_t name = declaration.find("encoding");
  const std::size_t open = declaration.find_first_of("'\"", name);
  if (name == std::string_view::npos || open == std::string_view::npos) return "";
  std::string value(declaration.substr(open + 1, declaration.find(declaration[open], open + 1) - open - 1));
  std::ranges::transform(value, value.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return value;
}

}  // namespace

std::optional<std::string> in_utf8(std::string_view text) {
  if (text.starts_with("\xFF\xFE")) return from_utf16(text.substr(2), true);
  if (text.starts_with("\xFE\xFF")) return from_utf16(text.substr(2), false);
  static constexpr std::array<std::string_view, 3> single_bytes{"iso-8859-1", "latin1", "windows-1252"};
  if (std::ranges::count(single_bytes, declared_encoding(text)) == 0) return std::nullopt;
  std::string result;
  for (const char c : text) append_utf8(result, static_cast<unsigned char>(c));
  return result;
}

}  // namespace vitrail::mitsuba
