// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "importers/shapes/polygon.h"
#include "importers/shapes/shapes.h"
#include "scene/geometry/bounds.h"

namespace vitrail {

namespace {

using Patch = std::array<std::uint32_t, 4>;
using Corners = std::array<Point3d, 4>;  // at (u,v) = (0,0), (1,0), (0,1), (1,1)
constexpr std::array<Point2f, 4> unit_square{{{0, 0}, {1, 0}, {0, 1}, {1, 1}}};

constexpr double planar_tolerance = 1e-6;  // of the longer diagonal
constexpr double bend_tolerance = 1e-4;    // likewise: its normals turn by a thousandth then
// How far triangles may be from their patch: of its longer diagonal, or of half the mesh's.
constexpr double patch_tolerance = 2e-4, mesh_tolerance = 2e-5;
constexpr double most_cells = 4e6;
constexpr int most_cells_a_side = 64;

Corners corners_of(const std::vector<Point3f>& positions, const Patch& patch) {
  Corners p;
  for (std::size_t i = 0; i < 4; ++i) p[i] = cast<double>(positions[patch[i]]);
  return p;
}

double greatest_coordinate(const Corners& p) {
  double greatest = 0;
  for (const Point3d& q : p) greatest = std::max({greatest, std::abs(q.x), std::abs(q.y), std::abs(q.z)});
  return greatest;
}

// In units of the patch's longer diagonal: how far its corners are from lying in a plane, and the greatest
// distance of a point of it from the point of its two triangles that has the same (u,v). With n×n cells both
// fall to 1/n².
struct Curvature {
  double out_of_plane = 0, distance = 0, diagonal = 0;
};

Curvature curvature(const Corners& p) {
  const Vector3d normal = normalize(cross(p[3] - p[0], p[2] - p[1]));
  const Vector3d twist = (p[3] - p[1]) - (p[2] - p[0]);
  const double diagonal = std::max(length(p[3] - p[0]), length(p[2] - p[1]));
  // What rounding to floats makes of a parallelogram.
  const double rounding = 0x1p-23 * greatest_coordinate(p);
  if (diagonal == 0 || length(twist) <= 4 * rounding) return {0, 0, diagonal};
  return {std::abs(dot(twist, normal)) / (4 * diagonal), length(twist) / (4 * diagonal), diagonal};
}

// Of the patch in the plane of (u,v).
double curvature(const std::array<Point2f, 4>& uv) {
  std::array<Point3d, 4> p;
  for (std::size_t i = 0; i < 4; ++i) p[i] = {static_cast<double>(uv[i].x), static_cast<double>(uv[i].y), 0};
  return curvature(p).distance;
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

// What is made of the patches.
struct Tessellation {
  const std::vector<Point3f>& positions;
  const std::vector<Normal3f>& normals;
  const std::vector<Point2f>& uvs;
  bool with_normals = false, with_uvs = false;  // in the mesh
  TriangleMesh mesh;
};

void append_vertex(Tessellation& t, const Corners& p, const std::array<double, 4>& w, const Patch& patch) {
  const auto mix = [&](auto component) {
    return static_cast<float>(w[0] * component(0u) + w[1] * component(1u) + w[2] * component(2u) +
                              w[3] * component(3u));
  };
  t.mesh.positions.push_back({mix([&](std::size_t i) { return p[i].x; }),
                              mix([&](std::size_t i) { return p[i].y; }),
                              mix([&](std::size_t i) { return p[i].z; })});
  if (t.with_normals && t.normals.empty()) {
    t.mesh.normals.push_back(cast<float>(to_normal(normal_at(p, w))));
  } else if (t.with_normals) {
    const auto n = pick(t.normals, patch);
    const Vector3f mixed{mix([&](std::size_t i) { return n[i].x; }),
                         mix([&](std::size_t i) { return n[i].y; }),
                         mix([&](std::size_t i) { return n[i].z; })};
    t.mesh.normals.push_back(to_normal(normalize(mixed)));
  }
  if (t.with_uvs) {
    const auto q = t.uvs.empty() ? unit_square : pick(t.uvs, patch);
    t.mesh.uvs.push_back(
        {mix([&](std::size_t i) { return q[i].x; }), mix([&](std::size_t i) { return q[i].y; })});
  }
}

void append_grid(Tessellation& t, const Patch& patch, int n) {
  const Corners p = corners_of(t.positions, patch);
  const auto first = static_cast<std::uint32_t>(t.mesh.positions.size());
  const auto side = static_cast<std::uint32_t>(n);
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) append_vertex(t, p, weights(i, j, n), patch);
  }
  for (std::uint32_t j = 0; j < side; ++j) {
    for (std::uint32_t i = 0; i < side; ++i) {
      const std::uint32_t at = first + j * (side + 1) + i, above = at + side + 1;
      t.mesh.triangles.push_back({at, at + 1, above + 1});
      t.mesh.triangles.push_back({at, above + 1, above});
    }
  }
}

// Two triangles a patch, in the order of MissingUv::patches.
TriangleMesh paired(const std::vector<Point3f>& positions, const std::vector<Patch>& patches,
                    const std::vector<Normal3f>& normals, const std::vector<Point2f>& uvs) {
  TriangleMesh mesh{positions, {}, normals, uvs, MissingUv::patches};
  mesh.triangles.reserve(2 * patches.size());
  for (const auto& [p00, p10, p01, p11] : patches) {
    mesh.triangles.push_back({p00, p10, p11});
    mesh.triangles.push_back({p00, p11, p01});
  }
  return mesh;
}

// Likewise, but that a concave one is cut where its outline allows it.
TriangleMesh flat_mesh(const std::vector<Point3f>& positions, const std::vector<Patch>& patches,
                       const std::vector<Normal3f>& normals, const std::vector<Point2f>& uvs) {
  TriangleMesh mesh = paired(positions, patches, normals, uvs);
  std::vector<CornerTriple> cut;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const Patch& patch = patches[i];
    const Corners p = corners_of(positions, patch);
    const Corners around{p[0], p[1], p[3], p[2]};
    const Patch indices{patch[0], patch[1], patch[3], patch[2]};
    cut.clear();
    triangulate_polygon(around, cut);
    for (std::size_t k = 0; k < 2; ++k)
      mesh.triangles[2 * i + k] = {indices[cut[k][0]], indices[cut[k][1]], indices[cut[k][2]]};
  }
  return mesh;
}

