// SPDX-License-Identifier: Apache-2.0
// A format may have no words for how textures are laid out. That is then written into the (u,v) of meshes.
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

// Returns the scene with copies of meshes whose (u,v) include the mappings that the format lacks: those that
// are not `is_kept`. All textures that show on such a mesh have one mapping, which then is the (u,v)
// themselves; nothing on it depends on the direction of u. It is exact for turned and sheared (u,v) and for
// planes; around spheres and cylinders within 1/500 of the image, by smaller triangles. Returns nothing where
// no mesh is so.
std::optional<MappedUvs> with_mapped_uvs(const Scene& scene, bool (*is_kept)(const TextureMapping&));

// Says what is not quite as it was.
void note(ConversionNotes& notes, const std::optional<MappedUvs>& mapped);

// Returns whether a mapping scales and moves (u,v) alone.
bool is_unturned(const TextureMapping& mapping);

}  // namespace vitrail
