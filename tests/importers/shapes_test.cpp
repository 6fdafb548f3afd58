// SPDX-License-Identifier: Apache-2.0
#include "importers/shapes/shapes.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <set>

#include "importers/shapes/polygon.h"
#include "importers/shapes/quadrics.h"
#include "scene/geometry/unit_circle.h"
#include "scene/shapes/tessellate.h"

namespace vitrail::shapes_test {
namespace {

using testing::ElementsAre;
using Triangle = std::array<std::uint32_t, 3>;

constexpr double inf = std::numeric_limits<double>::infinity(),
                 nan = std::numeric_limits<double>::quiet_NaN();

Point3d corner(const TriangleMesh& mesh, const Triangle& t, std::size_t i) {
  return cast<double>(mesh.positions[t[i]]);
}

Vector3d area_vector(const TriangleMesh& mesh, const Triangle& t) {
  const Point3d a = corner(mesh, t, 0);
  return cross(corner(mesh, t, 1) - a, corner(mesh, t, 2) - a) * 0.5;
}

double area(const TriangleMesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles) sum += length(area_vector(mesh, t));
  return sum;
}

// Of a closed mesh whose front is outside.
double volume(const TriangleMesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles)
    sum += dot(area_vector(mesh, t), corner(mesh, t, 0) - Point3d{}) / 3;
  return sum;
}

// Each edge, by the bits of its ends, goes as often one way as the other; the number of edges for which it
// does not.
std::size_t open_edges(const TriangleMesh& mesh) {
  using Bits = std::array<char, sizeof(Point3f)>;
  const auto bits = [](const Point3f& p) {
    Bits b;
    std::memcpy(b.data(), &p, sizeof p);
    return b;
  };
  std::map<std::pair<Bits, Bits>, int> balance;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Bits a = bits(mesh.positions[t[i]]), b = bits(mesh.positions[t[(i + 1) % 3]]);
      if (a < b) ++balance[{a, b}];
      if (b < a) --balance[{b, a}];
    }
  }
  return static_cast<std::size_t>(
      std::ranges::count_if(balance, [](const auto& e) { return e.second != 0; }));
}

// Every triangle faces the side that the normals of its corners point to, and has an area.
void expect_fronts_follow_normals(const TriangleMesh& mesh) {
  for (const Triangle& t : mesh.triangles) {
    const Vector3d n = area_vector(mesh, t);
    ASSERT_GT(length(n), 0);
    for (const std::uint32_t i : t) ASSERT_GT(dot(n, to_vector(cast<double>(mesh.normals[i]))), 0);
  }
}

// The greatest distance of the mesh's triangles from the surface, whose signed distance function is given.
template <class Distance>
double greatest_distance(const TriangleMesh& mesh, Distance&& distance) {
  double greatest = 0;
  constexpr int n = 8;
  for (const Triangle& t : mesh.triangles) {
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; i + j <= n; ++j) {
        const Point3d a = corner(mesh, t, 0);
        const Vector3d u = corner(mesh, t, 1) - a, v = corner(mesh, t, 2) - a;
        greatest = std::max(greatest, std::abs(distance(a + u * (double(i) / n) + v * (double(j) / n))));
      }
    }
  }
  return greatest;
}

TEST(UnitCircle, AgreesWithTheLibrary) {
  for (int i = 0; i <= 1000; ++i) {
    const double angle = 2 * pi * i / 1000;
    EXPECT_NEAR(unit_circle(angle).x, std::cos(angle), 4e-16);
    EXPECT_NEAR(unit_circle(angle).y, std::sin(angle), 4e-16);
  }
  EXPECT_EQ(unit_circle(pi), (Point2d{-1, 0}));
  EXPECT_EQ(unit_circle(pi / 2), (Point2d{0, 1}));
}

// ---- Quadrics -----------------------------------------------------------------------------------

// The triangles where the sizes put them, with unit normals.
TriangleMesh tessellated(const SizedQuadric& q, int segments = quadric_segments) {
  TriangleMesh mesh = tessellate(q.quadric, segments);
  for (Point3f& p : mesh.positions) p = cast<float>(transform_point(q.to_object, cast<double>(p)));
  for (Normal3f& n : mesh.normals)
    n = cast<float>(to_normal(normalize(to_vector(transform_normal(q.to_object, cast<double>(n))))));
  return mesh;
}

