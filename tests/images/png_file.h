// SPDX-License-Identifier: Apache-2.0
// Writes a PNG file of 8 bits a channel whose rows have a filter of the test's choice.
#pragma once

#include <zlib.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <vector>

namespace vitrail::test {

inline void append_big_endian(std::string& to, std::uint32_t v) {
  for (const int shift : {24, 16, 8, 0}) to += static_cast<char>(v >> shift & 0xff);
}

inline void append_chunk(std::string& png, const std::string& type, const std::string& data) {
  append_big_endian(png, static_cast<std::uint32_t>(data.size()));
  const std::string whole = type + data;
  png += whole;
  append_big_endian(png, static_cast<std::uint32_t>(crc32(0, reinterpret_cast<const Bytef*>(whole.data()),
                                                          static_cast<uInt>(whole.size()))));
}

// What a filter predicts of a byte from those to the left, above, and above to the left.
inline int png_prediction(int filter, int a, int b, int c) {
  const int p = a + b - c, pa = std::abs(p - a), pb = std::abs(p - b), pc = std::abs(p - c);
  const int paeth = pa <= pb && pa <= pc ? a : pb <= pc ? b : c;
  return std::array{0, a, b, (a + b) / 2, paeth}.at(static_cast<std::size_t>(filter));
}

// Pixels row by row from the top, `channels` bytes each; `filter` of each row y is filters[y %
// filters.size()]. The pixels are in chunks of at most `chunk` bytes.
inline std::string png_of(int width, int channels, std::span<const std::uint8_t> pixels,
                          const std::vector<int>& filters, std::size_t chunk = 1000) {
  const std::size_t row = static_cast<std::size_t>(width * channels), rows = pixels.size() / row;
  const auto step = static_cast<std::size_t>(channels);
  std::string filtered;
  for (std::size_t y = 0; y < rows; ++y) {
    const int filter = filters[y % filters.size()];
    filtered += static_cast<char>(filter);
    for (std::size_t i = 0; i < row; ++i) {
      const std::uint8_t* const at = &pixels[y * row + i];
      const int left = i < step ? 0 : *(at - step), above = y == 0 ? 0 : *(at - row),
                corner = i < step || y == 0 ? 0 : *(at - row - step);
      filtered += static_cast<char>(*at - png_prediction(filter, left, above, corner));
    }
  }
  uLongf bytes = compressBound(static_cast<uLong>(filtered.size()));
  std::string packed(bytes, '\0');
  compress(reinterpret_cast<Bytef*>(packed.data()), &bytes, reinterpret_cast<const Bytef*>(filtered.data()),
           static_cast<uLong>(filtered.size()));
  packed.resize(bytes);
  std::string png = "\x89PNG\r\n\x1a\n", header;
  append_big_endian(header, static_cast<std::uint32_t>(width));
  append_big_endian(header, static_cast<std::uint32_t>(rows));
  header += '\x08';
  header += std::array{'\0', '\x04', '\x02', '\x06'}.at(step == 1 ? 0 : step - 1);
  append_chunk(png, "IHDR", header + std::string(3, '\0'));
  for (std::size_t at = 0; at < packed.size(); at += chunk)
    append_chunk(png, "IDAT", packed.substr(at, chunk));
  append_chunk(png, "IEND", "");
  return png;
}

inline void write_file(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace vitrail::test
