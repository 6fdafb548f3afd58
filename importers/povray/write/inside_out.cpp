// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "importers/povray/write/write_meshes.h"
#include "importers/writing/placed_quadric.h"

namespace vitrail::povray {

namespace {

// The area vectors of a closed surface cancel: ∮ n dA = 0, up to this share of the area.
constexpr double most_open = 1e-3;
// A pane of 1 m² that is thinner than some micrometres has no inside.
constexpr double least_volume = 1e-6;

}  // namespace

bool is_inside_out(const MeshText& text) {
  const TriangleMesh& mesh = text.mesh;
  if (mesh.quadric)
    return mesh.quadric->kind == QuadricKind::sphere && is_whole(*mesh.quadric) &&
           text.flip != swaps_handedness(text.to_pov);
  if (mesh.triangles.empty()) return false;
  const auto position = [&](std::uint32_t i) {
    return transform_point(text.to_pov, cast<double>(mesh.positions[i]));
  };
  const Point3d origin = position(mesh.triangles[0][0]);
  Vector3d sum{};
  double area = 0, volume = 0;  // twice the area, six times the volume: ∮ p·n dA = 3 V
  for (const auto& t : mesh.triangles) {
    const Point3d a = position(t[0]);
    const Vector3d normal = cross(position(t[1]) - a, position(t[2]) - a);
    sum = sum + normal;
    area += length(normal);
    volume += dot(a - origin, normal);
  }
  const double outwards = text.flip ? -volume : volume;
  return length(sum) < most_open * area && outwards < -least_volume * std::pow(area, 1.5);
}

}  // namespace vitrail::povray
