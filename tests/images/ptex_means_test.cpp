// SPDX-License-Identifier: Apache-2.0
// Files as the Ptex File Format Specification 1.3 says; nothing here comes from Ptex's own library.
#include "images/ptex_means.h"

#include <gmock/gmock.h>
#include <zlib.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>

#include "scene/diagnostics.h"
#include "tests/support/temporary_directory.h"

namespace vitrail {
namespace {

using testing::ElementsAre;
using testing::FloatNear;
using testing::HasSubstr;

enum class Type : std::uint32_t { uint8, uint16, half, single };

class Ptex : public testing::Test {
 protected:
  static std::string zipped(const std::string& bytes) {
    std::string packed(compressBound(bytes.size()), '\0');
    uLongf size = packed.size();
    compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
             bytes.size());
    packed.resize(size);
    return packed;
  }
  template <class T>
  static void put(std::string& to, T value) {
    to.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  // All its faces are constant: it has a level without data.
  static std::string file_of(Type type, int channels, std::uint32_t faces, const std::string& means) {
    std::string info;
    for (std::uint32_t f = 0; f < faces; ++f) {
      info += std::string("\0\0\0\1", 4);
      for (int i = 0; i < 4; ++i) put(info, std::uint32_t{0xffffffff});
    }
    info = zipped(info);
    const std::string data = zipped(means), extended(40, '\0'), level(16, '\0');
    std::string file = "Ptex";
    put(file, std::uint32_t{1}), put(file, std::uint32_t{1}), put(file, type),
        put(file, std::uint32_t{0xffffffff});
    put(file, static_cast<std::uint16_t>(channels)), put(file, std::uint16_t{1}), put(file, faces);
    for (const std::size_t size : {extended.size(), info.size(), data.size(), level.size()})
      put(file, static_cast<std::uint32_t>(size));
    put(file, std::uint32_t{4}), put(file, std::uint64_t{0}), put(file, std::uint64_t{0});
    return file + extended + info + data + level;
  }
  std::string write(const std::string& bytes) {
    const std::filesystem::path file = folder_ / "a.ptx";
    std::ofstream(file, std::ios::binary) << bytes;
    return file.string();
  }

  test::TemporaryDirectory folder_;
};

const std::string two_faces("\xff\x80\x33\xff\x00\x33", 6);

TEST_F(Ptex, NumbersOfEveryType) {
  EXPECT_THAT(
      read_ptex_means(write(file_of(Type::uint8, 3, 2, two_faces))).values,
      ElementsAre(1, FloatNear(128 / 255.f, 1e-7f), FloatNear(.2f, 1e-7f), 1, 0, FloatNear(.2f, 1e-7f)));
  std::string words, halves, floats;
  for (const int v : {0, 13107, 65535}) put(words, static_cast<std::uint16_t>(v));
  for (const int v : {0x3800, 0xc000, 0x0001}) put(halves, static_cast<std::uint16_t>(v));
  for (const float v : {.25f, -3.0f, 1e-8f}) put(floats, v);
  EXPECT_THAT(read_ptex_means(write(file_of(Type::uint16, 1, 3, words))).values,
              ElementsAre(0, FloatNear(.2f, 1e-7f), 1));
  EXPECT_THAT(read_ptex_means(write(file_of(Type::half, 1, 3, halves))).values,
              ElementsAre(.5f, -2, 0x1p-24f));
  EXPECT_THAT(read_ptex_means(write(file_of(Type::single, 3, 1, floats))).values,
              ElementsAre(.25f, -3, 1e-8f));
}

TEST_F(Ptex, TheMeanOfFacesIsOfTheirDecodedColors) {
  PtexTexture texture{write(file_of(Type::uint8, 3, 2, two_faces))};
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
  const std::string good = file_of(Type::uint8, 3, 2, two_faces);
  std::string type = good, faces = good, magic = good, version = good, channels = good;
  type[12] = 4, magic[0] = 'p', version[4] = 2, channels[20] = 0;
  std::memset(&faces[24], 0xff, 4);
  for (const std::string& bad :
       {type, faces, magic, version, channels, good.substr(0, 63), good.substr(0, 110)})
    EXPECT_THROW(read_ptex_means(write(bad)), Error);
  for (std::size_t i = 0; i < good.size(); i += 3) {  // each is read or refused
    std::string bad = good;
    bad[i] = static_cast<char>(bad[i] ^ 0x55);
    try {
      read_ptex_means(write(bad));
    } catch (const Error&) {
    }
  }
  EXPECT_THROW(read_ptex_means("/none.ptx"), Error);
  EXPECT_THAT(mean_of_ptex({"/none.ptx"}).how, HasSubstr("grey, 0.5: cannot read /none.ptx"));
}

}  // namespace
}  // namespace vitrail
