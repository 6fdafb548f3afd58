// SPDX-License-Identifier: Apache-2.0
#include "compare/web_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "compare/comparison_page.h"

namespace vitrail::web_page_test {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string encoded(const std::string& text) {
  return base64(std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

TEST(Base64, IsThatOfTheStandard) {  // RFC 4648, section 10
  EXPECT_EQ(encoded(""), "");
  EXPECT_EQ(encoded("f"), "Zg==");
  EXPECT_EQ(encoded("fo"), "Zm8=");
  EXPECT_EQ(encoded("foobar"), "Zm9vYmFy");
}

double value_of(std::uint16_t half) {
  const int exponent = half >> 10 & 31, mantissa = half & 1023;
  const double size = exponent == 0 ? std::ldexp(mantissa, -24) : std::ldexp(1024 + mantissa, exponent - 25);
  return half & 0x8000 ? -size : size;
}

TEST(HalfFloats, AreTheNearest) {
  EXPECT_EQ(to_half(1), 0x3c00);
  EXPECT_EQ(to_half(-2), 0xc000);
  EXPECT_EQ(to_half(65504), 0x7bff);
  EXPECT_EQ(to_half(65520), 0x7c00);
  EXPECT_EQ(to_half(1e30f), 0x7c00);
  EXPECT_EQ(to_half(0x1p-24f), 1);
  EXPECT_EQ(to_half(0x1p-25f), 0);  // to even
  EXPECT_EQ(to_half(1 + 0x1p-11f), 0x3c00);
  EXPECT_EQ(to_half(1 + 3 * 0x1p-11f), 0x3c02);
  EXPECT_TRUE((to_half(std::numeric_limits<float>::quiet_NaN()) & 0x7fff) > 0x7c00);
  for (float v = 1e-7f; v < 6e4f; v *= 1.37f) {
    const double step = std::max(0x1p-24, std::ldexp(1, std::ilogb(v) - 10));
    EXPECT_LE(std::abs(value_of(to_half(v)) - static_cast<double>(v)), step / 2) << v;
  }
}

TEST(Page, HoldsItsDataWhateverTheNamesAre) {
  const Image image{2, 1, 3, {1, 0.5f, 0, 0, 0, 2}};
  const std::string page =
      comparison_page({"</script><script>alert(1)", "b", &image, &image, 0, 0, 67, false});
  EXPECT_THAT(page, Not(HasSubstr("</script><script>alert")));
  EXPECT_THAT(page, HasSubstr("\\u003c/script>"));
  EXPECT_THAT(page, Not(HasSubstr("@DATA@")));
  // 1, 0.5, 0, 0, 0, 2 as halves in units of 2^−13.
  EXPECT_THAT(page, HasSubstr("{\"unit\":0.0001220703125,\"halves\":\"AHAAbAAAAAAAAAB0\"}"));
  for (const char* other : {"http://", "https://", "src=", "@import", "url("})
    EXPECT_THAT(page, Not(HasSubstr(other))) << "a page needs nothing but itself";
}

TEST(Page, HasTheRatiosOfTheImageOverTheReference) {
  const Image image{1, 1, 3, {0.5f, 3, 2}}, reference{1, 1, 3, {1, 1, 1}};
  const std::string page = comparison_page({"a", "b", &image, &reference, 0, 0, 67, false});
  EXPECT_THAT(page, HasSubstr(R"(["red",0.5,)"));
  EXPECT_THAT(page, HasSubstr(R"(["green",3.0,)"));
  EXPECT_THAT(page, HasSubstr(R"(["blue",2.0,)"));
}

// What stands in the page after `"name":"mse"`: the unit of that map, and its pixels.
std::pair<double, std::string> squares_of(const std::string& page) {
  const auto after = [&](const std::string& mark, std::size_t from) {
    return page.find(mark, from) + mark.size();
  };
  const std::size_t map = page.find("\"name\":\"mse\""), pixels = after("\"halves\":\"", map);
  return {std::stod(page.substr(after("\"unit\":", map), 40)),
          page.substr(pixels, page.find('"', pixels) - pixels)};
}

TEST(Page, KeepsTheBitsOfPicturesOfAnyBrightness) {
  const auto page = [](float brightness) {
    Image image{2, 1, 3, {1, 0.5f, 0, 0, 0, 2}};
    for (float& v : image.values) v *= brightness;
    const Image dark = black_image(2, 1, 3);
    return comparison_page({"a", "b", &image, &dark, 0, 0, 67, false});
  };
  const auto [unit, squares] = squares_of(page(1));
  for (const float brightness : {0x1p-30f, 0x1p30f}) {
    const std::string scaled = page(brightness);
    EXPECT_THAT(scaled, HasSubstr("\"AHAAbAAAAAAAAAB0\"")) << "the image: as with brightness 1";
    const double twice = static_cast<double>(brightness) * static_cast<double>(brightness);
    EXPECT_EQ(squares_of(scaled), std::pair(twice * unit, squares));
  }
}

}  // namespace
}  // namespace vitrail::web_page_test
