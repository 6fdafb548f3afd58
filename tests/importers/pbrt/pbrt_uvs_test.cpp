// SPDX-License-Identifier: Apache-2.0
// The (u,v) that pbrt gives to shapes which have none, and its bilinear patches.
#include <fmt/format.h>

#include <cmath>

#include "scene/shapes/deferred_mesh.h"
#include "scene/shapes/mesh_uv.h"
#include "tests/importers/pbrt/pbrt_text.h"

namespace vitrail::pbrt_uvs_test {
namespace {

const std::string textured =
    "Texture \"t\" \"spectrum\" \"checkerboard\" Material \"diffuse\" \"texture reflectance\" \"t\"\n";

constexpr Point2f triangle_uvs[] = {{0, 0}, {1, 0}, {1, 1}};

struct Corner {
  Point3f p;
  Point2f uv;
};

// Of all triangles of the mesh, three each.
std::vector<Corner> corners(const TriangleMesh& given) {
  TriangleMesh storage;
  const TriangleMesh& mesh = loaded(given, storage);
  std::vector<Corner> all;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      all.push_back({mesh.positions[mesh.triangles[i][k]], uvs_of(mesh, i)[k]});
  return all;
}

template <class Expected>
void expect_uvs(const TriangleMesh& mesh, const Expected& expected) {
  for (const Corner& c : corners(mesh)) {
    const Point2f uv = expected(c.p);
    EXPECT_NEAR(c.uv.x, uv.x, 2e-6) << c.p.x << " " << c.p.y << " " << c.p.z;
    EXPECT_NEAR(c.uv.y, uv.y, 2e-6) << c.p.x << " " << c.p.y << " " << c.p.z;
  }
}

std::string ply_of(const std::vector<Point3f>& vertices, const std::vector<std::string>& faces) {
  std::string text = fmt::format(
      "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      vertices.size(), faces.size());
  for (const Point3f& v : vertices) text += fmt::format("{} {} {}\n", v.x, v.y, v.z);
  for (const std::string& face : faces) text += face + "\n";
  return text;
}

Scene import_ply(const std::string& file, const std::string& film, const std::string& material,
                 Diagnostics* diagnostics = nullptr, MeshMemory memory = MeshMemory{}) {
  const TemporaryFolder folder;
  folder.write("mesh.ply", file);
  const ImportedScene imported =
      read_pbrt(folder.write("scene.pbrt", "Film \"" + film + "\" WorldBegin\n" + material +
                                               "Shape \"plymesh\" \"string filename\" \"mesh.ply\"\n" +
                                               (film == "image" ? "WorldEnd" : "")),
                std::move(memory));
  if (diagnostics) *diagnostics = imported.diagnostics;
  return imported.scene;
}

const std::vector<Point3f> parallelogram{{0, 0, 1}, {2, 0, 1}, {3, 1, 1}, {1, 1, 1}};
const auto of_parallelogram = [](Point3f p) { return Point2f{(p.x - p.y) / 2, p.y}; };

TEST(PbrtQuads, AParallelogramIsTwoTrianglesOfOneSquare) {
  Diagnostics diagnostics;
  const Scene scene = import_ply(ply_of(parallelogram, {"4 0 1 2 3"}), "rgb", textured, &diagnostics);
  ASSERT_EQ(scene.meshes.size(), 1u);
  EXPECT_TRUE(diagnostics.empty());
  EXPECT_EQ(scene.meshes[0].positions.size(), 4u);
  EXPECT_EQ(scene.meshes[0].triangles.size(), 2u);
  EXPECT_TRUE(scene.meshes[0].uvs.empty());
  expect_uvs(scene.meshes[0], of_parallelogram);
}

// pbrt-v3 makes the triangles a b c and d a c of it, which are shapes of their own.
TEST(PbrtQuads, AreTrianglesInV3) {
  const Scene scene = import_ply(ply_of(parallelogram, {"4 0 1 2 3"}), "image", textured);
  const std::vector<Corner> c = corners(scene.meshes.at(0));
  ASSERT_EQ(c.size(), 6u);
  constexpr std::size_t corner[] = {0, 1, 2, 3, 0, 2};
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(c[i].p, parallelogram[corner[i]]);
    EXPECT_EQ(c[i].uv, triangle_uvs[i % 3]);
  }
}

// The point of the patch at (u,v).
Point3f on_patch(const std::vector<Point3f>& p, Point2f uv) {
  const auto mix = [&](auto component) {
    return (1 - uv.x) * (1 - uv.y) * component(p[0]) + uv.x * (1 - uv.y) * component(p[1]) +
           uv.x * uv.y * component(p[2]) + (1 - uv.x) * uv.y * component(p[3]);
  };
  return {mix([](Point3f q) { return q.x; }), mix([](Point3f q) { return q.y; }),
          mix([](Point3f q) { return q.z; })};
}

const std::vector<Point3f> trapezoid{{0, 0, 0}, {4, 0, 0}, {3, 1, 0}, {1, 1, 0}};
const std::vector<Point3f> curved{{0, 0, 0}, {1, 0, 0}, {1, 1, 1}, {0, 1, 0}};

TEST(PbrtQuads, OthersAreBilinearWhereATextureShowsIt) {
  for (const auto& quad : {trapezoid, curved}) {
    Diagnostics diagnostics;
    const Scene scene = import_ply(ply_of(quad, {"4 0 1 2 3"}), "rgb", textured, &diagnostics);
    EXPECT_GT(scene.meshes.at(0).triangles.size(), 100u);
    EXPECT_TRUE(mentions(diagnostics, "parallelograms"));
    for (const Corner& c : corners(scene.meshes[0])) {
      const Point3f p = on_patch(quad, c.uv);
      EXPECT_NEAR(length(p - c.p), 0, 1e-5);
    }
  }
  // Nothing shows how a plane is divided.
  EXPECT_EQ(import_ply(ply_of(trapezoid, {"4 0 1 2 3"}), "rgb", "").meshes.at(0).triangles.size(), 2u);
}

TEST(PbrtQuads, AndTrianglesAreTwoShapes) {
  const std::string file = ply_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {2, 1, 0}},
                                  {"4 0 1 2 3", "3 1 4 5", "3 1 5 2"});
  for (const std::uint64_t memory : {~std::uint64_t{0}, std::uint64_t{0}}) {
    const TemporaryFolder folder;
    folder.write("mesh.ply", file);
    const ImportedScene imported =
        read_pbrt(folder.write("scene.pbrt", "Film \"rgb\" WorldBegin\n" + textured +
                                                 "Shape \"plymesh\" \"string filename\" \"mesh.ply\"\n"),
                  MeshMemory(memory));
    ASSERT_EQ(imported.scene.shapes.size(), 2u);
    const std::vector<Corner> triangles = corners(imported.scene.meshes[0]);
    ASSERT_EQ(triangles.size(), 6u);
    for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(triangles[i].uv, triangle_uvs[i % 3]);
    expect_uvs(imported.scene.meshes[1], [](Point3f p) { return Point2f{p.x, p.y}; });
    EXPECT_EQ(imported.scene.meshes[0].deferred != nullptr, memory == 0);
  }
}

