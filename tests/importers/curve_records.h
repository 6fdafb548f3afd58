// SPDX-License-Identifier: Apache-2.0
// What tests of writers ask of curves that were read again.
#pragma once

#include <gtest/gtest.h>

#include "scene/records/curve_uses.h"
#include "scene/shapes/curve.h"
#include "scene/shapes/curve_meshes.h"
#include "scene/shapes/quadric_places.h"

namespace vitrail::test {

// All curves of these shapes where the shapes put them, their front outside unless `mirrored`.
inline std::vector<PlacedCurve> curves_of(const Scene& scene, const std::vector<Shape>& shapes) {
  std::vector<PlacedCurve> curves;
  for (const Shape& shape : shapes) {
    if (!is_of_curves(scene, shape)) continue;
    const QuadricPlaces& places = *scene.meshes[shape.mesh.value].places;
    std::vector<Transform> records(places.size());
    places.read(0, records);
    for (const Transform& record : records) {
      PlacedCurve c = transformed(shape.object_to_world, unpacked_curve(record));
      c.mirrored = c.mirrored != shape.flip_orientation;
      curves.push_back(c);
    }
  }
  return curves;
}

inline void expect_near(const PlacedCurve& a, const PlacedCurve& b, double relative) {
  double size = 0, widest = 0;
  for (const Vector3f& to : a.to) size = std::max(size, length(cast<double>(to)));
  for (const float r : a.radius) widest = std::max(widest, double{r});
  EXPECT_LE(length(a.origin - b.origin), relative * size);
  for (std::size_t k = 0; k < 3; ++k) {
    Vector3d to = cast<double>(a.to[k]), other = cast<double>(b.to[k]);
    if (a.straight && k == 0) to = normalize(to), other = normalize(other);  // of planes
    if (a.straight && k == 1)
      to = normalize(cast<double>(a.to[2]) - to), other = normalize(cast<double>(b.to[2]) - other);
    EXPECT_LE(length(to - other), relative * (a.straight && k < 2 ? 1 : size)) << k;
  }
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_NEAR(double{a.radius[k]}, double{b.radius[k]}, relative * widest) << k;
  EXPECT_EQ(a.straight, b.straight);
  EXPECT_EQ(a.mirrored, b.mirrored);
}

inline void expect_near(const std::vector<PlacedCurve>& a, const std::vector<PlacedCurve>& b,
                        double relative) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    SCOPED_TRACE(i);
    expect_near(a[i], b[i], relative);
  }
}

// Of one shape that all of them are.
inline Shape add_curves(Scene& scene, std::span<const PlacedCurve> curves, QuadricUv uv) {
  KeptCurves kept(uv, 1 << 20);
  kept.add(curves);
  scene.meshes.push_back(std::move(kept.mesh));
  Shape shape;
  shape.mesh = {static_cast<std::uint32_t>(scene.meshes.size() - 1)};
  return shape;
}

}  // namespace vitrail::test
