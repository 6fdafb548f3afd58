// SPDX-License-Identifier: Apache-2.0
// POV-Ray's (u,v) of a surface follow from the point.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>

#include "importers/solids/spline.h"
#include "scene/geometry/transform.h"
#include "scene/records/scene.h"

namespace vitrail::pov {

// `at(p, inside)` gives those of a point p of a triangle around `inside`, in the space of the shape. u is not
// a number on an axis, where any would do. Around the axis u begins anew.
struct SurfaceUvs {
  std::function<Point2d(Point3d p, Point3d inside)> at;  // empty: the world's x and y
  bool begins_anew = false;
};
SurfaceUvs sphere_uvs(Point3d center);
SurfaceUvs box_uvs(Point3d corner1, Point3d corner2);
SurfaceUvs torus_uvs(double major);
// Returns (u,v) by the angle around y and by how far along the curve of these points it is, where each
// segment counts as equally long.
SurfaceUvs lathe_uvs(solids::SplineKind kind, std::span<const Point2d> points);
SurfaceUvs revolution_uvs(std::span<const Point2d> points);
// `corners` has the (u,v) at the patch's (0,0), (1,0), (1,1), (0,1).
SurfaceUvs patch_uvs(const std::array<Point3d, 16>& points, const std::array<Point2d, 4>& corners);
// Returns the same for a surface that a transform moves.
SurfaceUvs moved(SurfaceUvs uvs, const Transform& to_world);

// Gives each triangle vertices of its own, with these (u,v).
TriangleMesh with_uvs(const TriangleMesh& mesh, const SurfaceUvs& uvs);

}  // namespace vitrail::pov
