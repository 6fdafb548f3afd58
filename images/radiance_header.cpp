// SPDX-License-Identifier: Apache-2.0
#include "images/radiance_header.h"

#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>

namespace vitrail {

namespace {

// "-Y 4 +X 6": rows go along the first axis, and pixels in them along the second. y is up.
void read_axes(std::string_view line, RadianceHeader& header) {
  const std::size_t second = line.find_first_of("+-", 1);
  if (line.size() < 2 || second == std::string_view::npos || second + 1 >= line.size()) return;
  header.is_transposed = line[1] == 'X';
  const char along_x = header.is_transposed ? line[0] : line[second],
             along_y = header.is_transposed ? line[second] : line[0];
  header.from_right = along_x == '-';
  header.from_below = along_y == '+';
}

}  // namespace

RadianceHeader radiance_header(std::string_view bytes) {
  constexpr std::string_view exposure = "EXPOSURE=";
  RadianceHeader header;
  bool is_last = false;
  while (!bytes.empty()) {
    const std::size_t end = bytes.find('\n');
    const std::string_view line = bytes.substr(0, end);
    if (is_last) {
      read_axes(line, header);
      break;
    }
    is_last = line.empty() || line == "\r";
    // Each program that changed it adds a line.
    if (line.starts_with(exposure))
      if (const float factor = std::strtof(std::string(line.substr(exposure.size())).c_str(), nullptr);
          std::isfinite(factor) && factor > 0)
        header.exposure *= factor;
    if (end == std::string_view::npos) break;
    bytes.remove_prefix(end + 1);
  }
  return header;
}

void undo(const RadianceHeader& header, std::vector<float>& values, int& width, int& height, int channels) {
  if (header.exposure != 1)
    for (float& v : values) v /= header.exposure;
  if (!header.is_turned()) return;
  const auto rows = static_cast<std::size_t>(height), columns = static_cast<std::size_t>(width),
             step = static_cast<std::size_t>(channels);
  if (header.is_transposed) std::swap(width, height);
  const auto w = static_cast<std::size_t>(width), h = static_cast<std::size_t>(height);
  std::vector<float> turned(values.size());
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t column = 0; column < columns; ++column) {
      std::size_t x = header.is_transposed ? row : column, y = header.is_transposed ? column : row;
      if (header.from_right) x = w - 1 - x;
      if (header.from_below) y = h - 1 - y;
      for (std::size_t c = 0; c < step; ++c)
        turned[(y * w + x) * step + c] = values[(row * columns + column) * step + c];
    }
  values = std::move(turned);
}

}  // namespace vitrail
