// SPDX-License-Identifier: Apache-2.0
#include "tracer/intersect/exact_test.h"

#include <algorithm>
#include <cmath>

namespace vitrail {
namespace {

std::uint32_t greatest_axis(Vector3f d) {
  const float x = std::abs(d.x), y = std::abs(d.y), z = std::abs(d.z);
  const std::uint32_t of_two = !(x > y), is_third = !(std::max(x, y) > z);
  return of_two + is_third * (2 - of_two);  // no branch: nobody can guess it
}

// A vertex as the sheared ray sees it: the ray runs along the third axis through 0.
struct Sheared {
  double x, y, z;
};

Sheared shear(const RayConstants& r, const float vertex[3][cluster_width], unsigned lane) {
  const double z = double{vertex[r.z][lane]} - double{r.origin[r.z]};
  const double x = double{vertex[r.x][lane]} - double{r.origin[r.x]};
  const double y = double{vertex[r.y][lane]} - double{r.origin[r.y]};
  return {x - r.exact_shear_x * z, y - r.exact_shear_y * z, z};
}

double max3(double a, double b, double c) { return std::max(std::max(a, b), c); }
double min3(double a, double b, double c) { return std::min(std::min(a, b), c); }
// a + b + c with the same bits whatever their order, and of −a, −b, −c the negative.
double sum3(double a, double b, double c) {
  const double low = std::min(a, b), high = std::max(a, b);
  return std::min(low, c) + std::max(high, c) + std::max(low, std::min(high, c));
}
double lateral(Sheared a) { return std::max(std::abs(a.x), std::abs(a.y)); }

double greatest_coordinate(const float vertex[3][cluster_width], unsigned lane) {
  return double{std::max({std::abs(vertex[0][lane]), std::abs(vertex[1][lane]), std::abs(vertex[2][lane])})};
}

double greatest_coordinate(const Cluster& cluster, unsigned lane) {
  const auto m = [&](int k) { return greatest_coordinate(cluster.vertex[k], lane); };
  return max3(m(0), m(1), m(2));
}

// Whether det is great enough for t to be trusted: of vertices up to m from the origin, w away and s beside
// the ray, |det| > s·w·(5e-9·depth/m + 6e-15). The first term keeps t so near to the true triangle's that the
// padding of the boxes, 2e-6·m at least, makes up for the rest; the second is the rounding of det itself, so
// that a triangle without area is never hit. docs/why/exact-intersection.md has the derivation. What holds
// for one vertex' m holds for the greatest, and mostly does.
bool well_conditioned(double det, Sheared a, Sheared b, Sheared c, const Cluster& cluster, unsigned lane) {
  const double s = max3(lateral(a), lateral(b), lateral(c));
  const double w = s + max3(std::abs(a.z), std::abs(b.z), std::abs(c.z));
  const double depth = max3(a.z, b.z, c.z) - min3(a.z, b.z, c.z);
  const auto holds = [&](double m) { return std::abs(det) * m > s * w * (5e-9 * depth + 6e-15 * m); };
  return holds(greatest_coordinate(cluster.vertex[0], lane)) || holds(greatest_coordinate(cluster, lane));
}

}  // namespace

RayConstants prepare(const Ray& ray, double time_s) {
  RayConstants r;
  // Arrays, so that an axis that chance has chosen is an index and no branch.
  const float direction[3] = {ray.direction.x, ray.direction.y, ray.direction.z};
  r.z = greatest_axis(ray.direction);
  r.x = r.z == 2 ? 0 : r.z + 1;
  r.y = r.x == 2 ? 0 : r.x + 1;
  const float dz = direction[r.z];
  // Not by the array, which the processor would wait for.
  const auto set = [&](std::uint32_t axis, float o, float d) {
    const bool along = std::abs(d) * 1e18f > std::abs(dz);
    r.origin[axis] = o;
    r.inverse_direction[axis] = along ? std::abs(dz) / d : std::copysign(1e18f, d);
    r.near_row[axis] = axis + 3 * static_cast<std::uint32_t>(std::signbit(d));
  };
  set(0, ray.origin.x, ray.direction.x);
  set(1, ray.origin.y, ray.direction.y);
  set(2, ray.origin.z, ray.direction.z);
  r.exact_shear_x = double{direction[r.x]} / double{dz};
  r.exact_shear_y = double{direction[r.y]} / double{dz};
  r.shear_x = static_cast<float>(r.exact_shear_x);
  r.shear_y = static_cast<float>(r.exact_shear_y);
  r.sign_z = std::copysign(1.0f, dz);
  r.drift = 0x1p-47f * std::max({std::abs(r.origin[0]), std::abs(r.origin[1]), std::abs(r.origin[2])});
  r.exclude = ray.exclude;
  r.direction_z = double{dz};
  r.time_s = time_s;
  return r;
}

bool exact_hit(const RayConstants& ray, const Cluster& cluster, unsigned lane, ExactHit& hit) {
  const Sheared a = shear(ray, cluster.vertex[0], lane);
  const Sheared b = shear(ray, cluster.vertex[1], lane);
  const Sheared c = shear(ray, cluster.vertex[2], lane);
  const double u = c.x * b.y - c.y * b.x;
  const double v = a.x * c.y - a.y * c.x;
  const double w = b.x * a.y - b.y * a.x;
  if (min3(u, v, w) < 0 && max3(u, v, w) > 0) return false;
  const double det = sum3(u, v, w);
  if (!well_conditioned(det, a, b, c, cluster, lane)) return false;
  const double t = sum3(u * a.z, v * b.z, w * c.z) / det / ray.direction_z;
  if (!(t > 0)) return false;
  hit = {t, v / det, w / det, (det > 0) == (ray.direction_z > 0)};
  return true;
}

double setback(const RayConstants& ray, double t, double reach) {
  const double from = double{ray.drift} * 0x1p47, depth = std::abs(ray.direction_z);
  return 0x1p-21 * std::min(reach, from + t * depth) / depth;
}

bool seen_hit(const RayConstants& ray, const Cluster& cluster, unsigned lane, ExactHit& hit) {
  if (!exact_hit(ray, cluster, lane, hit)) return false;
  if (!hit.front) hit.t += setback(ray, hit.t, greatest_coordinate(cluster, lane));
  return true;
}

}  // namespace vitrail