TEST(Sphere, CloseToTheTrueOneAsTheHeaderSays) {
  const TriangleMesh mesh = tessellated(sphere(2, -2, 2, 2 * pi));
  EXPECT_LE(greatest_distance(mesh, [](Point3d p) { return length(p - Point3d{}) - 2; }), 2 * 1.51e-4);
  EXPECT_NEAR(area(mesh) / (16 * pi) - 1, -1.255e-4, 0.02e-4);
  EXPECT_NEAR(volume(mesh) / (32 * pi / 3) - 1, -2.51e-4, 0.02e-4);
  EXPECT_EQ(open_edges(mesh), 0u);
  expect_fronts_follow_normals(mesh);
}

TEST(Sphere, NormalsAndParameters) {
  const double r = 3, zmin = -1, zmax = 2, phimax = 4;
  const TriangleMesh mesh = tessellated(sphere(r, zmax, zmin, phimax));  // sorted
  expect_fronts_follow_normals(mesh);
  double low = inf, high = -inf;
  const double first = std::acos(zmin / r), last = std::acos(zmax / r);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Point3d p = cast<double>(mesh.positions[i]);
    const Normal3d n = cast<double>(mesh.normals[i]);
    EXPECT_NEAR(length(to_vector(n) * r - (p - Point3d{})), 0, 1e-6);
    const double theta = first + mesh.uvs[i].y * (last - first), phi = mesh.uvs[i].x * phimax;
    EXPECT_NEAR(p.x, r * std::sin(theta) * std::cos(phi), 2e-6);
    EXPECT_NEAR(p.y, r * std::sin(theta) * std::sin(phi), 2e-6);
    EXPECT_NEAR(p.z, r * std::cos(theta), 2e-6);
    low = std::min(low, p.z);
    high = std::max(high, p.z);
  }
  EXPECT_NEAR(low, zmin, 1e-6);
  EXPECT_NEAR(high, zmax, 1e-6);
}

TEST(Sphere, ClampedAndTiny) {
  const SizedQuadric clamped = sphere(1, -9, 9, 100);
  EXPECT_EQ(clamped.quadric, Quadric{});
  EXPECT_EQ(clamped.to_object, Transform{});
  EXPECT_EQ(sphere(1e-30, -1, 1, 7).quadric, Quadric{}) << "the size is the transform's";
  const TriangleMesh sliver = tessellated(sphere(1e-30, -1, 1, 1e-3));
  EXPECT_GE(sliver.triangles.size(), 2u);
  for (const Point3f& p : sliver.positions) EXPECT_TRUE(is_finite(p));
}

TEST(Disk, AreaSideAndParameters) {
  for (const double inner : {0.0, 0.5}) {
    const TriangleMesh mesh = tessellated(disk(7, 2, inner, pi));
    EXPECT_NEAR(area(mesh) / (pi / 2 * (4 - inner * inner)) - 1, -1.0e-4, 0.05e-4);
    expect_fronts_follow_normals(mesh);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      const Point3f p = mesh.positions[i];
      EXPECT_EQ(p.z, 7);
      EXPECT_EQ(mesh.normals[i], (Normal3f{0, 0, 1}));
      const double r = 2 - mesh.uvs[i].y * (2 - inner);
      EXPECT_NEAR(p.x, r * std::cos(pi * mesh.uvs[i].x), 1e-6);
      EXPECT_NEAR(p.y, r * std::sin(pi * mesh.uvs[i].x), 1e-6);
    }
  }
}

TEST(Cylinder, DistanceNormalsAndParameters) {
  const TriangleMesh mesh = tessellated(cylinder(2, 3, -1, 2 * pi));
  const auto distance = [](Point3d p) { return std::hypot(p.x, p.y) - 2; };
  EXPECT_LE(greatest_distance(mesh, distance), 2 * 7.6e-5);
  EXPECT_NEAR(area(mesh) / (16 * pi) - 1, -2.5e-5, 0.1e-5);
  expect_fronts_follow_normals(mesh);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    EXPECT_NEAR(mesh.normals[i].x * 2, mesh.positions[i].x, 1e-6);
    EXPECT_NEAR(mesh.normals[i].y * 2, mesh.positions[i].y, 1e-6);
    EXPECT_EQ(mesh.normals[i].z, 0);
    EXPECT_EQ(mesh.positions[i].z, mesh.uvs[i].y == 0 ? -1 : 3);
  }
  // Open at the two rims only.
  EXPECT_EQ(open_edges(mesh), 2u * quadric_segments);
}

