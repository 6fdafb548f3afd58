// SPDX-License-Identifier: Apache-2.0
#include "cli/common/number_checks.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cctype>
#include <charconv>
#include <cmath>
#include <string_view>

namespace vitrail {

std::string more_than_0(const std::string& text) {
  double number = 0;
  return CLI::detail::lexical_cast(text, number) && number > 0 ? "" : "has to be more than 0, not " + text;
}

std::string not_below_0(const std::string& text) {
  double number = 0;
  return CLI::detail::lexical_cast(text, number) && number >= 0 ? "" : "must not be negative: " + text;
}

std::string plain_seconds(const std::string& text) {
  double sum_s = 0;
  const char *at = text.data(), *const end = at + text.size();
  while (at != end) {
    double number = 0;
    const auto parsed = std::from_chars(at, end, number, std::chars_format::fixed);
    if (parsed.ec != std::errc{} || parsed.ptr == end || number < 0) return text;
    switch (*parsed.ptr) {
      case 's':
        sum_s += number;
        break;
      case 'm':
        sum_s += 60 * number;
        break;
      case 'h':
        sum_s += 3600 * number;
        break;
      case 'd':
        sum_s += 86400 * number;
        break;
      default:
        return text;
    }
    at = parsed.ptr + 1;
  }
  return text.empty() ? text : fmt::format("{}", sum_s);
}

std::string plain_count(const std::string& text) {
  constexpr std::string_view units = "kmg";
  constexpr double most = 0x1p53;
  double number = 0;
  const char* const end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, number, std::chars_format::fixed);
  if (parsed.ec != std::errc{} || parsed.ptr + 1 != end) return text;
  const auto unit = units.find(static_cast<char>(std::tolower(static_cast<unsigned char>(*parsed.ptr))));
  if (unit == std::string_view::npos) return text;
  const double count = std::round(number * std::pow(1000.0, static_cast<double>(unit) + 1));
  return std::abs(count) < most ? std::to_string(static_cast<std::int64_t>(count)) : text;
}

}  // namespace vitrail
