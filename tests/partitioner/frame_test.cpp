// SPDX-License-Identifier: Apache-2.0
#include "partitioner/placing/frame.h"

#include <gtest/gtest.h>

#include "scene/shapes/deferred_mesh.h"

namespace vitrail::frame_test {
namespace {

const FramePart unit{{1, 2, 3}, 1, 1000};
const Bounds3d unit_box{{0, 1, 2}, {2, 3, 4}};

Bounds3d box_with(Bounds3d box, Point3d p) {
  extend(box, p);
  return box;
}

TEST(Frame, IsTheMiddleOfWhatIsTogether) {
  const std::vector<FramePart> parts{unit, {{100, 2, 3}, 1, 3}};
  EXPECT_EQ(origin_of(parts, {{0, 1, 2}, {101, 3, 4}}, {}), (Point3d{50.5, 2, 3}));
  EXPECT_EQ(origin_of({unit}, unit_box, {}), (Point3d{1, 2, 3}));
}

TEST(Frame, FewFarAwayDoNotMoveIt) {
  for (const double far : {1e5, -1e8, 1e12}) {
    const std::vector<FramePart> parts{unit, {{far, far, 0}, 1, 3}};
    EXPECT_EQ(origin_of(parts, box_with(unit_box, {far, far, 0}), {}), (Point3d{1, 2, 3}));
    EXPECT_EQ(whole_of(parts).centre, (Point3d{1, 2, 3}));
    EXPECT_EQ(whole_of(parts).radius, 1);
  }
}

TEST(Frame, WhatIsSeenLargeCountsMore) {
  const std::vector<FramePart> parts{unit, {{1e8, 0, 0}, 1, 3}};
  const Bounds3d box = box_with(unit_box, {1e8, 0, 0});
  EXPECT_EQ(origin_of(parts, box, Viewpoint{{1e8, 5, 0}, {}}), (Point3d{1e8, 0, 0}));
  EXPECT_EQ(origin_of(parts, box, Viewpoint{{0, 5, 0}, {}}), (Point3d{1, 2, 3}));
  // Parallel rays come as near to what lies far along them.
  EXPECT_EQ(origin_of(parts, box, Viewpoint{{1e8, 5, 0}, Vector3d{1, 0, 0}}), (Point3d{1, 2, 3}));
}

TEST(Frame, AMeshHasItsFocusWhereItsTrianglesAre) {
  TriangleMesh mesh;
  for (int i = 0; i < 100; ++i) {
    const auto x = static_cast<float>(i), first = static_cast<float>(3 * i);
    mesh.positions.insert(mesh.positions.end(), {{x, 0, 0}, {x + 1, 0, 0}, {x, 1, 0}});
    const auto v = static_cast<std::uint32_t>(first);
    mesh.triangles.push_back({v, v + 1, v + 2});
  }
  const MeshFocus before = focus_of(mesh);
  mesh.positions.push_back({1e9f, 0, 0});
  mesh.triangles.push_back({0, 1, 300});
  const MeshFocus after = focus_of(mesh);
  EXPECT_NEAR(after.centre.x, before.centre.x, 1);
  EXPECT_NEAR(after.radius, before.radius, 1);
  EXPECT_EQ(after.box, before.box);
  EXPECT_EQ(before.box, (Bounds3d{{0, 0, 0}, {100, 1, 0}}));
  // A mesh that stays in its file has the same.
  const TriangleMesh deferred = MeshMemory(0).keep(mesh, [mesh] { return mesh; });
  ASSERT_TRUE(deferred.deferred);
  EXPECT_EQ(focus_of(deferred).centre, after.centre);
  EXPECT_EQ(focus_of(deferred).radius, after.radius);
}

}  // namespace
}  // namespace vitrail::frame_test
