// SPDX-License-Identifier: Apache-2.0
// PNG files of chosen bytes: a library that writes images would divide or multiply by alpha.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace vitrail::test {

// 1 channel: grey; 2: with alpha; 3: RGB; 4: with alpha. The top row first; of 16 bits the high byte first.
void write_png(const std::filesystem::path& file, std::uint32_t width, std::uint32_t height, int channels,
               const std::vector<std::uint8_t>& bytes, int bits = 8);

}  // namespace vitrail::test
