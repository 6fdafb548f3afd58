// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/read/surface_uvs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "scene/geometry/pi.h"

namespace vitrail::pov {

namespace {

// From +x towards +z, 0 … 1.
double turn_around_y(Point3d p) {
  if (p.x == 0 && p.z == 0) return std::numeric_limits<double>::quiet_NaN();
  const double turn = std::atan2(p.z, p.x) / (2 * pi);
  return turn < 0 ? turn + 1 : turn;
}

Point2d between(Point2d a, Point2d b, double t) { return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)}; }

// A point of the k-th segment of the curve of a lathe, and how many there are.
std::size_t segments(solids::SplineKind kind, std::size_t points) {
  const std::size_t ends = kind == solids::SplineKind::linear      ? 1
                           : kind == solids::SplineKind::quadratic ? 2
                                                                   : 3;
  if (kind == solids::SplineKind::bezier) return points / 4;
  return points > ends ? points - ends : 0;
}

Point2d curve_point(solids::SplineKind kind, std::span<const Point2d> p, std::size_t k, double t) {
  const double s = 1 - t, t2 = t * t, t3 = t2 * t;
  std::array<double, 4> w{};
  std::size_t first = k;
  switch (kind) {
    case solids::SplineKind::linear:
      w = {s, t, 0, 0};
      break;
    case solids::SplineKind::quadratic:
      w = {(t2 - t) / 2, 1 - t2, (t2 + t) / 2, 0};
      break;
    case solids::SplineKind::cubic:
      w = {(2 * t2 - t3 - t) / 2, (3 * t3 - 5 * t2 + 2) / 2, (4 * t2 - 3 * t3 + t) / 2, (t3 - t2) / 2};
      break;
    case solids::SplineKind::bezier:
      w = {s * s * s, 3 * s * s * t, 3 * s * t2, t3};
      first = 4 * k;
  }
  Point2d sum{0, 0};
  for (std::size_t i = 0; i < w.size() && first + i < p.size(); ++i)
    sum.x += w[i] * p[first + i].x, sum.y += w[i] * p[first + i].y;
  return sum;
}

struct Chord {
  Point2d from, to;
  double v_from = 0, v_to = 0;
};

// The v of the nearest chord's nearest point.
double nearest_v(std::span<const Chord> chords, Point2d p) {
  double least = std::numeric_limits<double>::infinity(), v = 0;
  for (const Chord& c : chords) {
    const double dx = c.to.x - c.from.x, dy = c.to.y - c.from.y, square = dx * dx + dy * dy;
    const double along = square > 0 ? ((p.x - c.from.x) * dx + (p.y - c.from.y) * dy) / square : 0;
    const double t = std::clamp(along, 0.0, 1.0);
    const Point2d near = between(c.from, c.to, t);
    const double off = (near.x - p.x) * (near.x - p.x) + (near.y - p.y) * (near.y - p.y);
    if (off < least) least = off, v = c.v_from + t * (c.v_to - c.v_from);
  }
  return v;
}

Point3d patch_point(const std::array<Point3d, 16>& points, double u, double v) {
  const auto bernstein = [](double t) {
    const double s = 1 - t;
    return std::array{s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
  };
  const auto bu = bernstein(u), bv = bernstein(v);
  Vector3d sum;
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t i = 0; i < 4; ++i) sum = sum + (points[4 * k + i] - Point3d{}) * (bu[i] * bv[k]);
  return Point3d{} + sum;
}

// Where a patch comes nearest to a point: on ever finer grids around the nearest one.
Point2d nearest_on_patch(const std::array<Point3d, 16>& points, Point3d p) {
  constexpr int begin = 16, half = 2;
  Point2d best{0.5, 0.5};
  double least = std::numeric_limits<double>::infinity();
  const auto look = [&](double u, double v) {
    const Vector3d off = patch_point(points, u, v) - p;
    if (const double square = dot(off, off); square < least) least = square, best = {u, v};
  };
  for (int i = 0; i <= begin; ++i)
    for (int j = 0; j <= begin; ++j) look(static_cast<double>(i) / begin, static_cast<double>(j) / begin);
  for (double step = 0.5 / begin; step > 1e-5; step /= 2) {
    const Point2d around = best;
    for (int i = -half; i <= half; ++i)
      for (int j = -half; j <= half; ++j)
        look(std::clamp(around.x + i * step, 0.0, 1.0), std::clamp(around.y + j * step, 0.0, 1.0));
  }
  return best;
}

}  // namespace

SurfaceUvs sphere_uvs(Point3d center) {
  return {[center](Point3d p, Point3d) {
            const Vector3d d = p - center;
            const double r = length(d);
            return Point2d{turn_around_y(Point3d{} + d),
                           0.5 + (r > 0 ? std::asin(std::clamp(d.y / r, -1.0, 1.0)) : 0) / pi};
          },
          true};
}

