// SPDX-License-Identifier: Apache-2.0
#include "partitioner/appearance/baking_memory.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "images/byte_rows.h"
#include "images/file_part.h"
#include "images/texture_values.h"
#include "partitioner/appearance/bake_codes.h"
#include "scene/models/normal_map.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

// Of a picture: a PNG states them; others have at most so many a byte.
std::uint64_t most_pixels(const std::string& file) {
  constexpr std::uint64_t a_byte = 16;
  std::array<unsigned char, 24> head{};
  std::ifstream in(file, std::ios::binary);
  in.read(reinterpret_cast<char*>(head.data()), head.size());
  const auto number = [&](std::size_t at) {
    return std::uint64_t{head[at]} << 24 | std::uint64_t{head[at + 1]} << 16 |
           std::uint64_t{head[at + 2]} << 8 | head[at + 3];
  };
  if (in && head[1] == 'P' && head[2] == 'N' && head[3] == 'G') return number(16) * number(20);
  std::error_code unknown;
  const std::uint64_t bytes = std::filesystem::file_size(file, unknown);
  return unknown ? 0 : a_byte * bytes;
}

// Of normals, and of what shines where spectra are not by Jakob and Hanika: their values are kept, not their
// codes.
std::vector<bool> textures_of_values(const Scene& scene) {
  std::vector<bool> of_values(scene.textures.size());
  for (const Material& material : scene.materials)
    if (const auto map =
            material.normal_map ? normal_map_of(scene.textures, *material.normal_map) : std::nullopt)
      of_values.at(map->image.value) = true;
  const bool any_shines = std::ranges::any_of(scene.area_lights, [](const AreaLight& light) {
    return std::holds_alternative<Id<Texture>>(light.radiance);
  });
  if (any_shines && scene.settings.rgb != RgbMethod::jakob_hanika) of_values.assign(of_values.size(), true);
  return of_values;
}

// As TextureBaker::write_file has it, for what does not shine.
bool becomes_codes(const ImageTexture& image, bool is_float, const ByteRows& rows, RgbMethod method) {
  const TextureUse use = is_float ? TextureUse::number : TextureUse::reflectance;
  const bool chooses = is_float && rows.channels % 2 == 0;
  return coded_image(chooses ? without_choice(image) : image, rows, use, method).has_value();
}

class BakingCount {
 public:
  explicit BakingCount(int threads) : threads_(static_cast<std::uint64_t>(threads)) {}

  void add_codes(const ByteRows& rows) {
    ++coded_;
    widest_ = std::max(widest_, static_cast<std::uint64_t>(rows.width));
    reading_ = std::max(reading_, rows.reading_bytes);
  }
  // By rows, in the library: measured.
  void add_values(const std::string& file) {
    constexpr std::uint64_t least = 1 << 20, a_pixel = 64, most = 31 << 20;
    need(std::min(least + a_pixel * std::min(most_pixels(file), most), most));
    memory_.image_library = true;
  }
  // Codes take a row of tiles of each level, in each thread that writes: measured.
  BakingMemory memory() {
    constexpr std::uint64_t least = 1 << 18, a_column = 220;
    if (coded_ > 0) need(least + std::min(threads_, coded_) * (a_column * widest_ + reading_));
    return memory_;
  }

 private:
  void need(std::uint64_t bytes) { memory_.bytes = std::max(memory_.bytes, bytes); }

  std::uint64_t threads_, coded_ = 0, widest_ = 0, reading_ = 0;
  BakingMemory memory_;
};

}  // namespace

BakingMemory baking_memory(const Scene& scene, int threads) {
  BakingCount count(threads);
  const std::vector<bool> of_values = textures_of_values(scene);
  for (std::size_t i = 0; i < scene.textures.size(); ++i) {
    const Texture& texture = scene.textures[i];
    const auto* image = std::get_if<ImageTexture>(&texture.model);
    if (!image) continue;
    try {
      const bool is_part = file_part(image->filename).has_value();
      const auto rows = is_part || of_values[i] ? std::nullopt : plain_rows(image->filename);
      if (rows && becomes_codes(*image, texture.is_float, *rows, scene.settings.rgb))
        count.add_codes(*rows);
      else
        count.add_values(image->filename);
    } catch (const Error&) {  // it is said when the image is read
    }
  }
  for (const Light& light : scene.lights)
    std::visit(
        [&](const auto& l) {
          if constexpr (requires { l.filename; })
            if (!l.filename.empty()) count.add_values(l.filename);
        },
        light.model);
  return count.memory();
}

}  // namespace vitrail
