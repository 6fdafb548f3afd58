// SPDX-License-Identifier: Apache-2.0
// This file cuts a picture of all directions into six, on the faces of a cube around the origin.
#pragma once

#include <vector>

#include "importers/images/environment_images.h"
#include "scene/geometry/transform.h"

namespace vitrail {

// Local +z looks at the middle of the face, which lies within ±1 of it in x and y at distance 1.
struct CubeFace {
  Transform to_picture;  // directions of the face → of the picture
  Image image;           // square, the upper row at +y, the left column at −x
};

// Returns the faces. Each pixel is the mean over its part of the face, times cosⁿθ of the angle from the
// face's middle. Faces that are black are left out.
std::vector<CubeFace> cube_faces(const Image& picture, EnvironmentProjection projection, int cosine_power);

}  // namespace vitrail
