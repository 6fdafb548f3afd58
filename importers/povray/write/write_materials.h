// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "importers/povray/write/context.h"

namespace vitrail::povray {

constexpr double smooth_alpha = 0.01;  // below it, microfacets do not show

// A material as POV-Ray has it, in its own words: whole statements, or "".
struct Surface {
  std::string texture;  // one or more layers: texture { … } texture { … }
  std::string back;     // of the inside, where it differs
  std::string interior;
  std::string turned;  // the interior of shapes whose front is inside: there the index is 1/n
};

// What the names stand for that other materials, meshes and emitters use: `Material_3`, and where there is
// such a thing `Back_3` (the texture of the inside), `Interior_3` and `Turned_3`.
Surface surface_of(Context& context, Id<Material> material);

// "texture { … }" of two textures (their names, or what stands in them) in the proportion of `amount`: 0 is
// the first one alone.
std::string weighted(Context& context, const FloatParameter& amount, const std::string& at_0,
                     const std::string& at_1, const Origin& user);

// The texture and interior of a shape: "texture { Material_3 } interior { Interior_3 }".
// `inside_out` is the shape, whose front is inside.
// `media` is what fills it, "media { … }" or "".
std::string use_of(Context& context, const Shape& shape, const Surface& surface, bool inside_out,
                   const std::string& media);

// The same for a shape that shines.
std::string emitter_of(Context& context, const Shape& shape, const Surface& surface, const AreaLight& light);

// Whether a texture of the material, or of one that it is made of, is looked up by uvs.
bool uses_uvs(const Scene& scene, Id<Material> material);
// Whether nothing of it shows.
bool is_invisible(const Scene& scene, Id<Material> material);

}  // namespace vitrail::povray
