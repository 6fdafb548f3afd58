// SPDX-License-Identifier: Apache-2.0
#include "importers/shapes/grid_surfaces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "scene/geometry/unit_circle.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

// A point or a normal.
template <class T>
T single(const Vector3d& v) {
  const T made{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
  if (!std::isfinite(made.x) || !std::isfinite(made.y) || !std::isfinite(made.z))
    throw Error("a surface is not finite in single precision");
  return made;
}

// The triangles of columns × rows vertices: of each cell (0,0) (1,0) (1,1) and (0,0) (1,1) (0,1), as in
// pbrt-v3.
std::vector<std::array<std::uint32_t, 3>> grid_triangles(std::uint32_t columns, std::uint32_t rows) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  triangles.reserve(std::size_t{2} * (columns - 1) * (rows - 1));
  for (std::uint32_t y = 0; y + 1 < rows; ++y)
    for (std::uint32_t x = 0; x + 1 < columns; ++x) {
      const std::uint32_t a = y * columns + x, b = a + 1, c = b + columns, d = a + columns;
      triangles.push_back({a, b, c});
      triangles.push_back({a, c, d});
    }
  return triangles;
}

// Weights of control points at t, and their derivatives: of as many from `first` on as the order is. The
// others have none.
struct Weights {
  std::size_t first = 0;
  std::vector<double> values, derivatives;
};

double ratio(double a, double b) { return b > 0 ? a / b : 0; }  // a term between equal knots counts nothing

Weights weights(const Spline& s, double t) {
  const auto count = static_cast<std::size_t>(s.points);
  const auto order = static_cast<std::size_t>(s.order);
  const std::vector<double>& k = s.knots;
  std::size_t span = order - 1;  // the last one that is not empty and begins at t or before
  for (std::size_t i = span; i < count; ++i)
    if (k[i] <= t && k[i] < k[i + 1]) span = i;
  const std::size_t first = span - (order - 1);
  std::vector<double> n(count + order, 0), lower;
  n[span] = 1;
  for (std::size_t degree = 1; degree < order; ++degree) {
    lower = n;
    for (std::size_t i = first; i <= span; ++i)
      n[i] = ratio((t - k[i]) * lower[i], k[i + degree] - k[i]) +
             ratio((k[i + degree + 1] - t) * lower[i + 1], k[i + degree + 1] - k[i + 1]);
  }
  Weights w{first, {}, {}};
  const auto degree = static_cast<double>(order - 1);
  for (std::size_t i = first; i <= span; ++i) {
    w.values.push_back(n[i]);
    w.derivatives.push_back(
        degree * (ratio(lower[i], k[i + order - 1] - k[i]) - ratio(lower[i + 1], k[i + order] - k[i + 1])));
  }
  return w;
}

void require_valid(const Spline& s, const char* direction) {
  const auto fail = [&](const std::string& what) {
    throw Error(fmt::format("a NURBS surface in {}: {}", direction, what));
  };
  constexpr int highest_order = 256;  // the work grows with its square
  if (s.order > highest_order) fail(fmt::format("an order of {}; at most {}", s.order, highest_order));
  if (s.order < 2 || s.order > s.points)
    fail(fmt::format("an order of {} with {} points; it has to be at least 2 and at most their number",
                     s.order, s.points));
  if (s.knots.size() != static_cast<std::size_t>(s.points) + static_cast<std::size_t>(s.order))
    fail(fmt::format("{} knots, where {} points of order {} have {}", s.knots.size(), s.points, s.order,
                     s.points + s.order));
  if (!std::ranges::is_sorted(s.knots)) fail("the knots descend");
  const double first = s.knots[static_cast<std::size_t>(s.order - 1)],
               last = s.knots[static_cast<std::size_t>(s.points)];
  if (!(first < last) || !(first <= s.begin && s.begin < s.end && s.end <= last))
    fail(fmt::format("{} … {} is not within its knots, {} … {}", s.begin, s.end, first, last));
}

struct Surface {
  const Spline& u;
  const std::vector<std::array<double, 4>>& points;

  Vector3d at(const Weights& a, const Weights& b, Vector3d& normal) const {
    std::array<double, 4> p{}, du{}, dv{};
    for (std::size_t y = 0; y < b.values.size(); ++y)
      for (std::size_t x = 0; x < a.values.size(); ++x)
        for (std::size_t c = 0; c < 4; ++c) {
          const double point = points[(b.first + y) * static_cast<std::size_t>(u.points) + a.first + x][c];
          p[c] += a.values[x] * b.values[y] * point;
          du[c] += a.derivatives[x] * b.values[y] * point;
          dv[c] += a.values[x] * b.derivatives[y] * point;
        }
    if (!(p[3] > 0)) throw Error("a NURBS surface has a weight that is not above 0");
    const auto quotient = [&](const std::array<double, 4>& d) {
      const auto one = [&](std::size_t c) { return (d[c] * p[3] - p[c] * d[3]) / (p[3] * p[3]); };
      return Vector3d{one(0), one(1), one(2)};
    };
    normal = cross(quotient(du), quotient(dv));
    return {p[0] / p[3], p[1] / p[3], p[2] / p[3]};
  }
};

}  // namespace

