// SPDX-License-Identifier: Apache-2.0
#include "partitioner/meshes/surface.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace vitrail {

namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

struct HalfEdge {
  std::uint32_t low, high;  // points
  std::uint32_t corner;     // that it leaves, 3 · triangle + k
  bool upwards;             // from low to high
};

std::uint32_t next(std::uint32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }

class Corners {  // sets of corners that are one vertex
 public:
  explicit Corners(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = find(a), b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

std::vector<HalfEdge> sorted_half_edges(const std::vector<Triangle>& triangles) {
  std::vector<HalfEdge> edges;
  edges.reserve(3 * triangles.size());
  for (std::uint32_t i = 0; i < triangles.size(); ++i)
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t from = triangles[i][k], to = triangles[i][(k + 1) % 3];
      edges.push_back({std::min(from, to), std::max(from, to), 3 * i + k, from < to});
    }
  std::ranges::sort(edges, [](const HalfEdge& a, const HalfEdge& b) {
    return std::tie(a.low, a.high, a.corner) < std::tie(b.low, b.high, b.corner);
  });
  return edges;
}

// Joins corners across edges of two triangles; marks the ends of edges where that is not possible.
Corners join_across_edges(const std::vector<Triangle>& triangles, std::vector<bool>& held_points) {
  Corners corners(3 * triangles.size());
  const std::vector<HalfEdge> edges = sorted_half_edges(triangles);
  for (std::size_t i = 0, end = 0; i < edges.size(); i = end) {
    const HalfEdge& first = edges[i];
    while (end < edges.size() && edges[end].low == first.low && edges[end].high == first.high) ++end;
    if (end - i == 1) continue;
    const HalfEdge& second = edges[i + 1];
    if (end - i == 2 && first.upwards != second.upwards) {
      corners.join(first.corner, next(second.corner));
      corners.join(second.corner, next(first.corner));
    } else {
      held_points[first.low] = held_points[first.high] = true;
    }
  }
  return corners;
}

}  // namespace

bool MeshSurface::is_manifold() const { return std::ranges::find(held, true) == held.end(); }

MeshSurface surface_of(const TriangleMesh& mesh) {
  MeshSurface surface;
  const std::vector<std::uint32_t> point = first_at_position(mesh), vertex = first_equal(mesh);
  std::vector<Triangle> at_points;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto [a, b, c] = mesh.triangles[i];
    if (point[a] == point[b] || point[b] == point[c] || point[c] == point[a]) continue;
    surface.sources.push_back(i);
    at_points.push_back({point[a], point[b], point[c]});
    surface.wedges.push_back({vertex[a], vertex[b], vertex[c]});
  }
  std::vector<bool> held_points(mesh.positions.size());
  Corners corners = join_across_edges(at_points, held_points);
  std::vector<std::uint32_t> number(3 * at_points.size(), none), first_vertex(mesh.positions.size(), none);
  surface.triangles.resize(at_points.size());
  for (std::uint32_t corner = 0; corner < number.size(); ++corner) {
    const std::uint32_t set = corners.find(corner), at = at_points[corner / 3][corner % 3];
    if (number[set] == none) {
      number[set] = static_cast<std::uint32_t>(surface.points.size());
      surface.points.push_back(at);
      if (first_vertex[at] == none)
        first_vertex[at] = number[set];
      else
        held_points[at] = true;
    }
    surface.triangles[corner / 3][corner % 3] = number[set];
  }
  for (const std::uint32_t at : surface.points) surface.held.push_back(held_points[at]);
  return surface;
}

}  // namespace vitrail
