// SPDX-License-Identifier: Apache-2.0
#include "partitioner/placing/wedged_panes.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "partitioner/appearance/requirements.h"
#include "partitioner/placing/decimals.h"
#include "scene/shapes/deferred_mesh.h"

namespace vitrail {

namespace {

constexpr double one_way_rad = 0.03;        // of the normals of one side
constexpr double float_glass_rad = 1.2e-4;  // as the tracer's, of both faces

std::vector<Vector3d> doubled_areas(const TriangleMesh& mesh, const Transform& placed) {
  std::vector<Vector3d> areas;
  areas.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    const auto corner = [&](std::size_t k) {
      return transform_point(placed, cast<double>(mesh.positions[t[k]]));
    };
    areas.push_back(cross(corner(1) - corner(0), corner(2) - corner(0)));
  }
  return areas;
}

// Both sides turned by decimals that move every vertex by half a step, over the least height that a triangle
// of the largest one's area and a square's shape has.
double explained(const TriangleMesh& mesh, const Transform& placed, double largest) {
  const double stretch = std::cbrt(std::abs(determinant3(placed)));
  const double off = decimal_step(mesh.positions) / 2 * std::sqrt(3.0) * stretch;
  return 2 * off * (2 + std::sqrt(2.0)) / std::sqrt(largest);
}

}  // namespace

std::optional<PaneFaces> pane_faces(const TriangleMesh& mesh, const Transform& placed) {
  const std::vector<Vector3d> areas = doubled_areas(mesh, placed);
  double all = 0;
  Vector3d largest{};
  for (const Vector3d& a : areas) {
    all += length(a);
    if (length(a) > length(largest)) largest = a;
  }
  if (!(all > 0)) return std::nullopt;
  const Vector3d way = normalize(largest);
  Vector3d front{}, back{};
  for (const Vector3d& a : areas) {
    if (length(cross(a, way)) > one_way_rad * length(a)) continue;
    Vector3d& side = dot(a, way) > 0 ? front : back;
    side = side + a;
  }
  const double f = length(front), b = length(back);
  if (f + b < 0.5 * all || std::min(f, b) < 0.5 * std::max(f, b)) return std::nullopt;
  return PaneFaces{length(cross(front, back)) / (f * b), explained(mesh, placed, length(largest))};
}

WedgedPanes wedged_panes(const Scene& scene) {
  WedgedPanes found;
  const auto look_at = [&](const Shape& shape) {
    const TriangleMesh& mesh = scene.meshes.at(shape.mesh.value);
    if (!is_smooth_glass(scene.materials.at(shape.material.value)) || mesh.quadric) return;
    TriangleMesh storage;
    const auto faces = pane_faces(loaded(mesh, storage), shape.object_to_world);
    if (!faces || faces->wedge_rad <= std::max(float_glass_rad, faces->explained_rad)) return;
    ++found.count;
    if (faces->wedge_rad < found.widest_rad) return;
    found.widest_rad = faces->wedge_rad;
    found.widest = shape.origin;
  };
  for (const Shape& shape : scene.shapes) look_at(shape);
  for (const Prototype& prototype : scene.prototypes)
    for (const Shape& shape : prototype.shapes) look_at(shape);
  return found;
}

}  // namespace vitrail
