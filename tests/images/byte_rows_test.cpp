// SPDX-License-Identifier: Apache-2.0
#include "images/byte_rows.h"

#include <gtest/gtest.h>

#include <random>

#include "images/image_files.h"
#include "scene/system/diagnostics.h"
#include "tests/images/png_file.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::byte_rows_test {

namespace {

std::vector<std::uint8_t> some_pixels(int width, int height, int channels) {
  std::mt19937 random(1);
  std::vector<std::uint8_t> pixels(static_cast<std::size_t>(width * height * channels));
  for (std::uint8_t& p : pixels) p = static_cast<std::uint8_t>(random());
  return pixels;
}

std::vector<std::uint8_t> bytes_of(const ByteRows& rows) {
  std::vector<std::uint8_t> bytes;
  rows.read([&](std::span<const std::uint8_t> row) { bytes.insert(bytes.end(), row.begin(), row.end()); });
  return bytes;
}

TEST(ByteRows, EveryFilterAndChannelIsWhatTheLibraryReads) {
  const test::TemporaryDirectory directory;
  const std::filesystem::path file = directory / "a.png";
  for (const int channels : {1, 2, 3, 4})
    for (const std::vector<int>& filters : {std::vector{0}, {1}, {2}, {3}, {4}, {4, 3, 2, 1, 0}})
      for (const int width : {1, 2, 37}) {
        const std::vector<std::uint8_t> pixels = some_pixels(width, 23, channels);
        test::write_file(file, test::png_of(width, channels, pixels, filters));
        const std::optional<ByteRows> rows = byte_rows(file);
        ASSERT_TRUE(rows);
        EXPECT_EQ(rows->width, width);
        EXPECT_EQ(rows->height, 23);
        EXPECT_EQ(rows->channels, channels);
        EXPECT_EQ(bytes_of(*rows), pixels) << channels << " channels, filter " << filters[0];
        const StoredImage stored = read_stored_image(file);
        ASSERT_EQ(stored.image.channels, channels);
        for (std::size_t i = 0; i < pixels.size(); ++i)
          ASSERT_NEAR(stored.image.values[i], static_cast<float>(pixels[i]) / 255, 1e-6);
      }
}

TEST(ByteRows, WhatIsDamagedIsSaid) {
  const test::TemporaryDirectory directory;
  const std::filesystem::path file = directory / "a.png";
  const std::vector<std::uint8_t> pixels = some_pixels(9, 7, 3);
  const std::string good = test::png_of(9, 3, pixels, {4}, 40);
  const std::size_t first = good.find("IDAT") - 4, end = good.find("IEND") - 4;
  const auto outcome =
      [&](const std::string& bytes) -> bool {  // whether it is refused, or left to the library
    test::write_file(file, bytes);
    try {
      const std::optional<ByteRows> rows = byte_rows(file);
      return !rows || bytes_of(*rows) != pixels;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("cannot read the image"), std::string::npos) << error.what();
      return true;
    }
  };
  EXPECT_FALSE(outcome(good));
  for (std::size_t length = 0; length < end; ++length)
    EXPECT_TRUE(outcome(good.substr(0, length))) << length << " bytes";
  for (std::size_t at = first + 4; at + 8 < end; ++at) {
    std::string bytes = good;
    bytes[at] = static_cast<char>(bytes[at] ^ 4);
    test::write_file(file, bytes);
    try {
      const std::optional<ByteRows> rows = byte_rows(file);
      EXPECT_TRUE(!rows || bytes_of(*rows) == pixels) << "byte " << at << ": other pixels are read";
    } catch (const Error&) {
    }
  }
}

// An edit of the header, with its checksum; the library has to read these.
std::string with_header(std::string png, std::size_t at, char value) {
  std::string header = png.substr(16, 13);
  header[at] = value;
  std::string start = png.substr(0, 8);
  test::append_chunk(start, "IHDR", header);
  return start + png.substr(33);
}

TEST(ByteRows, OtherKindsAreLeftToTheLibrary) {
  const test::TemporaryDirectory directory;
  const std::filesystem::path file = directory / "a.png";
  const std::string good = test::png_of(8, 3, some_pixels(8, 8, 3), {0});
  for (const auto& [at, value] : {std::pair<std::size_t, char>{8, 16}, {9, 3}, {12, 1}}) {
    test::write_file(file, with_header(good, at, value));
    EXPECT_FALSE(byte_rows(file)) << "byte " << at << " of the header";
  }
  std::string transparent = good.substr(0, 33);
  test::append_chunk(transparent, "tRNS", std::string(6, '\0'));
  test::write_file(file, transparent + good.substr(33));
  EXPECT_FALSE(byte_rows(file));
  test::write_file(file, "GIF89a");
  EXPECT_FALSE(byte_rows(file));
}

}  // namespace

}  // namespace vitrail::byte_rows_test