TEST(Quadrics, ConesAndParaboloidsFaceOutwards) {
  const TriangleMesh mesh = tessellated(cone(3, 4, 2 * pi)), bowl = tessellated(paraboloid(2, 0, 1, 2 * pi));
  expect_fronts_follow_normals(mesh);
  expect_fronts_follow_normals(bowl);
  EXPECT_NEAR(area(mesh), pi * 3 * 5, 0.01);
  EXPECT_NEAR(area(bowl), pi * 8 / 3 * (std::pow(2, 1.5) - 1), 0.01);  // z = r²/4 up to r = 2
  EXPECT_GT(tessellated(paraboloid(2, 0.25, 1, 1)).positions[0].z, 0.2f);
}

TEST(Quadrics, SegmentsAreOfAFullTurn) {
  const auto triangles = [](const SizedQuadric& q, int segments) {
    return tessellated(q, segments).triangles.size();
  };
  EXPECT_EQ(triangles(cylinder(1, 0, 1, 2 * pi), 3), 6u);
  EXPECT_EQ(triangles(cylinder(1, 0, 1, pi), 10), 10u);
  EXPECT_EQ(triangles(sphere(1, -1, 1, 2 * pi), 8), 2u * 8 + 2 * 2 * 8);
}

TEST(Quadrics, SizesThatAreNone) {
  for (const double bad : {0.0, -1.0, nan, inf, 1e39}) {
    EXPECT_THROW(sphere(bad, -1, 1, 1), Error) << bad;
    EXPECT_THROW(disk(0, bad, 0, 1), Error) << bad;
    EXPECT_THROW(cylinder(bad, 0, 1, 1), Error) << bad;
    EXPECT_THROW(cone(bad, 1, 1), Error) << bad;
    EXPECT_THROW(paraboloid(1, 0, bad, 1), Error) << bad;
  }
  for (const double bad : {0.0, -1.0, nan}) {
    EXPECT_THROW(sphere(1, -1, 1, bad), Error) << bad;
    EXPECT_THROW(disk(0, 1, 0, bad), Error) << bad;
    EXPECT_THROW(cylinder(1, 0, 1, bad), Error) << bad;
  }
  EXPECT_THROW(sphere(1, nan, 1, 1), Error);
  EXPECT_THROW(sphere(1, 2, 3, 1), Error);
  EXPECT_THROW(disk(nan, 1, 0, 1), Error);
  EXPECT_THROW(disk(0, 1, 1, 1), Error);
  EXPECT_THROW(disk(0, 1, -1, 1), Error);
  EXPECT_THROW(disk(0, 1, nan, 1), Error);
  EXPECT_THROW(cylinder(1, 2, 2, 1), Error);
  EXPECT_THROW(cylinder(1, 0, inf, 1), Error);
  EXPECT_THROW(paraboloid(1, -1, 1, 1), Error);
}

TEST(Quadrics, Deterministic) {
  EXPECT_EQ(tessellated(sphere(1.1, -0.3, 0.9, 5)), tessellated(sphere(1.1, -0.3, 0.9, 5)));
}

TEST(Quadrics, AreasAreThoseOfTheClosedForms) {
  const Transform turn = rotate(0.7, {1, 2, -3}) * scale({3, -3, 3});  // areas times 9
  const auto expect = [&](const SizedQuadric& q, double area) {
    EXPECT_NEAR(area_of(q.quadric, turn * q.to_object) / (9 * area), 1, 1e-12)
        << static_cast<int>(q.quadric.kind);
  };
  expect(sphere(2, -2, 2, 2 * pi), 16 * pi);
  expect(sphere(2, -0.5, 1, 1.5), 1.5 * 2 * 1.5);
  expect(disk(4, 2, 1, 1.5), 1.5 / 2 * 3);
  expect(cylinder(2, 1, 6, 1.5), 1.5 * 2 * 5);
  expect(cone(3, 4, 1.5), 1.5 / 2 * 3 * 5);
  expect(paraboloid(2, 0, 1, 2 * pi), pi * 8 / 3 * (std::pow(2, 1.5) - 1));  // z = r²/4
}

