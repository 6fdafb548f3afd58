// SPDX-License-Identifier: Apache-2.0
#include "importers/gltf/read/tangents.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace vitrail::gltf {

namespace {

struct Axes {
  Vector3d du, up;  // ∂p/∂u and −∂p/∂v, times the area of the triangle in (u,v)
  Vector3d normal;  // of the shading, or of the face; not of unit length
  double area = 0;
};

Vector3d vector_of(Point3f p) {
  return {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)};
}

Axes axes_of(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& t) {
  const Vector3d a = vector_of(mesh.positions[t[0]]), e1 = vector_of(mesh.positions[t[1]]) - a,
                 e2 = vector_of(mesh.positions[t[2]]) - a;
  const Point2f o = mesh.uvs[t[0]], b = mesh.uvs[t[1]], c = mesh.uvs[t[2]];
  const double u1 = static_cast<double>(b.x) - static_cast<double>(o.x),
               v1 = static_cast<double>(b.y) - static_cast<double>(o.y),
               u2 = static_cast<double>(c.x) - static_cast<double>(o.x),
               v2 = static_cast<double>(c.y) - static_cast<double>(o.y);
  const double sign = u1 * v2 - u2 * v1 < 0 ? -1 : 1;
  Axes axes{(e1 * v2 - e2 * v1) * sign, (e1 * u2 - e2 * u1) * sign, cross(e1, e2), 0};
  axes.area = length(axes.normal) / 2;
  if (mesh.normals.empty()) return axes;
  Vector3d sum{0, 0, 0};
  for (const std::uint32_t corner : t) sum = sum + to_vector(cast<double>(mesh.normals[corner]));
  if (dot(sum, sum) > 0) axes.normal = sum;
  return axes;
}

}  // namespace

SidesOfUv sides_of_uv(const TriangleMesh& mesh, const std::vector<float>& tangents) {
  SidesOfUv sides;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& t = mesh.triangles[i];
    bool is_mirrored = false;
    if (!tangents.empty()) {
      is_mirrored = tangents[4 * std::size_t{t[0]} + 3] < 0;
    } else {
      const Axes axes = axes_of(mesh, t);
      is_mirrored = dot(cross(axes.normal, axes.du), axes.up) < 0;
    }
    (is_mirrored ? sides.mirrored : sides.straight).push_back(i);
  }
  return sides;
}

double turn_of_tangents_deg(const TriangleMesh& mesh, const std::vector<float>& tangents) {
  double sum = 0, area = 0;
  for (const auto& t : mesh.triangles) {
    const Axes axes = axes_of(mesh, t);
    Vector3d tangent{0, 0, 0};
    for (const std::uint32_t corner : t) {
      const float* v = &tangents[4 * std::size_t{corner}];
      tangent =
          tangent + Vector3d{static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
    }
    const double lengths = length(axes.du) * length(tangent);
    if (!(lengths > 0)) continue;
    sum += axes.area * std::acos(std::clamp(dot(axes.du, tangent) / lengths, -1.0, 1.0));
    area += axes.area;
  }
  return area > 0 ? sum / area * 180 / std::numbers::pi : 0;
}

}  // namespace vitrail::gltf