// Patches may share vertices; each is the unit square all the same.
TEST(PbrtPatches, HaveASquareEach) {
  const Scene scene = import_v4(textured +
                                "Shape \"bilinearmesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 0 2 0 0 2 1 0] "
                                "\"integer indices\" [0 1 2 3 1 4 3 5]")
                          .scene;
  const std::vector<Corner> c = corners(scene.meshes.at(0));
  ASSERT_EQ(c.size(), 12u);
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_EQ(c[i].uv.x, c[i].p.x - static_cast<float>(i / 6));
    EXPECT_EQ(c[i].uv.y, c[i].p.y);
  }
}

// pbrt's front follows the normals, its (u,v) the order of the corners.
TEST(PbrtMissingUvs, StayAtTheirCornersWhereTrianglesAreTurned) {
  const std::string two =
      "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 1 1 0 0 0 1 1 0 1 1 1 1] "
      "\"integer indices\" [0 1 2 3 4 5] \"normal N\" [0 0 -1 0 0 -1 0 0 -1 {}]";
  for (const char* const others : {"0 0 -1 0 0 -1 0 0 -1", "0 0 1 0 0 1 0 0 1"}) {
    const Scene scene = import_v4(textured + fmt::format(fmt::runtime(two), others)).scene;
    expect_uvs(scene.meshes.at(0), [](Point3f p) { return Point2f{p.x, p.y}; });
  }
}

TEST(PbrtMissingUvs, OfASubdividedCage) {
  const Scene scene = import_v4(textured +
                                "Shape \"loopsubdiv\" \"integer levels\" 0 \"point3 P\" [0 0 0 1 0 0 0 1 0] "
                                "\"integer indices\" [0 1 2]")
                          .scene;
  const TriangleMesh& mesh = scene.meshes.at(0);
  // Turned, since pbrt's front is on the other side; the second corner keeps (1,0).
  EXPECT_EQ(mesh.missing_uv, MissingUv::pbrt_turned);
}

}  // namespace
}  // namespace vitrail::pbrt_uvs_test
