// SPDX-License-Identifier: Apache-2.0
// glTF's materials become these models:
//   metallic-roughness            principled, GGX of width roughness² over Lambert's diffuse part, which gets
//                                 what is not reflected (docs/why/converting.md)
//   KHR_materials_specular of 0   Lambert's, where nothing is metal or coated
//   KHR_materials_transmission    a sheet (thin dielectric, or thin principled); with KHR_materials_volume's
//                                 thickness a solid (dielectric, or principled) with a medium that absorbs
//                                 inside
//   KHR_materials_unlit           black, and a light of the base colour
// Alpha is the opacity of the shape. Materials scatter on both sides, as in renderers of paths, also where
// doubleSided is false; what shines shines on the front alone there.
#pragma once

#include <map>
#include <optional>

#include "importers/gltf/read/textures.h"

namespace vitrail::gltf {

// A Surface holds what a shape gets of a material.
struct Surface {
  Id<Material> material;
  std::optional<Id<AreaLight>> light;
  FloatParameter opacity = 1.0f;
  std::optional<Id<Medium>> interior;
  int uv_set = 0;  // TEXCOORD_n, by which its meshes are laid out
  bool has_color_map = false;
};

// They are the names of the attributes of COLOR_0.
inline constexpr const char* vertex_color = "vertex_color";
inline constexpr const char* vertex_alpha = "vertex_alpha";

class Materials {
 public:
  Materials(const Document& document, Scene& scene, Diagnostics& diagnostics)
      : document_(document),
        scene_(scene),
        diagnostics_(diagnostics),
        textures_(document, scene, diagnostics) {}

  // Returns the surface of a material; without one it is glTF's default, for a primitive of `mesh`.
  // `color_channels` is 0, or 3 or 4 of COLOR_0, which multiplies the base colour.
  const Surface& surface(int material, int color_channels, int mesh);

  // Returns how many materials have doubleSided false, of those that were asked for.
  int single_sided() const { return single_sided_; }

 private:
  const Document& document_;
  Scene& scene_;
  Diagnostics& diagnostics_;
  Textures textures_;
  std::map<std::pair<int, int>, Surface> known_;
  int single_sided_ = 0;
};

}  // namespace vitrail::gltf
