// SPDX-License-Identifier: Apache-2.0
// Every kind of picture that is read: made by OpenImageIO itself, or byte by byte, its texels held to the
// known ones, whole and row by row.
#include <OpenImageIO/deepdata.h>
#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>

#include "images/image_files.h"
#include "scene/system/diagnostics.h"
#include "tests/images/image_bytes.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::image_kinds_test {
namespace {

using namespace test;
using testing::HasSubstr;
using Pixel = std::vector<double>;

constexpr int side = 64;  // the writer of HEIF reads rows of fewer pixels beyond their end

// What the pixel (x, y) of a picture of four quarters is written as.
double quarter(int x, int y, int channel) {
  if (channel == 3) return 128 / 255.0;
  const bool right = x >= side / 2, below = y >= side / 2;
  return channel == 0 ? (below ? 51 : 204) / 255.0 : channel == 1 ? (right ? 26 : 153) / 255.0 : 77 / 255.0;
}

class ImageKinds : public testing::Test {
 protected:
  std::filesystem::path path(const std::string& name) const { return folder_ / name; }
  std::filesystem::path write(const std::string& name, const Bytes& bytes) const {
    std::ofstream(path(name), std::ios::binary) << bytes;
    return path(name);
  }
  std::filesystem::path write(const std::string& name, OIIO::ImageSpec spec,
                              const std::vector<float>& values) const {
    const std::string file = path(name).string();
    const auto out = OIIO::ImageOutput::create(file);
    EXPECT_TRUE(out) << name << ": " << OIIO::geterror();
    spec.attribute("oiio:UnassociatedAlpha", 1);
    EXPECT_TRUE(out && out->open(file, spec) && out->write_image(OIIO::TypeDesc::FLOAT, values.data()) &&
                out->close())
        << name << ": " << out->geterror();
    return file;
  }
  // By the library, in its own defaults.
  std::filesystem::path quarters(const std::string& name, int channels, OIIO::TypeDesc type,
                                 OIIO::ImageSpec spec = {}) const {
    spec.width = spec.height = spec.full_width = spec.full_height = side;
    spec.nchannels = channels;
    spec.default_channel_names();
    spec.set_format(type);
    spec.attribute("CompressionQuality", 100);
    std::vector<float> values;
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x)
        for (int c = 0; c < channels; ++c)
          values.push_back(static_cast<float>(quarter(x, y, channels == 2 ? 3 * c : c)));
    return write(name, spec, values);
  }

  // The whole, which its rows are too.
  static Image read(const std::filesystem::path& file) {
    const StoredImage whole = read_stored_image(file);
    std::vector<float> rows;
    read_stored_rows(file, [&](const StoredImage& some) {
      rows.insert(rows.end(), some.image.values.begin(), some.image.values.end());
      EXPECT_EQ(some.integer, whole.integer);
    });
    EXPECT_EQ(rows, whole.image.values) << file;
    EXPECT_EQ(read_image_layout(file).channels, whole.image.channels);
    return whole.image;
  }
  static void expect_pixel(const Image& image, int x, int y, const Pixel& pixel, double tolerance,
                           const std::string& name) {
    ASSERT_EQ(image.channels, static_cast<int>(pixel.size())) << name;
    for (std::size_t c = 0; c < pixel.size(); ++c)
      EXPECT_NEAR(
          static_cast<double>(image.values[static_cast<std::size_t>(y * image.width + x) * pixel.size() + c]),
          pixel[c], tolerance)
          << name << ", pixel " << x << " " << y << ", channel " << c;
  }
  // red, green; blue, grey of 102.
  static void expect_colors(const std::filesystem::path& file, double tolerance = 1e-6) {
    const Image image = read(file);
    const double grey = 102 / 255.0;
    const std::vector<Pixel> expected{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {grey, grey, grey}};
    for (int i = 0; i < 4; ++i)
      expect_pixel(image, i % 2, i / 2, expected[static_cast<std::size_t>(i)], tolerance, file.filename());
  }
  static void expect_error(const std::filesystem::path& file, const std::string& what) {
    for (const bool whole : {true, false}) try {
        if (whole)
          read_stored_image(file);
        else
          read_stored_rows(file, [](const StoredImage&) {});
        ADD_FAILURE() << file << " was read";
      } catch (const Error& error) {
        EXPECT_THAT(std::string(error.what()), HasSubstr(what)) << file;
        EXPECT_EQ(error.location.file, file.string());
      }
  }

