// SPDX-License-Identifier: Apache-2.0
#include "importers/shapes/creases.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <tuple>

#include "importers/shapes/vertex_normals.h"

namespace vitrail {

namespace {

// A corner of a triangle where others meet it.
struct Meeting {
  std::size_t triangle, corner;
  Vector3d face;      // unit normal
  Vector3d weighted;  // by the angle of the corner
};

using Place = std::tuple<float, float, float, float, float>;  // position, (u,v)

Place place_of(const TriangleMesh& mesh, std::uint32_t vertex) {
  const Point3f& p = mesh.positions[vertex];
  const Point2f uv = mesh.uvs.empty() ? Point2f{} : mesh.uvs[vertex];
  return {p.x, p.y, p.z, uv.x, uv.y};
}

void append_vertex(const TriangleMesh& from, std::uint32_t vertex, TriangleMesh& to) {
  to.positions.push_back(from.positions[vertex]);
  if (!from.uvs.empty()) to.uvs.push_back(from.uvs[vertex]);
  for (std::size_t i = 0; i < from.attributes.size(); ++i) {
    const MeshAttribute& attribute = from.attributes[i];
    const auto width = static_cast<std::size_t>(attribute.channels);
    for (std::size_t k = 0; k < width && !attribute.per_face; ++k)
      to.attributes[i].values.push_back(attribute.values[width * vertex + k]);
  }
}

std::map<Place, std::vector<Meeting>> meetings_of(const TriangleMesh& mesh) {
  std::map<Place, std::vector<Meeting>> meetings;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& t = mesh.triangles[i];
    const std::array<Point3d, 3> corners{cast<double>(mesh.positions[t[0]]),
                                         cast<double>(mesh.positions[t[1]]),
                                         cast<double>(mesh.positions[t[2]])};
    const Vector3d face = normalize(cross(corners[1] - corners[0], corners[2] - corners[0]));
    const auto weighted = angle_weighted_normals(corners);
    for (std::size_t k = 0; k < 3; ++k) meetings[place_of(mesh, t[k])].push_back({i, k, face, weighted[k]});
  }
  return meetings;
}

}  // namespace

TriangleMesh with_creases(const TriangleMesh& mesh, double most_angle_rad) {
  const double least_cosine = std::cos(most_angle_rad);
  TriangleMesh made;
  made.missing_uv = mesh.missing_uv;
  made.triangles = mesh.triangles;
  made.attributes = mesh.attributes;
  for (MeshAttribute& attribute : made.attributes)
    if (!attribute.per_face) attribute.values.clear();
  for (auto& [place, left] : meetings_of(mesh)) {
    while (!left.empty()) {
      const auto is_apart = [&, first = left.front().face](const Meeting& m) {
        return dot(m.face, m.face) > 0 && !(dot(m.face, first) > least_cosine);
      };
      const auto apart = std::stable_partition(left.begin() + 1, left.end(), std::not_fn(is_apart));
      Vector3d sum;
      const auto vertex = static_cast<std::uint32_t>(made.positions.size());
      const auto& [triangle, corner, face, weighted] = left.front();
      append_vertex(mesh, mesh.triangles[triangle][corner], made);
      for (auto m = left.begin(); m != apart; ++m) {
        sum = sum + m->weighted;
        made.triangles[m->triangle][m->corner] = vertex;
      }
      made.normals.push_back(unit_normal(sum));
      left.erase(left.begin(), apart);
    }
  }
  return made;
}

}  // namespace vitrail
