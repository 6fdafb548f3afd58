// SPDX-License-Identifier: Apache-2.0
#include "tests/support/png.h"

#include <zlib.h>

#include <fstream>
#include <stdexcept>
#include <string>

namespace vitrail::test {

namespace {

std::string big_endian(std::uint32_t value) {
  std::string bytes(4, '\0');
  for (std::size_t i = 0; i < 4; ++i) bytes[i] = static_cast<char>(value >> (24 - 8 * i) & 255);
  return bytes;
}

std::string chunk(const std::string& type, const std::string& data) {
  const std::string checked = type + data;
  const auto* bytes = reinterpret_cast<const Bytef*>(checked.data());
  const auto sum = static_cast<std::uint32_t>(crc32(0, bytes, static_cast<uInt>(checked.size())));
  return big_endian(static_cast<std::uint32_t>(data.size())) + checked + big_endian(sum);
}

std::string deflated(const std::string& data) {
  uLongf size = compressBound(data.size());
  std::string result(size, '\0');
  compress(reinterpret_cast<Bytef*>(result.data()), &size, reinterpret_cast<const Bytef*>(data.data()),
           data.size());
  result.resize(size);
  return result;
}

}  // namespace

void write_png(const std::filesystem::path& file, std::uint32_t width, std::uint32_t height, int channels,
               const std::vector<std::uint8_t>& bytes, int bits) {
  constexpr char color_types[]{0, 4, 2, 6};
  const std::size_t row = static_cast<std::size_t>(width) * static_cast<std::size_t>(channels * bits / 8);
  if (bytes.size() != row * height) throw std::invalid_argument("write_png: bytes of another size");
  std::string data;
  for (std::size_t y = 0; y < height; ++y) {
    data += '\0';  // unfiltered
    data.append(reinterpret_cast<const char*>(bytes.data()) + y * row, row);
  }
  std::string header = big_endian(width) + big_endian(height);
  header += static_cast<char>(bits);
  header += color_types[channels - 1];
  header += std::string(3, '\0');
  std::ofstream(file, std::ios::binary)
      << "\x89PNG\r\n\x1a\n"
      << chunk("IHDR", header) << chunk("IDAT", deflated(data)) << chunk("IEND", "");
}

}  // namespace vitrail::test
