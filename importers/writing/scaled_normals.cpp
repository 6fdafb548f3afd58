// SPDX-License-Identifier: Apache-2.0
#include "importers/writing/scaled_normals.h"

#include <algorithm>
#include <set>

#include "images/image_files.h"
#include "images/texture_values.h"
#include "importers/writing/side_files.h"
#include "scene/models/normal_map.h"
#include "scene/records/material_traits.h"

namespace vitrail {

namespace {

// Materials of shapes, and those that they are made of.
std::set<std::uint32_t> shown_materials(const Scene& scene) {
  std::set<std::uint32_t> shown;
  const auto add = [&](Id<Material> id, const auto& add_part) -> void {
    if (!shown.insert(id.value).second) return;
    for (const Id<Material> part : parts_of(scene.materials[id.value].model)) add_part(part, add_part);
  };
  for (const Shape& shape : scene.shapes) add(shape.material, add);
  for (const Prototype& prototype : scene.prototypes)
    for (const Shape& shape : prototype.shapes) add(shape.material, add);
  return shown;
}

std::set<std::uint32_t> scaled_normals(const Scene& scene) {
  std::set<std::uint32_t> maps;
  for (const std::uint32_t id : shown_materials(scene)) {
    const Material& material = scene.materials[id];
    const auto map = material.normal_map ? normal_map_of(scene.textures, *material.normal_map) : std::nullopt;
    if (map && map->image != *material.normal_map) maps.insert(material.normal_map->value);
  }
  return maps;
}

Image values_of(const ImageTexture& texture, const std::array<float, 3>& factors) {
  const Image stored = texture_values(texture, read_stored_image(texture.filename), ImageUse::vector);
  Image image = black_image(stored.width, stored.height, 3);
  const auto channels = static_cast<std::size_t>(stored.channels);
  for (std::size_t i = 0; i < stored.pixels(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      image.values[3 * i + c] =
          0.5f + factors[c] * (stored.values[channels * i + (channels < 3 ? 0 : c)] - 0.5f);
  return image;
}

}  // namespace

bool has_scaled_normals(const Scene& scene) { return !scaled_normals(scene).empty(); }

void write_scaled_normals(Scene& scene, const std::filesystem::path& out) {
  const SideFiles files(out);
  const std::filesystem::path folder = std::filesystem::absolute(out).parent_path();
  std::size_t count = 0;
  for (const std::uint32_t id : scaled_normals(scene)) {
    Texture& texture = scene.textures[id];
    const NormalMap map = *normal_map_of(scene.textures, Id<Texture>{id});
    ImageTexture image = std::get<ImageTexture>(scene.textures[map.image.value].model);
    try {
      const Image values = values_of(image, map.factors);
      image.filename = (folder / files.name("normals", count++, "exr")).string();
      write_exr_image(image.filename, values);
    } catch (const Error& error) {
      throw Error(error.what(), location(scene, texture.origin));
    }
    image.encoding = Encoding::linear;
    image.scale = 1, image.invert = false;
    texture.model = image;
  }
}

}  // namespace vitrail
