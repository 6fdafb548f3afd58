// SPDX-License-Identifier: Apache-2.0
#include "film/image_io.h"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <numeric>
#include <random>

#include "film/picture_attributes.h"
#include "film/srgb_integers.h"
#include "film/tiff_file.h"
#include "images/image_files.h"
#include "scene/spectra/color.h"
#include "scene/system/diagnostics.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::image_io_test {
namespace {

Picture picture() {
  Picture p;
  p.rgb = {2, 1, 3, {0, 0.5f, 1, -2, 1e-7f, 3e4f}};
  p.variance = {2, 1, 1, {0.25f, 4}};
  p.window = {3, 5, 1, 2};
  p.full_width = 8, p.full_height = 6;
  p.samples_per_pixel = 16;
  p.render_time_s = 2.5;
  return p;
}

std::string bytes(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(ImageIo, MatricesOfOpenExrHaveRowsForColumns) {
  std::array<float, 16> m{};
  std::iota(m.begin(), m.end(), 0.0f);
  EXPECT_EQ(transposed(m), (std::array<float, 16>{0, 4, 8, 12, 1, 5, 9, 13, 2, 6, 10, 14, 3, 7, 11, 15}));
}

TEST(ImageIo, ExrKeepsEveryBitAndTheMetadata) {
  const test::TemporaryDirectory directory;
  write_picture(directory / "a.exr", picture());
  const Picture back = read_picture(directory / "a.exr");
  EXPECT_EQ(back.rgb, picture().rgb);
  EXPECT_EQ(back.variance, picture().variance);
  EXPECT_EQ(back.window, picture().window);
  EXPECT_EQ(back.full_width, 8);
  EXPECT_EQ(back.full_height, 6);
  EXPECT_EQ(back.samples_per_pixel, 16);
  EXPECT_EQ(back.render_time_s, 2.5);
  EXPECT_EQ(back.neighbours, Neighbours{});
  Picture splatted = picture();
  splatted.neighbours = {3.5, 1.75};
  write_picture(directory / "a.exr", splatted);
  EXPECT_EQ(read_picture(directory / "a.exr").neighbours, splatted.neighbours);
}

// More blocks than one, the last not full; noise, which no compression makes smaller, beside what it does;
// ids.
TEST(ImageIo, ExrHoldsBlocksOfEveryKind) {
  constexpr int width = 37, height = 53;
  Picture p;
  p.rgb = black_image(width, height, 3);
  p.window = {100, 100 + width, 50, 50 + height};
  p.full_width = 200, p.full_height = 150;
  PictureChannel id{.name = "a channel with a name of more than 31 letters", .is_id = true};
  std::mt19937 random(1);
  for (std::size_t i = 0; i < p.rgb.pixels(); ++i) {
    id.ids.push_back(static_cast<std::uint32_t>(random()));
    const bool is_noise = i < 20 * width;
    for (std::size_t c = 0; c < 3 && is_noise; ++c)
      p.rgb.values[3 * i + c] =
          std::ldexp(static_cast<float>(random()), static_cast<int>(random() % 200) - 100);
  }
  p.layers = {id};
  const test::TemporaryDirectory directory;
  const std::filesystem::path file = directory / "a.exr";
  write_picture(file, p);
  EXPECT_EQ(read_picture(file).rgb, p.rgb);
  EXPECT_EQ(read_picture(file).window, p.window);
  const auto in = OIIO::ImageInput::open(file.string());
  ASSERT_TRUE(in);
  const int channel = in->spec().channelindex(id.name);
  ASSERT_GE(channel, 0);
  std::vector<std::uint32_t> ids(p.rgb.pixels());
  ASSERT_TRUE(in->read_image(0, 0, channel, channel + 1, OIIO::TypeUInt32, ids.data()));
  EXPECT_EQ(ids, id.ids);
}

TEST(ImageIo, ExrWithoutVariance) {
  const test::TemporaryDirectory directory;
  Picture p = picture();
  p.variance = {};
  write_picture(directory / "a.exr", p);
  const Picture back = read_picture(directory / "a.exr");
  EXPECT_EQ(back.rgb, p.rgb);
  EXPECT_EQ(back.variance.pixels(), 0u);
}

// Ids as 32-bit integers.
TEST(ImageIo, ExrHasLayersAsChannels) {
  const test::TemporaryDirectory directory;
  Picture p = picture();
  p.layers = {{"Albedo.R", false, {0.25f, -3}, {}}, {"Id.shape", true, {}, {0xffffffffu, 7}}};
  write_picture(directory / "a.exr", p);
  const auto in = OIIO::ImageInput::open((directory / "a.exr").string());
  ASSERT_TRUE(in);
  const OIIO::ImageSpec& spec = in->spec();
  ASSERT_EQ(spec.nchannels, 6);
  const int albedo = spec.channelindex("Albedo.R"), shape = spec.channelindex("Id.shape");
  ASSERT_GE(albedo, 0);
  ASSERT_GE(shape, 0);
  EXPECT_EQ(spec.channelformat(albedo), OIIO::TypeDesc::FLOAT);
  EXPECT_EQ(spec.channelformat(shape), OIIO::TypeDesc::UINT32);
  std::array<float, 2> values{};
  std::array<std::uint32_t, 2> ids{};
  ASSERT_TRUE(in->read_image(0, 0, albedo, albedo + 1, OIIO::TypeDesc::FLOAT, values.data()));
  ASSERT_TRUE(in->read_image(0, 0, shape, shape + 1, OIIO::TypeDesc::UINT32, ids.data()));
  EXPECT_EQ(values, (std::array{0.25f, -3.0f}));
  EXPECT_EQ(ids, (std::array{0xffffffffu, 7u}));
  const Picture back = read_picture(directory / "a.exr");
  EXPECT_EQ(back.rgb, p.rgb);
  EXPECT_EQ(back.variance, p.variance);
}

TEST(ImageIo, EqualPicturesGiveEqualFilesAndNothingElse) {
  const test::TemporaryDirectory directory;
  for (const char* extension : {".exr", ".png", ".jpg", ".hdr", ".tif"}) {
    write_picture(directory / (std::string("a") + extension), picture());
    write_picture(directory / (std::string("b") + extension), picture());
    EXPECT_EQ(bytes(directory / (std::string("a") + extension)),
              bytes(directory / (std::string("b") + extension)));
  }
  const auto files = std::filesystem::directory_iterator(directory.path());
  EXPECT_EQ(std::distance(begin(files), end(files)), 10);
}

TEST(ImageIo, TheDateIsFixed) {
  const test::TemporaryDirectory directory;
  write_picture(directory / "a.exr", picture());
  EXPECT_NE(bytes(directory / "a.exr").find("1970:01:01 00:00:00"), std::string::npos);
  ::setenv("SOURCE_DATE_EPOCH", "1000000000", 1);
  write_picture(directory / "b.exr", picture());
  ::unsetenv("SOURCE_DATE_EPOCH");
  EXPECT_NE(bytes(directory / "b.exr").find("2001:09:09 01:46:40"), std::string::npos);
}

TEST(ImageIo, PngIsEncodedAndDecodedAsSrgb) {
  const test::TemporaryDirectory directory;
  Picture p;
  p.rgb = {2, 1, 3, {0, 1, 0.2158605f, -1, 7, 0.5f}};
  write_picture(directory / "a.png", p);
  const Picture back = read_picture(directory / "a.png");
  const std::vector<float> expected{0, 1, 0.2158605f, 0, 1, 0.5028865f};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(back.rgb.values[i], expected[i], 1e-6);
}

// What a reader finds in a PNG, but for the text that says once more that it is sRGB.
struct PngContent {
  std::vector<std::uint16_t> values;
  std::string format, about;
  bool operator==(const PngContent&) const = default;
};

PngContent content(const std::filesystem::path& file) {
  const auto in = OIIO::ImageInput::open(file.string());
  if (!in) return {};
  const OIIO::ImageSpec& spec = in->spec();
  PngContent found{std::vector<std::uint16_t>(spec.image_pixels() * static_cast<std::size_t>(spec.nchannels)),
                   spec.format.c_str(),
                   {}};
  in->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT16, found.values.data());
  found.about = spec.serialize(OIIO::ImageSpec::SerialText, OIIO::ImageSpec::SerialDetailed);
  return found;
}

// OpenImageIO's own writer, given what a picture has.
template <class Integer>
void write_by_openimageio(const std::filesystem::path& file, const Picture& p, OIIO::TypeDesc type) {
  std::vector<Integer> values;
  for (const float v : p.rgb.values)
    values.push_back(static_cast<Integer>(
        std::lround(std::numeric_limits<Integer>::max() * srgb_encode(std::clamp(double{v}, 0.0, 1.0)))));
  OIIO::ImageSpec spec(p.rgb.width, p.rgb.height, 3, type);
  spec.x = p.window.x0, spec.y = p.window.y0;
  spec.attribute("DateTime", "1970:01:01 00:00:00");
  spec.attribute("oiio:ColorSpace", "sRGB");
  const auto out = OIIO::ImageOutput::create(file.string());
  ASSERT_TRUE(out->open(file.string(), spec) && out->write_image(type, values.data()) && out->close());
}

TEST(ImageIo, PngHoldsWhatOpenImageIoWouldWrite) {
  const test::TemporaryDirectory directory;
  Picture p = picture();
  p.rgb = black_image(37, 300, 3);
  for (std::size_t i = 0; i < p.rgb.values.size(); ++i)
    p.rgb.values[i] = static_cast<float>(std::fmod(0.7548776662 * static_cast<double>(i), 1.2) - 0.1);
  p.window = {3, 40, 1, 301};
  for (const int bits : {8, 16}) {
    write_picture(directory / "ours.png", p, bits);
    if (bits == 8)
      write_by_openimageio<std::uint8_t>(directory / "theirs.png", p, OIIO::TypeDesc::UINT8);
    else
      write_by_openimageio<std::uint16_t>(directory / "theirs.png", p, OIIO::TypeDesc::UINT16);
    const PngContent ours = content(directory / "ours.png"), theirs = content(directory / "theirs.png");
    EXPECT_EQ(ours.values, theirs.values) << bits;
    EXPECT_EQ(ours.format, bits == 8 ? "uint8" : "uint16");
    EXPECT_EQ(ours.about, theirs.about);
    EXPECT_THAT(ours.about, ::testing::HasSubstr("1970:01:01"));
  }
}

// Steps of colour that go on over many blocks.
Picture wide_picture(int width, int height) {
  Picture p = picture();
  p.rgb = black_image(width, height, 3);
  const auto columns = static_cast<std::size_t>(width);
  for (std::size_t i = 0; i < p.rgb.pixels(); ++i) {
    const double x = static_cast<double>(i % columns) / width, y = static_cast<double>(i / columns) / height;
    const double colors[] = {x, y, 0.5 + 0.5 * std::sin(6 * (x + y))};
    for (std::size_t c = 0; c < 3; ++c) p.rgb.values[3 * i + c] = static_cast<float>(colors[c]);
  }
  p.origin.software = "Vitrail, a test 1.2";
  p.origin.denoiser = "nobody";
  return p;
}

TEST(ImageIo, JpegIsReadByOpenImageIo) {
  const test::TemporaryDirectory directory;
  const Picture p = wide_picture(131, 70);
  write_picture(directory / "a.jpg", p);
  const Picture back = read_picture(directory / "a.jpg");
  ASSERT_EQ(back.rgb.width, 131);
  ASSERT_EQ(back.rgb.height, 70);
  for (std::size_t i = 0; i < p.rgb.values.size(); ++i)
    EXPECT_NEAR(srgb_encode(double{back.rgb.values[i]}), srgb_encode(double{p.rgb.values[i]}), 0.05) << i;
  const auto in = OIIO::ImageInput::open((directory / "a.jpg").string());
  ASSERT_TRUE(in);
  const OIIO::ImageSpec& spec = in->spec();
  EXPECT_EQ(spec.get_string_attribute("Software"), p.origin.software);
  EXPECT_EQ(spec.get_string_attribute("ImageDescription"), "denoised by nobody");
  EXPECT_EQ(spec.get_string_attribute("DateTime"), "1970:01:01 00:00:00");
  EXPECT_EQ(spec.get_int_attribute("Exif:ColorSpace"), 1);
  EXPECT_EQ(spec.get_string_attribute("jpeg:subsampling"), "4:4:4");
}

// Of one strip and of several, of which the last is shorter; places of 32 bits and of 64.
TEST(ImageIo, TiffIsReadByOpenImageIo) {
  const test::TemporaryDirectory directory;
  const std::filesystem::path file = directory / "a.tif";
  for (const int height : {1, 32, 70})
    for (const int bits : {8, 16})
      for (const std::uint64_t most_bytes : {std::uint64_t{1} << 40, std::uint64_t{100}}) {
        Picture p = wide_picture(131, height);
        p.window = {7, 138, 5, 5 + height};
        p.full_width = 300, p.full_height = 200;
        write_tiff(file, p, bits, most_bytes);
        EXPECT_EQ(bytes(file)[2], most_bytes == 100 ? 43 : 42);
        const auto in = OIIO::ImageInput::open(file.string());
        ASSERT_TRUE(in) << OIIO::geterror();
        const OIIO::ImageSpec& spec = in->spec();
        EXPECT_EQ(spec.format, OIIO::TypeDesc(bits == 8 ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::UINT16));
        EXPECT_EQ((std::array{spec.width, spec.height, spec.x, spec.y, spec.full_width, spec.full_height}),
                  (std::array{131, height, 7, 5, 300, 200}));
        EXPECT_EQ(spec.get_string_attribute("Software"), p.origin.software);
        EXPECT_EQ(spec.get_string_attribute("ImageDescription"), "denoised by nobody");
        EXPECT_EQ(spec.get_string_attribute("DateTime"), "1970:01:01 00:00:00");
        EXPECT_EQ(spec.get_string_attribute("compression"), "zip");
        std::vector<std::uint16_t> expected(p.rgb.values.size()), values(p.rgb.values.size());
        if (bits == 16) {
          to_srgb_integers<std::uint16_t>(p.rgb.values, expected.data());
        } else {
          std::vector<std::uint8_t> of_a_byte(expected.size());
          to_srgb_integers<std::uint8_t>(p.rgb.values, of_a_byte.data());
          std::ranges::transform(of_a_byte, expected.begin(),
                                 [](int v) { return static_cast<std::uint16_t>(257 * v); });
        }
        ASSERT_TRUE(in->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT16, values.data()));
        EXPECT_EQ(values, expected) << height << " rows of " << bits << " bits";
      }
}

