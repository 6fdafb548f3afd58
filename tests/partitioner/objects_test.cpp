// SPDX-License-Identifier: Apache-2.0
#include "partitioner/placing/objects.h"

#include <gtest/gtest.h>

#include <cmath>

#include "partitioner/placing/plan_scene.h"
#include "scene/shapes/curve_meshes.h"
#include "scene/system/diagnostics.h"
#include "tests/support/test_scenes.h"

namespace vitrail::objects_test {
namespace {

using test::bumpy_torus;
using test::scene_of;

Instance at(std::size_t prototype, const Transform& t) {
  return {Id<Prototype>{static_cast<std::uint32_t>(prototype)}, t, {}};
}

// A torus of 2n² triangles, and so many levels of two of the one below.
Scene levels(int n, int count) {
  Scene scene = scene_of(bumpy_torus(n));
  scene.prototypes.push_back({"", scene.shapes, {}, {}});
  scene.shapes.clear();
  for (int i = 0; i < count; ++i) {
    const std::size_t below = scene.prototypes.size() - 1;
    scene.prototypes.push_back(
        {"", {}, {at(below, {}), at(below, translate({4 * std::ldexp(1.0, i), 0, 0}))}, {}});
  }
  scene.instances.push_back(at(scene.prototypes.size() - 1, {}));
  return scene;
}

std::size_t records(const ScenePlan& plan) {
  std::size_t count = plan.scene.placements.size() + plan.scene.uses.size();
  for (const Assembly& object : plan.objects) count += object.placements.size() + object.uses.size();
  return count;
}

TEST(Objects, ThirtyLevelsAreFewRecords) {
  const ScenePlan plan = plan_scene(levels(1, 30));
  EXPECT_EQ(plan.scene.triangles, std::uint64_t{1} << 31);
  EXPECT_LE(plan.scene.depth, max_instance_depth);
  EXPECT_LT(records(plan), 500u);
  EXPECT_NEAR(static_cast<double>(plan.scene.bounds.upper.x - plan.scene.bounds.lower.x),
              4 * std::ldexp(1.0, 30), std::ldexp(1.0, 26));
}

TEST(Objects, ChainsAreShortWhereTrianglesAreAsManyAsMayBe) {
  const ScenePlan plan = plan_scene(levels(1, 61));
  EXPECT_EQ(plan.scene.triangles, std::uint64_t{1} << 62);
  EXPECT_LE(plan.scene.depth, max_instance_depth);
  EXPECT_LT(records(plan), 5000u);
}

// Each level counts once, whatever a tracer can follow.
TEST(Objects, AsManyLevelsAsCanBeFollowedAreKept) {
  const ScenePlan plan = plan_scene(levels(10, 7));
  EXPECT_EQ(plan.scene.depth, 8 - 1) << "the uppermost has one use and is the scene's own";
  EXPECT_EQ(records(plan), 1u + 2 * 7);
}

TEST(Objects, WhatHoldsNothingTakesNothing) {
  Scene scene = levels(10, 60);
  scene.prototypes[0].shapes.clear();
  scene.shapes.push_back({Id<TriangleMesh>{0}, Id<Material>{0}});
  EXPECT_EQ(records(plan_scene(scene)), 1u);
}

TEST(Objects, TooManyTrianglesAreSaidAtOnce) {
  EXPECT_THROW(plan_scene(levels(1, 62)), Error);
  EXPECT_THROW(plan_scene(levels(1, 100)), Error);
}

TEST(Objects, LongChainsOfOneAreTheScenesOwn) {
  Scene scene = levels(2, 0);
  for (std::size_t i = 0; i < 100'000; ++i)
    scene.prototypes.push_back({"", {}, {at(i, translate({1, 0, 0}))}, {}});
  scene.instances = {at(100'000, {})};
  const ScenePlan plan = plan_scene(scene);
  EXPECT_EQ(records(plan), 1u);
  EXPECT_EQ(plan.scene.placements.at(0).to_world.m[0][3], 1e5);
}

// Whoever asks for placements is asked about each object's once, and only what is wanted is made.
TEST(Objects, AreAskedOnce) {
  const ScenePlan plan = plan_scene(levels(1, 30));
  std::size_t asked = 0;
  const auto none = expanded(plan, [&](const Placement&) {
    ++asked;
    return false;
  });
  EXPECT_TRUE(none.empty());
  EXPECT_LT(asked, 200u);
}

TEST(Objects, ExpandedIsEveryPlacementInOrder) {
  const ScenePlan plan = plan_scene(levels(10, 4));
  const auto all = expanded(plan, [](const Placement&) { return true; });
  ASSERT_EQ(all.size(), 16u);
  for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(all[i].first_triangle, 200 * i);
}

// Balls that are stretched are none: a copy of tubes.
TEST(Objects, StretchedCurvesAreNotKept) {
  Scene scene = levels(60, 0);
  KeptCurves curves(QuadricUv::pbrt, 0);
  const CurveSegment segment{{{{0, 0, 0}, .1}, {{1, 0, 0}, .1}, {{2, 1, 0}, .1}, {{3, 1, 0}, .1}}};
  curves.add(placed_curves({&segment, 1}, 0, 1, false, false));
  Shape curve = scene.prototypes[0].shapes[0];
  curve.mesh = {static_cast<std::uint32_t>(scene.meshes.size())};
  scene.meshes.push_back(curves.mesh);
  scene.prototypes[0].shapes.push_back(curve);
  scene.instances = {at(0, {}), at(0, scale({2, 2, 2})), at(0, scale({1, 1, 2})), at(0, scale({1, 1, 2}))};
  const ScenePlan plan = plan_scene(scene);
  EXPECT_EQ(plan.scene.uses.size(), 2u);
  EXPECT_EQ(plan.scene.placements.size(), 2u * 2) << "torus and tube";
  scene.prototypes[0].shapes.pop_back();
  EXPECT_EQ(plan_scene(scene).scene.uses.size(), 4u);
}

// ---- Shapes that share a mesh

Scene sharing(int shapes) {
  Scene scene = scene_of(bumpy_torus(60));
  const Shape shape = scene.shapes[0];
  scene.shapes.clear();
  for (int i = 0; i < shapes; ++i) {
    scene.shapes.push_back(shape);
    scene.shapes.back().object_to_world = translate({8.0 * i, 0, 0}) * scale({i % 2 ? -1.0 : 1.0, 1, 1});
    scene.shapes.back().flip_orientation = i % 2 == 1;  // so that fronts look outwards
  }
  return scene;
}

TEST(Objects, ShapesThatShareAMeshAreInstances) {
  const ScenePlan plan = plan_scene(sharing(40));
  ASSERT_EQ(plan.objects.size(), 1u);
  EXPECT_EQ(plan.scene.uses.size(), 40u);
  EXPECT_TRUE(plan.scene.placements.empty());
  EXPECT_EQ(plan.scene.triangles, 40u * 7200);
  EXPECT_FALSE(plan.objects[0].placements.at(0).flip);
}

TEST(Objects, FewCopiesAreMade) {
  const ScenePlan plan = plan_scene(sharing(8));
  EXPECT_TRUE(plan.objects.empty());
  EXPECT_EQ(plan.scene.placements.size(), 8u);
}

TEST(Objects, ShapesOfOneMeshAndTwoSurfacesAreTwoObjects) {
  Scene scene = sharing(100);
  scene.materials.push_back(scene.materials[0]);
  scene.media.resize(1);
  for (std::size_t i = 0; i < 50; ++i) scene.shapes[i].material = Id<Material>{1};
  scene.shapes[60].interior = Id<Medium>{0};
  scene.shapes[61].opacity = 0.5f;
  scene.shapes[62].flip_orientation = !scene.shapes[62].flip_orientation;
  scene.shapes[63].object_to_world = scale({1, 1, 0});  // cannot be an instance
  const ScenePlan plan = plan_scene(scene);
  EXPECT_EQ(plan.objects.size(), 2u);
  EXPECT_EQ(plan.scene.uses.size(), 96u);
  ASSERT_EQ(plan.scene.placements.size(), 4u);
  EXPECT_EQ(plan.scene.placements[0].shape, &scene.shapes[60]);
}

}  // namespace
}  // namespace vitrail::objects_test
