// SPDX-License-Identifier: Apache-2.0
// POV-Ray 3.7, in the part of its language that shows the Scene's own radiometry.
#pragma once

#include <filesystem>

#include "scene/records/scene.h"

namespace vitrail {

// Writes OUT.pov, OUT.ini (size, crop and sampling: `povray OUT.ini` in its folder renders linear EXR) and
// the larger meshes as OUT-meshes/000000.inc … . Triangles are in world space, prototypes and their instances
// stay. Exact are: geometry, cameras, constant colours and images of diffuse surfaces, point, distant and
// pbrt's spot lights, rectangles that shine and environments. Light that comes over other surfaces, or from
// shapes that are no rectangles, is POV-Ray's radiosity, an approximation like its models of all other
// materials; the diagnostics say which. So are homogeneous media that scatter: once, light of light sources.
// Media of grids are dropped. Throws MachineError.
Diagnostics write_povray(const Scene& scene, const std::filesystem::path& out);

}  // namespace vitrail
