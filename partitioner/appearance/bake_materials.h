// SPDX-License-Identifier: Apache-2.0
// This file bakes the materials of a bundle.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "partitioner/appearance/bake_textures.h"
#include "scene/records/scene.h"

namespace vitrail {

// A BakedMaterial is ready for rendering. `notes` say what stands for something else in it; `interior` is the
// medium that fills it where its model brings one (subsurface scattering).
struct BakedMaterial {
  Material material;
  std::vector<std::string> notes;
  std::optional<Medium> interior;
};

// A TableBaker has the tables of files, each read once.
class TableBaker {
 public:
  // Throws Error for a file that is not what the material says.
  Id<ScatteringTable> bake(const TabulatedMaterial& material);
  std::vector<ScatteringTable> take() { return std::move(tables_); }

 private:
  std::vector<ScatteringTable> tables_;
  std::map<std::pair<TabulatedMaterial::Format, std::string>, std::uint32_t> known_;
};

// `ids[i]` is the new id of the scene's material i; those that `material` refers to have one.
BakedMaterial bake_material(const Material& material, const std::vector<std::int32_t>& ids,
                            TextureBaker& textures, TableBaker& tables);

}  // namespace vitrail
