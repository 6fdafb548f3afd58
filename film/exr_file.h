// SPDX-License-Identifier: Apache-2.0
// This file writes pictures as OpenEXR without a library, so also where there is no OpenImageIO.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "images/image_codec.h"
#include "scene/system/atomic_file.h"

namespace vitrail {

// An ExrFile has scan lines, compressed by ZIP in blocks of 16 (OpenEXR, "File Layout"). It is written as its
// rows come: no more than a block of them is in memory. Channels are sorted by name, as the format asks for.
// "DateTime" and "Software" are called capDate and software there. Throws MachineError.
class ExrFile {
 public:
  ExrFile(const std::filesystem::path& file, const PictureFile& picture);

  // Adds the next row from the top: 32 bits each, interleaved as the picture's channels.
  void add_row(std::span<const std::uint32_t> pixels);
  // Ends the file after all rows. The file appears now.
  void commit();

 private:
  void write_block();

  AtomicFile out_;
  std::vector<std::size_t> order_;  // of the channels
  int y_, height_;                  // of the picture
  std::uint64_t table_ = 0;         // place of the offsets
  std::vector<std::uint64_t> offsets_;
  int rows_ = 0;
  std::vector<std::uint8_t> block_;
};

}  // namespace vitrail
