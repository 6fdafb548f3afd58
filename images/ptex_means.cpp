// SPDX-License-Identifier: Apache-2.0
#include "images/ptex_means.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>

#include "scene/diagnostics.h"
#include "scene/portable_math.h"

namespace vitrail {

namespace {

static_assert(std::endian::native == std::endian::little, "as the file has it");

// As it stands in the file.
struct Header {
  std::array<char, 4> magic;
  std::uint32_t version, mesh_type, data_type, alpha_channel;
  std::uint16_t channels, levels;
  std::uint32_t faces, extended_header_bytes, face_info_bytes, means_bytes, level_info_bytes, minor_version;
  std::uint64_t level_data_bytes;
  std::uint32_t meta_data_zip_bytes, meta_data_bytes;
};
static_assert(sizeof(Header) == 64);

constexpr std::array<std::size_t, 4> bytes_of_type{1, 2, 2, 4};  // uint8, uint16, half, float

double half(std::uint16_t bits) {
  const int exponent = bits >> 10 & 31, fraction = bits & 1023;
  double value = exponent == 0    ? std::ldexp(fraction, -24)
                 : exponent == 31 ? NAN
                                  : std::ldexp(1024 + fraction, exponent - 25);
  return bits >> 15 ? -value : value;
}

template <class T>
T word(const unsigned char* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return value;
}

float number(const unsigned char* at, std::uint32_t type) {
  const double value = type == 0   ? *at / 255.0
                       : type == 1 ? word<std::uint16_t>(at) / 65535.0
                       : type == 2 ? half(word<std::uint16_t>(at))
                                   : static_cast<double>(word<float>(at));
  return static_cast<float>(value);
}

// pbrt decodes what its filters make of the texels, from a gamma of 2.2 unless the scene says otherwise.
double decoded(double value, const PtexTexture& t) {
  if (!std::isfinite(value)) return 0;
  if (t.encoding == Encoding::linear || value <= 0) return value;
  if (t.encoding == Encoding::srgb) return srgb_decode(std::min(value, 1.0));
  return portable_pow(value, t.encoding == Encoding::gamma ? static_cast<double>(t.gamma) : 2.2);
}

}  // namespace

PtexMeans read_ptex_means(const std::filesystem::path& file) {
  const auto fail = [&](const char* why) {
    throw Error(fmt::format("cannot read {}: {}", file.string(), why));
  };
  std::ifstream in(file, std::ios::binary);
  if (!in) fail("there is no such file");
  Header h;
  if (!in.read(reinterpret_cast<char*>(&h), sizeof h) || std::string_view(h.magic.data(), 4) != "Ptex")
    fail("it is no Ptex file");
  if (h.version != 1) fail("its version is not 1");
  if (h.data_type > 3 || h.channels == 0 || h.faces == 0) fail("its header is damaged");
  const std::size_t size = bytes_of_type[h.data_type], count = std::size_t{h.faces} * h.channels;
  constexpr std::size_t greatest_expansion = 1032;  // of zlib's deflate
  if (count * size > greatest_expansion * h.means_bytes) fail("its means of faces are damaged");
  in.seekg(static_cast<std::streamoff>(sizeof h + std::size_t{h.extended_header_bytes} + h.face_info_bytes));
  std::error_code unknown;
  if (h.means_bytes > std::filesystem::file_size(file, unknown)) fail("it ends too early");
  std::vector<unsigned char> packed(h.means_bytes), bytes(count * size);
  if (!in.read(reinterpret_cast<char*>(packed.data()), static_cast<std::streamsize>(packed.size())))
    fail("it ends too early");
  uLongf unpacked = static_cast<uLongf>(bytes.size());
  if (uncompress(bytes.data(), &unpacked, packed.data(), static_cast<uLong>(packed.size())) != Z_OK ||
      unpacked != bytes.size())
    fail("its means of faces are damaged");
  PtexMeans means{h.channels, {}};
  for (std::size_t i = 0; i < count; ++i) means.values.push_back(number(&bytes[i * size], h.data_type));
  return means;
}

PtexMean mean_of_ptex(const PtexTexture& texture) {
  const double scale = static_cast<double>(texture.scale);
  PtexMeans means;
  try {
    means = read_ptex_means(texture.filename);
  } catch (const Error& error) {
    return {{0.5 * scale, 0.5 * scale, 0.5 * scale}, fmt::format("grey, {}: {}", 0.5 * scale, error.what())};
  }
  const auto channels = static_cast<std::size_t>(means.channels);
  const std::size_t faces = means.values.size() / channels;
  std::array<double, 3> sum{}, squares{};
  for (std::size_t f = 0; f < faces; ++f)
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t from = channels < 3 ? 0 : c;  // one or two channels are grey, and alpha
      const double value = scale * decoded(static_cast<double>(means.values[f * channels + from]), texture);
      sum[c] += value, squares[c] += value * value;
    }
  const double n = static_cast<double>(faces);
  double deviation = 0;
  for (std::size_t c = 0; c < 3; ++c)
    deviation = std::max(deviation, std::sqrt(std::max(0.0, squares[c] / n - sum[c] / n * (sum[c] / n))));
  const RGB mean{sum[0] / n, sum[1] / n, sum[2] / n};
  return {mean,
          fmt::format("the mean of its {} faces, rgb {:.3g} {:.3g} {:.3g}, from which they are {:.2g} in the "
                      "root mean square",
                      faces, mean.r, mean.g, mean.b, deviation)};
}

}  // namespace vitrail
