// SPDX-License-Identifier: Apache-2.0
#include "importers/gltf/read/tangents.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace vitrail::gltf {

namespace {

using Triangle = std::array<std::uint32_t, 3>;

Vector3d vector_of(Point3f p) {
  return {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)};
}

// ∂p/∂u of any length, and the area.
struct AlongU {
  Vector3d du;
  double area = 0;
};

AlongU along_u(const TriangleMesh& mesh, const Triangle& t) {
  const Vector3d a = vector_of(mesh.positions[t[0]]), e1 = vector_of(mesh.positions[t[1]]) - a,
                 e2 = vector_of(mesh.positions[t[2]]) - a;
  const Point2f o = mesh.uvs[t[0]], b = mesh.uvs[t[1]], c = mesh.uvs[t[2]];
  const double u1 = static_cast<double>(b.x) - static_cast<double>(o.x),
               v1 = static_cast<double>(b.y) - static_cast<double>(o.y),
               u2 = static_cast<double>(c.x) - static_cast<double>(o.x),
               v2 = static_cast<double>(c.y) - static_cast<double>(o.y);
  const double sign = u1 * v2 - u2 * v1 < 0 ? -1 : 1;
  return {(e1 * v2 - e2 * v1) * sign, length(cross(e1, e2)) / 2};
}

Vector3d tangent_of(const Triangle& t, const std::vector<float>& tangents) {
  Vector3d sum{0, 0, 0};
  for (const std::uint32_t corner : t) {
    const float* v = &tangents[4 * std::size_t{corner}];
    sum = sum + Vector3d{static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
  }
  return sum;
}

}  // namespace

std::vector<UvPart> parts_by_tangents(const TriangleMesh& mesh, const std::vector<float>& tangents) {
  std::array<UvPart, 4> all;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const Triangle& t = mesh.triangles[i];
    const bool back = dot(along_u(mesh, t).du, tangent_of(t, tangents)) < 0,
               over = (tangents[4 * std::size_t{t[0]} + 3] < 0) != back;
    UvPart& part = all[(back ? 1 : 0) + (over ? 2 : 0)];
    part.against = {back, over};
    part.triangles.push_back(i);
  }
  std::vector<UvPart> parts;
  for (UvPart& part : all)
    if (!part.triangles.empty()) parts.push_back(std::move(part));
  return parts;
}

double turn_of_tangents_deg(const TriangleMesh& mesh, const std::vector<float>& tangents) {
  double sum = 0, area = 0;
  for (const Triangle& t : mesh.triangles) {
    const AlongU u = along_u(mesh, t);
    const Vector3d tangent = tangent_of(t, tangents);
    const double lengths = length(u.du) * length(tangent);
    if (!(lengths > 0)) continue;
    sum += u.area * std::acos(std::min(std::abs(dot(u.du, tangent)) / lengths, 1.0));
    area += u.area;
  }
  return area > 0 ? sum / area * 180 / std::numbers::pi : 0;
}

}  // namespace vitrail::gltf
