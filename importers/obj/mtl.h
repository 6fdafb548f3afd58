// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace vitrail {

struct MtlMaterial {
  std::string name;
  Material material;
  std::optional<AreaLight> light;
  SourceLocation location;
};

// The materials of an MTL library, in its order. Colours are linear sRGB.
//   Kd                                        diffuse reflectance, clamped to [0,1]; 0 if not given, but 0.5
//   if a map_Kd is Ni > 1 with d < 1 or illum 4, 6, 7, 9     smooth dielectric of that index d = 0 (or Tr =
//   1) otherwise               no surface at all Ke                                        area light; from
//   both sides, since materials of MTL have no sides
// `d` goes before `Tr` where both are given. Everything else that would show is reported, once a keyword.
// Throws Error on what is not a number where one has to be, and where the file cannot be opened.
std::vector<MtlMaterial> read_mtl(const std::filesystem::path& file, Diagnostics& diagnostics);

}  // namespace vitrail
