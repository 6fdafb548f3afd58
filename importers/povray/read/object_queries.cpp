// SPDX-License-Identifier: Apache-2.0
// inside() and trace().
#include "importers/povray/read/object_hits.h"
#include "importers/povray/read/reader.h"

namespace vitrail::pov {

Numbers Reader::inside_of(const Object& object) {
  expect(',', "behind an object");
  return Numbers(is_inside(object, point("a point")) ? 1.0 : 0.0);
}

// The place of the hit; the origin where there is none. A name behind the direction gets the normal, which is
// then 0.
Numbers Reader::traced(const Object& object) {
  expect(',', "behind an object");
  const Point3d from = point("where a line begins");
  expect(',', "behind where a line begins");
  const Vector3d along = vector("the direction of a line");
  const std::optional<Hit> hit = first_hit(object, from, along);
  if (accept(',')) {
    const Vector3d n = hit ? hit->normal : Vector3d{};
    *symbols_.visible(raw_name("the name that gets a normal")) = Numbers::vector(n.x, n.y, n.z);
  }
  const Point3d p = hit ? from + along * hit->t : Point3d{};
  return Numbers::vector(p.x, p.y, p.z);
}

}  // namespace vitrail::pov
