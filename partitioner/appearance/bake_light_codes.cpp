// SPDX-License-Identifier: Apache-2.0
#include "partitioner/appearance/bake_light_codes.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "bundle/light_code.h"
#include "bundle/texture_writer.h"
#include "partitioner/appearance/row_pyramid.h"

namespace vitrail {

namespace {

struct NoCode {};

// Returns the bytes of a row of values, of which `code` makes codes.
template <class Code>
std::vector<std::byte> bytes_of_row(std::span<const float> row, std::size_t channels, const Code& code) {
  std::vector<std::byte> bytes;
  bytes.reserve(row.size() / channels * 6);
  for (std::size_t i = 0; i < row.size(); i += channels)
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t of = code(row[channels < 3 ? i : i + c]);
      bytes.push_back(static_cast<std::byte>(of & 0xff));
      bytes.push_back(static_cast<std::byte>(of >> 8));
    }
  return bytes;
}

std::uint32_t code_or_throw(float value) {
  if (const auto code = exact_code(value)) return *code;
  throw NoCode();
}

}  // namespace

std::optional<WrittenTextureFile> write_light_codes(const std::filesystem::path& file, const ImageRows& rows,
                                                    bool all_levels) try {
  const auto width = static_cast<std::uint32_t>(rows.width), height = static_cast<std::uint32_t>(rows.height);
  const TextureFileInfo info{TexelFormat::light_code_16, width, height,
                             all_levels ? texture_level_count(width, height) : 1};
  TextureWriter writer(file, info);
  std::optional<RowPyramid> pyramid;
  rows.read([&](Image values) {
    const auto channels = static_cast<std::size_t>(values.channels);
    if (!pyramid)
      pyramid.emplace(info, values.channels,
                      [&](std::uint32_t level, std::uint32_t, std::span<const float> row) {
                        writer.add_row(level, bytes_of_row(row, channels, nearest_code));
                      });
    for (float& v : values.values) v = std::isfinite(v) && v > 0 ? v : 0;
    for (std::span<const float> all = values.values; !all.empty(); all = all.subspan(width * channels)) {
      const std::span<const float> row = all.first(width * channels);
      writer.add_row(0, bytes_of_row(row, channels, code_or_throw));
      pyramid->add(row);
    }
  });
  return writer.finish();
} catch (const NoCode&) {
  return {};
}

}  // namespace vitrail
