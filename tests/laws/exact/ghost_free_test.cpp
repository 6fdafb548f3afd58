// SPDX-License-Identifier: Apache-2.0
// The second law: every triangle is stored once, and one that straddles an interface is cut into pieces that
// tile it and meet exactly. Everything is judged from the bundle's files alone.
#include <gtest/gtest.h>

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <cmath>
#include <cstdlib>
#include <map>
#include <string>

#include "partitioner/partition.h"
#include "tests/laws/exact/edge_chain.h"
#include "tests/laws/exact/ghost_free.h"
#include "tests/support/temporary_directory.h"
#include "tests/support/test_scenes.h"

namespace vitrail::test::ghost_free_test {

namespace {

using Key = std::array<double, 3>;
Key key(Point3d p) { return {p.x, p.y, p.z}; }

struct MeshTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
};
using Mesh = OpenMesh::PolyMesh_ArrayKernelT<MeshTraits>;

// Without vertices that repeat the one before: where a cut passes within rounding of a corner, two are the
// same.
std::vector<Point3d> without_repetition(const std::vector<Point3d>& polygon) {
  std::vector<Point3d> result;
  for (const Point3d& p : polygon)
    if (result.empty() || !(p == result.back())) result.push_back(p);
  while (result.size() > 1 && result.back() == result.front()) result.pop_back();
  return result;
}

Mesh mesh_of(const DomainGeometry& d, Problems& problems) {
  Mesh mesh;
  std::map<Key, Mesh::VertexHandle> vertices;
  for (const Face& f : d.faces()) {
    const std::vector<Point3d> polygon = without_repetition(f.polygon);
    if (polygon.size() < 3) continue;
    std::vector<Mesh::VertexHandle> corners;
    for (const Point3d& p : polygon) {
      auto [at, is_new] = vertices.try_emplace(key(p));
      if (is_new) at->second = mesh.add_vertex({p.x, p.y, p.z});
      corners.push_back(at->second);
    }
    if (!mesh.add_face(corners).is_valid()) {
      problems.add("a face does not fit into the mesh of its domain");
      break;
    }
  }
  return mesh;
}

// For a closed manifold: each domain is one too but for edges exactly in its interfaces, and these match
// those of the domains beyond.
std::string problems_of_closed_mesh(const BundleGeometry& b) {
  Problems problems;
  EdgeChain boundary;
  for (const DomainGeometry& d : b.domains) {
    const Mesh mesh = mesh_of(d, problems);
    const auto point = [&](Mesh::VertexHandle v) {
      return Point3d{mesh.point(v)[0], mesh.point(v)[1], mesh.point(v)[2]};
    };
    for (const auto h : mesh.halfedges()) {
      if (!mesh.is_boundary(h)) continue;
      const Point3d p = point(mesh.from_vertex_handle(h)), q = point(mesh.to_vertex_handle(h));
      bool in_interface = false;
      for (const Side& s : d.sides) in_interface |= p[s.axis] == s.split && q[s.axis] == s.split;
      if (!in_interface) problems.add("a boundary edge is not in an interface");
      boundary.add(p, q);
    }
  }
  if (!boundary.refined(tolerance(b)).edges().empty())
    problems.add("boundary edges of neighbours do not match");
  return problems.text();
}

BundleGeometry partitioned(TriangleMesh mesh, std::uint32_t domains) {
  const TemporaryDirectory directory;
  partition(scene_of(std::move(mesh)), directory.path() / "scene.vit", {.domains = domains});
  return load_geometry(directory.path() / "scene.vit");
}

class GhostFree : public ::testing::TestWithParam<std::uint32_t> {};

TEST_P(GhostFree, ClosedMesh) {
  const BundleGeometry b = partitioned(bumpy_torus(100), GetParam());
  EXPECT_TRUE(b.manifest.cut_triangles > 100 || GetParam() < 8);
  EXPECT_EQ(problems_of(b), "");
  EXPECT_EQ(problems_of_closed_mesh(b), "");
}

TEST_P(GhostFree, AdversarialSoup) {
  const BundleGeometry b = partitioned(adversarial_soup(), GetParam());
  std::size_t coplanar = 0;
  for (const DomainGeometry& d : b.domains)
    for (const Face& f : d.faces())
      for (const Side& s : d.sides)
        coplanar += f.polygon[0][s.axis] == s.split && f.polygon[1][s.axis] == s.split &&
                    f.polygon[2][s.axis] == s.split;
  EXPECT_TRUE(coplanar > 0 || GetParam() == 1)
      << "no triangle lies in an interface: the soup does not test what it should";
  EXPECT_EQ(problems_of(b), "");
}

INSTANTIATE_TEST_SUITE_P(Domains, GhostFree, ::testing::Values(1u, 2u, 8u, 13u, 64u));

// Each of these breaks one thing, and the law has to notice.
class BrokenBundle : public ::testing::Test {
 protected:
  BundleGeometry bundle = partitioned(bumpy_torus(40), 8);
  DomainGeometry& cut_domain() {
    for (DomainGeometry& d : bundle.domains)
      if (!d.pieces.empty()) return d;
    throw std::logic_error("nothing was cut");
  }
};

TEST_F(BrokenBundle, VertexMovedByOneBit) {
  DomainGeometry& d = cut_domain();
  double& x = d.piece_vertices[d.pieces[0].first_vertex].x;
  x = std::nextafter(x, 0.0);
  EXPECT_NE(problems_of(bundle), "");
  EXPECT_NE(problems_of_closed_mesh(bundle), "");
}

TEST_F(BrokenBundle, PieceLost) {
  cut_domain().pieces.pop_back();
  EXPECT_NE(problems_of(bundle), "");
  EXPECT_NE(problems_of_closed_mesh(bundle), "");
}

TEST_F(BrokenBundle, PieceStoredTwice) {
  DomainGeometry& d = cut_domain();
  d.pieces.push_back(d.pieces.back());
  EXPECT_NE(problems_of(bundle), "");
}

TEST_F(BrokenBundle, TriangleStoredTwice) {
  bundle.domains[0].clusters.push_back(bundle.domains[0].clusters[0]);
  EXPECT_NE(problems_of(bundle), "");
}

TEST_F(BrokenBundle, TriangleLost) {
  bundle.domains[0].clusters.pop_back();
  EXPECT_NE(problems_of(bundle), "");
}

// Judges any bundle: VITRAIL_GHOST_BUNDLE=scene.vit.
TEST(GhostFreeBundle, Given) {
  const char* path = std::getenv("VITRAIL_GHOST_BUNDLE");
  if (!path) GTEST_SKIP() << "VITRAIL_GHOST_BUNDLE names no bundle";
  EXPECT_EQ(problems_of(load_geometry(path)), "");
}

}  // namespace

}  // namespace vitrail::test::ghost_free_test
