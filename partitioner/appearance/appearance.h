// SPDX-License-Identifier: Apache-2.0
// The appearance is what a bundle keeps of a scene besides its triangles: its records, ready for rendering.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bundle/manifest.h"
#include "partitioner/appearance/bake_textures.h"
#include "scene/records/scene.h"

namespace vitrail {

// Spectra are resolved, images baked, transforms still the world's. Only what some shape uses is there:
// `material_ids`, `area_light_ids` and `medium_ids` say where, by the ids of the scene; −1: not used.
struct Appearance {
  std::vector<Material> materials;
  std::vector<Texture> textures;
  std::vector<ScatteringTable> tables;
  std::vector<Medium> media;
  std::vector<AreaLight> area_lights;
  std::vector<Light> lights;
  std::vector<std::int32_t> material_ids, area_light_ids, medium_ids;
  // Tubes stand in the place of some curves. For each material of the scene this names one that
  // shows it on their outer walls, and nothing on the inner ones. −1: it is not used so, or both
  // walls are alike (curve_uses.h).
  std::vector<std::int32_t> outer_wall_ids;
  std::vector<FloatParameter> opacities;            // by texture of the scene that is some shape's opacity
  std::vector<std::int32_t> material_interiors;     // index of the medium that a material of the scene brings
  std::vector<TextureBaker::Attribute> attributes;  // the mesh attributes that textures read
  std::vector<TextureFileEntry> texture_files;
  Diagnostics diagnostics;  // what stands for something else, and what is left out
};

// Writes textures/ into the bundle where images are in use; nothing where `bundle` is empty. Throws Error for
// images and volumes that cannot be read.
Appearance appearance_of(const Scene& scene, const std::filesystem::path& bundle,
                         const ImageBaking& images = {});

}  // namespace vitrail