void check(const std::vector<Point3f>& positions, const std::vector<Patch>& patches,
           const std::vector<Normal3f>& normals, const std::vector<Point2f>& uvs) {
  for (const Point3f& p : positions) {
    if (!is_finite(p)) throw Error("bilinear mesh: a vertex is not finite");
  }
  if ((!normals.empty() && normals.size() != positions.size()) ||
      (!uvs.empty() && uvs.size() != positions.size())) {
    throw Error("bilinear mesh: normals and uvs have to be as many as the vertices");
  }
  for (const Patch& patch : patches)
    for (const std::uint32_t index : patch) {
      if (index >= positions.size()) throw Error("bilinear mesh: an index is beyond the vertices");
    }
}

// How the patches of a mesh are bent at most.
struct Bend {
  double out_of_plane = 0;  // in units of a patch's diagonal
  // Of the distances of surfaces from their triangles, and of points of one (u,v), to what is allowed.
  double surface = 0, points = 0;
};

Bend bend_of(const std::vector<Point3f>& positions, const std::vector<Patch>& patches,
             const std::vector<Point2f>& uvs) {
  Bounds3f box;
  for (const Patch& patch : patches)
    for (const std::uint32_t index : patch) extend(box, positions[index]);
  const double half = length(cast<double>(extent(box))) / 2;
  Bend most;
  for (const Patch& patch : patches) {
    const Curvature c = curvature(corners_of(positions, patch));
    if (c.diagonal == 0) continue;
    const double allowed = std::max(patch_tolerance, mesh_tolerance * half / c.diagonal);
    const double in_uv = uvs.empty() ? 0 : curvature(pick(uvs, patch));
    most.out_of_plane = std::max(most.out_of_plane, c.out_of_plane);
    most.surface = std::max(most.surface, c.out_of_plane / allowed);
    most.points = std::max({most.points, c.distance / allowed, in_uv / patch_tolerance});
  }
  return most;
}

}  // namespace

TriangleMesh tessellate_bilinear(const std::vector<Point3f>& positions, const std::vector<Patch>& patches,
                                 const std::vector<Normal3f>& normals, const std::vector<Point2f>& uvs,
                                 bool uvs_show) {
  check(positions, patches, normals, uvs);
  const Bend bend = bend_of(positions, patches, uvs);
  const bool flat = bend.out_of_plane <= planar_tolerance;
  const double most = std::max(flat ? 0 : bend.surface, uvs_show ? bend.points : 0);
  const double wanted = std::min<double>(std::ceil(std::sqrt(most)), most_cells_a_side);
  const double affordable = std::floor(std::sqrt(most_cells / static_cast<double>(patches.size())));
  const int n = static_cast<int>(std::max(1.0, std::min(wanted, affordable)));
  const bool own_normals = normals.empty() && bend.out_of_plane > bend_tolerance;
  if (n == 1 && !own_normals)
    return uvs_show ? paired(positions, patches, normals, uvs) : flat_mesh(positions, patches, normals, uvs);
  Tessellation t{positions, normals, uvs, own_normals || !normals.empty(), uvs_show || !uvs.empty(), {}};
  t.mesh.missing_uv = MissingUv::patches;
  for (const Patch& patch : patches) append_grid(t, patch, n);
  return std::move(t.mesh);
}

}  // namespace vitrail