 private:
  TemporaryDirectory folder_;
};

struct Kind {
  const char* extension;
  std::vector<int> channels;
  OIIO::TypeDesc type;
  double tolerance;       // of what it loses
  int read_channels = 0;  // where they are others
};

TEST_F(ImageKinds, TheLibrarysOwnFiles) {
  const OIIO::TypeDesc byte = OIIO::TypeDesc::UINT8, word = OIIO::TypeDesc::UINT16,
                       half = OIIO::TypeDesc::HALF, single = OIIO::TypeDesc::FLOAT;
  const std::vector<Kind> kinds{
      {"exr", {1, 3, 4}, half, 3e-4},    {"exr", {1, 3, 4}, single, 1e-6},  {"tif", {1, 3, 4}, byte, 1e-6},
      {"tif", {1, 3, 4}, word, 1e-5},    {"tif", {1, 3, 4}, single, 1e-6},  {"jp2", {1, 3, 4}, byte, 0.02},
      {"j2k", {3}, byte, 0.02},          {"jpg", {1, 3}, byte, 0.01},       {"bmp", {1, 3, 4}, byte, 1e-6},
      {"dpx", {1, 3, 4}, byte, 1e-6},    {"dpx", {3}, word, 1e-5},          {"fits", {1, 3}, byte, 1e-6},
      {"fits", {3}, word, 1e-4},         {"fits", {3}, single, 1e-6},       {"gif", {3}, byte, 1e-6, 4},
      {"heic", {3, 4}, byte, 0.02},      {"avif", {3, 4}, byte, 0.01},      {"hdr", {3}, single, 4e-3},
      {"ico", {4}, byte, 1e-6},          {"ico", {3}, byte, 1e-6, 4},       {"iff", {3, 4}, byte, 1e-6},
      {"png", {1, 2, 3, 4}, byte, 1e-6}, {"png", {1, 2, 3, 4}, word, 1e-5}, {"ppm", {3}, byte, 1e-6},
      {"pgm", {1}, byte, 1e-6},          {"rla", {1, 3, 4}, byte, 1e-6},    {"rla", {3, 4}, single, 1e-6},
      {"sgi", {1, 3, 4}, byte, 1e-6},    {"sgi", {3}, word, 1e-5},          {"tga", {1, 3, 4}, byte, 1e-6},
      {"webp", {3}, byte, 0.02}};
  for (const Kind& kind : kinds)
    for (const int channels : kind.channels) {
      const std::string name = fmt::format("{}-{}.{}", channels, kind.type.c_str(), kind.extension);
      const Image image = read(quarters(name, channels, kind.type));
      ASSERT_EQ(image.channels, kind.read_channels ? kind.read_channels : channels) << name;
      for (const int x : {12, 50})
        for (const int y : {12, 50}) {
          Pixel expected;
          for (int c = 0; c < image.channels; ++c)
            expected.push_back(c == channels && c == 3 ? 1 : quarter(x, y, image.channels == 2 ? 3 * c : c));
          expect_pixel(image, x, y, expected, kind.tolerance, name);
        }
    }
}

// The library's writer divides by alpha^(1/2.2), and its reader multiplies by alpha.
TEST_F(ImageKinds, WebPKeepsColorsBesideAlpha) {
  const Image image = read(quarters("a.webp", 4, OIIO::TypeDesc::UINT8));
  const double alpha = quarter(0, 0, 3), divided = std::pow(alpha, -1 / 2.2);
  for (const int x : {12, 50})
    for (const int y : {12, 50}) {
      Pixel expected{0, 0, 0, alpha};
      for (int c = 0; c < 3; ++c)
        expected[static_cast<std::size_t>(c)] = std::min(1.0, divided * quarter(x, y, c));
      expect_pixel(image, x, y, expected, 0.02, "webp");
    }
}

