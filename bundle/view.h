// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/geometry/motion.h"
#include "scene/records/camera.h"

namespace vitrail {

// A View says how a scene is seen, in the world of its file.
struct View {
  Camera camera;
  Motion motion;  // none: it stands still
  Shutter shutter;
  int width = 0, height = 0;  // of the film that the camera's screen covers
};

}  // namespace vitrail
