// SPDX-License-Identifier: Apache-2.0
// The second law: every triangle is stored once, and one that straddles an interface is cut into pieces that
// tile it and meet exactly. Everything is judged from the bundle's files alone.
#include <gtest/gtest.h>

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>
#include <string>

#include "bundle/census.h"
#include "bundle/manifest.h"
#include "partitioner/partition.h"
#include "tests/laws/edge_chain.h"
#include "tests/partitioner/test_scenes.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test {

namespace {

struct Side {
  int axis;
  double split;
  bool above;
};

struct Face {
  std::uint32_t triangle;
  std::vector<Point3d> polygon;
};

// What the files say of one domain, and the interfaces around it.
struct DomainGeometry {
  std::vector<Cluster> clusters;
  std::vector<Piece> pieces;
  std::vector<Point3d> piece_vertices;
  std::vector<Side> sides;

  // Pieces as they are and triangles without one.
  std::vector<Face> faces() const {
    std::vector<Face> result;
    std::set<std::uint32_t> cut;
    for (const Piece& p : pieces) {
      const auto first = piece_vertices.begin() + p.first_vertex;
      result.push_back({p.triangle, {first, first + p.vertex_count}});
      cut.insert(p.triangle);
    }
    for (const Face& f : parents())
      if (!cut.contains(f.triangle)) result.push_back(f);
    return result;
  }

  // The uncut triangles of all lanes.
  std::vector<Face> parents() const {
    std::vector<Face> result;
    for (const Cluster& c : clusters)
      for (std::size_t lane = 0; lane < cluster_width; ++lane) {
        if (c.id[lane] == no_triangle) continue;
        Face& f = result.emplace_back(Face{c.id[lane], {}});
        for (const auto& v : c.vertex) f.polygon.push_back({v[0][lane], v[1][lane], v[2][lane]});
      }
    return result;
  }
};

struct BundleGeometry {
  Manifest manifest;
  std::vector<DomainGeometry> domains;
};

void find_sides(const Manifest& m, std::uint32_t child, std::vector<Side> sides, BundleGeometry& bundle) {
  if (child & KdNode::leaf_bit) {
    bundle.domains[child & ~KdNode::leaf_bit].sides = sides;
    return;
  }
  const KdNode& node = m.kd_nodes[child];
  sides.push_back({static_cast<int>(node.axis), node.split, false});
  find_sides(m, node.below, sides, bundle);
  sides.back().above = true;
  find_sides(m, node.above, sides, bundle);
}

BundleGeometry load(const std::filesystem::path& path) {
  BundleGeometry bundle{read_manifest(path), {}};
  for (std::uint32_t i = 0; i < bundle.manifest.domains.size(); ++i) {
    const MappedDomain mapped(domain_path(path, i));
    check_domain(bundle.manifest, i, mapped, domain_path(path, i));
    const auto vector = [](auto span) { return std::vector(span.begin(), span.end()); };
    bundle.domains.push_back(
        {vector(mapped.view().clusters), vector(mapped.pieces()), vector(mapped.piece_vertices()), {}});
  }
  if (!bundle.manifest.kd_nodes.empty()) find_sides(bundle.manifest, 0, {}, bundle);
  return bundle;
}

// What is wrong, in words; at most a few of each kind.
class Problems {
 public:
  void add(const std::string& what) {
    if (++count_[what] == 1) words_.push_back(what);
  }
  std::string text() const {
    std::string all;
    for (const std::string& w : words_) all += w + " (" + std::to_string(count_.at(w)) + "×)\n";
    return all;
  }

