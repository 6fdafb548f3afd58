// SPDX-License-Identifier: Apache-2.0
// Boxes of what a plan places, and where most of its triangles lie. World coordinates, or the parent's,
// before the parent's centre is taken off.
#pragma once

#include <vector>

#include "partitioner/placing/frame.h"
#include "partitioner/placing/objects.h"

namespace vitrail {

// The greatest sum of magnitudes in a row of the linear part: by so much a vector's greatest coordinate
// grows.
double greatest_row(const Transform& t);
Bounds3d transformed(const Transform& t, const Bounds3d& box);

// The box of the corners of the mesh's own, in the world. Throws Error where floats cannot hold it: with the
// vertex, where there is one.
Bounds3d world_bounds(const Placement& p);
// Of a use, or a run of uses. Throws Error where floats cannot hold it.
Bounds3d box_of(const std::vector<Assembly>& objects, const ObjectUse& use);
Bounds3d box_of(const QuadricRun& run);

// The half of the triangles of a mesh, of a use or of a run, where it stands.
FramePart part_of(const Placement& p);
FramePart part_of(const std::vector<Assembly>& objects, const ObjectUse& use);
FramePart part_of(const QuadricRun& run);

// Rounded outwards.
Bounds3f placed_bounds(const Quadric& quadric, const Affine& to_parent);
Bounds3f swept(const Motion& motion, const Bounds3d& box);
// Where the object stands, or moves, that a use of the scene, or a use within its object, is of.
Bounds3f placed_bounds(const Assembly& object, const Affine& to_parent);

}  // namespace vitrail
