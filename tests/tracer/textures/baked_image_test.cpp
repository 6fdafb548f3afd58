// SPDX-License-Identifier: Apache-2.0
#include "tracer/textures/baked_image.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <random>
#include <thread>

#include "scene/spectra/rgb_to_spectrum.h"
#include "scene/system/diagnostics.h"
#include "tests/support/temporary_directory.h"
#include "tracer/textures/tile_cache.h"

namespace vitrail::baked_image_test {

namespace {

constexpr SampledWavelengths some_wavelengths{{430, 512.5f, 601, 700}, {1, 1, 1, 1}};
constexpr std::array all_wraps{Wrap::repeat, Wrap::mirror, Wrap::clamp, Wrap::black};

float number_at(std::uint32_t level, std::uint32_t x, std::uint32_t y) {
  return static_cast<float>(level) * 1000 + static_cast<float>(x) + static_cast<float>(y) / 512;
}

// An image of numbers, each its own.
std::filesystem::path write_numbers(const std::filesystem::path& path, std::uint32_t width,
                                    std::uint32_t height) {
  write_texture_file(path, {TexelFormat::number, width, height, texture_level_count(width, height)},
                     [](std::uint32_t level, std::uint32_t x, std::uint32_t y) {
                       return TexelWords{std::bit_cast<std::uint32_t>(number_at(level, x, y))};
                     });
  return path;
}

// Texel i of an endless row, by walking there.
long long plain_wrap(long long i, long long n, Wrap wrap) {
  if (wrap == Wrap::repeat) {
    while (i < 0) i += n;
    while (i >= n) i -= n;
    return i;
  }
  if (wrap == Wrap::mirror) {
    while (i < 0 || i >= n) i = i < 0 ? -1 - i : 2 * n - 1 - i;
    return i;
  }
  if (wrap == Wrap::clamp) return i < 0 ? 0 : i >= n ? n - 1 : i;
  return i < 0 || i >= n ? -1 : i;
}

double plain_texel(const BakedImage& image, long long x, long long y, Wrap wrap, int level) {
  x = plain_wrap(x, image.width(level), wrap);
  y = plain_wrap(y, image.height(level), wrap);
  if (x < 0 || y < 0) return 0;
  return static_cast<double>(number_at(static_cast<std::uint32_t>(level), static_cast<std::uint32_t>(x),
                                       static_cast<std::uint32_t>(y)));
}

double plain_bilinear(const BakedImage& image, double s, double t, Wrap wrap, int level) {
  double sum = 0;
  const double x = s * image.width(level) - 0.5, y = t * image.height(level) - 0.5;
  for (int dy = 0; dy < 2; ++dy)
    for (int dx = 0; dx < 2; ++dx) {
      const double fx = x - std::floor(x), fy = y - std::floor(y);
      sum +=
          (dx ? fx : 1 - fx) * (dy ? fy : 1 - fy) *
          plain_texel(image, std::llround(std::floor(x)) + dx, std::llround(std::floor(y)) + dy, wrap, level);
    }
  return sum;
}

TEST(BakedImage, WrapsAndBlendsAsAnEndlessImage) {
  const test::TemporaryDirectory directory;
  const auto cache = std::make_shared<TileCache>(1 << 20);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(-3.3, 4.2);
  for (const auto [width, height] : {std::array{1u, 1u}, {5u, 3u}, {130u, 70u}}) {
    const BakedImage image(write_numbers(directory / "a.tex", width, height), cache);
    for (const Wrap wrap : all_wraps)
      for (int level = 0; level < std::min(image.levels(), 3); ++level)
        for (int i = 0; i < 2000; ++i) {
          const double s = i % 10 == 0 ? std::floor(u(random)) : u(random);
          const double t = i % 7 == 0 ? std::floor(u(random)) : u(random);
          const auto nearest = static_cast<double>(image.nearest(s, t, wrap, level, some_wavelengths).v[1]);
          const auto x = std::llround(std::floor(s * image.width(level)));
          const auto y = std::llround(std::floor(t * image.height(level)));
          // Folding may round a point on the edge between two texels to its other side.
          if (s != std::floor(s) && t != std::floor(t)) {
            ASSERT_EQ(nearest, plain_texel(image, x, y, wrap, level)) << s << ' ' << t;
          }
          const double expected = plain_bilinear(image, s, t, wrap, level);
          ASSERT_NEAR(static_cast<double>(image.bilinear(s, t, wrap, level, some_wavelengths).v[2]), expected,
                      2e-6 * (3000 + width));
          ASSERT_NEAR(image.bilinear_vector(s, t, wrap, level)[1], expected, 2e-6 * (3000 + width));
        }
  }
}

TEST(BakedImage, AnswersFarOffAndForNothing) {
  const test::TemporaryDirectory directory;
  const BakedImage image(write_numbers(directory / "a.tex", 5, 3), std::make_shared<TileCache>(1 << 20));
  for (const Wrap wrap : all_wraps)
    for (const double s : {1e300, -1e300, 1e17, -0.0, -1e-320, double(INFINITY), double(NAN)})
      for (const double t : {0.5, s}) {
        EXPECT_TRUE(std::isfinite(image.bilinear(s, t, wrap, 0, some_wavelengths).v[0]));
        EXPECT_TRUE(std::isfinite(image.nearest(s, t, wrap, 0, some_wavelengths).v[0]));
      }
}

RGB color_at(std::uint32_t x, std::uint32_t y) { return {0.1 + 0.2 * x, 0.05 + 0.25 * y, 0.3}; }
float factor_at(std::uint32_t x, std::uint32_t y) { return static_cast<float>(0.25 + 8 * x + 3 * y); }

// What the texels send out, not their colours apart from their brightness: bright blue beside dim red would
// lose a fifth of its blue halfway.
TEST(BakedImage, BlendsTheSpectraOfTexels) {
  const test::TemporaryDirectory directory;
  const auto cache = std::make_shared<TileCache>(1 << 20);
  const auto write = [&](TexelFormat format) {
    write_texture_file(directory / "a.tex", {format, 4, 3, 1},
                       [&](std::uint32_t, std::uint32_t x, std::uint32_t y) {
                         return pack({nodes_of(reflectance_from_rgb(color_at(x, y))), factor_at(x, y)});
                       });
    return directory / "a.tex";
  };
  const auto expected = [&](bool scaled, float lambda, double s, double t) {
    double sum = 0;
    const double fx = s * 4 - 0.5, fy = t * 3 - 0.5;  // between texels (0,0) and (1,1)
    for (std::uint32_t y = 0; y < 2; ++y)
      for (std::uint32_t x = 0; x < 2; ++x)
        sum += (x ? fx : 1 - fx) * (y ? fy : 1 - fy) * (scaled ? static_cast<double>(factor_at(x, y)) : 1) *
               evaluate(Spectrum{reflectance_from_rgb(color_at(x, y))}, static_cast<double>(lambda));
    return sum;
  };
  for (const TexelFormat format :
       {TexelFormat::reflectance, TexelFormat::unbounded, TexelFormat::illuminant}) {
    const BakedImage image(write(format), cache);
    const SampledSpectrum value = image.bilinear(0.3, 0.4, Wrap::clamp, 0, some_wavelengths);
    for (std::size_t i = 0; i < hero_count; ++i) {
      const float lambda = some_wavelengths.lambda_nm[i];
      const double light = format == TexelFormat::illuminant
                               ? evaluate(Spectrum{emission_from_rgb({1, 1, 1})}, static_cast<double>(lambda))
                               : 1;
      const double blend = expected(format != TexelFormat::reflectance, lambda, 0.3, 0.4);
      EXPECT_NEAR(static_cast<double>(value.v[i]), light * blend, 5e-5 * light * std::max(blend, 1.0));
    }
  }
}

TEST(BakedImage, LuminanceIsNearTheColors) {
  const test::TemporaryDirectory directory;
  write_texture_file(directory / "a.tex", {TexelFormat::illuminant, 4, 4, 1},
                     [&](std::uint32_t, std::uint32_t x, std::uint32_t y) {
                       const RgbIlluminantSpectrum e = emission_from_rgb(color_at(x, y));
                       return pack({nodes_of(e.shape), e.scale});
                     });
  const BakedImage image(directory / "a.tex", std::make_shared<TileCache>(1 << 20));
  for (std::uint32_t y = 0; y < 4; ++y)
    for (std::uint32_t x = 0; x < 4; ++x) {
      const double y_of_color = srgb_to_xyz(color_at(x, y)).y;
      EXPECT_NEAR(image.luminance(static_cast<int>(x), static_cast<int>(y), 0), y_of_color,
                  0.04 * y_of_color);
    }
}

// Fields of tiles, looked at everywhere: sums of what four threads see.
std::vector<double> values_under(std::uint64_t budget, const std::filesystem::path& path, int threads,
                                 std::uint64_t& loads) {
  const auto cache = std::make_shared<TileCache>(budget);
  const BakedImage image(path, cache);
  std::vector<double> values(40'000);
  std::vector<std::thread> all;
  for (int thread = 0; thread < threads; ++thread)
    all.emplace_back([&, thread] {
      for (std::size_t i = static_cast<std::size_t>(thread); i < values.size();
           i += static_cast<std::size_t>(threads)) {
        const double s = static_cast<double>(i * 7919 % 10007) / 10007;
        const double t = static_cast<double>(i * 104729 % 10009) / 10009;
        values[i] = static_cast<double>(image.bilinear(s, t, Wrap::repeat, 0, some_wavelengths).v[0]);
        EXPECT_LE(cache->resident_bytes(), std::max(budget, TileCache::slot_bytes));
      }
    });
  for (std::thread& thread : all) thread.join();
  loads = cache->tile_loads();
  return values;
}

TEST(TileCache, ValuesDoNotDependOnWhatIsInMemory) {
  const test::TemporaryDirectory directory;
  const std::filesystem::path path = write_numbers(directory / "a.tex", 300, 200);  // 5 × 4 tiles
  std::uint64_t loads = 0;
  const std::vector<double> expected = values_under(1 << 30, path, 1, loads);
  EXPECT_EQ(loads, 20u);
  for (const std::uint64_t slots : {0, 1, 3, 19}) {
    EXPECT_EQ(values_under(slots * TileCache::slot_bytes, path, 4, loads), expected);
    EXPECT_GT(loads, 100u);
  }
}

TEST(TileCache, KeepsWhatIsUsed) {
  const test::TemporaryDirectory directory;
  const std::filesystem::path path = write_numbers(directory / "a.tex", 64 * 8, 64);  // 8 tiles
  const auto cache = std::make_shared<TileCache>(4 * TileCache::slot_bytes);
  const BakedImage image(path, cache);
  // Every other lookup is in tile 0; the others go round seven tiles, for which three slots are left.
  constexpr int rounds = 300;
  for (int i = 0; i < rounds; ++i) {
    image.texel(5, 5, 0, some_wavelengths);
    image.texel(64 * (1 + i % 7) + 5, 5, 0, some_wavelengths);
  }
  EXPECT_LE(cache->tile_loads(), 1 + rounds + 1u);
  EXPECT_EQ(cache->resident_bytes(), 4 * TileCache::slot_bytes);
}

TEST(BakedImage, DamagedTileIsAnErrorWhenItIsRead) {
  const test::TemporaryDirectory directory;
  const std::filesystem::path path = write_numbers(directory / "a.tex", 128, 64);
  {
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(-1, std::ios::end);
    file.put(1);  // in the last tile, that of the last level
  }
  const BakedImage image(path, std::make_shared<TileCache>(1 << 20));
  EXPECT_NO_THROW(image.texel(0, 0, 0, some_wavelengths));
  EXPECT_THROW(image.texel(0, 0, image.levels() - 1, some_wavelengths), Error);
}

}  // namespace

}  // namespace vitrail::baked_image_test