// As the faces of a cube lie in an image of four by three: left, front, right, back, and two below and above.
SurfaceUvs box_uvs(Point3d corner1, Point3d corner2) {
  const Point3d low{std::min(corner1.x, corner2.x), std::min(corner1.y, corner2.y),
                    std::min(corner1.z, corner2.z)};
  const Point3d high{std::max(corner1.x, corner2.x), std::max(corner1.y, corner2.y),
                     std::max(corner1.z, corner2.z)};
  const auto share = [low, high](Point3d p) {
    return Point3d{(p.x - low.x) / (high.x - low.x), (p.y - low.y) / (high.y - low.y),
                   (p.z - low.z) / (high.z - low.z)};
  };
  return {[share](Point3d at, Point3d inside) {
            const Point3d p = share(at), c = share(inside);
            const std::array off{c.x, 1 - c.x, c.y, 1 - c.y, c.z, 1 - c.z};
            const auto face =
                std::ranges::min_element(off, {}, [](double x) { return std::abs(x); }) - off.begin();
            const double middle = (1 + p.y) / 3;
            switch (face) {
              case 0:
                return Point2d{p.z / 4, middle};
              case 1:
                return Point2d{(3 - p.z) / 4, middle};
              case 2:
                return Point2d{(1 + p.x) / 4, p.z / 3};
              case 3:
                return Point2d{(1 + p.x) / 4, 1 - p.z / 3};
              case 4:
                return Point2d{1 - p.x / 4, middle};
              default:
                return Point2d{(1 + p.x) / 4, middle};
            }
          },
          false};
}

SurfaceUvs torus_uvs(double major) {
  return {[major](Point3d p, Point3d) {
            const double r = std::sqrt(p.x * p.x + p.z * p.z) - major;
            return Point2d{0.5 - std::atan2(p.z, p.x) / (2 * pi), 0.5 + std::atan2(p.y, r) / (2 * pi)};
          },
          true};
}

SurfaceUvs lathe_uvs(solids::SplineKind kind, std::span<const Point2d> points) {
  const std::size_t count = segments(kind, points.size());
  const int pieces = kind == solids::SplineKind::linear ? 1 : 16;
  std::vector<Chord> chords;
  for (std::size_t k = 0; k < count; ++k)
    for (int i = 0; i < pieces; ++i) {
      const double from = static_cast<double>(i) / pieces, to = static_cast<double>(i + 1) / pieces;
      const auto all = static_cast<double>(count), before = static_cast<double>(k);
      chords.push_back({curve_point(kind, points, k, from), curve_point(kind, points, k, to),
                        (before + from) / all, (before + to) / all});
    }
  return {[chords](Point3d p, Point3d) {
            return Point2d{turn_around_y(p), nearest_v(chords, {std::sqrt(p.x * p.x + p.z * p.z), p.y})};
          },
          true};
}

SurfaceUvs revolution_uvs(std::span<const Point2d> points) {
  std::vector<Chord> heights;
  for (std::size_t k = 1; k + 2 < points.size(); ++k) {
    const auto all = static_cast<double>(points.size() - 3), before = static_cast<double>(k - 1);
    heights.push_back({{0, points[k].y}, {0, points[k + 1].y}, before / all, (before + 1) / all});
  }
  return {[heights](Point3d p, Point3d) {
            return Point2d{turn_around_y(p), nearest_v(heights, {0, p.y})};
          },
          true};
}

SurfaceUvs patch_uvs(const std::array<Point3d, 16>& points, const std::array<Point2d, 4>& corners) {
  return {[points, corners](Point3d p, Point3d) {
            const Point2d at = nearest_on_patch(points, p);
            return between(between(corners[0], corners[1], at.x), between(corners[3], corners[2], at.x),
                           at.y);
          },
          false};
}

SurfaceUvs moved(SurfaceUvs uvs, const Transform& to_world) {
  if (!uvs.at || to_world == Transform{}) return uvs;
  return {[at = std::move(uvs.at), back = inverse(to_world)](Point3d p, Point3d inside) {
            return at(transform_point(back, p), transform_point(back, inside));
          },
          uvs.begins_anew};
}

TriangleMesh with_uvs(const TriangleMesh& mesh, const SurfaceUvs& uvs) {
  TriangleMesh result;
  for (const auto& triangle : mesh.triangles) {
    std::array<Point3d, 3> p;
    for (std::size_t i = 0; i < 3; ++i) p[i] = cast<double>(mesh.positions[triangle[i]]);
    const Point3d middle =
        Point3d{} + ((p[0] - Point3d{}) + (p[1] - Point3d{}) + (p[2] - Point3d{})) * (1.0 / 3);
    const Point2d around = uvs.at(middle, middle);
    const auto first = static_cast<std::uint32_t>(result.positions.size());
    result.triangles.push_back({first, first + 1, first + 2});
    for (std::size_t i = 0; i < 3; ++i) {
      Point2d uv = uvs.at(p[i], middle);
      if (std::isnan(uv.x)) uv.x = around.x;
      if (uvs.begins_anew) uv.x -= std::nearbyint(uv.x - around.x), uv.y -= std::nearbyint(uv.y - around.y);
      result.positions.push_back(mesh.positions[triangle[i]]);
      if (!mesh.normals.empty()) result.normals.push_back(mesh.normals[triangle[i]]);
      result.uvs.push_back({static_cast<float>(uv.x), static_cast<float>(uv.y)});
    }
  }
  return result;
}

}  // namespace vitrail::pov