TEST(Quadrics, AreasUnderAnyTransform) {
  // A spheroid of half axes 1, 1 and c.
  const double c = 2, e = std::sqrt(1 - 1 / (c * c));
  EXPECT_NEAR(area_of({}, scale({1, 1, c})), 2 * pi * (1 + c / e * std::asin(e)), 1e-9);
  EXPECT_NEAR(area_of({}, scale({1, c, 1})), 2 * pi * (1 + c / e * std::asin(e)), 1e-9);
  Transform shear = scale({1, 2, 0.5});
  shear.m[0][1] = 0.8, shear.m[2][0] = -0.4;
  for (const SizedQuadric& q : {sphere(1, -0.3, 1, 5), disk(1, 2, 0.5, 5), cylinder(1, 0, 3, 5),
                                cone(1, 2, 5), paraboloid(1, 0.1, 2, 5)}) {
    const Transform to = shear * q.to_object;
    EXPECT_NEAR(area_of(q.quadric, to) / area(tessellated({q.quadric, to}, 2048)), 1, 1e-5)
        << static_cast<int>(q.quadric.kind);
  }
}

// ---- Bilinear patches ---------------------------------------------------------------------------

TEST(Bilinear, PlanarPatchIsTwoTriangles) {
  const TriangleMesh mesh =
      tessellate_bilinear({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2, 3}}, {}, {});
  EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{0, 1, 3}, Triangle{0, 3, 2}));
  EXPECT_TRUE(mesh.normals.empty());
  for (const Triangle& t : mesh.triangles) EXPECT_GT(area_vector(mesh, t).z, 0);  // (p10 − p00) × (p01 − p00)
}

TEST(Bilinear, CurvedPatch) {
  const std::vector<Point3f> p{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1}};  // z = xy
  const std::vector<Point2f> uvs{{0, 0}, {1, 0}, {0, 1}, {1, 1}};
  const TriangleMesh mesh = tessellate_bilinear(p, {{0, 1, 2, 3}}, {}, uvs);
  expect_fronts_follow_normals(mesh);
  // The vertical distance is at least the distance.
  EXPECT_LE(greatest_distance(mesh, [](Point3d q) { return q.z - q.x * q.y; }), 2e-4 * std::sqrt(3.0));
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Point3d q = cast<double>(mesh.positions[i]);
    EXPECT_NEAR(q.z, q.x * q.y, 1e-6);
    EXPECT_NEAR(mesh.uvs[i].x, q.x, 1e-6);
    EXPECT_NEAR(mesh.uvs[i].y, q.y, 1e-6);
    const Vector3d n = normalize(Vector3d{-q.y, -q.x, 1});
    EXPECT_NEAR(dot(n, to_vector(cast<double>(mesh.normals[i]))), 1, 1e-6);
  }
}

// Two curved patches with one edge, which runs one way in the first and the other way in the second.
TEST(Bilinear, NeighboursAgreeBitForBit) {
  const std::vector<Point3f> p{{0, 0, 0},    {1, 0.1f, 0}, {0, 1, 0.2f},
                               {1.3f, 1, 1}, {2, 0, 0.3f}, {2.1f, 1.1f, 0}};
  const TriangleMesh one = tessellate_bilinear(p, {{0, 1, 2, 3}}, {}, {});
  const TriangleMesh two = tessellate_bilinear(p, {{0, 1, 2, 3}, {5, 3, 4, 1}}, {}, {});
  const auto n = static_cast<std::size_t>(std::sqrt(static_cast<double>(two.triangles.size()) / 4));
  EXPECT_EQ(open_edges(two), 6 * n);
  EXPECT_LE(one.triangles.size(), 2 * n * n);
}

TEST(Bilinear, GivenNormalsAreKept) {
  const std::vector<Normal3f> normals(4, Normal3f{0, 3, 4});
  const TriangleMesh mesh =
      tessellate_bilinear({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1}}, {{0, 1, 2, 3}}, normals, {});
  for (const Normal3f& n : mesh.normals) {
    EXPECT_NEAR(n.y, 0.6f, 1e-6);
    EXPECT_NEAR(n.z, 0.8f, 1e-6);
  }
}

TEST(Bilinear, DegenerateAndWrong) {
  const std::vector<Point3f> p{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1}};
  for (const Normal3f& n : tessellate_bilinear(p, {{0, 1, 0, 3}}, {}, {}).normals)
    EXPECT_TRUE(std::isfinite(n.x));
  EXPECT_EQ(tessellate_bilinear(p, {{0, 0, 0, 0}}, {}, {}).triangles.size(), 2u);
  EXPECT_TRUE(tessellate_bilinear(p, {}, {}, {}).triangles.empty());
  EXPECT_THROW(tessellate_bilinear(p, {{0, 1, 2, 4}}, {}, {}), Error);
  EXPECT_THROW(tessellate_bilinear(p, {{0, 1, 2, 3}}, {{0, 0, 1}}, {}), Error);
  EXPECT_THROW(tessellate_bilinear({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {NAN, 1, 1}}, {{0, 1, 2, 3}}, {}, {}),
               Error);
}

