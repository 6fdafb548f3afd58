// SPDX-License-Identifier: Apache-2.0
#include "bundle/texture_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "bundle/light_code.h"
#include "scene/spectra/rgb_to_spectrum.h"
#include "scene/system/diagnostics.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::texture_file_test {

namespace {

TexelWords sample_texel(std::uint32_t level, std::uint32_t x, std::uint32_t y) {
  return {level << 28 | x, y, x ^ (y << 16)};
}

TextureFileInfo info_of(TexelFormat format, std::uint32_t width, std::uint32_t height) {
  return {format, width, height, texture_level_count(width, height)};
}

TEST(TextureFile, EveryTexelComesBack) {
  const test::TemporaryDirectory directory;
  const std::filesystem::path path = directory / "a.tex";
  for (std::uint32_t f = 0; f < texel_format_count; ++f)
    for (const auto [width, height] : {std::array{1u, 1u}, {64u, 64u}, {65u, 33u}, {200u, 3u}, {1u, 130u}}) {
      const TextureFileInfo info = info_of(static_cast<TexelFormat>(f), width, height);
      const WrittenTextureFile written = write_texture_file(path, info, sample_texel);
      EXPECT_EQ(written.bytes, std::filesystem::file_size(path));
      const TextureFile file(path);
      ASSERT_EQ(file.info(), info);
      EXPECT_EQ(file.hash(), written.hash);
      const std::size_t words = words_per_texel(info.format);
      std::array<std::uint32_t, max_tile_words> tile;
      for (std::uint32_t l = 0; l < info.levels; ++l) {
        const TextureLevel& level = file.layout().levels[l];
        std::uint64_t texels = 0;
        for (std::uint32_t ty = 0; ty < level.tiles_y; ++ty)
          for (std::uint32_t tx = 0; tx < level.tiles_x; ++tx) {
            const TextureFile::Tile size = file.read_tile(l, tx, ty, tile);
            texels += size.width * size.height;
            for (std::uint32_t y = 0; y < size.height; ++y)
              for (std::uint32_t x = 0; x < size.width; ++x) {
                const TexelWords expected =
                    sample_texel(l, tx * tile_width(info.format) + x, ty * tile_height(info.format) + y);
                const std::uint32_t* const read = &tile[(y * size.width + x) * words];
                const std::uint32_t code = expected[0];
                if (info.format == TexelFormat::number_code)
                  ASSERT_EQ(std::bit_cast<float>(read[0]), static_cast<float>(code & 255) / 255);
                else if (info.format == TexelFormat::band_code)
                  for (std::size_t k = 0; k < 3; ++k)
                    ASSERT_EQ(std::bit_cast<float>(read[k]), static_cast<float>(code >> 8 * k & 255) / 255);
                else if (info.format == TexelFormat::color_code)
                  ASSERT_EQ(read[1], color_code_word(code & 255, code >> 8 & 255, code >> 16 & 255));
                else if (info.format == TexelFormat::light_code)
                  ASSERT_EQ(read[2], color_code_word(code & 255, code >> 8 & 255, code >> 16 & 255));
                else if (info.format == TexelFormat::light_code_16)
                  ASSERT_EQ((TexelWords{read[0], read[1], read[2]}),
                            words_of_codes({code & 0xffff, code >> 16, expected[1] & 0xffff}));
                else
                  for (std::size_t w = 0; w < words; ++w) ASSERT_EQ(read[w], expected[w]);
              }
          }
        EXPECT_EQ(texels, static_cast<std::uint64_t>(level.width) * level.height);
      }
    }
}

std::vector<char> bytes_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write_bytes(const std::filesystem::path& path, const std::vector<char>& bytes) {
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

void read_everything(const std::filesystem::path& path) {
  const TextureFile file(path);
  std::array<std::uint32_t, max_tile_words> tile;
  for (std::uint32_t l = 0; l < file.info().levels; ++l)
    for (std::uint32_t ty = 0; ty < file.layout().levels[l].tiles_y; ++ty)
      for (std::uint32_t tx = 0; tx < file.layout().levels[l].tiles_x; ++tx) file.read_tile(l, tx, ty, tile);
}

TEST(TextureFile, EveryChangedByteIsFound) {
  const test::TemporaryDirectory directory;
  const std::filesystem::path path = directory / "a.tex";
  write_texture_file(path, info_of(TexelFormat::reflectance, 9, 5), sample_texel);
  const std::vector<char> good = bytes_of(path);
  EXPECT_NO_THROW(read_everything(path));
  for (std::size_t i = 0; i < good.size(); ++i)
    for (const int flip : {1, 0x80, 0xff}) {
      std::vector<char> bad = good;
      bad[i] = static_cast<char>(bad[i] ^ flip);
      write_bytes(path, bad);
      try {
        read_everything(path);
        ADD_FAILURE() << "byte " << i;
      } catch (const Error& error) {
        EXPECT_EQ(error.location.file, path.string());
      }
    }
}

TEST(TextureFile, AnyOtherLengthIsFound) {
  const test::TemporaryDirectory directory;
  const std::filesystem::path path = directory / "a.tex";
  write_texture_file(path, info_of(TexelFormat::number, 9, 5), sample_texel);
  const std::vector<char> good = bytes_of(path);
  for (std::size_t length = 0; length < good.size(); length += 7) {
    write_bytes(path, {good.begin(), good.begin() + static_cast<std::ptrdiff_t>(length)});
    EXPECT_THROW(read_everything(path), Error) << length;
  }
  std::vector<char> longer = good;
  longer.push_back(0);
  write_bytes(path, longer);
  EXPECT_THROW(read_everything(path), Error);
}

// Tiles are read through a descriptor that stays open, as long as it is of the same content.
TEST(TextureFile, ATileOpensNoFile) {
  const test::TemporaryDirectory directory;
  const std::filesystem::path path = directory / "a.tex";
  const auto info = info_of(TexelFormat::number, 9, 5);
  write_texture_file(path, info, sample_texel);
  const TextureFile file(path);
  std::array<std::uint32_t, max_tile_words> tile, other;
  std::filesystem::remove(path);
  EXPECT_EQ(file.read_tile(0, 0, 0, tile).words, 45u);
  write_texture_file(path, info, [](auto... at) { return TexelWords{sample_texel(at...)[0] + 1}; });
  const TextureFile successor(path);
  successor.read_tile(0, 0, 0, other);
  EXPECT_EQ(other[0], tile[0] + 1);
  EXPECT_THROW(file.read_tile(0, 0, 0, tile), Error) << "it is no longer there";
}

// Of more files than stay open every tile can be read.
TEST(TextureFile, ThereIsNoLimitToTheirNumber) {
  const test::TemporaryDirectory directory;
  std::vector<TextureFile> files;
  std::array<std::uint32_t, max_tile_words> tile;
  for (std::uint32_t i = 0; i < 300; ++i) {
    const std::filesystem::path path = directory / (std::to_string(i) + ".tex");
    write_texture_file(path, info_of(TexelFormat::number, 1, 1), [i](auto...) { return TexelWords{i}; });
    files.emplace_back(path);
  }
  for (int again = 0; again < 2; ++again)
    for (std::uint32_t i = 0; i < files.size(); ++i) {
      files[i].read_tile(0, 0, 0, tile);
      EXPECT_EQ(tile[0], i);
    }
}

TEST(TextureFile, WhatTheMachineRefuses) {
  EXPECT_THROW(TextureFile("/nowhere/a.tex"), MachineError);
  EXPECT_THROW(write_texture_file("/proc/a.tex", info_of(TexelFormat::number, 1, 1), sample_texel),
               MachineError);
}

TEST(Texel, RealNumbersInTwentyOneBits) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> exponent(-13.99f, 16.99f);
  for (int i = 0; i < 100'000; ++i) {
    const float value = (i % 2 ? 1.0f : -1.0f) * std::exp2(exponent(random));
    EXPECT_NEAR(decode_real21(encode_real21(value)), value, std::fabs(value) * 0x1p-16f);
  }
  EXPECT_EQ(decode_real21(encode_real21(0)), 0);
  EXPECT_EQ(decode_real21(encode_real21(INFINITY)), real21_max);
  EXPECT_EQ(decode_real21(encode_real21(-INFINITY)), -real21_max);
  EXPECT_EQ(decode_real21(encode_real21(NAN)), 0);
  for (std::uint32_t code = 1; code < 1u << 21; ++code)
    if ((code & 0xf8000u) != 0) {
      ASSERT_EQ(encode_real21(decode_real21(code)), code);
    }
}

double unpacked(const SigmoidNodes& x, double lambda) {
  const double t = (lambda - 595) / 235;
  const double v = t * (t - 1) / 2 * static_cast<double>(x[0]) + (1 - t * t) * static_cast<double>(x[1]) +
                   t * (t + 1) / 2 * static_cast<double>(x[2]);
  return 0.5 + v / (2 * std::sqrt(1 + v * v));
}

// The greatest |ΔS| of the stored reflectance of a colour.
double error_of(RGB color) {
  const SigmoidSpectrum s = reflectance_from_rgb(color);
  const TexelWords words = pack({nodes_of(s)});
  const SigmoidNodes x = unpack_nodes(words.data());
  double greatest = 0;
  for (double lambda = lambda_min_nm; lambda <= lambda_max_nm; lambda += 5)
    greatest = std::max(greatest, std::abs(unpacked(x, lambda) - evaluate(Spectrum{s}, lambda)));
  return greatest;
}

TEST(Texel, StoredReflectancesAreNear) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> u(0.001, 0.999);
  double greatest = 0;
  for (int i = 0; i < 3000; ++i) greatest = std::max(greatest, error_of({u(random), u(random), u(random)}));
  EXPECT_LT(greatest, 1e-4);
}

// Where spectra are steepest: |x| in the thousands, so that the parabola's values near 0 lose digits.
TEST(Texel, StoredReflectancesAtTheEdgesOfTheGamut) {
  constexpr std::array edges{0.0, 1e-4, 0.5, 0.999, 1.0};
  double greatest = 0;
  for (const double r : edges)
    for (const double g : edges)
      for (const double b : edges) greatest = std::max(greatest, error_of({r, g, b}));
  std::printf("greatest error of S: %.3g\n", greatest);
  EXPECT_LT(greatest, 2e-4);
}

TEST(Texel, BlackAndWhite) {
  for (const double v : {0.0, 1.0}) {
    const TexelWords words = pack({nodes_of(reflectance_from_rgb({v, v, v}))});
    const SigmoidNodes x = unpack_nodes(words.data());
    for (const double lambda : {360.0, 411.0, 595.0, 830.0}) EXPECT_NEAR(unpacked(x, lambda), v, 2e-11);
  }
}

}  // namespace

}  // namespace vitrail::texture_file_test
