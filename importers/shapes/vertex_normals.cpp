// SPDX-License-Identifier: Apache-2.0
#include "importers/shapes/vertex_normals.h"

#include <algorithm>
#include <cmath>

namespace vitrail {

namespace {

Vector3d winding_normal(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& t) {
  const Point3d a = cast<double>(mesh.positions[t[0]]);
  return cross(cast<double>(mesh.positions[t[1]]) - a, cast<double>(mesh.positions[t[2]]) - a);
}

}  // namespace

std::vector<Normal3f> smooth_normals(const TriangleMesh& mesh) {
  std::vector<Vector3d> sums(mesh.positions.size());
  for (const auto& t : mesh.triangles) {
    const Vector3d normal = normalize(winding_normal(mesh, t));
    for (std::size_t i = 0; i < 3; ++i) {
      const Point3d p = cast<double>(mesh.positions[t[i]]);
      const Vector3d a = cast<double>(mesh.positions[t[(i + 1) % 3]]) - p,
                     b = cast<double>(mesh.positions[t[(i + 2) % 3]]) - p;
      const double angle = std::atan2(length(cross(a, b)), dot(a, b));
      sums[t[i]] = sums[t[i]] + normal * angle;
    }
  }
  std::vector<Normal3f> normals;
  normals.reserve(sums.size());
  for (const Vector3d& sum : sums) {
    constexpr double cancelled = 1e-12;  // of angles of the order of 1
    normals.push_back(length(sum) > cancelled ? cast<float>(to_normal(normalize(sum))) : Normal3f{1, 0, 0});
  }
  return normals;
}

bool normals_oppose_winding(const TriangleMesh& mesh) {
  std::int64_t balance = 0;
  for (std::size_t i = 0; !mesh.normals.empty() && i < mesh.triangles.size(); ++i) {
    const auto& t = mesh.triangles[i];
    Vector3d sum;
    for (const std::uint32_t corner : t) sum = sum + to_vector(cast<double>(mesh.normals[corner]));
    const double side = dot(sum, winding_normal(mesh, t));
    balance += side > 0 ? 1 : side < 0 ? -1 : 0;
  }
  return balance < 0;
}

bool normals_lean(const TriangleMesh& mesh) {
  if (mesh.normals.empty()) return false;
  constexpr double cosine = 0.97;
  return std::ranges::any_of(mesh.triangles, [&](const std::array<std::uint32_t, 3>& t) {
    const Vector3d face = normalize(winding_normal(mesh, t));
    return std::ranges::any_of(t, [&](std::uint32_t v) {
      return std::abs(dot(normalize(to_vector(cast<double>(mesh.normals[v]))), face)) < cosine;
    });
  });
}

}  // namespace vitrail
