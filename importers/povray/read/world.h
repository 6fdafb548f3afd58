// SPDX-License-Identifier: Apache-2.0
// A World is a scene as its file says it, before it becomes a Scene.
#pragma once

#include <optional>
#include <vector>

#include "importers/povray/read/fog.h"
#include "importers/povray/read/object.h"
#include "importers/povray/read/view.h"

namespace vitrail::pov {

class Reader;

// It is an object that stands in the scene, with what `#default` said when it was whole: povray looks no
// earlier, not even where an identifier was declared, and no later.
struct Placed {
  Shared<Object> object;
  Shared<Texture> default_texture;
};

struct World {
  std::vector<Placed> objects;
  Shared<CameraView> camera;
  Shared<SkySphere> sky;
  std::vector<Shared<Fog>> fogs;
  std::vector<Shared<MediaBlock>> media;  // around everything
  std::optional<Numbers> background;
  std::optional<Numbers> ambient_light;
  bool radiosity = false, photons = false;
  int max_trace_level = 5;
  Place background_place, photons_place;
};

// Reads the file to its end.
World read_world(Reader& reader);

}  // namespace vitrail::pov
