// SPDX-License-Identifier: Apache-2.0
#include "film/own_picture.h"

#include <algorithm>
#include <fstream>
#include <string>

#include "film/renderer_version.h"

namespace vitrail {

namespace {

// PNG, JPEG and OpenEXR have it before the pixels, TIFF after them.
constexpr std::streamoff searched = 64 << 10;

// The end of what to_string says of every renderer, before the number.
std::string signature() {
  const std::string text = to_string(this_renderer());
  return text.substr(text.find(','), text.rfind(' ') + 1 - text.find(','));
}

std::string bytes_at(std::ifstream& in, std::streamoff begin, std::streamoff end) {
  std::string bytes(static_cast<std::size_t>(std::max<std::streamoff>(end - begin, 0)), '\0');
  in.seekg(begin);
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return bytes;
}

}  // namespace

bool is_own_picture(const std::filesystem::path& file) {
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(file, unknown)) return false;
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  const std::streamoff size = in.tellg();
  const std::string first = bytes_at(in, 0, std::min(size, searched)),
                    last = bytes_at(in, std::max<std::streamoff>(0, size - searched), size);
  if (file.extension() == ".csv") return first.starts_with("x,y,z,nx,ny,nz,illuminance_lx,");
  return first.find(signature()) != std::string::npos || last.find(signature()) != std::string::npos;
}

}  // namespace vitrail
