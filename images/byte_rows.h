// SPDX-License-Identifier: Apache-2.0
// These functions read pictures of 8 bits a channel as the bytes that they hold: PNG by zlib and JPEG by
// libjpeg, without the image library, and JPEG of other colours with it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>

namespace vitrail {

// The channels are Y, Y and alpha, RGB, or RGB and alpha, as in a StoredImage.
struct ByteRows {
  int width = 0, height = 0, channels = 0;
  // It calls its argument with all rows from the top, one or several at a time. What that function throws
  // stops the reading. It throws Error with the file's name where the picture is damaged.
  std::function<void(const std::function<void(std::span<const std::uint8_t>)>&)> read;
  std::uint64_t reading_bytes = 0;  // that this takes beside a row
};

// Reads files that need no library. Returns nothing for other files.
std::optional<ByteRows> plain_rows(const std::filesystem::path& file);

// Returns nothing for other files, for parts of files, and for PNG that is interlaced, has a palette, or
// states a transparent colour: the image library reads those. Throws Error for a file that may not be read.
std::optional<ByteRows> byte_rows(const std::filesystem::path& file);

}  // namespace vitrail
