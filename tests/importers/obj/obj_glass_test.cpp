// SPDX-License-Identifier: Apache-2.0
// Glass in OBJ: solid where it encloses something, a thin sheet where not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "importers/obj/read/obj.h"
#include "tests/importers/temporary_folder.h"

namespace vitrail::obj_glass_test {
namespace {

using testing::Contains;
using testing::Field;
using testing::HasSubstr;
using testing::Not;

// A square pane at z = 0 and a tetrahedron above it, each with corners of its own.
const std::string pane = "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\n";
const std::string solid = "v 0 0 1\nv 1 0 1\nv 0 1 1\nv 0 0 2\n";
const std::string faces_of_solid = "f 5 7 6\nf 5 6 8\nf 5 8 7\nf 6 7 8\n";

class ObjGlass : public testing::Test {
 protected:
  const Scene& read(const std::string& obj, const std::string& more = "") {
    folder_.write("m.mtl", "newmtl g\nNi 1.5\nd .2\nillum 9\nKd .8 .8 .8\n" + more + "newmtl w\nKd 1 1 1\n");
    imported_ = read_obj(folder_.write("s.obj", "mtllib m.mtl\n" + obj));
    return imported_.scene;
  }
  template <class Model>
  bool is(std::size_t shape) const {
    const Scene& s = imported_.scene;
    return std::holds_alternative<Model>(s.materials[s.shapes[shape].material.value].model);
  }
  std::size_t triangles(std::size_t shape) const {
    return imported_.scene.meshes[imported_.scene.shapes[shape].mesh.value].triangles.size();
  }
  static auto says(const std::string& text) { return Contains(Field(&Diagnostic::message, HasSubstr(text))); }

  TemporaryFolder folder_;
  ImportedScene imported_;
};

TEST_F(ObjGlass, OfOneFaceIsThin) {
  const Scene& scene = read(pane + "usemtl w\nf 1 2 3\nusemtl g\nf 1 2 3 4\n");
  ASSERT_EQ(scene.shapes.size(), 2u);
  EXPECT_TRUE(is<DiffuseMaterial>(0));
  EXPECT_TRUE(is<ThinDielectricMaterial>(1));
  EXPECT_EQ(scene.materials.size(), 2u);
  EXPECT_THAT(imported_.diagnostics, says("glass 'g': 1 of its 1 parts enclose nothing"));
  EXPECT_THAT(imported_.diagnostics, says("area 2 at 1 0.5 0"));
  EXPECT_THAT(imported_.diagnostics, says("Kd, d of glass"));
}

TEST_F(ObjGlass, ThatIsClosedIsSolid) {
  const Scene& scene = read(pane + solid + "usemtl g\n" + faces_of_solid);
  ASSERT_EQ(scene.shapes.size(), 1u);
  EXPECT_TRUE(is<DielectricMaterial>(0));
  EXPECT_THAT(imported_.diagnostics, Not(says("enclose nothing")));
}

TEST_F(ObjGlass, OfBothKindsIsParted) {
  const Scene& scene = read(pane + solid + "usemtl g\nf 1 2 3 4\n" + faces_of_solid, "Tf .5 .6 .7\n");
  ASSERT_EQ(scene.shapes.size(), 2u);
  EXPECT_TRUE(is<DielectricMaterial>(0));
  EXPECT_TRUE(is<ThinDielectricMaterial>(1));
  EXPECT_EQ(triangles(0), 4u);
  EXPECT_EQ(triangles(1), 2u);
  const Scene& s = imported_.scene;
  const auto& thin = std::get<ThinDielectricMaterial>(s.materials[s.shapes[1].material.value].model);
  const auto& thick = std::get<DielectricMaterial>(s.materials[s.shapes[0].material.value].model);
  EXPECT_EQ(thin.eta, thick.eta);
  EXPECT_EQ(thin.transmittance_factor, thick.transmittance_factor);
}

// Corners that (u,v) and normals part, and groups with and without them.
TEST_F(ObjGlass, IsJoinedByPositions) {
  const std::string seams = "vt 0 0\nvt 1 1\nvn 0 0 1\nvn 0 1 0\n";
  read(pane + solid + seams + "usemtl g\nf 5/1/1 7/1/1 6/2/1\nf 5/2/2 6/1/2 8/1/2\nf 5/1 8/1 7/2\nf 6 7 8\n");
  for (std::size_t i = 0; i < imported_.scene.shapes.size(); ++i) EXPECT_TRUE(is<DielectricMaterial>(i)) << i;
}

TEST_F(ObjGlass, WithBothFacesStandsOnce) {
  for (const char* back : {"f 4 3 2 1\n", "f 3 2 1 4\n", "f 1 2 3 4\n"}) {
    read(pane + "usemtl g\nf 1 2 3 4\n" + back);
    EXPECT_TRUE(is<ThinDielectricMaterial>(0)) << back;
    EXPECT_EQ(triangles(0), 2u) << back;
    EXPECT_THAT(imported_.diagnostics, says("2 of its triangles stand where others do")) << back;
  }
}

TEST_F(ObjGlass, OfTwoFacesBackToBackIsSolid) {
  const std::string behind = "v 0 0 -.006\nv 2 0 -.006\nv 2 1 -.006\nv 0 1 -.006\n";
  read(pane + behind + "usemtl g\nf 1 2 3 4\nf 8 7 6 5\n");
  EXPECT_TRUE(is<DielectricMaterial>(0));
  EXPECT_THAT(imported_.diagnostics, says("2 of its parts are opposite faces of panes without a rim"));
  read(pane + behind + "usemtl g\nf 1 2 3 4\nf 5 6 7 8\n");
  EXPECT_TRUE(is<ThinDielectricMaterial>(0));
}

}  // namespace
}  // namespace vitrail::obj_glass_test
