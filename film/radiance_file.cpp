// SPDX-License-Identifier: Apache-2.0
#include "film/radiance_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "scene/system/atomic_file.h"

namespace vitrail {

namespace {

using Bytes = std::vector<std::uint8_t>;

std::array<std::uint8_t, 4> encoded(const float* rgb) {
  std::array<float, 3> c{};
  for (std::size_t i = 0; i < 3; ++i) c[i] = rgb[i] > 0 ? std::min(rgb[i], 1.7e38f) : 0.0f;
  const float greatest = std::max({c[0], c[1], c[2]});
  if (greatest < 1e-38f) return {};
  int exponent = 0;
  std::frexp(greatest, &exponent);  // greatest < 2^exponent
  std::array<std::uint8_t, 4> bytes{0, 0, 0, static_cast<std::uint8_t>(exponent + 128)};
  for (std::size_t i = 0; i < 3; ++i) bytes[i] = static_cast<std::uint8_t>(std::ldexp(c[i], 8 - exponent));
  return bytes;
}

// How many equal values begin there, 127 at most.
std::size_t run_at(std::span<const std::uint8_t> values, std::size_t at) {
  std::size_t end = at + 1;
  while (end < values.size() && end - at < 127 && values[end] == values[at]) ++end;
  return end - at;
}

// Runs of four and more as 128 + count and the value, others as they are, 128 after their count at most.
void add_runs(std::span<const std::uint8_t> values, Bytes& bytes) {
  constexpr std::size_t worth = 4, most = 128;
  for (std::size_t at = 0; at < values.size();) {
    if (const std::size_t run = run_at(values, at); run >= worth) {
      bytes.insert(bytes.end(), {static_cast<std::uint8_t>(128 + run), values[at]});
      at += run;
      continue;
    }
    std::size_t end = at;
    while (end < values.size() && end - at < most && run_at(values, end) < worth) ++end;
    bytes.push_back(static_cast<std::uint8_t>(end - at));
    bytes.insert(bytes.end(), values.begin() + static_cast<std::ptrdiff_t>(at),
                 values.begin() + static_cast<std::ptrdiff_t>(end));
    at = end;
  }
}

void add_row(std::span<const float> rgb, Bytes& bytes) {
  const std::size_t width = rgb.size() / 3;
  constexpr std::size_t narrowest = 8, widest = 32767;  // of rows that may have runs
  std::array<Bytes, 4> parts;
  for (Bytes& part : parts) part.resize(width);
  for (std::size_t x = 0; x < width; ++x) {
    const auto pixel = encoded(&rgb[3 * x]);
    for (std::size_t c = 0; c < 4; ++c) parts[c][x] = pixel[c];
  }
  if (width < narrowest || width > widest) {
    for (std::size_t x = 0; x < width; ++x)
      for (const Bytes& part : parts) bytes.push_back(part[x]);
    return;
  }
  bytes.insert(bytes.end(), {2, 2, static_cast<std::uint8_t>(width >> 8), static_cast<std::uint8_t>(width)});
  for (const Bytes& part : parts) add_runs(part, bytes);
}

}  // namespace

void write_radiance(const std::filesystem::path& file, const Picture& picture) {
  std::string header = "#?RADIANCE\n";
  if (!picture.origin.software.empty()) header += "SOFTWARE=" + picture.origin.software + "\n";
  header += fmt::format("FORMAT=32-bit_rle_rgbe\n\n-Y {} +X {}\n", picture.rgb.height, picture.rgb.width);
  AtomicFile target(file);
  target.write(std::as_bytes(std::span(header)));
  const std::size_t values = 3 * static_cast<std::size_t>(picture.rgb.width);
  for (std::size_t at = 0; at < picture.rgb.values.size(); at += values) {
    Bytes bytes;
    add_row(std::span(picture.rgb.values).subspan(at, values), bytes);
    target.write(std::as_bytes(std::span(bytes)));
  }
  target.commit();
}

}  // namespace vitrail
