// SPDX-License-Identifier: Apache-2.0
// Faces that modellers write twice, back to back, are one surface of two materials.
#include "importers/reading/back_to_back_faces.h"

#include <gmock/gmock.h>

namespace vitrail::back_to_back_faces_test {
namespace {

using Quad = std::array<Point3f, 4>;
const Quad quad{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}},
    beside{{{1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}}};
Quad back_of(const Quad& q) { return {q[3], q[2], q[1], q[0]}; }       // along the other diagonal
Quad same_back_of(const Quad& q) { return {q[2], q[1], q[0], q[3]}; }  // along the same one

class BackToBack : public testing::Test {
 protected:
  BackToBack() {
    for (const float r : {0.25f, 0.5f, 0.75f})
      scene().materials.push_back({DiffuseMaterial{.reflectance = ConstantSpectrum{r}}});
  }
  Scene& scene() { return imported_.scene; }
  Shape& add(const std::vector<Quad>& quads, std::uint32_t material) {
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
    shape.material = {material};
    return scene().shapes.emplace_back(shape);
  }
  // Triangles and material of each shape: "2 of 3:0/1" has two sides.
  std::vector<std::string> joined() {
    join_faces_back_to_back(imported_);
    std::vector<std::string> all;
    for (const Shape& shape : scene().shapes) {
      std::string text = std::to_string(scene().meshes[shape.mesh.value].triangles.size()) + " of ";
      const auto* sides = std::get_if<TwoSidedMaterial>(&scene().materials[shape.material.value].model);
      text += sides ? std::to_string(sides->front.value) + "/" + std::to_string(sides->back.value)
                    : std::to_string(shape.material.value);
      all.push_back(text);
    }
    return all;
  }
  ImportedScene imported_;
};
using testing::ElementsAre;

TEST_F(BackToBack, OneSurfaceWithAMaterialForEachSide) {
  for (const Quad& back : {back_of(quad), same_back_of(quad)}) {
    scene().shapes.clear(), imported_.diagnostics.clear();
    add({quad}, 0), add({back}, 1);
    EXPECT_THAT(joined(), ElementsAre("2 of 0/1"));
    EXPECT_EQ(imported_.diagnostics.size(), 1u);
  }
}

TEST_F(BackToBack, FrontsAreThoseOfTheShape) {
  add({back_of(quad)}, 0).flip_orientation = true;
  add({quad}, 1).object_to_world = scale({1, 1, -1});
  EXPECT_THAT(joined(), ElementsAre("2 of 0/1")) << "one is turned, the other mirrored";
}

TEST_F(BackToBack, OnlyTheTrianglesThatHaveABack) {
  add({quad, beside}, 0), add({back_of(beside)}, 1), add({back_of(quad)}, 2);
  EXPECT_THAT(joined(), ElementsAre("2 of 0/1", "2 of 0/2"));
  scene().shapes.clear();
  add({quad, beside}, 0), add({back_of(beside)}, 1);
  EXPECT_THAT(joined(), ElementsAre("2 of 0", "2 of 0/1"));
}

TEST_F(BackToBack, OthersStay) {
  add({quad}, 0), add({quad}, 1);
  EXPECT_THAT(joined(), ElementsAre("2 of 0", "2 of 1")) << "they face one way";
  scene().shapes.clear();
  add({quad}, 0), add({back_of(quad)}, 0);
  EXPECT_THAT(joined(), ElementsAre("2 of 0", "2 of 0")) << "one material, the same on both sides";
  scene().materials[0].two_sided = false;
  EXPECT_THAT(joined(), ElementsAre("2 of 0/0")) << "black on its back";
  scene().shapes.clear();
  scene().area_lights.emplace_back();
  add({quad}, 0), add({back_of(quad)}, 1).area_light = Id<AreaLight>{0};
  EXPECT_EQ(joined().size(), 2u) << "one shines";
  scene().shapes.clear();
  add({quad}, 0), add({back_of(quad)}, 1).opacity = 0.5f;
  EXPECT_EQ(joined().size(), 2u) << "one is half there";
  scene().shapes.clear();
  scene().materials[1].model = DielectricMaterial{};
  add({quad}, 0), add({back_of(quad)}, 1);
  EXPECT_EQ(joined().size(), 2u) << "one lets light through";
  scene().shapes.clear();
  scene().materials[1].model = DiffuseMaterial{};
  Quad away = back_of(quad);
  for (Point3f& p : away) p.z = 0.001f;
  add({quad}, 0), add({away}, 1);
  EXPECT_EQ(joined().size(), 2u) << "they do not lie in one place";
}

TEST_F(BackToBack, WithinObjectsToo) {
  add({quad}, 0), add({back_of(quad)}, 1);
  scene().prototypes.push_back({"wall", std::move(scene().shapes), {}, {}});
  scene().shapes.clear();
  join_faces_back_to_back(imported_);
  EXPECT_EQ(scene().prototypes[0].shapes.size(), 1u);
}

}  // namespace
}  // namespace vitrail::back_to_back_faces_test
