// SPDX-License-Identifier: Apache-2.0
// Curves with a radius become triangle meshes here: tubes, and ribbons of twice the radius as their width.
#pragma once

#include <span>

#include "scene/shapes/curve.h"
#include "scene/shapes/mesh.h"
#include "scene/shapes/quadric_places.h"

namespace vitrail {

// It keeps curves as what they are; they go to places as they come. It throws Error for numbers that are not
// finite in single precision.
struct KeptCurves {
  KeptCurves(QuadricUv uv, std::uint64_t memory_bytes);
  void add(std::span<const PlacedCurve> curves);

  TriangleMesh mesh;
  std::shared_ptr<QuadricPlaces> places;  // the mesh's
};

// It says how finely curves are cut: steps along a segment, corners around a tube.
struct CurveDetail {
  int steps = 8, corners = 16;
};
// Returns the detail: finer for few segments, so that meshes stay within a few million triangles; 1 step
// where all are straight. Throws Error for so many segments that no mesh can hold them.
CurveDetail curve_detail(std::size_t segments, bool straight);

// Returns the steps a segment after which chords are this near to the curve (Wang 1984), at most `most`.
int steps_within(std::span<const CurveSegment> segments, double tolerance, int most);

// Appends the tube around a curve, as wide as that in the mean of all sides; its front is outside. u runs
// around it from 0 to 1, beginning at the second axis of Duff's frame (2017) around the first tangent; v runs
// along it from `v_first` to `v_last`, equally for all segments. `round_ends` adds half a sphere at either
// end, else the ends are open.
void append_tube(std::span<const CurveSegment> segments, const CurveDetail& detail, double v_first,
                 double v_last, bool round_ends, TriangleMesh& mesh);

// Appends a ribbon across a curve: it is perpendicular to the normals, one a segment's end (segments + 1),
// which are interpolated on the sphere. Where a normal is not perpendicular to the curve the ribbon is
// narrower, by the sine of their angle: it looks as wide as pbrt's. Its front is where the normals point; u
// runs along it, v across.
void append_ribbon(std::span<const CurveSegment> segments, std::span<const Vector3d> normals, int steps,
                   TriangleMesh& mesh);

}  // namespace vitrail
