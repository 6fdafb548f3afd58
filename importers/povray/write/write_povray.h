// SPDX-License-Identifier: Apache-2.0
// Scenes are written for POV-Ray 3.7, in the part of its language that shows the Scene's own radiometry.
#pragma once

#include <filesystem>

#include "scene/records/scene.h"

namespace vitrail {

// Writes OUT.pov, OUT.ini (size, crop and sampling: `povray OUT.ini` in its folder renders linear EXR) and
// the larger meshes as OUT-meshes/000000.inc … . Triangles are in world space, prototypes and their instances
// stay. It is exact for geometry, cameras, constant colours and images of diffuse surfaces, point, distant
// and pbrt's spot lights, rectangles that shine and environments. Light that comes over other surfaces, or
// from shapes that are no rectangles, is POV-Ray's radiosity, an approximation like its models of all other
// materials; the diagnostics say which. Homogeneous media that scatter are approximated, too: they scatter
// light of light sources, once. Media of grids are dropped. Throws MachineError.
Diagnostics write_povray(const Scene& scene, const std::filesystem::path& out);

}  // namespace vitrail
