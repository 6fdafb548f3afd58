// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

namespace vitrail {

inline bool is_digit(char c) { return static_cast<unsigned char>(c - '0') < 10; }

// Reads a number of the form that most files use: "-12.345", at most 15 digits, no exponent. Returns where it
// ends, or nullptr if what stands there is something else, which a full parser has to look at. The value is
// exact: digits and power are both doubles without rounding, so their quotient is the double nearest to the
// number (Clinger 1990).
inline const char* plain_decimal(const char* at, const char* end, double& value) {
  constexpr std::array<double, 16> powers{1e0, 1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                          1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
  const bool negative = at != end && *at == '-';
  if (negative) ++at;
  const char* const begin = at;
  std::uint64_t digits = 0;
  for (; at != end && is_digit(*at); ++at) digits = 10 * digits + static_cast<unsigned char>(*at - '0');
  auto count = at - begin;
  std::size_t decimals = 0;
  if (at != end && *at == '.') {
    const char* const point = ++at;
    for (; at != end && is_digit(*at); ++at) digits = 10 * digits + static_cast<unsigned char>(*at - '0');
    decimals = static_cast<std::size_t>(at - point);
    count += at - point;
  }
  constexpr int most_digits = 15;
  if (count == 0 || count > most_digits || (at != end && (*at == 'e' || *at == 'E'))) return nullptr;
  const auto whole = static_cast<double>(static_cast<std::int64_t>(digits));
  const double magnitude = decimals == 0 ? whole : whole / powers[decimals];
  value = negative ? -magnitude : magnitude;
  return at;
}

}  // namespace vitrail
