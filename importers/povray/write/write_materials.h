// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "importers/povray/write/context.h"

namespace vitrail::povray {

constexpr double smooth_alpha = 0.01;  // below it, microfacets do not show

// It is a material as POV-Ray has it, in its own words: whole statements, or "".
struct Surface {
  std::string texture;  // one or more layers: texture { … } texture { … }
  std::string back;     // of the inside, where it differs
  std::string interior;
  std::string turned;  // the interior of shapes whose front is inside: there the index is 1/n
};

// Returns what the names stand for that other materials, meshes and emitters use: `Material_3`, and where
// there is such a thing `Back_3` (the texture of the inside), `Interior_3` and `Turned_3`.
Surface surface_of(Context& context, Id<Material> material);

// Returns "texture { … }" of two textures (their names, or their content) in the proportion of `amount`: 0 is
// the first one alone.
std::string weighted(Context& context, const FloatParameter& amount, const std::string& at_0,
                     const std::string& at_1, const Origin& user);

// Returns the texture and interior of a shape: "texture { Material_3 } interior { Interior_3 }".
// `inside_out` says that the shape's front is inside.
// `media` is what fills it, "media { … }" or "".
std::string use_of(Context& context, const Shape& shape, const Surface& surface, bool inside_out,
                   const std::string& media);

// Returns the same for a shape that shines.
std::string emitter_of(Context& context, const Shape& shape, const Surface& surface, const AreaLight& light);

// Returns whether a texture of the material, or of one that it is made of, is looked up by uvs.
bool uses_uvs(const Scene& scene, Id<Material> material);
// Returns whether nothing of it shows.
bool is_invisible(const Scene& scene, Id<Material> material);

}  // namespace vitrail::povray
