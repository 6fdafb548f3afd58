// SPDX-License-Identifier: Apache-2.0
#include "partitioner/appearance/bake_codes.h"

#include <atomic>
#include <cmath>
#include <random>
#include <thread>

#include "bundle/reflectances/color_words.h"
#include "scene/system/diagnostics.h"
#include "tests/images/png_file.h"
#include "tests/partitioner/baked_scene.h"
#include "tracer/textures/baked_image.h"
#include "tracer/textures/tile_cache.h"

namespace vitrail::bake_codes_test {

namespace {

using test::at_uv;
using test::some_wavelengths;

// Of all brightnesses, half of them near black.
std::vector<std::uint8_t> dark_and_bright(int width, int height, int channels) {
  std::mt19937 random(7);
  std::vector<std::uint8_t> pixels(static_cast<std::size_t>(width * height * channels));
  for (std::uint8_t& p : pixels) p = static_cast<std::uint8_t>(random() % 2 ? random() : random() % 12);
  return pixels;
}

std::filesystem::path png(const test::BakedScene& s, const char* name, int width, int channels,
                          const std::vector<std::uint8_t>& pixels) {
  test::write_file(s.directory / name, test::png_of(width, channels, pixels, {0, 4, 1}));
  return s.directory / name;
}

RGB decoded(const std::uint8_t* p) {
  return {srgb_decode(p[0] / 255.0), srgb_decode(p[1] / 255.0), srgb_decode(p[2] / 255.0)};
}

TexelFormat format_of(const test::BakedScene& s, const char* name) {
  return TextureFile(s.directory / "b.vit/textures" / name).info().format;
}

TEST(BakeCodes, EveryColourIsFoundAtItsPlace) {
  constexpr int width = 131, height = 77;
  test::BakedScene s;
  const auto pixels = dark_and_bright(width, height, 3);
  png(s, "a.png", width, 3, pixels);
  const SpectrumParameter baked = s.bake().bake(s.add(s.image("a.png")), TextureUse::reflectance);
  const TextureFileEntry entry = s.baker->files().at(0);
  EXPECT_EQ(entry.bytes, std::filesystem::file_size(s.directory / "b.vit" / entry.name));
  EXPECT_EQ(entry.read_bytes, 8u * width * height);
  EXPECT_EQ(format_of(s, "000000.tex"), TexelFormat::color_code);
  TextureFile(s.directory / "b.vit" / entry.name).check_tiles();
  const Textures textures = s.look_up();
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const TexturePoint at = at_uv((x + 0.5) / width, 1 - (y + 0.5) / height);
      const RGB color = decoded(&pixels[static_cast<std::size_t>(3 * (y * width + x))]);
      for (int again = 0; again < 2; ++again)  // found, and kept
        test::expect_near(textures.spectrum(baked, at, some_wavelengths), reflectance_from_rgb(color), 2e-3);
    }
}

// By the words of the texels: those that write_baked_image stores of the same values.
TEST(BakeCodes, TexelsAreThoseOfTheValuesWhateverTheMemoryAndThreads) {
  constexpr int width = 200, height = 150;
  test::BakedScene s;
  const auto pixels = dark_and_bright(width, height, 3);
  const auto rows = byte_rows(png(s, "a.png", width, 3, pixels));
  const auto coded = coded_image(s.image("a.png"), *rows, TextureUse::reflectance, {});
  ASSERT_TRUE(coded);
  write_coded_image(s.directory / "codes.tex", *rows, *coded, false);
  const ReflectanceFitter fitter;
  Image values = black_image(width, height, 3);
  for (std::size_t i = 0; i < pixels.size(); ++i) values.values[i] = coded->values[pixels[i]];
  write_baked_image(s.directory / "spectra.tex", rows_of(values), TextureUse::reflectance, false, fitter);
  const auto words_of = [&](const BakedImage& image, int x, int y) {
    TexelWords words{};
    const std::int32_t at_x = x, at_y = y;
    image.read_texels(0, 1, 1, &at_x, &at_y, words.data());
    return words;
  };
  const BakedImage spectra(s.directory / "spectra.tex", std::make_shared<TileCache>(1 << 20));
  for (const std::uint64_t budget : {std::uint64_t{1} << 20, TileCache::slot_bytes}) {
    const BakedImage codes(s.directory / "codes.tex", std::make_shared<TileCache>(budget));
    std::atomic<int> different = 0;
    const auto compare = [&](unsigned seed) {
      std::mt19937 random(seed);
      for (int i = 0; i < 20000; ++i) {
        const int x = static_cast<int>(random() % width), y = static_cast<int>(random() % height);
        if (words_of(codes, x, y) != words_of(spectra, x, y)) ++different;
      }
    };
    {
      std::vector<std::jthread> threads;
      for (unsigned t = 0; t < 4; ++t) threads.emplace_back(compare, t);
    }
    EXPECT_EQ(different, 0);
  }
}

TEST(BakeCodes, LevelsAreTheMeansToACodeAndRightOverSome) {
  constexpr int size = 128;
  test::BakedScene s;
  const auto pixels = dark_and_bright(size, size, 3);
  const auto rows = byte_rows(png(s, "a.png", size, 3, pixels));
  const auto coded = coded_image(s.image("a.png"), *rows, TextureUse::reflectance, {});
  const WrittenTextureFile written = write_coded_image(s.directory / "a.tex", *rows, *coded, true);
  EXPECT_LT(written.bytes, 1.4 * 3 * size * size + 4096);
  const TextureFile file(s.directory / "a.tex");
  std::vector<double> exact;
  for (const std::uint8_t p : pixels) exact.push_back(static_cast<double>(coded->values[p]));
  for (std::uint32_t l = 1, n = size / 2; n >= 8; ++l, n /= 2) {
    std::vector<double> half(3 * n * n);
    for (std::size_t i = 0; i < half.size(); ++i) {
      const std::size_t x = i / 3 % n, y = i / 3 / n, c = i % 3;
      const auto at = [&](std::size_t dx, std::size_t dy) {
        return exact[3 * ((2 * y + dy) * 2 * n + 2 * x + dx) + c];
      };
      half[i] = (at(0, 0) + at(1, 0) + at(0, 1) + at(1, 1)) / 4;
    }
    exact = half;
    std::array<double, 3> off{};
    double step = 0;
    const BakedImage image(s.directory / "a.tex", std::make_shared<TileCache>(1 << 20));
    std::array<std::uint32_t, max_tile_words> tile;
    file.read_tile(l, 0, 0, tile);
    const std::uint32_t seen = std::min(n, 32u);
    for (std::uint32_t row = 0; row < seen; ++row)
      for (std::uint32_t x = 0; x < n; ++x)
        for (std::size_t c = 0; c < 3; ++c) {
          const std::uint32_t code = tile[2 * (row * std::min(n, 64u) + x) + 1] >> (8 * c) & 255;
          const double value = static_cast<double>(coded->values[code]);
          const double wanted = exact[3 * ((n - 1 - row) * n + x) + c];
          const double next = static_cast<double>(coded->values[std::min(code + 1, 255u)]) - value;
          EXPECT_LE(std::abs(value - wanted), next + 1e-6) << "level " << l;
          off[c] += value - wanted;
          step = std::max(step, next);
        }
    for (const double sum : off) EXPECT_LT(std::abs(sum) / (seen * n), 1.5 * step / std::sqrt(seen * n));
  }
}

TEST(BakeCodes, NumbersAndGreysTakeAByte) {
  constexpr int width = 70, height = 66;
  test::BakedScene s;
  const auto pixels = dark_and_bright(width, height, 4);
  png(s, "rgba.png", width, 4, pixels);
  ImageTexture alpha = s.image("rgba.png");
  alpha.number = ImageNumber::alpha, alpha.encoding = Encoding::linear, alpha.scale = 0.5f;
  auto grey = pixels;
  for (std::size_t i = 0; i < grey.size(); i += 4) grey[i + 1] = grey[i + 2] = grey[i];
  png(s, "grey.png", width, 4, grey);
  const Id<Texture> number = s.add(alpha, true), shade = s.add(s.image("grey.png"));
  TextureBaker& baker = s.bake();
  const FloatParameter baked = baker.bake(FloatParameter{number});
  const SpectrumParameter color = baker.bake(shade, TextureUse::reflectance);
  baker.files();
  EXPECT_EQ(format_of(s, "000000.tex"), TexelFormat::number_code);
  EXPECT_EQ(format_of(s, "000001.tex"), TexelFormat::number_code);
  const Textures textures = s.look_up();
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const TexturePoint at = at_uv((x + 0.5) / width, 1 - (y + 0.5) / height);
      const auto p = static_cast<std::size_t>(4 * (y * width + x));
      EXPECT_NEAR(textures.number(baked, at), 0.5 * pixels[p + 3] / 255.0, 1e-6);
      EXPECT_NEAR(static_cast<double>(textures.spectrum(color, at, some_wavelengths).v[0]),
                  srgb_decode(grey[p] / 255.0), 1e-6);
    }
}

