// SPDX-License-Identifier: Apache-2.0
#include "bundle/occupancy.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vitrail {

namespace {

constexpr int n = Occupancy::cells;

// The cells on one axis: [lower + i·size, lower + (i + 1)·size).
struct Axis {
  double lower, size;
  int cell(double x) const {
    const double at = size > 0 ? (x - lower) / size : 0;
    return at > 0 ? static_cast<int>(std::min(at, n - 1.0)) : 0;  // no number counts as 0
  }
};

std::array<Axis, 3> axes_of(const Bounds3f& box) {
  std::array<Axis, 3> axes;
  for (int a = 0; a < 3; ++a)
    axes[static_cast<std::size_t>(a)] = {
        static_cast<double>(box.lower[a]),
        (static_cast<double>(box.upper[a]) - static_cast<double>(box.lower[a])) / n};
  return axes;
}

// Cells first … last on each axis.
struct Cells {
  std::array<int, 3> first, last;
  int dimensions() const { return (last[0] > first[0]) + (last[1] > first[1]) + (last[2] > first[2]); }
};

Cells cells_of(const std::array<Axis, 3>& axes, const Bounds3d& bounds, double padding) {
  Cells c;
  for (int a = 0; a < 3; ++a) {
    const auto at = static_cast<std::size_t>(a);
    c.first[at] = axes[at].cell(bounds.lower[a] - padding);
    c.last[at] = axes[at].cell(bounds.upper[a] + padding);
  }
  return c;
}

std::uint64_t bit(int x, int y) { return std::uint64_t{1} << (y * n + x); }

// Whether the direction parts the polygon from a box with half extents h around the origin.
bool separates(Vector3d direction, std::span<const Point3d> polygon, Point3d centre, Vector3d h) {
  double least = std::numeric_limits<double>::infinity(), greatest = -least;
  for (const Point3d& p : polygon) {
    const double s = dot(direction, p - centre);
    least = std::min(least, s);
    greatest = std::max(greatest, s);
  }
  const double reach =
      h.x * std::abs(direction.x) + h.y * std::abs(direction.y) + h.z * std::abs(direction.z);
  // Rounding must not part what touches.
  const double slack = 1e-12 * (reach + std::max(std::abs(least), std::abs(greatest)));
  return least > reach + slack || greatest < -reach - slack;
}

// Separating axes of a convex polygon and a box (Gottschalk et al. 1996), but for the box's own.
bool overlaps(std::span<const Point3d> polygon, Vector3d normal, Point3d centre, Vector3d h) {
  if (separates(normal, polygon, centre, h)) return false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector3d e = polygon[(i + 1) % polygon.size()] - polygon[i];
    for (const Vector3d axis : {Vector3d{0, -e.z, e.y}, Vector3d{e.z, 0, -e.x}, Vector3d{-e.y, e.x, 0}})
      if (separates(axis, polygon, centre, h)) return false;
  }
  return true;
}

// Of all its triangles; lanes without one hold NaN, which no comparison takes.
Bounds3d bounds_of(const Cluster& c) {
  Bounds3f b;
  for (const auto& vertex : c.vertex)
    for (int axis = 0; axis < 3; ++axis)
      for (const float x : vertex[axis]) {
        b.lower[axis] = x < b.lower[axis] ? x : b.lower[axis];
        b.upper[axis] = x > b.upper[axis] ? x : b.upper[axis];
      }
  return {cast<double>(b.lower), cast<double>(b.upper)};
}

double greatest(const Bounds3d& b) {
  double most = 0;
  for (int axis = 0; axis < 3 && !b.empty(); ++axis)
    most = std::max({most, std::abs(b.lower[axis]), std::abs(b.upper[axis])});
  return most;
}

template <class Test>
void mark(Occupancy& occupancy, const Cells& c, const Test& wanted) {
  for (int z = c.first[2]; z <= c.last[2]; ++z)
    for (int y = c.first[1]; y <= c.last[1]; ++y)
      for (int x = c.first[0]; x <= c.last[0]; ++x) {
        std::uint64_t& slice = occupancy.slice[static_cast<std::size_t>(z)];
        if (!(slice & bit(x, y)) && wanted(x, y, z)) slice |= bit(x, y);
      }
}

}  // namespace