TEST_F(ImageKinds, TiffInEveryWay) {
  const Bytes rgb = bytes_of({255, 0, 0, 0, 255, 0, 0, 0, 255, 102, 102, 102});
  const Bytes planes = bytes_of({255, 0, 0, 102, 0, 255, 0, 102, 0, 0, 255, 102});
  expect_colors(write("a.tif", tiff_bytes({.pixels = rgb})));
  expect_colors(write("planes.tif", tiff_bytes({.apart = true, .pixels = planes})));
  // A photograph says how it was held; pbrt and Mitsuba do not look.
  expect_colors(write("turned.tif", tiff_bytes({.orientation = 3, .pixels = rgb})));
  const Bytes inks = bytes_of({0, 255, 255, 0, 255, 0, 255, 0, 255, 255, 0, 0, 0, 0, 0, 153});
  expect_colors(write("cmyk.tif", tiff_bytes({.photometric = 5, .channels = 4, .pixels = inks})), 1e-5);
  std::vector<std::uint16_t> palette(48);
  for (const auto& [i, v] :
       {std::pair{1, 0xffff}, {18, 0xffff}, {35, 0xffff}, {4, 0x6666}, {20, 0x6666}, {36, 0x6666}})
    palette[static_cast<std::size_t>(i)] = static_cast<std::uint16_t>(v);
  expect_colors(write("palette.tif", tiff_bytes({.photometric = 3,
                                                 .channels = 1,
                                                 .bits = 4,
                                                 .pixels = bytes_of({0x12, 0x34}),
                                                 .palette = palette})));
  for (const auto& [bits, rows, levels] :
       {std::tuple{1, bytes_of({0x40, 0x80}), std::array{0.0, 1.0, 1.0, 0.0}},
        {2, bytes_of({0x10, 0xe0}), {0.0, 1 / 3.0, 1.0, 2 / 3.0}},
        {4, bytes_of({0x0f, 0x36}), {0.0, 1.0, 0.2, 0.4}}}) {
    const Image image = read(write(
        fmt::format("{}.tif", bits),
        tiff_bytes(
            {.photometric = 1, .channels = 1, .bits = static_cast<std::uint16_t>(bits), .pixels = rows})));
    for (int i = 0; i < 4; ++i)
      expect_pixel(image, i % 2, i / 2, {levels.at(static_cast<std::size_t>(i))}, 1e-6, fmt::to_string(bits));
  }
}

TEST_F(ImageKinds, ByteByByte) {
  const Bytes top_bgr = bytes_of({0, 0, 255, 0, 255, 0}), bottom_bgr = bytes_of({255, 0, 0, 102, 102, 102});
  expect_colors(write("a.bmp", bmp_bytes(24, "", bottom_bgr + zeros(2) + top_bgr + zeros(2))));
  const Bytes palette = bytes_of({0, 0, 255, 0, 0, 255, 0, 0, 255, 0, 0, 0, 102, 102, 102, 0});
  expect_colors(write("8.bmp", bmp_bytes(8, palette, bytes_of({2, 3, 0, 0, 0, 1, 0, 0}))));
  expect_colors(write("4.bmp", bmp_bytes(4, palette, bytes_of({0x23, 0, 0, 0, 0x01, 0, 0, 0}))));
  expect_colors(write("up.tga", targa_bytes(false, bottom_bgr + top_bgr)));
  expect_colors(write("down.tga", targa_bytes(true, top_bgr + bottom_bgr)));
  const Bytes rgb = bytes_of({255, 0, 0, 0, 255, 0, 0, 0, 255, 102, 102, 102});
  expect_colors(write("a.ppm", "P6\n# a comment\n2 2 255\n" + rgb));
  expect_colors(write("text.ppm", "P3 2 2 255 255 0 0 0 255 0 0 0 255 102 102 102\n"));
  expect_colors(write("a.psd", psd_bytes(3, 3, bytes_of({255, 0, 0, 102, 0, 255, 0, 102, 0, 0, 255, 102}))));
  // Photoshop's inks are the other way round.
  expect_colors(
      write("cmyk.psd",
            psd_bytes(4, 4, bytes_of({255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 102}))),
      1e-2);
  const Image dds =
      read(write("a.dds", dds_bytes(bytes_of({0, 0, 255, 255, 0, 255, 0, 128, 255, 0, 0, 255, 9, 8, 7, 0}))));
  expect_pixel(dds, 0, 0, {1, 0, 0, 1}, 1e-6, "dds");
  expect_pixel(dds, 1, 0, {0, 1, 0, 128 / 255.0}, 1e-6, "dds");
  const Image bits = read(write("a.pbm", "P4 2 2\n" + bytes_of({0x40, 0x80})));
  for (int i = 0; i < 4; ++i) expect_pixel(bits, i % 2, i / 2, {i == 0 || i == 3 ? 1.0 : 0.0}, 1e-6, "pbm");
}

