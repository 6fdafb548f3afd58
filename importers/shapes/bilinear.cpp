// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "importers/shapes/polygon.h"
#include "importers/shapes/shapes.h"

namespace vitrail {

namespace {

using Patch = std::array<std::uint32_t, 4>;
using Corners = std::array<Point3d, 4>;  // at (u,v) = (0,0), (1,0), (0,1), (1,1)

constexpr double planar_tolerance = 1e-6;   // of the longer diagonal
constexpr double surface_tolerance = 2e-4;  // of the longer diagonal
constexpr double most_cells = 4e6;
constexpr int most_cells_a_side = 64;

Corners corners_of(const std::vector<Point3f>& positions, const Patch& patch) {
  Corners p;
  for (std::size_t i = 0; i < 4; ++i) p[i] = cast<double>(positions[patch[i]]);
  return p;
}

// In units of the patch's longer diagonal: how far its corners are from lying in a plane, and the greatest
// distance of the patch from its two triangles. With n×n cells that falls to 1/n².
struct Curvature {
  double out_of_plane, distance;
};

Curvature curvature(const Corners& p) {
  const Vector3d normal = normalize(cross(p[3] - p[0], p[2] - p[1]));
  const Vector3d twist = (p[3] - p[1]) - (p[2] - p[0]);
  const double diagonal = std::max(length(p[3] - p[0]), length(p[2] - p[1]));
  if (diagonal == 0) return {0, 0};
  return {std::abs(dot(twist, normal)) / (4 * diagonal), length(twist) / (4 * diagonal)};
}

// Weights of the four corners at (i/n, j/n). Along an edge they are the same numbers from either end, so that
// patches which share it agree on its points bit for bit.
std::array<double, 4> weights(int i, int j, int n) {
  const double u = static_cast<double>(i) / n, v = static_cast<double>(j) / n;
  const double s = static_cast<double>(n - i) / n, t = static_cast<double>(n - j) / n;
  return {s * t, u * t, s * v, u * v};
}

Vector3d normal_at(const Corners& p, const std::array<double, 4>& w) {
  const Vector3d du = (p[1] - p[0]) * (w[0] + w[1]) + (p[3] - p[2]) * (w[2] + w[3]);
  const Vector3d dv = (p[2] - p[0]) * (w[0] + w[2]) + (p[3] - p[1]) * (w[1] + w[3]);
  const Vector3d normal = cross(du, dv);
  return normalize(dot(normal, normal) > 0 ? normal : cross(p[3] - p[0], p[2] - p[1]));
}

template <class T>
std::array<T, 4> pick(const std::vector<T>& values, const Patch& patch) {
  return {values[patch[0]], values[patch[1]], values[patch[2]], values[patch[3]]};
}

void append_vertex(TriangleMesh& mesh, const Corners& p, const std::array<double, 4>& w, const Patch& patch,
                   const std::vector<Normal3f>& normals, const std::vector<Point2f>& uvs) {
  const auto mix = [&](auto component) {
    return static_cast<float>(w[0] * component(0u) + w[1] * component(1u) + w[2] * component(2u) +
                              w[3] * component(3u));
  };
  mesh.positions.push_back({mix([&](std::size_t i) { return p[i].x; }),
                            mix([&](std::size_t i) { return p[i].y; }),
                            mix([&](std::size_t i) { return p[i].z; })});
  if (normals.empty()) {
    mesh.normals.push_back(cast<float>(to_normal(normal_at(p, w))));
  } else {
    const auto n = pick(normals, patch);
    const Vector3f mixed{mix([&](std::size_t i) { return n[i].x; }),
                         mix([&](std::size_t i) { return n[i].y; }),
                         mix([&](std::size_t i) { return n[i].z; })};
    mesh.normals.push_back(to_normal(normalize(mixed)));
  }
  if (!uvs.empty()) {
    const auto q = pick(uvs, patch);
    mesh.uvs.push_back(
        {mix([&](std::size_t i) { return q[i].x; }), mix([&](std::size_t i) { return q[i].y; })});
  }
}

void append_grid(TriangleMesh& mesh, const Corners& p, const Patch& patch, int n,
                 const std::vector<Normal3f>& normals, const std::vector<Point2f>& uvs) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  const auto side = static_cast<std::uint32_t>(n);
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) append_vertex(mesh, p, weights(i, j, n), patch, normals, uvs);
  }
  for (std::uint32_t j = 0; j < side; ++j) {
    for (std::uint32_t i = 0; i < side; ++i) {
      const std::uint32_t at = first + j * (side + 1) + i, above = at + side + 1;
      mesh.triangles.push_back({at, at + 1, above + 1});
      mesh.triangles.push_back({at, above + 1, above});
    }
  }
}

TriangleMesh flat_mesh(const std::vector<Point3f>& positions, const std::vector<Patch>& patches,
                       const std::vector<Normal3f>& normals, const std::vector<Point2f>& uvs) {
  TriangleMesh mesh{positions, {}, normals, uvs};
  std::vector<CornerTriple> cut;
  for (const Patch& patch : patches) {
    const Corners p = corners_of(positions, patch);
    const Corners around{p[0], p[1], p[3], p[2]};
    const Patch indices{patch[0], patch[1], patch[3], patch[2]};
    cut.clear();
    triangulate_polygon(around, cut);
    for (const CornerTriple& t : cut) mesh.triangles.push_back({indices[t[0]], indices[t[1]], indices[t[2]]});
  }
  return mesh;
}

}  // namespace

TriangleMesh tessellate_bilinear(const std::vector<Point3f>& positions, const std::vector<Patch>& patches,
                                 const std::vector<Normal3f>& normals, const std::vector<Point2f>& uvs) {
  for (const Point3f& p : positions) {
    if (!is_finite(p)) throw Error("bilinear mesh: a vertex is not finite");
  }
  if ((!normals.empty() && normals.size() != positions.size()) ||
      (!uvs.empty() && uvs.size() != positions.size())) {
    throw Error("bilinear mesh: normals and uvs have to be as many as the vertices");
  }
  Curvature most{0, 0};
  for (const Patch& patch : patches) {
    for (const std::uint32_t index : patch) {
      if (index >= positions.size()) throw Error("bilinear mesh: an index is beyond the vertices");
    }
    const Curvature c = curvature(corners_of(positions, patch));
    most = {std::max(most.out_of_plane, c.out_of_plane), std::max(most.distance, c.distance)};
  }
  if (most.out_of_plane <= planar_tolerance) return flat_mesh(positions, patches, normals, uvs);
  const double wanted =
      std::min<double>(std::ceil(std::sqrt(most.distance / surface_tolerance)), most_cells_a_side);
  const double affordable = std::floor(std::sqrt(most_cells / static_cast<double>(patches.size())));
  const int n = static_cast<int>(std::max(1.0, std::min(wanted, affordable)));
  TriangleMesh mesh;
  for (const Patch& patch : patches) append_grid(mesh, corners_of(positions, patch), patch, n, normals, uvs);
  return mesh;
}

}  // namespace vitrail
