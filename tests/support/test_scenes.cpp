// SPDX-License-Identifier: Apache-2.0
#include "tests/support/test_scenes.h"

#include <cmath>
#include <numbers>
#include <random>

namespace vitrail::test {

namespace {

void add_triangle(TriangleMesh& mesh, Point3d a, Point3d b, Point3d c) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Point3d& p : {a, b, c}) mesh.positions.push_back(cast<float>(p));
  mesh.triangles.push_back({first, first + 1, first + 2});
}

// std::uniform_real_distribution differs between libraries; this does not.
struct Random {
  std::mt19937_64 bits{7};
  double operator()(double scale) { return (static_cast<double>(bits() >> 11) * 0x1p-52 - 1) * scale; }
  Point3d point(double scale) {
    const double x = (*this)(scale), y = (*this)(scale);
    return {x, y, (*this)(scale)};
  }
  Vector3d vector(double scale) { return point(scale) - Point3d{}; }
};

void add_random_triangles(TriangleMesh& mesh) {
  Random random;
  for (int i = 0; i < 2000; ++i) {
    const Point3d p = random.point(15);
    add_triangle(mesh, p, p + random.vector(1), p + random.vector(1));
  }
  for (int i = 0; i < 40; ++i) add_triangle(mesh, random.point(16), random.point(16), random.point(16));
  for (int i = 0; i < 200; ++i) {
    const Point3d p = random.point(15);
    const Vector3d along = random.vector(8);
    add_triangle(mesh, p, p + along, p + along * 0.4 + random.vector(1e-5));
  }
  for (int i = 0; i < 20; ++i) {
    const Point3d p = random.point(10), q = random.point(10);
    add_triangle(mesh, p, p, q);
    add_triangle(mesh, p, p, p);
  }
}

// Unit squares in the plane where coordinate `axis` is `height`.
void add_grid(TriangleMesh& mesh, int axis, double height) {
  const auto at = [&](int u, int v) {
    Point3d p;
    p[axis] = height;
    p[(axis + 1) % 3] = u;
    p[(axis + 2) % 3] = v;
    return p;
  };
  for (int u = -16; u < 16; ++u)
    for (int v = -16; v < 16; ++v) {
      add_triangle(mesh, at(u, v), at(u + 1, v), at(u + 1, v + 1));
      add_triangle(mesh, at(u, v), at(u + 1, v + 1), at(u, v + 1));
    }
}

}  // namespace

TriangleMesh bumpy_torus(int n) {
  TriangleMesh mesh;
  const double step = 2 * std::numbers::pi / n;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double u = i * step, v = j * step, r = 1 + 0.1 * std::sin(7 * u) * std::cos(5 * v);
      const Normal3d normal{std::cos(u) * std::cos(v), std::sin(u) * std::cos(v), std::sin(v)};
      mesh.positions.push_back(cast<float>(Point3d{std::cos(u) * (3 + r * std::cos(v)),
                                                   std::sin(u) * (3 + r * std::cos(v)), r * std::sin(v)}));
      mesh.normals.push_back(cast<float>(normal));
    }
  const auto index = [n](int i, int j) { return static_cast<std::uint32_t>((i % n) * n + j % n); };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      mesh.triangles.push_back({index(i, j), index(i + 1, j), index(i + 1, j + 1)});
      mesh.triangles.push_back({index(i, j), index(i + 1, j + 1), index(i, j + 1)});
    }
  return mesh;
}

TriangleMesh adversarial_soup() {
  TriangleMesh mesh;
  for (int axis = 0; axis < 3; ++axis)
    for (const double height : {-16.0, 0.0, 16.0}) add_grid(mesh, axis, height);
  add_random_triangles(mesh);
  const std::vector<std::array<std::uint32_t, 3>> once = mesh.triangles;
  mesh.triangles.insert(mesh.triangles.end(), once.begin(), once.end());
  return mesh;
}

Scene scene_of(TriangleMesh mesh) {
  Scene scene;
  scene.meshes.push_back(std::move(mesh));
  scene.materials.emplace_back(Material{DiffuseMaterial{}});
  scene.shapes.push_back({.mesh = {0}, .material = {0}});
  return scene;
}

}  // namespace vitrail::test