Bytes floats(const std::vector<float>& values, bool little) {
  Bytes bytes;
  for (const float v : values)
    bytes += little ? low(std::bit_cast<std::uint32_t>(v)) : high(std::bit_cast<std::uint32_t>(v));
  return bytes;
}

// Its rows go up.
TEST_F(ImageKinds, FloatsByteByByte) {
  for (const bool little : {true, false}) {
    const Bytes rows = floats({0, 0, 7, .5f, .25f, .125f, 3, 0, 0, 0, 2, 0}, little);
    const Image image = read(write("a.pfm", fmt::format("PF\n2 2\n{}\n", little ? -1 : 1) + rows));
    expect_pixel(image, 0, 0, {3, 0, 0}, 0, "pfm");
    expect_pixel(image, 1, 0, {0, 2, 0}, 0, "pfm");
    expect_pixel(image, 1, 1, {.5, .25, .125}, 0, "pfm");
  }
  const Image grey = read(write("g.pfm", "Pf\n1 2\n-1\n" + floats({3, .5f}, true)));
  expect_pixel(grey, 0, 0, {.5}, 0, "grey pfm");
  const Image hdr = read(write("a.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n" +
                                            bytes_of({128, 64, 0, 129, 0, 0, 128, 131})));
  expect_pixel(hdr, 0, 0, {1, .5, 0}, 0.01, "hdr");
  expect_pixel(hdr, 1, 0, {0, 0, 4}, 0.04, "hdr");
}

// As Radiance's programs write them: rows from below, columns for rows, values that an exposure multiplied.
TEST_F(ImageKinds, RadianceIsTurnedUpright) {
  // A dark, a bright and a brighter grey from the left; below them four times that.
  const std::vector<float> upright{.25f, .5f, 1, 1, 2, 4};
  const auto pixels = [](const std::vector<int>& exponents) {
    Bytes bytes;
    for (const int exponent : exponents) {
      const Bytes pixel = bytes_of({128, 128, 128, 128 + exponent});
      bytes.insert(bytes.end(), pixel.begin(), pixel.end());
    }
    return bytes;
  };
  const auto values = [&](const std::string& lines, const std::vector<int>& exponents) {
    const Image image = read(write("a.hdr", "#?RADIANCE\n" + lines + pixels(exponents)));
    EXPECT_EQ(std::pair(image.width, image.height), std::pair(3, 2)) << lines;
    std::vector<float> red;
    for (std::size_t i = 0; i < image.pixels(); ++i)
      red.push_back(std::exp2(std::round(std::log2(image.values[3 * i]))));
    return red;
  };
  const std::string kind = "FORMAT=32-bit_rle_rgbe\n\n";
  EXPECT_EQ(values(kind + "-Y 2 +X 3\n", {-1, 0, 1, 1, 2, 3}), upright);
  EXPECT_EQ(values(kind + "+Y 2 +X 3\n", {1, 2, 3, -1, 0, 1}), upright);
  EXPECT_EQ(values(kind + "-Y 2 -X 3\n", {1, 0, -1, 3, 2, 1}), upright);
  EXPECT_EQ(values(kind + "+X 3 -Y 2\n", {-1, 1, 0, 2, 1, 3}), upright);
  EXPECT_EQ(values(kind + "-X 3 +Y 2\n", {3, 1, 2, 0, 1, -1}), upright);
  EXPECT_EQ(values("EXPOSURE=2\nEXPOSURE= 2\n" + kind + "-Y 2 +X 3\n", {1, 2, 3, 3, 4, 5}), upright);
}

