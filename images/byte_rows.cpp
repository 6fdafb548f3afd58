// SPDX-License-Identifier: Apache-2.0
#include "images/byte_rows.h"

#include <array>
#include <cmath>
#include <fstream>
#include <vector>

#include "images/file_part.h"
#include "images/image_files.h"
#include "images/jpeg_rows.h"
#include "images/png_rows.h"
#include "scene/system/input_files.h"

namespace vitrail {

namespace {

bool is_jpeg(const std::filesystem::path& file) {
  std::array<unsigned char, 3> head{};
  std::ifstream in = open_input(file);
  return in.read(reinterpret_cast<char*>(head.data()), head.size()) && head[0] == 0xff && head[1] == 0xd8 &&
         head[2] == 0xff;
}

// Of other colours than jpeg_rows.h reads. The image library says i/255 of byte i.
ByteRows converted_rows(const std::filesystem::path& file) {
  const ImageLayout layout = read_image_layout(file);
  return {layout.width, layout.height, layout.channels, [file](const auto& visit) {
            std::vector<std::uint8_t> bytes;
            read_stored_rows(file, [&](const StoredImage& rows) {
              bytes.clear();
              for (const float v : rows.image.values)
                bytes.push_back(static_cast<std::uint8_t>(v * 255 + 0.5f));
              visit(bytes);
            });
          }};
}

}  // namespace

std::optional<ByteRows> plain_rows(const std::filesystem::path& file) {
  if (file_part(file.string())) return {};
  if (auto rows = png_rows(file)) return rows;
  return is_jpeg(file) ? jpeg_rows(file) : std::nullopt;
}

std::optional<ByteRows> byte_rows(const std::filesystem::path& file) {
  if (file_part(file.string())) return {};
  if (auto rows = plain_rows(file)) return rows;
  if (is_jpeg(file)) return converted_rows(file);
  return {};
}

}  // namespace vitrail
