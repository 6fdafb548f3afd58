// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>

#include "bundle/texture_file.h"
#include "tests/support/temporary_directory.h"
#include "tests/tracer/lights/light_fixtures.h"

namespace vitrail::test {

inline constexpr const char* file_of_image = "textures/000000.tex";

// Numbers, row by row from the top. Level l is the mean of 2^l × 2^l texels, as far as the image goes.
inline void write_image(const std::filesystem::path& path, std::uint32_t width, std::uint32_t height,
                        const std::vector<float>& rows) {
  const auto texel = [&](std::uint32_t level, std::uint32_t x, std::uint32_t y) {
    double sum = 0;
    const std::uint32_t size = 1u << level;
    for (std::uint32_t j = 0; j < size; ++j)
      for (std::uint32_t i = 0; i < size; ++i)
        sum += static_cast<double>(rows[(height - 1 - std::min(y * size + j, height - 1)) * width +
                                        std::min(x * size + i, width - 1)]);
    return TexelWords{std::bit_cast<std::uint32_t>(static_cast<float>(sum / size / size))};
  };
  std::filesystem::create_directories(path.parent_path());
  write_texture_file(path, {TexelFormat::number, width, height, texture_level_count(width, height)}, texel);
}

// Lights whose textures read one image, `file_of_image`.
struct TexturedLights {
  TemporaryDirectory directory;
  std::vector<Texture> records;
  Textures textures;

  TexturedLights(std::vector<Texture> t, std::uint32_t width, std::uint32_t height,
                 const std::vector<float>& rows)
      : records(std::move(t)), textures(open(directory.path(), records, width, height, rows)) {}

  LightScene scene(std::span<const Light> lights) const {
    LightScene s;
    s.lights = lights;
    s.textures = &textures;
    s.texture_records = records;
    s.bounds = {{-1, -1, -1}, {1, 1, 1}};
    return s;
  }

 private:
  static Textures open(const std::filesystem::path& bundle, const std::vector<Texture>& records,
                       std::uint32_t width, std::uint32_t height, const std::vector<float>& rows) {
    write_image(bundle / file_of_image, width, height, rows);
    return Textures(records, bundle, 1 << 20);
  }
};

}  // namespace vitrail::test
