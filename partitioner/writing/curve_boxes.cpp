// SPDX-License-Identifier: Apache-2.0
#include "partitioner/writing/curve_boxes.h"

#include <algorithm>

#include "bundle/domain_file.h"
#include "partitioner/hierarchy/build_bvh.h"
#include "scene/shapes/curve.h"

namespace vitrail {

namespace {

Bounds3d box_of(const CurveSegment& s) {
  double r = 0;
  for (const CurvePoint& p : s) r = std::max(r, p.radius);
  Bounds3d box;
  for (const CurvePoint& p : s)
    extend(box, p.position - Vector3d{r, r, r}), extend(box, p.position + Vector3d{r, r, r});
  return box;
}

double area(const Bounds3d& box) {
  const Vector3d e = extent(box);
  return e.x * e.y + e.y * e.z + e.z * e.x;
}

}  // namespace

std::vector<Bounds3f> curve_boxes(const InstanceRef& ref) {
  const Bounds3f whole = vitrail::box_of(ref);
  std::vector<CurveSegment> parts{segment_of(unpacked_curve(ref.to_parent.m))};
  for (constexpr double worth = 0.75; parts.size() < most_curve_boxes;) {
    std::vector<CurveSegment> halves(2 * parts.size());
    double before = 0, after = 0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      halve(parts[i], halves[2 * i], halves[2 * i + 1]);
      before += area(box_of(parts[i]));
      after += area(box_of(halves[2 * i])) + area(box_of(halves[2 * i + 1]));
    }
    if (!(after < worth * before)) break;
    parts = std::move(halves);
  }
  std::vector<Bounds3f> boxes;
  if (parts.size() == 1) return {whole};
  for (const CurveSegment& part : parts) {
    const Bounds3d own = box_of(part);
    Bounds3f box = inflated({cast<float>(own.lower), cast<float>(own.upper)}, padding(greatest(whole)));
    for (int axis = 0; axis < 3; ++axis) {
      box.lower[axis] = std::max(box.lower[axis], whole.lower[axis]);
      box.upper[axis] = std::min(box.upper[axis], whole.upper[axis]);
    }
    if (!box.empty()) boxes.push_back(box);
  }
  return boxes.empty() ? std::vector{whole} : boxes;
}

}  // namespace vitrail
