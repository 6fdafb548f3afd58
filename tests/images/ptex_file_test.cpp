// SPDX-License-Identifier: Apache-2.0
#include "images/ptex_file.h"

#include <gmock/gmock.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>

#include "images/ptex_means.h"
#include "scene/system/diagnostics.h"
#include "tests/images/ptex_bytes.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::ptex_file_test {
namespace {

using namespace test;
using testing::ElementsAre;
using testing::FloatNear;
using testing::HasSubstr;

class Ptex : public testing::Test {
 protected:
  static std::string constant_faces(PtexType type, int channels, std::size_t faces,
                                    const std::string& means) {
    std::vector<PtexFace> all;
    for (std::size_t f = 0; f < faces; ++f)
      all.push_back({0, 0, means.substr(f * means.size() / faces, means.size() / faces)});
    return ptex_bytes(type, channels, all);
  }
  std::string write(const std::string& bytes) {
    const std::filesystem::path file = folder_ / "a.ptx";
    std::ofstream(file, std::ios::binary) << bytes;
    return file.string();
  }
  std::vector<float> means(const std::string& bytes) { return PtexFile(write(bytes)).means(); }

  TemporaryDirectory folder_;
};

const std::string two_faces("\xff\x80\x33\xff\x00\x33", 6);

TEST_F(Ptex, NumbersOfEveryType) {
  EXPECT_THAT(
      means(constant_faces(PtexType::uint8, 3, 2, two_faces)),
      ElementsAre(1, FloatNear(128 / 255.f, 1e-7f), FloatNear(.2f, 1e-7f), 1, 0, FloatNear(.2f, 1e-7f)));
  std::string words, halves, floats;
  for (const int v : {0, 13107, 65535}) put(words, static_cast<std::uint16_t>(v));
  for (const int v : {0x3800, 0xc000, 0x0001}) put(halves, static_cast<std::uint16_t>(v));
  for (const float v : {.25f, -3.0f, 1e-8f}) put(floats, v);
  EXPECT_THAT(means(constant_faces(PtexType::uint16, 1, 3, words)), ElementsAre(0, FloatNear(.2f, 1e-7f), 1));
  EXPECT_THAT(means(constant_faces(PtexType::half, 1, 3, halves)), ElementsAre(.5f, -2, 0x1p-24f));
  EXPECT_THAT(means(constant_faces(PtexType::single, 3, 1, floats)), ElementsAre(.25f, -3, 1e-8f));
}

// IEEE 754's binary16: (−1)^s · 2^(e−15) · (1 + f/1024), and without the 1 where e is 0; what is not finite
// is read as not a number.
float value_of_half(std::uint16_t bits) {
  const int sign = bits >> 15, exponent = bits >> 10 & 31, fraction = bits & 1023;
  const double value = exponent == 31  ? NAN
                       : exponent == 0 ? std::ldexp(fraction, -24)
                                       : std::ldexp(1024 + fraction, exponent - 25);
  return static_cast<float>(std::copysign(value, sign ? -1 : 1));
}

TEST_F(Ptex, EveryHalf) {
  constexpr std::size_t count = 1 << 16;
  std::string halves;
  for (std::size_t bits = 0; bits < count; ++bits) put(halves, static_cast<std::uint16_t>(bits));
  const std::vector<float> read = means(constant_faces(PtexType::half, 1, count, halves));
  ASSERT_EQ(read.size(), count);
  for (std::size_t bits = 0; bits < count; ++bits)
    ASSERT_EQ(std::bit_cast<std::uint32_t>(read[bits]),
              std::bit_cast<std::uint32_t>(value_of_half(static_cast<std::uint16_t>(bits))))
        << bits;
}

// 4 × 2 texels of two channels, 0 … 7 and 10 … 17, each way that a file may have them.
TEST_F(Ptex, TexelsOfEveryEncoding) {
  std::string plain, steps, tiles, sizes, halves[2];
  std::uint16_t before = 0;
  for (const int c : {0, 10})
    for (int i = 0; i < 8; ++i) {
      const auto value = static_cast<std::uint16_t>(c + i);
      put(plain, value), put(steps, static_cast<std::uint16_t>(value - before));
      before = value;
      put(halves[i % 4 / 2], value);  // of 2 × 2
    }
  put(tiles, std::uint8_t{1}), put(tiles, std::uint8_t{1});
  const std::string left = zipped(halves[0]), right = zipped(halves[1]);
  put(sizes, block_word(left, PtexEncoding::zipped)), put(sizes, block_word(right, PtexEncoding::zipped));
  sizes = zipped(sizes);
  put(tiles, static_cast<std::uint32_t>(sizes.size()));
  tiles += sizes + left + right;
  std::string mean;
  put(mean, std::uint16_t{3}), put(mean, std::uint16_t{13});
  PtexFile file(write(ptex_bytes(PtexType::uint16, 2,
                                 {{2, 1, mean, PtexEncoding::zipped, zipped(plain)},
                                  {1, 1, mean},
                                  {2, 1, mean, PtexEncoding::differences, zipped(steps)},
                                  {2, 1, mean, PtexEncoding::tiled, tiles}})));
  ASSERT_EQ(file.faces().size(), 4u);
  EXPECT_EQ(file.faces()[0].width, 4u);
  EXPECT_EQ(file.faces()[0].height, 2u);
  for (const std::size_t face : {0u, 2u, 3u}) {
    const std::vector<float> texels = file.texels(face);
    ASSERT_EQ(texels.size(), 16u);
    for (std::size_t i = 0; i < 8; ++i) {
      EXPECT_NEAR(texels[2 * i] * 65535, static_cast<float>(i), 1e-3) << face;
      EXPECT_NEAR(texels[2 * i + 1] * 65535, static_cast<float>(10 + i), 1e-3) << face;
    }
  }
  EXPECT_THAT(file.texels(1), testing::Each(testing::AnyOf(3 / 65535.f, 13 / 65535.f)));
}

TEST_F(Ptex, TheMeanOfFacesIsOfTheirDecodedColors) {
  PtexTexture texture{write(constant_faces(PtexType::uint8, 3, 2, two_faces))};
  texture.scale = 2;
  const PtexMean mean = mean_of_ptex(texture);
  EXPECT_NEAR(mean.color.r, 2, 1e-6);
  EXPECT_NEAR(mean.color.g, std::pow(128 / 255.0, 2.2), 1e-6);
  EXPECT_NEAR(mean.color.b, 2 * std::pow(.2, 2.2), 1e-6);
  EXPECT_THAT(mean.how, HasSubstr("of its 2 faces"));
  EXPECT_THAT(mean.how, HasSubstr("they are 0.22 in"));  // ± (128/255)^2.2 in green
  texture.encoding = Encoding::linear;
  EXPECT_NEAR(mean_of_ptex(texture).color.g, 128 / 255.0, 1e-6);
}

TEST_F(Ptex, DamagedFiles) {
  const std::string good =
      ptex_bytes(PtexType::uint8, 3, {{0, 0, "abc"}, {1, 0, "abc", PtexEncoding::zipped, zipped("aabbcc")}});
  std::string type = good, faces = good, magic = good, version = good, channels = good, mesh = good;
  type[12] = 4, magic[0] = 'p', version[4] = 2, channels[20] = 0, mesh[8] = 2;
  std::memset(&faces[24], 0xff, 4);
  const auto read = [&](const std::string& bytes) {
    PtexFile file(write(bytes));
    for (std::size_t i = 0; i < file.faces().size(); ++i) file.texels(i);
  };
  EXPECT_NO_THROW(read(good));
  for (const std::string& bad :
       {type, faces, magic, version, channels, mesh, good.substr(0, 63), good.substr(0, good.size() - 1)})
    EXPECT_THROW(read(bad), Error);
  for (std::size_t i = 0; i < good.size(); ++i) {  // each is read or refused
    std::string bad = good;
    bad[i] = static_cast<char>(bad[i] ^ 0x55);
    try {
      read(bad);
    } catch (const Error&) {
    }
  }
  EXPECT_THROW(PtexFile("/none.ptx"), Error);
  EXPECT_THAT(mean_of_ptex({"/none.ptx"}).how, HasSubstr("grey, 0.5: cannot read /none.ptx"));
}

}  // namespace
}  // namespace vitrail::ptex_file_test
