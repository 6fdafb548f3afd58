// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/read/numbers_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace vitrail::pov {

std::string text_of(const Numbers& numbers) {
  if (numbers.terms == 1) return fmt::format("{:.6g}", numbers.v[0]);
  std::string text;
  for (int i = 0; i < numbers.terms; ++i)
    text += fmt::format("{}{:.6g}", i == 0 ? "<" : ",", numbers.v[static_cast<std::size_t>(i)]);
  return text + ">";
}

std::string formatted(double value, int length, int digits) {
  constexpr int most = 500;
  const int precision = std::min(digits < 0 ? 6 : digits, most);
  const int width = std::min(std::abs(std::max(length, -most)), most);
  return length < 0 ? fmt::format("{:0{}.{}f}", value, width, precision)
                    : fmt::format("{:{}.{}f}", value, width, precision);
}

}  // namespace vitrail::pov
