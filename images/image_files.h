// SPDX-License-Identifier: Apache-2.0
// These functions read and write pictures that a scene refers to, where a format needs them in another form.
// The first call loads OpenImageIO.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>

#include "scene/records/image.h"
#include "scene/spectra/color.h"

namespace vitrail {

// A StoredImage has the numbers as the file stores them; integers are taken to [0,1], and nothing is decoded.
// Its channels are R, G, B, or one of a grey picture, and alpha where there is one.
struct StoredImage {
  Image image;
  bool integer = false;                          // in the file
  std::optional<Chromaticities> chromaticities;  // where the file states them
};

// An ImageLayout says what a file holds. Its pixels need not be read for that.
struct ImageLayout {
  int width = 0, height = 0, channels = 0;  // of a StoredImage
  bool integer = false;
  std::optional<Chromaticities> chromaticities;
  // They are the bytes of memory that reading takes, the library's own included: of the whole, and of some
  // rows at a time.
  std::uint64_t whole_bytes = 0, rows_bytes = 0;
};

// It is the memory that loading the library and opening a file take, as measured
// (tests/cli/too_little_memory_test.cpp).
inline constexpr std::uint64_t image_library_bytes = 132 << 20;

// Returns whether a file has needed the library, so that it is loaded.
bool image_library_is_loaded();

// They are the most that a file may state. They are checked before memory is reserved for the picture.
inline constexpr int max_image_extent = 1 << 20;
inline constexpr std::uint64_t most_image_pixels = std::uint64_t{1} << 30;

// These functions throw Error with the file's name, or MachineError where OpenImageIO cannot be loaded.
ImageLayout read_image_layout(const std::filesystem::path& file);
StoredImage read_stored_image(const std::filesystem::path& file);

// Reads the same from the top, some rows at a time. It never has more of the picture in memory than the
// file's own rows of tiles. What `visit` throws stops the reading.
void read_stored_rows(const std::filesystem::path& file, const std::function<void(StoredImage)>& visit);

// Returns the colours in linear sRGB, without alpha; integers are decoded.
Image read_linear_image(const std::filesystem::path& file);

// Writes linear 32-bit floats as a part of a scene (AtomicFile::commit_part): the file appears whole or not
// at all, and equal images give equal files. Throws MachineError.
void write_exr_image(const std::filesystem::path& file, const Image& image);

}  // namespace vitrail
