// SPDX-License-Identifier: Apache-2.0
#include "bundle/light_code.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "bundle/reflectances/color_words.h"

namespace vitrail::light_code_test {

namespace {

constexpr std::uint32_t first_infinite = 0xff80;  // codes from here on are no numbers

TEST(LightCode, EveryValueHasItsCode) {
  for (std::uint32_t code = 0; code < first_infinite; ++code) {
    const float value = value_of_code(code);
    ASSERT_TRUE(std::isfinite(value));
    const auto back = exact_code(value);
    ASSERT_TRUE(back) << code;
    ASSERT_EQ(value_of_code(*back), value) << code;
    ASSERT_EQ(value_of_code(nearest_code(value)), value) << code;
  }
}

TEST(LightCode, HalfFloatsAndRadiancesValuesAreExact) {
  EXPECT_EQ(value_of_code(0x3c00), 1.0f);
  EXPECT_EQ(value_of_code(0x7bff), 65504.0f);
  EXPECT_EQ(value_of_code(1), 0x1p-24f);
  for (int exponent = -100; exponent < 100; ++exponent)
    for (int mantissa = 0; mantissa < 256; ++mantissa) {
      const float value = std::ldexp(static_cast<float>(mantissa), exponent);
      const auto code = exact_code(value);
      ASSERT_TRUE(code) << mantissa << " · 2^" << exponent;
      ASSERT_EQ(value_of_code(*code), value);
    }
  for (const float none : {0.1f, 1.0001f, 65505.0f, 1e-9f, 1.001f * 0x1p-20f}) EXPECT_FALSE(exact_code(none));
  EXPECT_EQ(exact_code(-0.0f), exact_code(0.0f));
}

TEST(LightCode, TheNearestIsWithinItsBound) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> exponent(-30, 40);
  for (int i = 0; i < 200000; ++i) {
    const float value = std::exp2(exponent(random));
    const double error = std::abs(static_cast<double>(value_of_code(nearest_code(value))) / value - 1);
    ASSERT_LE(error, value >= 0x1p-14f && value < 65504 ? 0x1p-11 : 0x1p-8) << value;
  }
  EXPECT_TRUE(std::isfinite(value_of_code(nearest_code(std::numeric_limits<float>::max()))));
}

// Also where another thread has stored the first two words of the spectrum, not yet the third.
TEST(LightCode, WordsTellTheColourAndItsScale) {
  const ReflectanceFitter fitter;
  std::mt19937 random(2);
  for (int i = 0; i < 20000; ++i) {
    LightCodes codes{};
    for (std::uint32_t& c : codes)
      c = static_cast<std::uint32_t>(random() % (i % 2 ? first_infinite : 0x4000));
    const TexelWords words = words_of_codes(codes);
    ASSERT_TRUE(is_color_code(words[1]) && is_color_code(words[2]));
    ASSERT_EQ(codes_of_words(words), codes);
    if (i > 2000) continue;
    const TexelWords found = found_words(TexelFormat::light_code_16, words, {}, fitter);
    ASSERT_FALSE(is_color_code(found[1]) || is_color_code(found[2]));
    ASSERT_EQ(found_words(TexelFormat::light_code_16, {found[0], found[1], words[2]}, {}, fitter), found);
  }
}

}  // namespace
}  // namespace vitrail::light_code_test
