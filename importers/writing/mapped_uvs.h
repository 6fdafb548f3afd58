// SPDX-License-Identifier: Apache-2.0
// How textures are laid out, where a format cannot say it: written into the (u,v) of meshes.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "importers/writing/conversion_notes.h"
#include "scene/records/scene.h"

namespace vitrail {

struct MappedUvs {
  Scene scene;
  std::vector<std::pair<Origin, std::string>> notes;  // of shapes that are not quite as they were
};

// The scene with copies of meshes whose (u,v) are what `is_kept` says that the format has no mapping for. All
// textures that show on such a mesh have one mapping, which then is the (u,v) themselves; nothing on it goes
// by the direction of u. Exact for turned and sheared (u,v) and for planes; around spheres and cylinders
// within 1/500 of the image, by smaller triangles. Nothing where no mesh is so.
std::optional<MappedUvs> with_mapped_uvs(const Scene& scene, bool (*is_kept)(const TextureMapping&));

// Says what is not quite as it was.
void note(ConversionNotes& notes, const std::optional<MappedUvs>& mapped);

// A mapping that scales and moves (u,v) alone.
bool is_unturned(const TextureMapping& mapping);

}  // namespace vitrail