// ---- Loop subdivision ---------------------------------------------------------------------------

TriangleMesh octahedron() {
  return {{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
          {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}},
          {},
          {}};
}

TEST(Loop, OctahedronBecomesASmoothClosedSurface) {
  const TriangleMesh mesh = loop_subdivide(octahedron(), 3);
  EXPECT_EQ(mesh.triangles.size(), 8u * 64);
  EXPECT_EQ(mesh.positions.size(), 2u + 8 * 64 / 2);  // Euler
  EXPECT_EQ(open_edges(mesh), 0u);
  expect_fronts_follow_normals(mesh);
  EXPECT_NEAR(length(to_vector(cast<double>(mesh.normals[0])) - Vector3d{1, 0, 0}), 0, 1e-6);
  // Warren's weights for valence 4: the limit of a vertex takes 1/8 of each neighbour, here together 0.
  EXPECT_NEAR(mesh.positions[0].x, 0.5, 1e-6);
}

// The limit does not depend on how often the cage was refined before: vertices of the cage stay where they
// are.
TEST(Loop, LimitPointsDoNotMove) {
  TriangleMesh cage = octahedron();
  cage.positions[4] = {0.3f, 0.1f, 2};
  cage.triangles.pop_back();  // a boundary
  const TriangleMesh coarse = loop_subdivide(cage, 0), fine = loop_subdivide(cage, 4);
  ASSERT_EQ(coarse.positions.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(length(fine.positions[i] - coarse.positions[i]), 0, 1e-6) << i;
    EXPECT_NEAR(length(to_vector(fine.normals[i]) - to_vector(coarse.normals[i])), 0, 1e-5) << i;
  }
}

// Valence 3, where Warren's weight is 3/16: the limit takes 1/5 of each neighbour, refined before or not.
TEST(Loop, Tetrahedron) {
  const TriangleMesh cage{{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}},
                          {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}},
                          {},
                          {}};
  for (const int levels : {0, 1, 4}) {
    const TriangleMesh mesh = loop_subdivide(cage, levels);
    EXPECT_NEAR(mesh.positions[0].x, 0.2, 1e-6) << levels;
    EXPECT_NEAR(mesh.normals[0].x, std::sqrt(1.0 / 3), 1e-6) << levels;
    expect_fronts_follow_normals(mesh);
  }
}

// Normals of the limit surface agree with its fine triangles, inside and on boundaries of every valence.
TEST(Loop, NormalsAreThoseOfTheSurface) {
  TriangleMesh fan{{{0, 0, 0.5f}}, {}, {}, {}};
  constexpr std::uint32_t corners = 7;
  for (std::uint32_t i = 0; i < corners; ++i) {
    const double angle = 2 * pi * i / corners;
    fan.positions.push_back({float(std::cos(angle)), float(std::sin(angle)), float(0.2 * (i % 3))});
  }
  for (std::uint32_t faces = 1; faces <= corners; ++faces) {
    fan.triangles.push_back({0, faces, faces % corners + 1});
    const TriangleMesh mesh = loop_subdivide(fan, 5);
    for (const Triangle& t : mesh.triangles) {
      const Vector3d n = normalize(area_vector(mesh, t));
      for (const std::uint32_t i : t) {
        ASSERT_GT(dot(n, to_vector(cast<double>(mesh.normals[i]))), 0.97) << faces << " faces, vertex " << i;
      }
    }
  }
}

TEST(Loop, PlaneStaysAndBoundaryIsASpline) {
  const TriangleMesh square{
      {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {9, 9, 9}}, {{0, 1, 2}, {0, 2, 3}}, {}, {}};
  const TriangleMesh mesh = loop_subdivide(square, 4);
  for (const Point3f& p : mesh.positions) EXPECT_EQ(p.z, 0);
  for (const Normal3f& n : mesh.normals) EXPECT_NEAR(n.z, 1, 1e-6);
  // The corner vertex of the limit: 2/3 of itself and 1/6 of its neighbours on the boundary.
  EXPECT_NEAR(mesh.positions[1].x, 2.0 / 3, 1e-6);
  EXPECT_NEAR(mesh.positions[1].y, -2.0 / 3, 1e-6);
}

