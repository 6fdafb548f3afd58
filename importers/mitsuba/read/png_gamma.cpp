// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/read/png_gamma.h"

#include <array>
#include <cstdint>
#include <fstream>
#include <string_view>

#include "scene/system/input_files.h"

namespace vitrail::mitsuba {

namespace {

std::uint32_t big_endian(const unsigned char* b) {
  return std::uint32_t{b[0]} << 24 | std::uint32_t{b[1]} << 16 | std::uint32_t{b[2]} << 8 | b[3];
}

bool read(std::ifstream& in, std::array<unsigned char, 8>& to, std::streamsize bytes) {
  return static_cast<bool>(in.read(reinterpret_cast<char*>(to.data()), bytes));
}

}  // namespace

std::optional<double> png_gamma(const std::filesystem::path& file) {
  constexpr std::array<unsigned char, 8> signature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  constexpr std::uint32_t checksum_bytes = 4;
  std::ifstream in = open_input(file);
  std::array<unsigned char, 8> b{};
  if (!read(in, b, 8) || b != signature) return {};
  std::optional<double> gamma;
  while (read(in, b, 8)) {  // length and name of a chunk
    std::uint32_t length = big_endian(b.data());
    const std::string_view name(reinterpret_cast<const char*>(b.data()) + 4, 4);
    if (name == "sRGB") return {};
    if (name == "IDAT" || name == "IEND") break;
    if (name == "gAMA" && length >= 4) {
      if (!read(in, b, 4)) break;
      if (const std::uint32_t inverse = big_endian(b.data()); inverse > 0) gamma = 100000.0 / inverse;
      length -= 4;
    }
    in.seekg(std::streamoff{length} + checksum_bytes, std::ios::cur);
  }
  return gamma;
}

}  // namespace vitrail::mitsuba
