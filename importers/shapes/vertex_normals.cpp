// SPDX-License-Identifier: Apache-2.0
#include "importers/shapes/vertex_normals.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vitrail {

namespace {

Vector3d winding_normal(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& t) {
  const Point3d a = cast<double>(mesh.positions[t[0]]);
  return cross(cast<double>(mesh.positions[t[1]]) - a, cast<double>(mesh.positions[t[2]]) - a);
}

}  // namespace

std::array<Vector3d, 3> angle_weighted_normals(const std::array<Point3d, 3>& corners) {
  const Vector3d area = cross(corners[1] - corners[0], corners[2] - corners[0]);
  if (!(length(area) > 0)) return {};
  const Vector3d normal = normalize(area);
  std::array<Vector3d, 3> weighted;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3d a = corners[(i + 1) % 3] - corners[i], b = corners[(i + 2) % 3] - corners[i];
    weighted[i] = normal * std::atan2(length(cross(a, b)), dot(a, b));
  }
  return weighted;
}

Normal3f unit_normal(const Vector3d& sum) {
  constexpr double cancelled = 1e-12;  // of angles of the order of 1
  return length(sum) > cancelled ? cast<float>(to_normal(normalize(sum))) : Normal3f{1, 0, 0};
}

std::vector<Normal3f> smooth_normals(const TriangleMesh& mesh) {
  std::vector<Vector3d> sums(mesh.positions.size());
  const auto position = [&](std::uint32_t vertex) { return cast<double>(mesh.positions[vertex]); };
  for (const auto& t : mesh.triangles) {
    const auto normals = angle_weighted_normals({position(t[0]), position(t[1]), position(t[2])});
    for (std::size_t i = 0; i < 3; ++i) sums[t[i]] = sums[t[i]] + normals[i];
  }
  std::vector<Normal3f> normals;
  normals.reserve(sums.size());
  for (const Vector3d& sum : sums) normals.push_back(unit_normal(sum));
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

bool normals_lean(const TriangleMesh& mesh, double degrees) {
  if (mesh.normals.empty()) return false;
  const double cosine = std::cos(degrees * std::numbers::pi / 180);
  return std::ranges::any_of(mesh.triangles, [&](const std::array<std::uint32_t, 3>& t) {
    const Vector3d face = normalize(winding_normal(mesh, t));
    return std::ranges::any_of(t, [&](std::uint32_t v) {
      return std::abs(dot(normalize(to_vector(cast<double>(mesh.normals[v]))), face)) < cosine;
    });
  });
}

}  // namespace vitrail