 private:
  std::map<std::string, int> count_;
  std::vector<std::string> words_;
};

double tolerance(const BundleGeometry& b) { return 1e-12 * double{b.manifest.scale}; }

void check_census(const BundleGeometry& b, Problems& problems) {
  Census census(b.manifest.triangles);
  for (std::uint32_t i = 0; i < b.domains.size(); ++i) {
    const DomainGeometry& d = b.domains[i];
    census.add(i, {{}, d.clusters, {}}, d.pieces, d.piece_vertices);
  }
  const CensusResult r = census.result();
  if (r.duplicates != 0) problems.add("a triangle is stored twice");
  if (r.lost != 0) problems.add("a triangle is lost");
  if (!(r.area_error < 1e-6)) problems.add("pieces and triangle differ in area");
  if (r.cut_triangles != b.manifest.cut_triangles) problems.add("the manifest counts other cut triangles");
}

// Everything in a domain lies in its cell, faces between its interfaces exactly.
void check_cells(const BundleGeometry& b, Problems& problems) {
  for (const DomainGeometry& d : b.domains)
    for (const Face& f : d.faces())
      for (const Point3d& p : f.polygon)
        for (const Side& s : d.sides)
          if (s.above ? p[s.axis] < s.split : p[s.axis] > s.split)
            problems.add("a vertex is outside its domain");
}

using Key = std::array<double, 3>;
Key key(Point3d p) { return {p.x, p.y, p.z}; }

// A vertex that a cut made has the same bits on both sides of it: no domain has one alone.
void check_cut_vertices(const BundleGeometry& b, Problems& problems) {
  std::map<std::uint32_t, std::map<Key, int>> domains_with;
  for (const DomainGeometry& d : b.domains)
    for (const Piece& p : d.pieces) {
      std::set<Key> own;
      for (std::uint32_t i = 0; i < p.vertex_count; ++i)
        own.insert(key(d.piece_vertices[p.first_vertex + i]));
      for (const Key& k : own) ++domains_with[p.triangle][k];
    }
  for (const DomainGeometry& d : b.domains)
    for (const Face& f : d.parents())
      if (const auto at = domains_with.find(f.triangle); at != domains_with.end())
        for (const Point3d& p : f.polygon) at->second.erase(key(p));
  for (const auto& [triangle, vertices] : domains_with)
    for (const auto& [vertex, count] : vertices)
      if (count < 2) problems.add("a cut vertex differs on the two sides");
}

// The boundaries of a triangle's pieces add up to its own.
void check_tiling(const BundleGeometry& b, Problems& problems) {
  std::map<std::uint32_t, EdgeChain> sums;
  for (const DomainGeometry& d : b.domains)
    for (const Piece& p : d.pieces)
      sums[p.triangle].add_polygon(std::span(d.piece_vertices).subspan(p.first_vertex, p.vertex_count));
  std::set<std::uint32_t> subtracted;
  for (const DomainGeometry& d : b.domains)
    for (const Face& f : d.parents())
      if (sums.contains(f.triangle) && subtracted.insert(f.triangle).second)
        sums[f.triangle].add_polygon(f.polygon, -1);
  for (const auto& [triangle, sum] : sums)
    if (!sum.refined(tolerance(b)).edges().empty()) problems.add("pieces do not tile their triangle");
}

// The boundary of all domains together is the input's: nothing gapes between them.
void check_boundary(const BundleGeometry& b, Problems& problems) {
  EdgeChain sum;
  std::set<std::uint32_t> subtracted;
  for (const DomainGeometry& d : b.domains) {
    for (const Face& f : d.faces()) sum.add_polygon(f.polygon);
    for (const Face& f : d.parents())
      if (subtracted.insert(f.triangle).second) sum.add_polygon(f.polygon, -1);
  }
  if (!sum.refined(tolerance(b)).edges().empty()) problems.add("a boundary that the input does not have");
}

std::string problems_of(const BundleGeometry& b) {
  Problems problems;
  check_census(b, problems);
  check_cells(b, problems);
  check_cut_vertices(b, problems);
  check_tiling(b, problems);
  check_boundary(b, problems);
  return problems.text();
}

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
  return load(directory.path() / "scene.vit");
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
  EXPECT_EQ(problems_of(load(path)), "");
}

}  // namespace

}  // namespace vitrail::test
