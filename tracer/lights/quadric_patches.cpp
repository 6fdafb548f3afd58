// SPDX-License-Identifier: Apache-2.0
#include "tracer/lights/quadric_patches.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "scene/geometry/portable_math.h"
#include "tracer/quadrics/quadric_area.h"
#include "tracer/quadrics/quadric_surface.h"

namespace vitrail {

namespace {

struct Square {
  double s0 = 0, s1 = 1, t0 = 0, t1 = 1;
  double s(double x) const { return s0 + (s1 - s0) * x; }
  double t(double x) const { return t0 + (t1 - t0) * x; }
};

Vector3d column(const Affine& a, int j) { return {a.m[0][j], a.m[1][j], a.m[2][j]}; }

// Of the normals of a surface placed so, in the ratio of their lengths.
Vector3d placed_normal(const Affine& to, Vector3d n) {
  const Vector3d x = column(to, 0), y = column(to, 1), z = column(to, 2);
  const Vector3d across = cross(y, z) * n.x + cross(z, x) * n.y + cross(x, y) * n.z;
  return mirrors(to) ? -across : across;
}

// A point of the half plane that turns about the axis, or a direction.
struct Meridian {
  double rho = 0, z = 0;
};
// Control points of a meridian as a rational quadratic, or less, with positive weights, and of its outward
// normals.
struct Profile {
  std::vector<Meridian> points, normals;
};

Profile profile_of(const Quadric& q, double t0, double t1) {
  const auto at = [&](double t) {
    const Point3d p = point_by_area(q, 0, t);
    return Meridian{p.x, p.z};
  };
  const Meridian a = at(t0), b = at(t1);
  switch (q.kind) {
    case QuadricKind::sphere: {
      // Where the tangents of its ends meet: (a + b)/(1 + a·b).
      const double scale = 1 / (1 + a.rho * b.rho + a.z * b.z);
      const std::vector<Meridian> arc{a, {(a.rho + b.rho) * scale, (a.z + b.z) * scale}, b};
      return {arc, arc};
    }
    case QuadricKind::cylinder:
      return {{a, b}, {{1, 0}}};
    case QuadricKind::disk:
      return {{a, b}, {{0, 1}}};
    case QuadricKind::cone:
      return {{a, b}, {{1, 1}}};
    case QuadricKind::paraboloid:
      return {{a, {(a.rho + b.rho) / 2, a.rho * b.rho}, b}, {{2 * a.rho, -1}, {2 * b.rho, -1}}};
    case QuadricKind::curve:
      break;
  }
  return {};
}

// What holds all of a patch: as a product of rational quadratics with positive weights, it lies in the convex
// hull of its control points, its normals in the convex cone of theirs, and so their images do.
LightBounds bounds_of_patch(const EmissiveQuadric& record, const Square& square) {
  const Quadric& q = record.quadric.quadric;
  const double phi0 = q.phi_max_rad * square.s0, phi1 = q.phi_max_rad * square.s1;
  const double middle = (phi0 + phi1) / 2, longer = 1 / portable_cos((phi1 - phi0) / 2);
  const std::array<Point2d, 3> around{{{portable_cos(phi0), portable_sin(phi0)},
                                       {portable_cos(middle) * longer, portable_sin(middle) * longer},
                                       {portable_cos(phi1), portable_sin(phi1)}}};
  const Profile profile = profile_of(q, square.t0, square.t1);
  LightBounds b;
  const auto outward_at = [&](Point3d p) {
    const Vector3d n = placed_quadric_normal(record.quadric, record.to_bundle, p);
    return record.quadric.inside_out ? -n : n;
  };
  b.axis = outward_at(point_by_area(q, square.s(0.5), square.t(0.5)));
  double least_cosine = 1;
  for (const Point2d& e : around) {
    for (const Meridian& m : profile.points)
      extend(b.box, placed_point(record.to_bundle, {m.rho * e.x, m.rho * e.y, m.z}));
    for (const Meridian& m : profile.normals) {
      const Vector3d n = placed_normal(record.to_bundle, {m.rho * e.x, m.rho * e.y, m.z});
      least_cosine = std::min(least_cosine, dot(n, b.axis) / length(n));
    }
  }
  // A cone of less than a half turn is convex. One of all directions else.
  b.theta_o_rad = least_cosine > 0 ? portable_acos(std::min(least_cosine, 1.0)) + 1e-6 : pi;
  b.theta_e_rad = pi / 2;
  return b;
}

// Where it stands, of that own area.
double placed_area(const EmissiveQuadric& record, const Square& square) {
  constexpr int side = 2;
  double sum = 0;
  for (int i = 0; i < side * side; ++i) {
    const Point3d p = point_by_area(record.quadric.quadric, square.s((i % side + 0.5) / side),
                                    square.t((i / side + 0.5) / side));
    sum += area_stretch(record.to_bundle, placed_quadric_normal(record.quadric, record.to_bundle, p));
  }
  return sum / (side * side);
}

// Of the whole, where it stands, along the middle of s, or of t.
double extent_along(const EmissiveQuadric& record, bool along_s) {
  constexpr int steps = 32;
  const auto at = [&](int i) {
    const double x = static_cast<double>(i) / steps;
    return placed_point(record.to_bundle,
                        point_by_area(record.quadric.quadric, along_s ? x : 0.5, along_s ? 0.5 : x));
  };
  double sum = 0;
  for (int i = 0; i < steps; ++i) sum += length(at(i + 1) - at(i));
  return sum;
}

}  // namespace

Sides sides_seen(const Quadric& q, Point3d p) {
  constexpr double doubt = 1e-6;
  if (!is_whole_turn(q)) return Sides::both;
  const double rho2 = p.x * p.x + p.y * p.y;
  double outside = 0;
  switch (q.kind) {
    case QuadricKind::sphere:
      if ((q.low > -1 && p.z < q.low) || (q.high < 1 && p.z > q.high)) return Sides::both;
      outside = rho2 + p.z * p.z - 1;
      break;
    case QuadricKind::cylinder:
      if (p.z < 0 || p.z > 1) return Sides::both;
      outside = rho2 - 1;
      break;
    case QuadricKind::disk:
      return Sides::both;
    case QuadricKind::cone:
      if (p.z < 0) return Sides::both;
      outside = std::sqrt(rho2) + p.z - 1;
      break;
    case QuadricKind::paraboloid:
      if (p.z > 1 || (q.low > 0 && p.z < q.low)) return Sides::both;
      outside = rho2 - p.z;
      break;
    case QuadricKind::curve:
      break;
  }
  return std::abs(outside) <= doubt ? Sides::both : outside > 0 ? Sides::outer : Sides::inner;
}

QuadricPatches::QuadricPatches(const EmissiveQuadric& record, bool two_sided, int count)
    : quadric_(record.quadric.quadric), two_sided_(two_sided) {
  // At least four along s and two along t, so that each turns by at most a quarter of the way round. As long
  // as wide, but with sixteen along s where there are enough: normals differ along it.
  count = std::clamp(count, fewest, most);
  const double around = extent_along(record, true), along = extent_along(record, false);
  columns_ = 4, rows_ = 2;
  while (2 * columns_ * rows_ <= count)
    (columns_ < 16 || around * rows_ > along * columns_ ? columns_ : rows_) *= 2;

  std::vector<LightBounds> patches;
  for (int i = 0; i < columns_ * rows_; ++i) {
    const int column = i % columns_, row = i / columns_;
    const Square square{static_cast<double>(column) / columns_, static_cast<double>(column + 1) / columns_,
                        static_cast<double>(row) / rows_, static_cast<double>(row + 1) / rows_};
    LightBounds b = bounds_of_patch(record, square);
    b.power = placed_area(record, square);
    if (!std::isfinite(b.power)) b.power = 0;
    patches.push_back(b);
  }
  const auto tree_of = [&](Sides shining) {
    std::vector<LightBounds> bounds = patches;
    for (LightBounds& b : bounds) {
      b.two_sided = shining == Sides::both;
      if (shining == Sides::inner) b.axis = -b.axis;
    }
    return LightTree(bounds, LightChoice::tree);
  };
  if (!two_sided) {
    trees_[0] = tree_of(record.quadric.inside_out ? Sides::inner : Sides::outer);
    return;
  }
  const bool parts = is_whole_turn(quadric_) && quadric_.kind != QuadricKind::disk;
  for (const Sides seen : {Sides::both, Sides::outer, Sides::inner})
    if (parts || seen == Sides::both) trees_[static_cast<std::size_t>(seen)] = tree_of(seen);
}

std::optional<QuadricPatches::Place> QuadricPatches::choose(Point3d from, Sides seen, double u,
                                                            double v) const {
  const LightTree& patches = tree(seen);
  const auto chosen = patches.choose(from, u);
  if (!chosen) return std::nullopt;
  const auto patch = static_cast<int>(patches.order()[chosen->slot]);
  return Place{(patch % columns_ + chosen->rest) / columns_, (patch / columns_ + v) / rows_,
               chosen->probability * columns_ * rows_};
}

double QuadricPatches::density(Point3d from, Sides seen, Point3d local) const {
  const Point2d at = place_by_area(quadric_, local);
  const int column = std::clamp(static_cast<int>(at.x * columns_), 0, columns_ - 1),
            row = std::clamp(static_cast<int>(at.y * rows_), 0, rows_ - 1);
  return tree(seen).probability(from, static_cast<std::uint32_t>(row * columns_ + column)) * columns_ * rows_;
}

}  // namespace vitrail
