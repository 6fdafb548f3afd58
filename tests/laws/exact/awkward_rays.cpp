// SPDX-License-Identifier: Apache-2.0
#include "tests/laws/exact/awkward_rays.h"

#include <numbers>
#include <random>

namespace vitrail::test {
namespace {

// std::uniform_real_distribution differs between libraries; this does not.
class Random {
 public:
  std::uint64_t below(std::uint64_t n) { return bits_() % n; }
  float uniform(float scale) { return (static_cast<float>(bits_() >> 40) * 0x1p-23f - 1) * scale; }
  Vector3f vector(float scale) {
    const float x = uniform(scale), y = uniform(scale);
    return {x, y, uniform(scale)};
  }
  Point3f point(float scale) { return Point3f{} + vector(scale); }

 private:
  std::mt19937_64 bits_{2024};
};

void add(TriangleMesh& mesh, Point3f a, Point3f b, Point3f c) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), {a, b, c});
  mesh.triangles.push_back({first, first + 1, first + 2});
}

void add_sphere(TriangleMesh& mesh, Point3f center, double radius) {
  constexpr int rings = 52, segments = 2 * rings;
  const auto point = [&](int ring, int segment) {
    const double theta = std::numbers::pi * ring / rings,
                 phi = 2 * std::numbers::pi * (segment % segments) / segments;
    const double s = ring % rings == 0 ? 0 : std::sin(theta);
    const double r = radius * (1 + 0.05 * s * std::sin(9 * theta) * std::sin(7 * phi));
    return center + cast<float>(Vector3d{r * s * std::cos(phi), r * s * std::sin(phi), r * std::cos(theta)});
  };
  for (int ring = 0; ring < rings; ++ring) {
    for (int segment = 0; segment < segments; ++segment) {
      const Point3f a = point(ring, segment), b = point(ring + 1, segment);
      const Point3f c = point(ring + 1, segment + 1), d = point(ring, segment + 1);
      if (ring + 1 < rings) add(mesh, a, b, c);
      if (ring > 0) add(mesh, a, c, d);
    }
  }
}

void add_doubled_grid(TriangleMesh& mesh, int axis) {
  constexpr int cells = 24;
  const auto point = [&](int i, int j) {
    Point3f p;
    p[(axis + 1) % 3] = static_cast<float>(i) / cells;
    p[(axis + 2) % 3] = static_cast<float>(j) / cells;
    return p;
  };
  for (int copy = 0; copy < 2; ++copy) {
    for (int i = -cells; i < cells; ++i) {
      for (int j = -cells; j < cells; ++j) {
        add(mesh, point(i, j), point(i + 1, j), point(i + 1, j + 1));
        add(mesh, point(i, j), point(i + 1, j + 1), point(i, j + 1));
      }
    }
  }
}

}  // namespace

TriangleMesh awkward_mesh(float size, Vector3f offset) {
  TriangleMesh mesh;
  for (int octant = 0; octant < 8; ++octant) {
    const auto half = [&](int bit) { return octant >> bit & 1 ? 0.5f : -0.5f; };
    add_sphere(mesh, {half(0), half(1), half(2)}, 0.4);
  }
  for (int axis = 0; axis < 3; ++axis) add_doubled_grid(mesh, axis);
  Random random;
  for (int i = 0; i < 24; ++i) add(mesh, random.point(1), random.point(1), random.point(1));
  for (int i = 0; i < 2000; ++i) {
    const Point3f p = random.point(0.9f);
    const Vector3f along = random.vector(i % 2 ? 0.1f : 0.9f);
    add(mesh, p, p + along, p + along * 0.4f + random.vector(i % 3 ? 1e-4f : 1e-6f));
  }
  for (Point3f& p : mesh.positions) p = Point3f{} + (p - Point3f{}) * size + offset;
  return mesh;
}

namespace {

struct RayMaker {
  const Triangles& triangles;
  std::span<const KdNode> interfaces;
  float size;
  Random random{};

  const Triangle& any_triangle() { return triangles[random.below(triangles.size())]; }
  Ray towards(Point3f target) {
    const Point3f origin = random.point(size * (random.below(8) ? 1.5f : 100.0f));
    return {origin, target - origin};
  }
  Ray from_afar() {
    const Point3f origin = random.point(size * 1e4f);
    return {origin, random.point(size) - origin};
  }
  Ray along_interface() {
    const KdNode& plane = interfaces[random.below(interfaces.size())];
    const int axis = static_cast<int>(plane.axis);
    Ray ray{random.point(size * 1.2f), random.vector(1)};
    const float away[] = {0, 0, 1e-7f, 1e-6f, 5e-6f};
    ray.origin[axis] = plane.split + random.uniform(1) * size * away[random.below(5)];
    const float lean[] = {0, 0, 1e-9f, 1e-6f};
    ray.direction[axis] = random.uniform(1) * lean[random.below(4)];
    return ray;
  }
  Ray through_edge() {
    const Triangle& t = any_triangle();
    const std::size_t corner = random.below(3);
    return towards(t[corner] + (t[(corner + 1) % 3] - t[corner]) * (random.uniform(0.5f) + 0.5f));
  }
  // Through the point where an interface cuts an edge; through some vertex where no cut edge is found.
  Ray through_cut() {
    for (int attempt = 0; attempt < 200; ++attempt) {
      const KdNode& plane = interfaces[random.below(interfaces.size())];
      const int axis = static_cast<int>(plane.axis);
      const Triangle& t = any_triangle();
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const Point3f a = t[corner], b = t[(corner + 1) % 3];
        if (!((a[axis] < plane.split && plane.split < b[axis]) ||
              (b[axis] < plane.split && plane.split < a[axis])))
          continue;
        Point3f target = a + (b - a) * ((plane.split - a[axis]) / (b[axis] - a[axis]));
        target[axis] = plane.split;
        return towards(target);
      }
    }
    return towards(any_triangle()[0]);
  }
  // From the coordinates of a vertex, so that it runs through edges and vertices exactly.
  Ray along_axis() {
    const int axis = static_cast<int>(random.below(3));
    Ray ray{any_triangle()[random.below(3)], {}};
    if (random.below(2)) ray.origin = ray.origin + random.vector(size * 0.01f);
    ray.origin[axis] = random.uniform(size * 1.5f);
    ray.direction[axis] = random.below(2) ? 1.0f : -1.0f;
    return ray;
  }
  Ray make(std::size_t i) {
    switch (i % 10) {
      case 0:
        return along_interface();
      case 1:
        return towards(any_triangle()[random.below(3)]);
      case 2:
        return through_edge();
      case 3:
        return through_cut();
      case 4:
        return along_axis();
      default:
        return random.below(8) ? Ray{random.point(size * 1.5f), random.vector(1)} : from_afar();
    }
  }
};

}  // namespace

std::vector<Ray> awkward_rays(const Triangles& triangles, std::span<const KdNode> interfaces,
                              std::size_t count) {
  RayMaker maker{triangles, interfaces, greatest_coordinate(triangles)};
  std::vector<Ray> rays;
  rays.reserve(count);
  while (rays.size() < count) {
    const Ray ray = maker.make(rays.size());
    if (ray.direction != Vector3f{}) rays.push_back(ray);
  }
  return rays;
}

}  // namespace vitrail::test
