// SPDX-License-Identifier: Apache-2.0
// Colours of light are stored as three codes of 16 bits: the values of a Radiance picture and of a half float
// are kept exactly.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <optional>

#include "bundle/texel.h"

namespace vitrail {

// A code below 2¹⁵ is a half float that is not negative, whose greatest exponent stands for numbers too. A
// greater one is 2¹⁵ and the upper half of a float that is not negative: 8 bits of exponent, 7 of fraction.
// These hold every value of a Radiance picture.
constexpr float value_of_code(std::uint32_t code) {
  if (code >> 15 != 0) return std::bit_cast<float>(code << 17 >> 1);
  const std::uint32_t exponent = code >> 10, fraction = code & 0x3ff;
  if (exponent == 0) return static_cast<float>(fraction) * 0x1p-24f;
  return std::bit_cast<float>((exponent + 112) << 23 | fraction << 13);
}
// Returns the code of this value, which is finite and not negative; nothing where no code has it.
constexpr std::optional<std::uint32_t> exact_code(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value == 0 ? 0.0f : value);
  if ((bits & 0xffff) == 0) return 1u << 15 | bits >> 16;
  const std::uint32_t exponent = bits >> 23;
  if (exponent > 112 && exponent <= 143)
    return (bits & 0x1fff) == 0 ? std::optional((exponent - 112) << 10 | (bits >> 13 & 0x3ff)) : std::nullopt;
  const float fraction = value * 0x1p24f;
  if (!(fraction < 1024)) return {};
  const auto whole = static_cast<std::uint32_t>(fraction);
  return static_cast<float>(whole) == fraction ? std::optional(whole) : std::nullopt;
}
// Returns the code of this value or of one near it. The difference is within 2⁻¹¹ of the value between 2⁻¹⁴
// and 65504, else within 2⁻⁸.
constexpr std::uint32_t nearest_code(float value) {
  if (const auto exact = exact_code(value)) return *exact;
  const auto bits = std::bit_cast<std::uint32_t>(value);
  if (value >= 0x1p-14f && value < 65504) {
    const std::uint32_t rounded = bits + 0xfff + (bits >> 13 & 1);
    return ((rounded >> 23) - 112) << 10 | (rounded >> 13 & 0x3ff);
  }
  const std::uint32_t rounded = std::min(bits + 0x7fff + (bits >> 16 & 1), 0x7f7fffffu);
  return 1u << 15 | rounded >> 16;
}

using LightCodes = std::array<std::uint32_t, 3>;  // of red, green, blue

// A colour whose spectrum is still to be found is read as three words. The third has the greatest code, which
// alone gives the scale of the texel, and all but the highest bit of the next code. The second has the rest.
// Both have their highest bit set, which the words of a spectrum have not. A reader that finds the second
// word of a spectrum beside the third of a code knows all that it needs.
constexpr TexelWords words_of_codes(const LightCodes& codes) {
  std::uint32_t most = 0;
  for (std::uint32_t i = 1; i < 3; ++i)
    if (value_of_code(codes[i]) > value_of_code(codes[most])) most = i;
  const std::uint32_t next = codes[(most + 1) % 3], last = codes[(most + 2) % 3];
  return {0, 1u << 31 | last | next >> 15 << 16 | most << 17, 1u << 31 | codes[most] | (next & 0x7fff) << 16};
}
constexpr float greatest_of_words(const TexelWords& words) { return value_of_code(words[2] & 0xffff); }
constexpr LightCodes codes_of_words(const TexelWords& words) {
  const std::uint32_t most = words[1] >> 17 & 3;
  LightCodes codes{};
  codes[most] = words[2] & 0xffff;
  codes[(most + 1) % 3] = (words[2] >> 16 & 0x7fff) | (words[1] >> 16 & 1) << 15;
  codes[(most + 2) % 3] = words[1] & 0xffff;
  return codes;
}

}  // namespace vitrail
