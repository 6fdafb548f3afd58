// SPDX-License-Identifier: Apache-2.0
// Lamps in one place count once.
#include "importers/reading/coincident_lamps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scene/geometry/transform.h"

namespace vitrail::coincident_lamps_test {
namespace {

using testing::HasSubstr;
using Quad = std::array<Point3f, 4>;

const Quad quad{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}};

Quad back_of(const Quad& q) { return {q[3], q[2], q[1], q[0]}; }  // along the other diagonal

class CoincidentLamps : public testing::Test {
 protected:
  CoincidentLamps() {
    scene().materials.push_back({DiffuseMaterial{}});
    for (const bool two_sided : {false, true})
      for (const float radiance : {1.0f, 2.0f}) {
        AreaLight light{Spectrum{ConstantSpectrum{radiance}}};
        light.two_sided = two_sided;
        scene().area_lights.push_back(light);
      }
  }
  Scene& scene() { return imported_.scene; }
  static Id<AreaLight> light(bool two_sided, float radiance = 1) {
    return {(two_sided ? 2u : 0u) + (radiance > 1 ? 1u : 0u)};
  }
  Shape& add(const std::vector<Quad>& quads, std::optional<Id<AreaLight>> light) {
    TriangleMesh mesh;
    for (const Quad& q : quads) {
      const auto first = static_cast<std::uint32_t>(mesh.positions.size());
      mesh.positions.insert(mesh.positions.end(), q.begin(), q.end());
      mesh.triangles.push_back({first, first + 1, first + 2});
      mesh.triangles.push_back({first, first + 2, first + 3});
    }
    scene().meshes.push_back(mesh);
    Shape shape;
    shape.mesh = {static_cast<std::uint32_t>(scene().meshes.size() - 1)};
    shape.area_light = light;
    return scene().shapes.emplace_back(shape);
  }
  // Triangles that shine afterwards.
  std::size_t left() {
    drop_coincident_lamps(imported_);
    std::size_t count = 0;
    for (const Shape& shape : scene().shapes)
      if (shape.area_light) count += scene().meshes[shape.mesh.value].triangles.size();
    return count;
  }
  std::string said() const {
    return imported_.diagnostics.empty() ? "" : imported_.diagnostics.back().message;
  }

  ImportedScene imported_;
};

TEST_F(CoincidentLamps, OfBothFacesCountOnce) {
  add({quad, back_of(quad), quad, back_of(quad)}, light(true));
  EXPECT_EQ(left(), 2u);
  EXPECT_THAT(said(), HasSubstr("6 triangles of this lamp, 75 % of its area"));
}

TEST_F(CoincidentLamps, InTwoShapesCountOnceWhateverTheirTransforms) {
  add({quad}, light(false));
  Shape& other = add({Quad{{{0, 0, 5}, {2, 0, 5}, {2, 2, 5}, {0, 2, 5}}}}, light(false));
  other.object_to_world = scale({0.5, 0.5, 1}) * translate({0, 0, -5});
  EXPECT_EQ(left(), 2u);
  EXPECT_EQ(scene().shapes.size(), 1u);
}

TEST_F(CoincidentLamps, ThatShineToOppositeSidesAreTwo) {
  add({quad}, light(false));
  add({back_of(quad)}, light(false));
  EXPECT_EQ(left(), 4u);
  EXPECT_EQ(said(), "");
}

TEST_F(CoincidentLamps, SidesGoByFlipsAndMirrors) {
  add({quad}, light(false));
  add({back_of(quad)}, light(false)).flip_orientation = true;
  EXPECT_EQ(left(), 2u);
}

TEST_F(CoincidentLamps, BothSidesCoverOne) {
  add({quad}, light(false));
  add({back_of(quad)}, light(true));
  EXPECT_EQ(left(), 2u);
  EXPECT_TRUE(scene().area_lights[scene().shapes.at(0).area_light->value].two_sided);
}

TEST_F(CoincidentLamps, OfOtherRadianceGiveWayToTheFirst) {
  add({quad}, light(false, 2));
  add({quad}, light(false, 1));
  EXPECT_EQ(left(), 2u);
  EXPECT_EQ(scene().shapes.at(0).area_light, light(false, 2));
  EXPECT_THAT(said(), HasSubstr("another radiance"));
}

TEST_F(CoincidentLamps, ThatOverlapInPartStayAndAreTold) {
  add({quad}, light(false));
  add({Quad{{{0.5f, 0, 0}, {1.5f, 0, 0}, {1.5f, 1, 0}, {0.5f, 1, 0}}}}, light(false));
  EXPECT_EQ(left(), 4u);
  EXPECT_THAT(said(), HasSubstr("50 % of the area of this lamp"));
}

TEST_F(CoincidentLamps, LeaveAloneWhatDoesNotShineOrTouchesOnly) {
  add({quad}, light(true));
  add({quad}, std::nullopt);
  add({Quad{{{1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}}}}, light(true));
  add({Quad{{{0, 0, 0.01f}, {1, 0, 0.01f}, {1, 1, 0.01f}, {0, 1, 0.01f}}}}, light(true));
  EXPECT_EQ(left(), 6u);
  EXPECT_EQ(scene().shapes.size(), 4u);
}

TEST_F(CoincidentLamps, GlowsThatAreNoLampsStay) {
  for (AreaLight& one : scene().area_lights) one.sampled = false;
  add({quad, back_of(quad), quad}, light(true));
  EXPECT_EQ(left(), 6u);
  EXPECT_EQ(said(), "");
}

TEST_F(CoincidentLamps, TriangulatedOtherwiseCountOnce) {
  std::vector<Quad> fan;  // quads of a disk around its middle, as triangles with a double corner
  const auto at = [](int i) {
    return Point3f{static_cast<float>(std::cos(i * std::numbers::pi / 8)),
                   static_cast<float>(std::sin(i * std::numbers::pi / 8)), 0.1f};
  };
  for (int i = 0; i < 16; ++i) fan.push_back({{{0, 0, 0.1f}, at(i), at(i + 1), {0, 0, 0.1f}}});
  add(fan, light(false));
  std::vector<Quad> from_rim;
  for (int i = 1; i < 15; ++i) from_rim.push_back({{at(0), at(i), at(i + 1), at(0)}});
  add(from_rim, light(false));
  drop_coincident_lamps(imported_);
  EXPECT_EQ(scene().shapes.size(), 1u);
}

TEST_F(CoincidentLamps, QuadricsAndInstancesTwice) {
  for (int i = 0; i < 2; ++i) {
    TriangleMesh sphere;
    sphere.quadric = Quadric{};
    scene().meshes.push_back(sphere);
    Shape shape;
    shape.mesh = {static_cast<std::uint32_t>(scene().meshes.size() - 1)};
    shape.area_light = light(false);
    scene().shapes.push_back(shape);
  }
  add({quad}, light(false));
  scene().prototypes.push_back({"lamp", {scene().shapes.back()}, {}, {}});
  scene().shapes.pop_back();
  scene().instances.assign(3, {Id<Prototype>{0}, translate({0, 0, 9}), {}});
  scene().instances[2].prototype_to_world = translate({0, 0, 8});
  drop_coincident_lamps(imported_);
  EXPECT_EQ(scene().shapes.size(), 1u);
  EXPECT_EQ(scene().instances.size(), 2u);
  EXPECT_EQ(imported_.diagnostics.size(), 2u);
}

}  // namespace
}  // namespace vitrail::coincident_lamps_test
