// SPDX-License-Identifier: Apache-2.0
// These functions turn normal maps given by the axes of their images, as glTF, OBJ, FBX and COLLADA mean
// them: the first number is along the image to the right, the second one up. A Scene's maps are along ∂p/∂u
// and N × ∂p/∂u, as pbrt's and Mitsuba's. The two are one but for signs, which change where (u,v) are
// mirrored: on half of a model that shows one image on both of its sides.
#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "scene/records/scene.h"
#include "scene/records/texture.h"

namespace vitrail {

// It says which of a normal map's axes run against those of a Scene's maps.
struct AgainstAxes {
  bool first = false, second = false;
  auto operator<=>(const AgainstAxes&) const = default;
};

struct UvPart {
  AgainstAxes against;
  std::vector<std::uint32_t> triangles;
};

// Returns the triangles of a mesh that is loaded, in parts by the axes of an image that is laid out so. The
// front is where the triangles run counter-clockwise, in a space that is not mirrored.
std::vector<UvPart> uv_parts(const TriangleMesh& mesh, const UvMapping& mapping);

// It makes materials with their normal maps turned over, each once.
class TurnedMaterials {
 public:
  explicit TurnedMaterials(Scene& scene) : scene_(scene) {}

  // Returns how the normal map of the material, or of a part of it, is laid out; nothing without one, or
  // where it is no image.
  std::optional<UvMapping> layout(Id<Material> id) const;

  // Returns the material with these axes of its normal maps, and of those of its parts, turned round.
  Id<Material> turned(Id<Material> id, AgainstAxes against);

 private:
  Id<Texture> turned_map(Id<Texture> id, AgainstAxes against, const Origin& origin);

  Scene& scene_;
  std::map<std::pair<std::uint32_t, AgainstAxes>, Id<Material>> known_;
};

// Turns the normal maps of what instances mirror: such instances get prototypes of their own.
void turn_mirrored_instances(Scene& scene, TurnedMaterials& materials);

// Turns all normal maps of the scene from the axes of their images to those of a Scene, or back: done twice,
// it changes nothing. Shapes that show both sides of (u,v) become one a side.
void turn_normal_maps(Scene& scene);

}  // namespace vitrail
