// SPDX-License-Identifier: Apache-2.0
#include "tests/laws/exact/exact_view.h"

#include <CGAL/Exact_rational.h>

#include <algorithm>
#include <cmath>

namespace vitrail::test {

namespace {

using Exact = CGAL::Exact_rational;

int greatest_axis(Vector3f d) {
  int axis = 0;
  for (int a = 1; a < 3; ++a)
    if (std::abs(d[a]) > std::abs(d[axis])) axis = a;
  return axis;
}

double distance_to_segment(double ax, double ay, double bx, double by) {
  const double ex = bx - ax, ey = by - ay, square = ex * ex + ey * ey;
  const double t = square > 0 ? std::clamp(-(ax * ex + ay * ey) / square, 0.0, 1.0) : 0;
  return std::hypot(ax + ex * t, ay + ey * t);
}

}  // namespace

ExactView exact_view(const Ray& ray, const Triangle& triangle) {
  const int k = greatest_axis(ray.direction), i = (k + 1) % 3, j = (k + 2) % 3;
  const Exact dz(ray.direction[k]), sx = Exact(ray.direction[i]) / dz, sy = Exact(ray.direction[j]) / dz;
  Exact x[3], y[3], z[3];
  for (std::size_t v = 0; v < 3; ++v) {
    z[v] = Exact(triangle[v][k]) - Exact(ray.origin[k]);
    x[v] = Exact(triangle[v][i]) - Exact(ray.origin[i]) - sx * z[v];
    y[v] = Exact(triangle[v][j]) - Exact(ray.origin[j]) - sy * z[v];
  }
  const auto edge = [&](std::size_t a, std::size_t b) { return Exact(x[a] * y[b] - y[a] * x[b]); };
  const Exact u = edge(1, 2), v = edge(2, 0), w = edge(0, 1), det = u + v + w;
  ExactView view{};
  for (std::size_t n = 0; n < 3; ++n) {
    view.x[n] = CGAL::to_double(x[n]);
    view.y[n] = CGAL::to_double(y[n]);
    view.z[n] = CGAL::to_double(z[n]);
  }
  view.edge[0] = CGAL::to_double(u);
  view.edge[1] = CGAL::to_double(v);
  view.edge[2] = CGAL::to_double(w);
  view.det = CGAL::to_double(det);
  const bool inside = (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
  view.crossed = inside && det != 0;
  if (det != 0) {
    const Exact zeta = (u * z[0] + v * z[1] + w * z[2]) / det;
    view.zeta = CGAL::to_double(zeta) * (ray.direction[k] < 0 ? -1 : 1);
  }
  return view;
}

double distance_aside(const ExactView& v) {
  if (v.crossed) return 0;
  double least = INFINITY;
  for (std::size_t a = 0; a < 3; ++a) {
    const std::size_t b = (a + 1) % 3;
    least = std::min(least, distance_to_segment(v.x[a], v.y[a], v.x[b], v.y[b]));
  }
  return least;
}

}  // namespace vitrail::test
