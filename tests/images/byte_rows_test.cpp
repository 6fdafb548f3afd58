// SPDX-License-Identifier: Apache-2.0
#include "images/byte_rows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "images/image_files.h"
#include "scene/system/diagnostics.h"
#include "tests/images/jpeg_file.h"
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

// Smooth, with some noise.
std::vector<std::uint8_t> photograph(int width, int height, int channels) {
  std::vector<std::uint8_t> pixels = some_pixels(width, height, channels);
  for (std::size_t i = 0; i < pixels.size(); ++i)
    pixels[i] = static_cast<std::uint8_t>(100 + 80 * std::sin(static_cast<double>(i) / 300) + pixels[i] % 40);
  return pixels;
}

std::vector<std::uint8_t> bytes_of_library(const std::filesystem::path& file, int& channels) {
  const StoredImage stored = read_stored_image(file);
  channels = stored.image.channels;
  std::vector<std::uint8_t> bytes;
  for (const float v : stored.image.values) bytes.push_back(static_cast<std::uint8_t>(v * 255 + 0.5f));
  return bytes;
}

TEST(JpegRows, AreWhatTheLibraryReads) {
  const test::TemporaryDirectory directory;
  const std::filesystem::path file = directory / "a.jpg";
  for (const test::JpegKind& kind : {test::JpegKind{1},
                                     {3},
                                     {1, true},
                                     {3, true},
                                     {3, false, false},
                                     {3, true, false},
                                     {3, false, true, 1},
                                     {3, true, true, 2},
                                     {3, false, true, 0, true}})
    for (const int width : {1, 7, 16, 61}) {
      test::write_file(file, test::jpeg_of(width, photograph(width, 45, kind.channels), kind));
      const std::optional<ByteRows> rows = plain_rows(file);
      ASSERT_TRUE(rows);
      EXPECT_EQ(rows->width, width);
      EXPECT_EQ(rows->height, 45);
      int channels = 0;
      EXPECT_EQ(bytes_of(*rows), bytes_of_library(file, channels));
      EXPECT_EQ(rows->channels, channels);
    }
}

TEST(JpegRows, OtherColoursAreLeftToTheLibrary) {
  const test::TemporaryDirectory directory;
  const std::filesystem::path file = directory / "a.jpg";
  test::write_file(file, test::jpeg_of(20, photograph(20, 10, 4), {4}));
  EXPECT_FALSE(plain_rows(file));
  int channels = 0;
  const std::vector<std::uint8_t> expected = bytes_of_library(file, channels);
  const std::optional<ByteRows> rows = byte_rows(file);
  ASSERT_TRUE(rows);
  EXPECT_EQ(rows->channels, channels);
  EXPECT_EQ(bytes_of(*rows), expected);
}

// Nothing where it is left to the library.
std::optional<std::vector<std::uint8_t>> plain_bytes(const std::filesystem::path& file,
                                                     std::string& refusal) {
  refusal.clear();
  try {
    if (const std::optional<ByteRows> rows = plain_rows(file)) return bytes_of(*rows);
  } catch (const Error& error) {
    EXPECT_EQ(error.location.file, file.string());
    refusal = error.what();
    EXPECT_NE(refusal.find("cannot read the image"), std::string::npos) << refusal;
  }
  return std::nullopt;
}

TEST(JpegRows, AnEarlyEndIsSaid) {
  const test::TemporaryDirectory directory;
  const std::filesystem::path file = directory / "a.jpg";
  for (const bool progressive : {false, true}) {
    const std::string good = test::jpeg_of(40, photograph(40, 33, 3), {3, progressive});
    test::write_file(file, good);
    std::string refusal;
    const auto whole = plain_bytes(file, refusal);
    ASSERT_TRUE(whole) << refusal;
    int refused = 0, left = 0;
    for (std::size_t length = 0; length < good.size(); ++length) {
      test::write_file(file, good.substr(0, length));
      const auto bytes = plain_bytes(file, refusal);
      if (bytes) {
        EXPECT_TRUE(*bytes == *whole) << length << " of " << good.size() << " bytes: other pixels";
      } else {
        ++(refusal.empty() ? left : refused);
      }
    }
    EXPECT_GT(refused, 100);
    EXPECT_LT(left, 700) << "only heads are left to the library";
  }
}

// Both go on, with the same pixels.
TEST(JpegRows, WhatIsDamagedIsReadAsByTheLibrary) {
  const test::TemporaryDirectory directory;
  const std::filesystem::path file = directory / "a.jpg";
  int compared = 0;
  for (const bool progressive : {false, true}) {
    const std::string good = test::jpeg_of(40, photograph(40, 33, 3), {3, progressive});
    for (std::size_t at = 2; at < good.size(); at += 1 + at / 60) {
      std::string bytes = good, refusal;
      bytes[at] = static_cast<char>(bytes[at] ^ 16);
      test::write_file(file, bytes);
      const auto ours = plain_bytes(file, refusal);
      if (!ours) continue;
      int channels = 0;
      EXPECT_TRUE(*ours == bytes_of_library(file, channels)) << "byte " << at << ": other pixels are read";
      ++compared;
    }
  }
  EXPECT_GT(compared, 20);
}

}  // namespace

}  // namespace vitrail::byte_rows_test