TEST(BakeCodes, WhatIsNoFunctionOfAByteIsBakedAsBefore) {
  constexpr int width = 9, height = 5;
  test::BakedScene s;
  png(s, "a.png", width, 3, dark_and_bright(width, height, 3));
  const auto rows = byte_rows(s.directory / "a.png");
  ImageTexture plain = s.image("a.png"), inverted = plain, bright = plain;
  inverted.invert = true;
  bright.scale = 2;
  const auto is_coded = [&](const ImageTexture& t, TextureUse use, RgbMethod method = {}) {
    return coded_image(t, *rows, use, method).has_value();
  };
  EXPECT_TRUE(is_coded(plain, TextureUse::reflectance));
  EXPECT_TRUE(is_coded(plain, TextureUse::unbounded));
  EXPECT_TRUE(is_coded(bright, TextureUse::reflectance)) << "clamped to 1";
  EXPECT_FALSE(is_coded(bright, TextureUse::unbounded));
  EXPECT_FALSE(is_coded(inverted, TextureUse::reflectance));
  EXPECT_FALSE(is_coded(plain, TextureUse::number)) << "a mean of three";
  EXPECT_FALSE(is_coded(plain, TextureUse::vector));
  EXPECT_FALSE(is_coded(plain, TextureUse::illuminant));
  EXPECT_FALSE(is_coded(plain, TextureUse::reflectance, RgbMethod::matrix_r));
}

TEST(BakeCodes, DamagedPixelsAreSaidWithTheirTexture) {
  test::BakedScene s;
  std::string bytes = test::png_of(64, 3, dark_and_bright(64, 64, 3), {0});
  bytes.resize(bytes.size() / 2);
  test::write_file(s.directory / "a.png", bytes);
  TextureBaker& baker = s.bake();
  try {
    baker.bake(s.add(s.image("a.png")), TextureUse::reflectance);
    baker.files();
    ADD_FAILURE() << "half of an image was baked";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("a.png: cannot read the image"), std::string::npos)
        << error.what();
  }
}

}  // namespace

}  // namespace vitrail::bake_codes_test
