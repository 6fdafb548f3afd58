// SPDX-License-Identifier: Apache-2.0
// The values of the cross product's dimensions. Each adds records to a scene that is being made.
#pragma once

#include <filesystem>
#include <span>

#include "scene/records/scene.h"

namespace vitrail::test {

struct SceneParts {
  Scene scene;
  std::filesystem::path images;
  // What materials are made of.
  SpectrumParameter color;
  FloatParameter number = 0.3f;

  Id<Texture> add(TextureModel model, bool is_float) {
    scene.textures.push_back({std::move(model), is_float, "", {}});
    return {static_cast<std::uint32_t>(scene.textures.size() - 1)};
  }
  Id<Material> add(Material material) {
    scene.materials.push_back(std::move(material));
    return {static_cast<std::uint32_t>(scene.materials.size() - 1)};
  }
  Id<TriangleMesh> add(TriangleMesh mesh) {
    scene.meshes.push_back(std::move(mesh));
    return {static_cast<std::uint32_t>(scene.meshes.size() - 1)};
  }
  void add(LightModel light) { scene.lights.push_back({std::move(light), {}}); }
  std::string image(const char* name) const { return (images / name).string(); }
};

struct ColorValue {
  const char* name;
  SpectrumParameter (*make)(SceneParts&);
};
struct NumberValue {  // in [0.1, 0.9]
  const char* name;
  FloatParameter (*make)(SceneParts&);
};
struct MaterialValue {
  const char* name;
  MaterialModel (*make)(const SceneParts&);
};
struct WrapperValue {
  const char* name;
  Id<Material> (*make)(SceneParts&, Material inner);
};
struct LightValue {
  const char* name;
  void (*make)(SceneParts&);
};
struct ShapeValue {
  const char* name;
  void (*make)(SceneParts&, Id<Material>);
};
std::span<const ColorValue> color_values();
std::span<const NumberValue> number_values();
std::span<const MaterialValue> material_values();
std::span<const WrapperValue> wrapper_values();
std::span<const LightValue> light_values();
std::span<const ShapeValue> shape_values();

// a.png, b.png (8-bit colours), grey.png, a.exr, normal.png, sky.exr (2:1) and octahedron.exr (square).
void write_part_images(const std::filesystem::path& folder);

}  // namespace vitrail::test
