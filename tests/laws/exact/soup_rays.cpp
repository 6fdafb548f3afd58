// SPDX-License-Identifier: Apache-2.0
#include "tests/laws/exact/soup_rays.h"

#include <limits>

namespace vitrail::test {

namespace {

bool is_fine(const Ray& r) {
  const Vector3f& d = r.direction;
  return std::max({std::abs(r.origin.x), std::abs(r.origin.y), std::abs(r.origin.z)}) < 1e18f &&
         is_finite(Point3f{} + d) && d != Vector3f{};
}

struct RayMaker {
  const Triangles& triangles;
  std::span<const KdNode> interfaces;
  double reach;
  SoupRandom& random;

  std::uint32_t any_id() { return static_cast<std::uint32_t>(random.below(triangles.size())); }
  const Triangle& any_triangle() { return triangles[any_id()]; }
  Point3f any_vertex() { return any_triangle()[random.below(3)]; }
  Vector3f any_direction() { return cast<float>(random.vector(1)); }
  // About a vertex, at a distance between that of neighbours and of all.
  Point3f any_origin() {
    return cast<float>(cast<double>(any_vertex()) + random.vector(reach * random.log_uniform(1e-4, 4)));
  }
  Point3f on(const Triangle& t) {
    double u = random.unit(), v = random.unit();
    if (u + v > 1) u = 1 - u, v = 1 - v;
    if (random.chance(0.3)) v = 0;
    const Point3d a = cast<double>(t[0]);
    return cast<float>(a + (cast<double>(t[1]) - a) * u + (cast<double>(t[2]) - a) * v);
  }
  Ray towards(Point3f target, Point3f origin) { return {origin, target - origin}; }
  // Of a direction that floats have, whose multiple the way to the target is.
  Ray exactly_towards(Point3f target) {
    Vector3f d;
    for (int axis = 0; axis < 3; ++axis)
      d[axis] = static_cast<float>(reach * std::exp2(-5) * (static_cast<double>(random.below(9)) - 4));
    return {target - d, d};
  }

