// SPDX-License-Identifier: Apache-2.0
#include "compare/web_page.h"

#include <bit>
#include <cmath>
#include <vector>

#include "scene/system/atomic_file.h"

namespace vitrail {

std::string base64(std::span<const std::uint8_t> bytes) {
  constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) { return i + k < bytes.size() ? std::uint32_t{bytes[i + k]} : 0; };
    const std::uint32_t three = byte(0) << 16 | byte(1) << 8 | byte(2);
    text += digits[three >> 18];
    text += digits[three >> 12 & 63];
    text += i + 1 < bytes.size() ? digits[three >> 6 & 63] : '=';
    text += i + 2 < bytes.size() ? digits[three & 63] : '=';
  }
  return text;
}

std::uint16_t to_half(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  const auto sign = static_cast<std::uint16_t>(bits >> 16 & 0x8000);
  const float size = std::abs(value);
  if (std::isnan(value)) return sign | 0x7e00;
  if (size >= 65520) return sign | 0x7c00;
  // Below 2^−14 a half has steps of 2^−24. nearbyint rounds to nearest even.
  if (size < 0x1p-14f) return sign | static_cast<std::uint16_t>(std::nearbyint(size * 0x1p24f));
  // The exponent is rebiased from 127 to 15; a carry out of the mantissa steps it up as it should.
  const std::uint32_t rebiased = (bits & 0x7fffffff) - (112u << 23);
  return sign | static_cast<std::uint16_t>((rebiased + 0xfff + (rebiased >> 13 & 1)) >> 13);
}

std::string half_floats_base64(std::span<const float> values) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(2 * values.size());
  for (const float v : values) {
    const std::uint16_t half = to_half(v);
    bytes.push_back(static_cast<std::uint8_t>(half & 255));
    bytes.push_back(static_cast<std::uint8_t>(half >> 8));
  }
  return base64(bytes);
}

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

std::string page_with_data(std::string_view page, std::string_view json) {
  constexpr std::string_view mark = "@DATA@";
  const std::size_t at = page.find(mark);
  std::string out(page.substr(0, at));
  for (const char c : json) {
    if (c == '<')
      out += "\\u003c";  // within a JSON string, the only place that JSON has it, the same character
    else
      out += c;
  }
  return out.append(page.substr(at + mark.size()));
}

void write_whole(const std::filesystem::path& file, std::string_view text) {
  AtomicFile out(file);
  out.write(std::as_bytes(std::span(text)));
  out.commit();
}

}  // namespace vitrail
