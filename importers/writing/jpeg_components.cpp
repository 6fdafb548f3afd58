// SPDX-License-Identifier: Apache-2.0
#include "importers/writing/jpeg_components.h"

#include <algorithm>
#include <array>
#include <fstream>

#include "scene/system/input_files.h"

namespace vitrail {

int jpeg_components(const std::string& filename) {
  std::ifstream file = open_input(filename);
  std::array<unsigned char, 4> segment{};  // its marker and length
  file.seekg(2);
  while (file.read(reinterpret_cast<char*>(segment.data()), segment.size()) && segment[0] == 0xff) {
    const int marker = segment[1], length = segment[2] << 8 | segment[3];
    const bool is_frame =
        marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
    file.seekg(is_frame ? 5 : length - 2, std::ios::cur);
    if (is_frame) return std::max(0, file.get());
  }
  return 0;
}

}  // namespace vitrail