  Ray anywhere() { return {any_origin(), any_direction()}; }
  Ray through_vertex() {
    const Point3f target = any_vertex();
    return random.chance(0.5) ? exactly_towards(target) : towards(target, any_origin());
  }
  Ray through_edge() {
    const Triangle& t = any_triangle();
    const std::size_t k = random.below(3);
    const Point3d a = cast<double>(t[k]), b = cast<double>(t[(k + 1) % 3]);
    return towards(cast<float>(a + (b - a) * (random.chance(0.3) ? 0.5 : random.unit())), any_origin());
  }
  Ray through_triangle() { return towards(on(any_triangle()), any_origin()); }
  // A point where an interface cuts an edge; a vertex where none is found.
  Point3f any_cut_point() {
    for (int attempt = 0; attempt < 20 && !interfaces.empty(); ++attempt) {
      const KdNode& plane = interfaces[random.below(interfaces.size())];
      const auto axis = static_cast<int>(plane.axis);
      const Triangle& t = any_triangle();
      for (std::size_t k = 0; k < 3; ++k) {
        const Point3d a = cast<double>(t[k]), b = cast<double>(t[(k + 1) % 3]);
        if ((a[axis] < plane.split) == (b[axis] < plane.split)) continue;
        Point3f p = cast<float>(a + (b - a) * ((plane.split - a[axis]) / (b[axis] - a[axis])));
        p[axis] = plane.split;
        return p;
      }
    }
    return any_vertex();
  }
  Ray through_cut() { return towards(any_cut_point(), any_origin()); }
  Ray from_cut() {
    const Point3f p = any_cut_point();
    return random.chance(0.5) ? Ray{p, any_direction()} : towards(any_vertex(), p);
  }
  // In an interface or within some ε of it.
  Ray along_interface() {
    if (interfaces.empty()) return anywhere();
    const KdNode& plane = interfaces[random.below(interfaces.size())];
    const auto axis = static_cast<int>(plane.axis);
    Ray ray = random.chance(0.5) ? anywhere() : towards(any_vertex(), any_origin());
    const double m = std::max(reach, double{std::abs(plane.split)});
    ray.origin[axis] = static_cast<float>(
        plane.split + random.sign() * m * (random.chance(0.5) ? 0 : random.log_uniform(1e-8, 1e-5)));
    ray.direction[axis] =
        random.chance(0.5) ? 0 : static_cast<float>(random.sign() * random.log_uniform(1e-20, 1e-4));
    return ray;
  }
  // From the coordinates of a vertex.
  Ray along_axis() {
    const auto axis = static_cast<int>(random.below(3));
    Ray ray{random.chance(0.5) ? any_vertex() : on(any_triangle()), {}};
    if (!interfaces.empty() && random.chance(0.3)) {
      const KdNode& plane = interfaces[random.below(interfaces.size())];
      ray.origin[static_cast<int>(plane.axis)] = plane.split;
    }
    ray.origin[axis] = any_origin()[axis];
    ray.direction[axis] = static_cast<float>(random.sign());
    return ray;
  }
  Ray off_triangle() {
    const std::uint32_t id = any_id();
    const Point3f p = on(triangles[id]);
    Ray ray = random.chance(0.5) ? Ray{p, any_direction()}
                                 : towards(random.chance(0.5) ? any_vertex() : on(any_triangle()), p);
    ray.exclude = id;
    return ray;
  }
  Ray from_vertex() { return {any_vertex(), any_direction()}; }
  Ray grazing() {
    const Triangle& t = any_triangle();
    const Point3d a = cast<double>(t[0]);
    const Vector3d e = cast<double>(t[1]) - a, f = cast<double>(t[2]) - a;
    Vector3d n = cross(e, f);
    const double l = length(n), size = length(e) + length(f);
    if (l > 0) n = n * (size / l);
    const Vector3d d = e * random.uniform(-1, 1) + f * random.uniform(-1, 1) +
                       n * (random.chance(0.3) ? 0 : random.sign() * random.log_uniform(1e-12, 1e-2));
    const Point3f target = on(t);
    return {cast<float>(cast<double>(target) - d * random.log_uniform(0.1, 1000)), cast<float>(d)};
  }
  Ray from_afar() {
    const double most = random.chance(0.9) ? 1e7 : 1e13;
    const Point3d target = cast<double>(random.chance(0.5) ? any_vertex() : on(any_triangle()));
    Point3d origin = target + random.vector(reach * random.log_uniform(10, most));
    const auto axis = static_cast<int>(random.below(3));
    if (random.chance(0.3)) origin[axis] = target[axis];
    if (random.chance(0.1)) origin[(axis + 1) % 3] = target[(axis + 1) % 3];
    return {cast<float>(origin), cast<float>(target - origin)};
  }

  Ray make() {
    using Way = Ray (RayMaker::*)();
    static constexpr Way ways[] = {
        &RayMaker::anywhere,         &RayMaker::through_vertex,   &RayMaker::through_edge,
        &RayMaker::through_triangle, &RayMaker::through_triangle, &RayMaker::through_cut,
        &RayMaker::from_cut,         &RayMaker::along_interface,  &RayMaker::along_axis,
        &RayMaker::off_triangle,     &RayMaker::off_triangle,     &RayMaker::from_vertex,
        &RayMaker::grazing,          &RayMaker::from_afar};
    Ray ray = (this->*ways[random.below(std::size(ways))])();
    if (random.chance(0.3)) ray.direction = ray.direction * (1 / length(ray.direction));
    if (random.chance(0.05)) {
      constexpr float small[] = {0, -0.0f, 1e-45f, -1e-38f, 1e-30f, -1e-19f, 1e-18f, 1e-12f};
      ray.direction[static_cast<int>(random.below(3))] = small[random.below(std::size(small))];
    }
    if (random.chance(0.05))
      ray.direction = ray.direction * static_cast<float>(random.log_uniform(1e-30, 1e30));
    return ray;
  }
};

}  // namespace

std::vector<Ray> rays_for(const Triangles& triangles, std::span<const KdNode> interfaces, double reach,
                          SoupRandom& random, std::size_t count) {
  std::vector<Ray> rays;
  if (triangles.empty()) return {{{}, {1, 2, 3}}};
  RayMaker maker{triangles, interfaces, reach, random};
  while (rays.size() < count) {
    Ray ray = maker.make();
    if (!is_fine(ray)) ray = {ray.origin, {0, 0, 1}, ray.exclude};
    if (is_fine(ray)) rays.push_back(ray);
  }
  return rays;
}

}  // namespace vitrail::test