// Components are of eight bits beside the greatest; black, one colour, and what no number is.
TEST(ImageIo, RadianceIsReadByOpenImageIo) {
  for (const int width : {3, 7, 8, 500}) {
    const test::TemporaryDirectory directory;
    Picture p = wide_picture(width, 9);
    for (std::size_t i = 0; i < 3 * static_cast<std::size_t>(width); ++i) p.rgb.values[i] = 0.25f;
    const float special[] = {0, 0, 0, -1, 2, std::nanf(""), 1e30f, 1, 0, 1e-30f, 1e-33f, 0};
    std::ranges::copy(special, p.rgb.values.end() - 12);
    write_picture(directory / "a.hdr", p);
    EXPECT_THAT(bytes(directory / "a.hdr"),
                ::testing::StartsWith("#?RADIANCE\nSOFTWARE=Vitrail, a test 1.2\n"));
    const Picture back = read_picture(directory / "a.hdr");
    ASSERT_EQ(back.rgb.values.size(), p.rgb.values.size());
    for (std::size_t i = 0; i < p.rgb.values.size(); ++i) {
      const auto kept = [&](std::size_t at) { return p.rgb.values[at] > 0 ? p.rgb.values[at] : 0.0f; };
      const std::size_t pixel = i / 3 * 3;
      const float greatest = std::max({kept(pixel), kept(pixel + 1), kept(pixel + 2)});
      EXPECT_LE(back.rgb.values[i], kept(i)) << width << ", " << i;
      EXPECT_GE(back.rgb.values[i], kept(i) - greatest / 128) << width << ", " << i;
    }
  }
}

