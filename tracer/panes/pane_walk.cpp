// SPDX-License-Identifier: Apache-2.0
#include "tracer/panes/pane_walk.h"

#include "tracer/bsdf/local.h"
#include "tracer/panes/parallel_faces.h"
#include "tracer/rays/rounding.h"

namespace vitrail {

namespace {

// Files give the index of air as 1 or as what it is, 1.0003.
constexpr double index_of_air = 6e-4;

}  // namespace

ParallelWay parallel_way(Vector3d direction, bool back, Vector3d to_light, const MetFace& face,
                         double doubt_rad) {
  const auto mirrored = [&](Vector3d v) { return v - face.normal * (2 * dot(v, face.normal)); };
  const auto as_it_goes = [&](Vector3d v) { return back ? mirrored(v) : v; };
  ParallelWay way;
  way.to_light = to_light;
  way.turned = mirrored(direction);
  way.passes = refract(-direction, face.normal, face.eta, way.passed);
  // As if it was on its way there.
  const Vector3d there = as_it_goes(direction), normal = as_it_goes(face.normal);
  if (!(dot(to_light, normal) < 0)) return way;
  // What a mirror's normal is off by counts twice.
  const double turned_by = back ? 2 * doubt_rad : 0;
  way.is_in = length(there - to_light) <= turned_by + doubt_rad + 2 * direction_rounding;
  const OffNormal met = off_normal(there, to_light, face.eta, normal);
  way.is_out = met.along_face <= doubt_rad * met.length + turned_by + direction_rounding * (1 + face.eta);
  if (!way.is_in && !way.is_out) {
    const Vector3d along = cross(to_light, normal);
    way.is_within = length(cross(there, normal) * face.near_index - along) <=
                    index_of_air * length(along) + turned_by + doubt_rad + 2 * direction_rounding;
    return way;
  }
  // Anew from the light's direction.
  Vector3d arriving = to_light, passing = to_light;
  if (!way.is_in) refract(-to_light, normal, 1 / face.eta, arriving);
  way.passes = way.is_out || refract(-to_light, normal, face.eta, passing);
  way.turned = as_it_goes(mirrored(arriving));
  way.passed = as_it_goes(passing);
  return way;
}

}  // namespace vitrail