void mark(Occupancy& occupancy, const Bounds3f& box, std::span<const Point3d> polygon, double padding) {
  const std::array<Axis, 3> axes = axes_of(box);
  Bounds3d bounds;
  for (const Point3d& p : polygon) extend(bounds, p);
  const Cells c = cells_of(axes, bounds, padding);
  if (c.dimensions() < 2) return mark(occupancy, c, [](int, int, int) { return true; });
  Vector3d normal;
  for (std::size_t i = 2; i < polygon.size(); ++i)
    normal = normal + cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  const Vector3d h{axes[0].size / 2 + padding, axes[1].size / 2 + padding, axes[2].size / 2 + padding};
  mark(occupancy, c, [&](int x, int y, int z) {
    const Point3d centre{axes[0].lower + (x + 0.5) * axes[0].size, axes[1].lower + (y + 0.5) * axes[1].size,
                         axes[2].lower + (z + 0.5) * axes[2].size};
    return overlaps(polygon, normal, centre, h);
  });
}

void mark(Occupancy& occupancy, const Bounds3f& box, const Bounds3f& content) {
  const Bounds3d bounds{cast<double>(content.lower), cast<double>(content.upper)};
  mark(occupancy, cells_of(axes_of(box), bounds, 0), [](int, int, int) { return true; });
}

Occupancy occupancy_of(const Bounds3f& box, const DomainView& view, std::span<const Piece> pieces,
                       std::span<const Point3d> piece_vertices, double margin) {
  Occupancy occupancy;
  const std::array<Axis, 3> axes = axes_of(box);
  auto piece = pieces.begin();
  for (const Cluster& c : view.clusters) {
    const Bounds3d bounds = bounds_of(c);
    const double pad = padding(greatest(bounds)) + margin;
    std::array<bool, cluster_width> cut;
    for (std::size_t lane = 0; lane < cluster_width; ++lane) {
      cut[lane] = piece != pieces.end() && piece->triangle == c.id[lane];
      if (cut[lane]) {
        mark(occupancy, box, piece_vertices.subspan(piece->first_vertex, piece->vertex_count), pad);
        ++piece;
      }
    }
    // Most clusters lie in one cell.
    const Cells cells = cells_of(axes, bounds, pad);
    if (cells.dimensions() == 0) {
      mark(occupancy, cells, [](int, int, int) { return true; });
      continue;
    }
    for (std::size_t lane = 0; lane < cluster_width; ++lane) {
      if (c.id[lane] != no_triangle && !cut[lane]) mark(occupancy, box, triangle_in(c, lane), pad);
    }
  }
  for (const InstanceRef& ref : view.instances) mark(occupancy, box, box_of(ref));
  return occupancy;
}

bool meets(const Occupancy& occupancy, const Bounds3f& box, Point3d p, Vector3d d, double t0, double t1) {
  const std::array<Axis, 3> axes = axes_of(box);
  std::array<int, 3> cell;
  for (std::size_t a = 0; a < 3; ++a)
    cell[a] = axes[a].cell(p[static_cast<int>(a)] + t0 * d[static_cast<int>(a)]);
  const auto is_marked = [&] {
    return (occupancy.slice[static_cast<std::size_t>(cell[2])] & bit(cell[0], cell[1])) != 0;
  };
  // A ray that starts on what the domain holds mostly ends here.
  if (is_marked()) return true;
  // Amanatides and Woo 1987.
  std::array<int, 3> step;
  std::array<double, 3> next, per_cell;  // t of the next bound, and from one bound to another
  for (std::size_t a = 0; a < 3; ++a) {
    const double along = d[static_cast<int>(a)];
    step[a] = along > 0 ? 1 : -1;
    const bool moves = along != 0 && axes[a].size > 0;
    const double bound = axes[a].lower + (cell[a] + (step[a] > 0)) * axes[a].size;
    const double inverse = moves ? 1 / along : std::numeric_limits<double>::infinity();  // of a float: finite
    next[a] = moves ? (bound - p[static_cast<int>(a)]) * inverse : inverse;
    per_cell[a] = moves ? axes[a].size * std::abs(inverse) : 0;
  }
  do {
    std::size_t a = next[1] <= next[0];
    a = next[2] <= next[a] ? 2 : a;
    if (next[a] > t1) return false;
    cell[a] += step[a];
    if (cell[a] < 0 || cell[a] >= n) return false;
    next[a] += per_cell[a];
  } while (!is_marked());
  return true;
}

}  // namespace vitrail
