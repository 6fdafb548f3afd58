// SPDX-License-Identifier: Apache-2.0
// The scenes of bench_render, made here: no corpus is needed.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scene/records/scene.h"

namespace vitrail::test {

// Eight bumpy spheres in a room with a lamp: 1.06 million triangles.
Scene million_room();

struct NamedScene {
  std::string name;
  Scene scene;
};
// One for each way in which renders spend their time. Images go into `folder`.
std::vector<NamedScene> render_scenes(const std::filesystem::path& folder);

}  // namespace vitrail::test
