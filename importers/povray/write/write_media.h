// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "importers/povray/write/context.h"
#include "importers/povray/write/write_meshes.h"

namespace vitrail::povray {

// Returns "media { … }", once or more: the same σ_a, σ_s, phase function and emission, of grids by density
// files. POV-Ray scatters the light of its light sources, once. It is "" for none, and for media that are
// reported: procedural clouds, temperatures and emission by a grid.
std::string media_text(Context& context, std::optional<Id<Medium>> medium);

// Returns the medium inside of the closed surface of a shape.
std::optional<Id<Medium>> medium_inside(const Scene& scene, const Shape& shape, const MeshText& mesh);

// Returns the medium around everything: the camera is in it, and no shape holds it.
std::optional<Id<Medium>> medium_around(const Scene& scene);

}  // namespace vitrail::povray