TEST(Loop, CagesThatAreNoSurface) {
  const std::vector<Point3f> p{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}, {-1, 0, 0}};
  for (const auto& triangles :
       std::vector<std::vector<Triangle>>{{{0, 1, 2}, {0, 1, 3}},  // an edge runs twice the same way
                                          {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}},  // three faces at an edge
                                          {{0, 1, 2}, {0, 4, 5}},  // two surfaces touch at a vertex
                                          {{0, 0, 1}},
                                          {{0, 1, 6}}}) {
    EXPECT_THROW(loop_subdivide({p, triangles, {}, {}}, 1), Error);
  }
  EXPECT_THROW(loop_subdivide(octahedron(), -1), Error);
  EXPECT_THROW(loop_subdivide(octahedron(), 40), Error);
  EXPECT_TRUE(loop_subdivide({}, 3).triangles.empty());
}

TEST(Loop, Deterministic) { EXPECT_EQ(loop_subdivide(octahedron(), 3), loop_subdivide(octahedron(), 3)); }

// ---- Polygons -----------------------------------------------------------------------------------

// Triangles are n − 2, none is turned over, and together they have the polygon's area.
void expect_tiles(const std::vector<Point3d>& p, double expected_area) {
  std::vector<CornerTriple> cut;
  triangulate_polygon(p, cut);
  ASSERT_EQ(cut.size(), p.size() - 2);
  Vector3d whole;
  for (std::size_t i = 1; i + 1 < p.size(); ++i) whole = whole + cross(p[i] - p[0], p[i + 1] - p[0]);
  double sum = 0;
  for (const auto& [a, b, c] : cut) {
    const Vector3d n = cross(p[b] - p[a], p[c] - p[a]) * 0.5;
    EXPECT_GE(dot(n, whole), 0);
    sum += length(n);
  }
  EXPECT_NEAR(sum, expected_area, 1e-9 * expected_area);
}

TEST(PolygonShape, ConcaveOnesInEveryPlaneAndFromEveryCorner) {
  const std::vector<Point2d> comb{{0, 0}, {5, 0}, {5, 3}, {4, 3}, {4, 1}, {3, 1},
                                  {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}};
  const std::vector<Point2d> arrow{{0, 0}, {2, 1}, {0, 2}, {1, 1}};
  const std::vector<Point2d> with_collinear{{0, 0}, {1, 0}, {2, 0}, {2, 2}, {1, 2}, {1, 1}, {0, 1}};
  for (const auto& [flat, area_of_flat] : {std::pair{comb, 11.0}, {arrow, 1.0}, {with_collinear, 3.0}}) {
    for (std::size_t start = 0; start < flat.size(); ++start) {
      for (int axis = 0; axis < 3; ++axis) {
        for (const bool reversed : {false, true}) {
          std::vector<Point3d> p;
          for (std::size_t i = 0; i < flat.size(); ++i) {
            const Point2d q = flat[(start + i) % flat.size()];
            p.push_back(axis == 0   ? Point3d{7, q.x, q.y}
                        : axis == 1 ? Point3d{q.x, 7, q.y}
                                    : Point3d{q.x, q.y, 7});
          }
          if (reversed) std::ranges::reverse(p);
          expect_tiles(p, area_of_flat);
        }
      }
    }
  }
}

// A square ring, cut open: the bridge is passed twice.
TEST(PolygonShape, BridgeToAHole) {
  expect_tiles({{0, 0, 0},
                {4, 0, 0},
                {4, 4, 0},
                {0, 4, 0},
                {0, 0, 0},
                {1, 1, 0},
                {1, 3, 0},
                {3, 3, 0},
                {3, 1, 0},
                {1, 1, 0}},
               12);
}

TEST(PolygonShape, DegenerateOnesEnd) {
  for (const std::vector<Point3d>& p : std::vector<std::vector<Point3d>>{
           {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}},
           {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}},
           {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}},
           {{0, 0, 0}, {3, 3, 0}, {3, 0, 0}, {0, 2, 0}, {1, 5, 2}, {1, -4, 0}}}) {
    std::vector<CornerTriple> cut;
    triangulate_polygon(p, cut);
    EXPECT_EQ(cut.size(), p.size() - 2);
  }
}

}  // namespace
}  // namespace vitrail::shapes_test
