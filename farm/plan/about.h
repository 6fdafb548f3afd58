// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "bundle/manifest.h"
#include "farm/plan/options.h"

namespace vitrail {

// Returns FilmProgress::about of a render: {"scene": name, "camera": kind, "world_to_camera": 16 numbers, row
// by row, of a matrix that takes columns; "world_to_ndc": the same, but of cameras that see all directions;
// "parts": the scene in words (scene_parts.h); "mattes": {"crypto_object": names of masks,
// "crypto_material"}, of films that keep them; "glazing", "sampling": what was asked for, where it was}.
// Camera space is +x right, +y up, +z the view; in the other x and y go from −1 to 1 over the picture, right
// and up, and z from 0, 0.01 before the camera, to 1, infinitely far (an orthographic one's z is the
// camera's).
std::string about(const Manifest& manifest, const RenderOptions& options);

}  // namespace vitrail