// Rows leave the encoder while it works: what cannot be written is said, and nothing is left.
TEST(ImageIo, OnAFullDisk) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  for (const std::string name : {"a.png", "a.jpg", "a.hdr", "a.tif"}) {
    const test::TemporaryDirectory directory;
    std::filesystem::create_symlink("/dev/full", directory / (name + ".tmp" + std::to_string(::getpid())));
    try {
      write_picture(directory / name, picture());
      ADD_FAILURE() << name;
    } catch (const MachineError& e) {
      EXPECT_THAT(e.what(),
                  ::testing::AllOf(::testing::HasSubstr(name), ::testing::HasSubstr("No space left")));
    }
    EXPECT_TRUE(std::filesystem::is_empty(directory.path()));
  }
}

TEST(ImageIo, PlainExrNeedsNoImageLibrary) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");  // a process that has loaded nothing yet
  const test::TemporaryDirectory directory;
  const auto read = [&] {
    write_picture(directory / "a.exr", picture());
    const bool is_right = read_picture(directory / "a.exr").rgb == picture().rgb;
    std::_Exit(is_right && !image_library_is_loaded() ? 0 : 1);
  };
  EXPECT_EXIT(read(), ::testing::ExitedWithCode(0), "");
}

TEST(ImageIo, ExrThatIsCutIsNamed) {
  const test::TemporaryDirectory directory;
  write_picture(directory / "a.exr", picture());
  const std::string whole = bytes(directory / "a.exr");
  for (std::size_t size = 0; size < whole.size(); size += 7) {
    std::ofstream(directory / "b.exr", std::ios::binary) << whole.substr(0, size);
    try {
      read_picture(directory / "b.exr");
      ADD_FAILURE() << size;
    } catch (const Error& e) {
      EXPECT_EQ(e.location.file, (directory / "b.exr").string());
    }
  }
}

TEST(ImageIo, WhatCannotBeReadIsNamed) {
  const test::TemporaryDirectory directory;
  std::ofstream(directory / "a.exr") << "no image";
  try {
    read_picture(directory / "a.exr");
    ADD_FAILURE();
  } catch (const Error& e) {
    EXPECT_EQ(e.location.file, (directory / "a.exr").string());
  }
  EXPECT_THROW(write_picture(directory / "a.txt", picture()), UsageError);
  EXPECT_THROW(write_picture(directory / "nowhere/a.exr", picture()), MachineError);
  EXPECT_THROW(write_picture(directory / "nowhere/a.png", picture()), MachineError);
}

}  // namespace
}  // namespace vitrail::image_io_test
