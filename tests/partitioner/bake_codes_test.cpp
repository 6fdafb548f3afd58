// SPDX-License-Identifier: Apache-2.0
#include "partitioner/appearance/bake_codes.h"

#include <atomic>
#include <cmath>
#include <random>
#include <thread>

#include "bundle/light_code.h"
#include "bundle/reflectances/color_words.h"
#include "partitioner/appearance/bake_light_codes.h"
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

TexelFormat format_of_file(const std::filesystem::path& file) { return TextureFile(file).info().format; }
TexelFormat format_of(const test::BakedScene& s, const char* name) {
  return format_of_file(s.directory / "b.vit/textures" / name);
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

// Threads with much memory and with room for one tile read the same words in both files, but in column 0.
void expect_equal_words(const test::BakedScene& s, int width, int height) {
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
        const int x = 1 + static_cast<int>(random() % static_cast<unsigned>(width - 1)),
                  y = static_cast<int>(random() % static_cast<unsigned>(height));
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

// By the words of the texels: those that write_baked_image stores of the same values. A value in column 0
// that has no code makes it store spectra.
TEST(BakeCodes, TexelsAreThoseOfTheValuesWhateverTheMemoryAndThreads) {
  constexpr int width = 200, height = 150;
  test::BakedScene s;
  const auto pixels = dark_and_bright(width, height, 3);
  const auto rows = byte_rows(png(s, "a.png", width, 3, pixels));
  const ReflectanceFitter fitter;
  for (const TextureUse use : {TextureUse::reflectance, TextureUse::illuminant}) {
    const auto coded = coded_image(s.image("a.png"), *rows, use, {});
    ASSERT_TRUE(coded);
    EXPECT_EQ(coded->format,
              use == TextureUse::illuminant ? TexelFormat::light_code : TexelFormat::color_code);
    write_coded_image(s.directory / "codes.tex", *rows, *coded, false);
    Image values = black_image(width, height, 3);
    for (std::size_t i = 0; i < pixels.size(); ++i) values.values[i] = coded->values[pixels[i]];
    values.values[0] = 0.1f;
    write_baked_image(s.directory / "spectra.tex", rows_of(values), use, false, fitter);
    EXPECT_FALSE(finds_spectra(format_of_file(s.directory / "spectra.tex")));
    expect_equal_words(s, width, height);
  }
}

// Of half floats, of Radiance's values beyond them, and of both.
TEST(BakeCodes, LightKeepsItsNumbers) {
  constexpr int width = 90, height = 70;
  test::BakedScene s;
  const ReflectanceFitter fitter;
  std::mt19937 random(3);
  for (const std::uint32_t kinds : {0u, 1u, 2u}) {
    Image values = black_image(width, height, 3);
    for (float& v : values.values) {
      const auto any = [&](std::uint32_t below) { return static_cast<std::uint32_t>(random() % below); };
      const std::uint32_t kind = kinds < 2 ? kinds : any(2);
      v = value_of_code(kind == 0 ? any(0x7c00) : 0x8000 + 0x2800 + any(0x2000));
    }
    for (int i = 0; i < 9; ++i) values.values[30 + static_cast<std::size_t>(i)] = i < 3 ? 0 : 0.5f;  // greys
    const auto written = write_light_codes(s.directory / "codes.tex", rows_of(values), false);
    ASSERT_TRUE(written);
    EXPECT_EQ(written->read_bytes, 12u * width * height);
    EXPECT_LT(written->bytes, 6u * width * height + 200);
    values.values[0] = 0.1f;
    write_baked_image(s.directory / "spectra.tex", rows_of(values), TextureUse::illuminant, false, fitter);
    EXPECT_EQ(format_of_file(s.directory / "spectra.tex"), TexelFormat::illuminant);
    expect_equal_words(s, width, height);
    EXPECT_FALSE(write_light_codes(s.directory / "none.tex", rows_of(values), false));
    EXPECT_FALSE(std::filesystem::exists(s.directory / "none.tex"));
  }
}

// Each texel of a coarser level is the mean of four, to a code.
TEST(BakeCodes, LevelsOfLightAreMeans) {
  constexpr int size = 64;
  test::BakedScene s;
  Image values = black_image(size, size, 1);
  std::mt19937 random(5);
  for (float& v : values.values) v = value_of_code(static_cast<std::uint32_t>(0x2000 + random() % 0x3000));
  ASSERT_TRUE(write_light_codes(s.directory / "codes.tex", rows_of(values), true));
  const BakedImage codes(s.directory / "codes.tex", std::make_shared<TileCache>(1 << 20));
  ASSERT_EQ(codes.levels(), 7);
  for (int y = 0; y < size / 2; ++y)
    for (int x = 0; x < size / 2; ++x) {
      double mean = 0;
      for (const int i : {0, 1})
        for (const int j : {0, 1})
          mean +=
              0.25 * static_cast<double>(
                         values.values[static_cast<std::size_t>((size - 1 - 2 * y - i) * size + 2 * x + j)]);
      EXPECT_NEAR(codes.luminance(x, y, 1), mean, 1e-3 * mean);
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

TEST(BakeCodes, NumbersAreOfTheirChannel) {
  test::BakedScene s;
  png(s, "a.png", 1, 3, {10, 100, 200});
  const auto value = [&](ImageNumber number) {
    ImageTexture channel = s.image("a.png");
    channel.number = number, channel.encoding = Encoding::linear;
    const FloatParameter baked = s.bake().bake(FloatParameter{s.add(channel, true)});
    s.baker->files();
    EXPECT_EQ(format_of(s, "000000.tex"), TexelFormat::number_code);
    return s.look_up().number(baked, at_uv(0.5, 0.5));
  };
  EXPECT_NEAR(value(ImageNumber::red), 10 / 255.0, 1e-6);
  EXPECT_NEAR(value(ImageNumber::green), 100 / 255.0, 1e-6);
  EXPECT_NEAR(value(ImageNumber::blue), 200 / 255.0, 1e-6);
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
  EXPECT_TRUE(is_coded(bright, TextureUse::illuminant));
  EXPECT_FALSE(is_coded(plain, TextureUse::illuminant, RgbMethod::matrix_r));
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