TriangleMesh heightfield(int columns, int rows, const std::vector<double>& heights) {
  TriangleMesh mesh;
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      const double u = x / static_cast<double>(columns - 1), v = y / static_cast<double>(rows - 1);
      mesh.positions.push_back(single<Point3f>({u, v, heights[mesh.positions.size()]}));
      mesh.uvs.push_back({static_cast<float>(u), static_cast<float>(v)});
    }
  mesh.triangles = grid_triangles(static_cast<std::uint32_t>(columns), static_cast<std::uint32_t>(rows));
  return mesh;
}

namespace {

// a·(x² + y²) − c·z² = 1, which pbrt-v3 takes for what a line sweeps: through p2 and the point that is as far
// behind it as p1 is before it.
struct Waisted {
  double a = 0, c = 0;
  Waisted(const Vector3d& p1, const Vector3d& p2) {
    const Vector3d other = p2 * 2.0 - p1;
    const auto squared = [](const Vector3d& p) { return p.x * p.x + p.y * p.y; };
    const double z2 = p2.z * p2.z, other_z2 = other.z * other.z;
    a = (z2 - other_z2) / (squared(other) * z2 - squared(p2) * other_z2);
    c = (a * squared(p2) - 1) / z2;
  }
  // By which a point of the line is farther from the axis; 1 where there is no such surface.
  double scale(const Vector3d& p) const {
    const double squared = (1 + c * p.z * p.z) / (a * (p.x * p.x + p.y * p.y));
    return std::isfinite(squared) ? std::sqrt(std::max(0.0, squared)) : 1;
  }
};

}  // namespace

TriangleMesh hyperboloid(Vector3d p1, Vector3d p2, double phimax_rad) {
  constexpr int of_turn = 256, rows = 64;
  if (p2.z == 0) std::swap(p1, p2);
  const Waisted waisted(p1, p2);
  const int columns = std::max(1, static_cast<int>(std::ceil(of_turn * phimax_rad / (2 * pi))));
  TriangleMesh mesh;
  for (int y = 0; y <= rows; ++y)
    for (int x = 0; x <= columns; ++x) {
      const double u = x / static_cast<double>(columns), v = y / static_cast<double>(rows);
      const Point2d circle = unit_circle(u * phimax_rad);
      const auto turned = [&](const Vector3d& p) {
        return Vector3d{p.x * circle.x - p.y * circle.y, p.x * circle.y + p.y * circle.x, p.z};
      };
      const Vector3d along = p2 - p1;
      Vector3d p = turned(p1 + along * v);
      if (p1.z != p2.z) {
        const double scale = waisted.scale(p);
        p.x *= scale, p.y *= scale;
      }
      const Vector3d normal = cross({-p.y, p.x, 0}, turned(along));
      mesh.positions.push_back(single<Point3f>(p));
      mesh.normals.push_back(single<Normal3f>(normal));
      mesh.uvs.push_back({static_cast<float>(u), static_cast<float>(v)});
    }
  mesh.triangles = grid_triangles(static_cast<std::uint32_t>(columns + 1), rows + 1);
  return mesh;
}

TriangleMesh nurbs(const Spline& u, const Spline& v, const std::vector<std::array<double, 4>>& points) {
  constexpr int diced = 30;
  require_valid(u, "u");
  require_valid(v, "v");
  const Surface surface{u, points};
  const auto place = [](const Spline& spline, int i) {
    return std::lerp(spline.begin, spline.end, i / (diced - 1.0));
  };
  std::array<Weights, diced> of_column, of_row;
  for (int i = 0; i < diced; ++i) {
    of_column[static_cast<std::size_t>(i)] = weights(u, place(u, i));
    of_row[static_cast<std::size_t>(i)] = weights(v, place(v, i));
  }
  TriangleMesh mesh;
  for (int y = 0; y < diced; ++y)
    for (int x = 0; x < diced; ++x) {
      const double s = place(u, x), t = place(v, y);
      Vector3d normal;
      mesh.positions.push_back(single<Point3f>(
          surface.at(of_column[static_cast<std::size_t>(x)], of_row[static_cast<std::size_t>(y)], normal)));
      if (!(length(normal) > 0)) {  // a pole: the normal beside it
        constexpr double beside = 1e-4;
        surface.at(weights(u, std::lerp(s, (u.begin + u.end) / 2, beside)),
                   weights(v, std::lerp(t, (v.begin + v.end) / 2, beside)), normal);
      }
      const Vector3d unit = length(normal) > 0 ? normalize(normal) : Vector3d{0, 0, 1};
      mesh.normals.push_back(single<Normal3f>(unit));
      mesh.uvs.push_back({static_cast<float>(s), static_cast<float>(t)});
    }
  mesh.triangles = grid_triangles(diced, diced);
  return mesh;
}

}  // namespace vitrail
