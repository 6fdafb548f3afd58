// SPDX-License-Identifier: Apache-2.0
#include "partitioner/meshes/subdivide.h"

#include <algorithm>
#include <limits>
#include <span>

#include "partitioner/meshes/surface.h"

namespace vitrail {

namespace {

// What a vertex has beside its position and normal, as a row of numbers: uv, then attributes.
std::size_t row_length(const TriangleMesh& mesh) {
  std::size_t length = mesh.uvs.empty() ? 0 : 2;
  for (const MeshAttribute& a : mesh.attributes)
    if (!a.per_face) length += static_cast<std::size_t>(a.channels);
  return length;
}

std::vector<float> rows_of(const TriangleMesh& mesh) {
  std::vector<float> rows;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    if (!mesh.uvs.empty()) rows.insert(rows.end(), {mesh.uvs[v].x, mesh.uvs[v].y});
    for (const MeshAttribute& a : mesh.attributes) {
      if (a.per_face) continue;
      const auto first = a.values.begin() + static_cast<std::ptrdiff_t>(v) * a.channels;
      rows.insert(rows.end(), first, first + a.channels);
    }
  }
  return rows;
}

void set_rows(TriangleMesh& mesh, bool has_uvs, const std::vector<float>& rows) {
  auto next = rows.begin();
  while (next != rows.end()) {
    if (has_uvs) {
      mesh.uvs.push_back({next[0], next[1]});
      next += 2;
    }
    for (MeshAttribute& a : mesh.attributes)
      if (!a.per_face) {
        a.values.insert(a.values.end(), next, next + a.channels);
        next += a.channels;
      }
  }
}

// The vertices of a smooth surface, doubled where rows differ.
class Vertices {
 public:
  Vertices(const TriangleMesh& smooth, std::size_t row) : smooth_(smooth), row_(row) {
    first_.assign(smooth.positions.size(), none);
  }

  std::uint32_t find_or_add(std::uint32_t v, const std::vector<float>& row) {
    for (std::uint32_t u = first_[v]; u != none; u = next_[u])
      if (std::ranges::equal(row, std::span(rows).subspan(u * row_, row_))) return u;
    const auto u = static_cast<std::uint32_t>(positions.size());
    positions.push_back(smooth_.positions[v]);
    normals.push_back(smooth_.normals[v]);
    rows.insert(rows.end(), row.begin(), row.end());
    next_.push_back(first_[v]);
    return first_[v] = u;
  }

  std::vector<Point3f> positions;
  std::vector<Normal3f> normals;
  std::vector<float> rows;

 private:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  const TriangleMesh& smooth_;
  std::size_t row_;
  std::vector<std::uint32_t> first_, next_;  // chains of the copies of a vertex
};

std::vector<float> blend(const std::vector<float>& rows, std::size_t length, const Triangle& t, Point2d at) {
  std::vector<float> row(length);
  for (std::size_t i = 0; i < length; ++i) {
    const auto value = [&](std::size_t k) { return static_cast<double>(rows[t[k] * length + i]); };
    row[i] = static_cast<float>((1 - at.x - at.y) * value(0) + at.x * value(1) + at.y * value(2));
  }
  return row;
}

}  // namespace

SubdividedMesh subdivide(const TriangleMesh& mesh, int levels, const Subdivision& scheme) {
  const MeshSurface surface = surface_of(mesh);
  TriangleMesh cage;
  for (const std::uint32_t p : surface.points) cage.positions.push_back(mesh.positions[p]);
  cage.triangles = surface.triangles;
  std::vector<std::array<Point2d, 3>> corners;
  const TriangleMesh smooth = scheme(cage, levels, corners);

  SubdividedMesh result{{}, mesh.triangles.size() - surface.triangles.size(), surface.is_manifold()};
  for (const MeshAttribute& a : mesh.attributes)
    result.mesh.attributes.push_back({a.name, a.per_face, a.channels, {}});
  const std::size_t length = row_length(mesh);
  const std::vector<float> rows = rows_of(mesh);
  Vertices vertices(smooth, length);
  for (std::size_t i = 0; i < smooth.triangles.size(); ++i) {
    const std::size_t parent = i >> (2 * levels);
    Triangle& t = result.mesh.triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k)
      t[k] = vertices.find_or_add(smooth.triangles[i][k],
                                  blend(rows, length, surface.wedges[parent], corners[i][k]));
    for (std::size_t a = 0; a < mesh.attributes.size(); ++a)
      if (const MeshAttribute& from = mesh.attributes[a]; from.per_face) {
        const auto first =
            from.values.begin() + static_cast<std::ptrdiff_t>(surface.sources[parent]) * from.channels;
        auto& values = result.mesh.attributes[a].values;
        values.insert(values.end(), first, first + from.channels);
      }
  }
  result.mesh.positions = std::move(vertices.positions);
  result.mesh.normals = std::move(vertices.normals);
  set_rows(result.mesh, !mesh.uvs.empty(), vertices.rows);
  return result;
}

}  // namespace vitrail
