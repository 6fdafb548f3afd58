// SPDX-License-Identifier: Apache-2.0
// Files of kinds that OpenImageIO reads and does not write, or not in this way, byte by byte. Pictures are 2
// × 2 pixels: red, green; blue, grey.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace vitrail::test {

using Bytes = std::string;

// Little-endian, and big-endian.
template <class T>
Bytes low(T value) {
  Bytes bytes;
  for (std::size_t i = 0; i < sizeof(T); ++i) bytes += static_cast<char>(value >> (8 * i) & 0xff);
  return bytes;
}
template <class T>
Bytes high(T value) {
  const Bytes bytes = low(value);
  return {bytes.rbegin(), bytes.rend()};
}
inline Bytes zeros(std::size_t count) { return Bytes(count, '\0'); }
inline Bytes bytes_of(const std::vector<int>& values) {
  Bytes bytes;
  for (const int v : values) bytes += static_cast<char>(v);
  return bytes;
}

// Uncompressed, of one strip, or of one for each channel where they are `apart`.
struct Tiff {
  std::uint16_t photometric = 2, channels = 3, bits = 8, orientation = 1;
  bool apart = false;
  Bytes pixels;
  std::vector<std::uint16_t> palette{};
};
inline Bytes tiff_bytes(const Tiff& t) {
  const bool many = t.channels > 1;
  const std::uint32_t strips = t.apart ? t.channels : 1;
  const auto each = static_cast<std::uint32_t>(t.pixels.size()) / strips;
  const std::uint32_t entries = 11 + !t.palette.empty(), after = 8 + 2 + entries * 12 + 4;
  const std::uint32_t widths = after, offsets = widths + 2u * t.channels, counts = offsets + 4 * strips,
                      palette = counts + 4 * strips,
                      data = palette + 2 * static_cast<std::uint32_t>(t.palette.size());
  Bytes directory = low<std::uint16_t>(static_cast<std::uint16_t>(entries));
  const auto entry = [&](std::uint16_t tag, std::uint16_t type, std::uint32_t count, std::uint32_t value) {
    directory += low(tag) + low(type) + low(count) + low(value);
  };
  entry(256, 4, 1, 2), entry(257, 4, 1, 2), entry(258, 3, t.channels, many ? widths : t.bits);
  entry(259, 3, 1, 1), entry(262, 3, 1, t.photometric), entry(273, 4, strips, strips > 1 ? offsets : data);
  entry(274, 3, 1, t.orientation), entry(277, 3, 1, t.channels), entry(278, 4, 1, 2);
  entry(279, 4, strips, strips > 1 ? counts : each), entry(284, 3, 1, t.apart ? 2 : 1);
  if (!t.palette.empty()) entry(320, 3, static_cast<std::uint32_t>(t.palette.size()), palette);
  Bytes file = "II" + low<std::uint16_t>(42) + low<std::uint32_t>(8) + directory + low<std::uint32_t>(0);
  for (int c = 0; c < t.channels; ++c) file += low(t.bits);
  for (std::uint32_t s = 0; s < strips; ++s) file += low(data + s * each);
  for (std::uint32_t s = 0; s < strips; ++s) file += low(each);
  for (const std::uint16_t v : t.palette) file += low(v);
  return file + t.pixels;
}

// Rows from the bottom up; of 8 bits with a palette, or 24.
inline Bytes bmp_bytes(std::uint16_t bits, const Bytes& palette, const Bytes& pixels) {
  const auto start = static_cast<std::uint32_t>(54 + palette.size());
  return "BM" + low<std::uint32_t>(start + static_cast<std::uint32_t>(pixels.size())) + zeros(4) +
         low(start) + low<std::uint32_t>(40) + low<std::uint32_t>(2) + low<std::uint32_t>(2) +
         low<std::uint16_t>(1) + low(bits) + zeros(4) +
         low<std::uint32_t>(static_cast<std::uint32_t>(pixels.size())) + zeros(8) +
         low<std::uint32_t>(static_cast<std::uint32_t>(palette.size() / 4)) + zeros(4) + palette + pixels;
}

// Uncompressed, 24 bits, blue first; from the top down where `from_top`.
inline Bytes targa_bytes(bool from_top, const Bytes& pixels) {
  return bytes_of({0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 2, 0, 24, from_top ? 32 : 0}) + pixels;
}

// Its whole channels, one after the other.
inline Bytes psd_bytes(std::uint16_t mode, std::uint16_t channels, const Bytes& planes) {
  return "8BPS" + high<std::uint16_t>(1) + zeros(6) + high(channels) + high<std::uint32_t>(2) +
         high<std::uint32_t>(2) + high<std::uint16_t>(8) + high(mode) + zeros(12) + high<std::uint16_t>(0) +
         planes;
}

// 32 bits a pixel: blue, green, red, alpha.
inline Bytes dds_bytes(const Bytes& pixels) {
  return "DDS " + low<std::uint32_t>(124) + low<std::uint32_t>(0x1007) + low<std::uint32_t>(2) +
         low<std::uint32_t>(2) + low<std::uint32_t>(8) + zeros(52) + low<std::uint32_t>(32) +
         low<std::uint32_t>(0x41) + zeros(4) + low<std::uint32_t>(32) + low<std::uint32_t>(0xff0000) +
         low<std::uint32_t>(0xff00) + low<std::uint32_t>(0xff) + low<std::uint32_t>(0xff000000) +
         low<std::uint32_t>(0x1000) + zeros(16) + pixels;
}

// One packet of uncompressed red, green and blue.
inline Bytes softimage_bytes(const Bytes& pixels) {
  return high<std::uint32_t>(0x5380f634) + zeros(84) + "PICT" + high<std::uint16_t>(2) +
         high<std::uint16_t>(2) + zeros(4) + high<std::uint16_t>(3) + zeros(2) + bytes_of({0, 8, 0, 0xe0}) +
         pixels;
}

}  // namespace vitrail::test
