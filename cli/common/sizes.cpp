// SPDX-License-Identifier: Apache-2.0
#include "cli/common/sizes.h"

#include <fmt/format.h>

#include <cctype>
#include <charconv>
#include <cmath>
#include <string_view>

#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

constexpr std::string_view units = "KMGT";

}  // namespace

std::uint64_t parse_bytes(const std::string& text) {
  double value = 0;
  const bool digit_first = !text.empty() && text[0] >= '0' && text[0] <= '9';
  const char* const end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, value, std::chars_format::fixed);
  const bool number = digit_first && parsed.ec == std::errc{};
  std::string_view suffix(parsed.ptr, end);
  if (!suffix.empty()) {
    const auto unit = units.find(static_cast<char>(std::toupper(static_cast<unsigned char>(suffix[0]))));
    if (unit != std::string_view::npos) {
      value *= std::pow(1024.0, static_cast<double>(unit) + 1);
      suffix.remove_prefix(1);
      if (suffix == "iB") suffix.remove_prefix(1);
    }
    if (suffix == "B" || suffix == "b") suffix = {};
  }
  if (!number || !suffix.empty() || !(value < 0x1p63))
    throw UsageError(
        fmt::format("'{}' is not a size; write bytes, or a number with K, M, G or T as in 512M", text));
  return static_cast<std::uint64_t>(value);
}

std::string format_bytes(std::uint64_t bytes) {
  if (bytes < 1024) return fmt::format("{} B", bytes);
  auto value = static_cast<double>(bytes) / 1024;
  std::size_t unit = 0;
  for (; value >= 1024 && unit + 1 < units.size(); ++unit) value /= 1024;
  return fmt::format("{:.1f} {}iB", value, units[unit]);
}

}  // namespace vitrail
