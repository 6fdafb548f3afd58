// SPDX-License-Identifier: Apache-2.0
// Wedged panes have faces that are less parallel than sunlight is connected through.
#pragma once

#include <optional>
#include <span>

#include "scene/geometry/transform.h"
#include "scene/records/scene.h"
#include "scene/shapes/mesh.h"

namespace vitrail {

// PaneFaces are of a mesh most of whose area faces one way and back. They say how far the two sides are off
// parallel, and how far the decimals of its file may have turned them together, in rad.
struct PaneFaces {
  double wedge_rad = 0, explained_rad = 0;
};
std::optional<PaneFaces> pane_faces(const TriangleMesh& mesh, const Transform& placed);

// They are the panes of smooth glass that are less parallel than float glass is and their decimals explain.
struct WedgedPanes {
  std::size_t count = 0;
  double widest_rad = 0;
  Origin widest;
};
WedgedPanes wedged_panes(const Scene& scene);

}  // namespace vitrail
