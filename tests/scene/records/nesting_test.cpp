// SPDX-License-Identifier: Apache-2.0
#include "scene/records/nesting.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <tuple>

namespace vitrail::nesting_test {
namespace {

Instance at(std::uint32_t prototype, const Transform& t) { return {Id<Prototype>{prototype}, t, {}}; }

// Of each level two of the one below, 2^level apart; the second one mirrored where `mirrors`.
Scene levels(int count, bool mirrors = false) {
  Scene scene;
  scene.meshes.resize(1);
  scene.materials.push_back({DiffuseMaterial{}});
  scene.prototypes.push_back({"", {Shape{}}, {}, {}});
  for (int i = 0; i < count; ++i) {
    const auto below = static_cast<std::uint32_t>(i);
    const Transform moved = translate({std::ldexp(1.0, i), 0, 0});
    scene.prototypes.push_back(
        {"", {}, {at(below, {}), at(below, mirrors ? moved * scale({1, -1, 1}) : moved)}, {}});
  }
  scene.instances.push_back(at(static_cast<std::uint32_t>(count), {}));
  return scene;
}

std::size_t records(const Scene& scene) {
  std::size_t count = scene.shapes.size() + scene.instances.size();
  for (const Prototype& p : scene.prototypes) count += p.shapes.size() + p.instances.size();
  return count;
}

// Where the shapes of a scene without nesting stand: how many at each x, by their sides.
std::map<std::tuple<double, bool, bool>, int> places(const Scene& scene) {
  std::map<std::tuple<double, bool, bool>, int> found;
  for (const Instance& instance : scene.instances)
    for (const Shape& shape : scene.prototypes[instance.prototype.value].shapes) {
      const Transform t = instance.prototype_to_world * shape.object_to_world;
      const bool mirrored = swaps_handedness(instance.prototype_to_world);
      ++found[{t.m[0][3], swaps_handedness(t), shape.flip_orientation != mirrored}];
    }
  return found;
}

TEST(Nesting, EveryShapeStandsWhereItStood) {
  for (const bool mirrors : {false, true}) {
    const Scene flat = without_nested_instances(levels(9, mirrors));
    EXPECT_FALSE(has_nested_instances(flat));
    const auto found = places(flat);
    ASSERT_EQ(found.size(), 512u);
    int x = 0;
    for (const auto& [place, count] : found) {
      EXPECT_EQ(count, 1);
      EXPECT_EQ(std::get<0>(place), x);
      const bool mirrored = mirrors && __builtin_popcount(static_cast<unsigned>(x)) % 2 == 1;
      EXPECT_EQ(std::get<1>(place), mirrored) << x;
      EXPECT_EQ(std::get<2>(place), mirrored) << "fronts stay, " << x;
      ++x;
    }
  }
}

TEST(Nesting, GrowsAsTheRootOfWhatItStandsFor) {
  EXPECT_LT(records(without_nested_instances(levels(16))), 4u * 256);
  EXPECT_LT(records(without_nested_instances(levels(30))), 4u * 32768);
}

TEST(Nesting, ObjectsStayWholeWhereThatIsNoMore) {
  Scene scene = levels(1);
  const Scene flat = without_nested_instances(scene);
  EXPECT_EQ(flat.prototypes[1].shapes.size(), 2u);
  EXPECT_EQ(flat.instances.size(), 1u);
}

TEST(Nesting, WhatIsTooMuchIsSaid) {
  EXPECT_THROW(without_nested_instances(levels(60)), Error);
  EXPECT_THROW(without_nested_instances(levels(3000)), Error);
}

TEST(Nesting, LongChainsAndEmptyObjectsCostLittle) {
  Scene scene = levels(40);
  scene.prototypes[0].shapes.clear();  // 2⁴⁰ times nothing
  for (std::uint32_t i = 0; i < 50'000; ++i)
    scene.prototypes.push_back({"", {Shape{}}, {at(40 + i, {})}, {}});
  scene.instances = {at(50'040, {})};
  const Scene flat = without_nested_instances(scene);
  EXPECT_LT(records(flat), 300'000u);
  std::size_t shapes = 0;
  for (const Instance& instance : flat.instances)
    shapes += flat.prototypes[instance.prototype.value].shapes.size();
  EXPECT_EQ(shapes, 50'000u);
}

}  // namespace
}  // namespace vitrail::nesting_test