TEST_F(ImageKinds, ExrInEveryWay) {
  // Only a window of the picture is there, beyond its left upper corner.
  OIIO::ImageSpec window(2, 1, 3, OIIO::TypeDesc::FLOAT);
  window.x = -3, window.y = -2, window.full_x = 0, window.full_y = 0;
  window.full_width = window.full_height = 100;
  const Image part = read(write("window.exr", window, {1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(part.width, 2);
  expect_pixel(part, 1, 0, {4, 5, 6}, 0, "window");
  // Colours, however they stand among others of other types, and not the depth.
  OIIO::ImageSpec mixed(1, 1, 5, OIIO::TypeDesc::FLOAT);
  mixed.channelnames = {"R", "G", "B", "Z", "id"};
  mixed.channelformats = {OIIO::TypeDesc::HALF, OIIO::TypeDesc::HALF, OIIO::TypeDesc::HALF,
                          OIIO::TypeDesc::FLOAT, OIIO::TypeDesc::UINT32};
  expect_pixel(read(write("mixed.exr", mixed, {.25f, .5f, 2, 100, 0})), 0, 0, {.25, .5, 2}, 1e-6, "mixed");
  EXPECT_FALSE(read_image_layout(path("mixed.exr")).integer);
  OIIO::ImageSpec tiles;
  tiles.tile_width = tiles.tile_height = 8;
  expect_pixel(read(quarters("tiles.exr", 3, OIIO::TypeDesc::FLOAT, tiles)), 50, 12,
               {204 / 255.0, 26 / 255.0, 77 / 255.0}, 1e-6, "tiles");
  OIIO::ImageSpec layer(1, 1, 3, OIIO::TypeDesc::FLOAT);
  layer.channelnames = {"diffuse.R", "diffuse.G", "diffuse.B"};
  expect_pixel(read(write("layer.exr", layer, {1, 2, 3})), 0, 0, {1, 2, 3}, 0, "layer");
}

// Of several pictures in one file the first counts.
TEST_F(ImageKinds, TheFirstOfSeveral) {
  for (const char* const name : {"parts.exr", "pages.tif", "frames.gif"}) {
    const std::string file = path(name).string();
    const auto out = OIIO::ImageOutput::create(file);
    const OIIO::ImageSpec spec(
        side, side, 3, std::string(name) == "parts.exr" ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8);
    const std::vector<OIIO::ImageSpec> specs{spec, spec};
    const std::vector<float> first(side * side * 3, 0.8f), second(side * side * 3, 0.2f);
    EXPECT_TRUE(out->supports("multiimage") ? out->open(file, 2, specs.data()) : out->open(file, spec))
        << out->geterror();
    EXPECT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, first.data())) << out->geterror();
    EXPECT_TRUE(out->open(file, spec, OIIO::ImageOutput::AppendSubimage)) << out->geterror();
    EXPECT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, second.data()) && out->close()) << out->geterror();
    const Image image = read(file);
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(static_cast<double>(image.values[static_cast<std::size_t>(c)]), 0.8, 3e-3) << name;
  }
}

TEST_F(ImageKinds, WhatIsNoPictureIsRefused) {
  const std::string deep = path("deep.exr").string();
  OIIO::ImageSpec spec(1, 1, 4, OIIO::TypeDesc::FLOAT);
  spec.deep = true;
  const auto out = OIIO::ImageOutput::create(deep);
  ASSERT_TRUE(out->open(deep, spec));
  OIIO::DeepData data(spec);
  data.set_samples(0, 2);
  ASSERT_TRUE(out->write_deep_image(data) && out->close());
  expect_error(deep, "deep images");
  expect_error(path("none.null"), "cannot read the image");
  expect_error(write("a.null", "anything"), "are not read as pictures");
  expect_error(quarters("a.zfile", 1, OIIO::TypeDesc::FLOAT), "\"zfile\"");
  expect_error(write("a.pic", softimage_bytes(bytes_of({255, 0, 0, 0, 255, 0, 0, 0, 255, 9, 9, 9}))),
               "\"softimage\"");
  expect_error(write("a.fits", "SIMPLE  =                    T"), "cannot read the image");
  expect_error(write("a.png", "\x89PNG\r\n\x1a\n"), "cannot read the image");
  expect_error(path("none.png"), "cannot read the image");
}

}  // namespace
}  // namespace vitrail::image_kinds_test
