// SPDX-License-Identifier: Apache-2.0
#include "tracer/surfaces/moved_point.h"

#include <optional>

#include "bundle/instance.h"
#include "scene/geometry/motion.h"

namespace vitrail {

namespace {

Transform transform_of(const Affine& a) {
  Transform t;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 4; ++j) t.m[i][j] = a.m[i][j];
  return t;
}

// From the coordinates of the innermost object that moves to the bundle's. What stands still within that
// moves along with it.
std::optional<Transform> from_mover(const DomainView& domain, const Hit& hit, double time_s) {
  const DomainView* at = &domain;
  Transform to_bundle;
  std::optional<Transform> found;
  for (std::uint32_t i = 0; i < hit.depth; ++i) {
    const InstanceRef& ref = at->instances[hit.chain[i]];
    at = domain.objects[ref.object];
    to_bundle = to_bundle * transform_of(ref.to_parent);
    if (!at->motion) continue;
    to_bundle = to_bundle * at->motion->at(time_s);
    found = to_bundle;
  }
  return found;
}

}  // namespace

Point3d moved_point(const DomainView& domain, const Hit& hit, Point3d p, double from_s, double to_s) {
  const std::optional<Transform> from = from_mover(domain, hit, from_s);
  if (!from) return p;
  return transform_point(*from_mover(domain, hit, to_s), transform_point(inverse(*from), p));
}

}  // namespace vitrail
