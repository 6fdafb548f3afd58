// SPDX-License-Identifier: Apache-2.0
// These are boxes of what a plan places, and where most of its triangles lie. They are in world coordinates,
// or the parent's, before the parent's centre is taken off.
#pragma once

#include <vector>

#include "partitioner/placing/frame.h"
#include "partitioner/placing/objects.h"

namespace vitrail {

// Returns the greatest sum of magnitudes in a row of the linear part: a vector's greatest coordinate
// grows by at most that factor.
double greatest_row(const Transform& t);
Bounds3d transformed(const Transform& t, const Bounds3d& box);

// Returns the box in the world of the corners of the mesh's own box. Throws Error where floats cannot hold
// it: with the vertex, where there is one.
Bounds3d world_bounds(const Placement& p);
// They return the box of a use, or of a run of uses. They throw Error where floats cannot hold it.
Bounds3d box_of(const std::vector<Assembly>& objects, const ObjectUse& use);
Bounds3d box_of(const QuadricRun& run);

// They return where half of the triangles of a mesh, of a use or of a run lie, where it stands.
FramePart part_of(const Placement& p);
FramePart part_of(const std::vector<Assembly>& objects, const ObjectUse& use);
FramePart part_of(const QuadricRun& run);

// These boxes are rounded outwards.
Bounds3f placed_bounds(const Quadric& quadric, const Affine& to_parent);
Bounds3f swept(const Motion& motion, const Bounds3d& box);
// Returns where an object that the scene or another object uses stands, or moves.
Bounds3f placed_bounds(const Assembly& object, const Affine& to_parent);

}  // namespace vitrail
