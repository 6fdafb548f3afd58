// SPDX-License-Identifier: Apache-2.0
#include "tracer/lights/quadric_light.h"

#include <algorithm>
#include <cmath>

#include "scene/geometry/portable_math.h"
#include "tracer/bsdf/local.h"
#include "tracer/lights/normal_cone.h"
#include "tracer/lights/sphere_light_lanes.h"
#include "tracer/quadrics/quadric_area.h"
#include "tracer/quadrics/quadric_surface.h"

namespace vitrail {

namespace {

constexpr Point3d middle{};

Vector3d column(const Affine& a, int j) { return {a.m[0][j], a.m[1][j], a.m[2][j]}; }
double hypotenuse(double x, double y) { return std::sqrt(x * x + y * y); }
Point3d origin_of(const Affine& a) { return {a.m[0][3], a.m[1][3], a.m[2][3]}; }

// A direction of light that leaves, from the point whose normal is the middle of all, and how far the others
// are off it in the quadric's own space.
struct Facing {
  Point3d middle;
  double half_rad = 0;
};

Facing facing_of(const Quadric& q) {
  const double mid = q.phi_max_rad / 2;
  switch (q.kind) {
    case QuadricKind::sphere: {
      const double around_top = q.low <= -1 ? pi : portable_acos(q.low);
      const double around_bottom = q.high >= 1 ? pi : portable_acos(-q.high);
      return around_top <= around_bottom ? Facing{{0, 0, 1}, around_top} : Facing{{0, 0, -1}, around_bottom};
    }
    case QuadricKind::cylinder:
      return {{portable_cos(mid), portable_sin(mid), 0}, mid};
    case QuadricKind::disk:
      return {{0, 0, 0}, 0};
    case QuadricKind::cone:
      return {{0, 0, 1}, pi / 4};
    case QuadricKind::paraboloid:
      return {{0, 0, 0}, portable_atan2(2, 1)};
    case QuadricKind::curve:
      break;
  }
  return {};
}

bool is_similarity(const Affine& a) {
  constexpr double tolerance = 1e-9;
  const Vector3d x = column(a, 0), y = column(a, 1), z = column(a, 2);
  const double size = dot(x, x);
  const auto is_zero = [&](double w) { return std::abs(w) <= tolerance * size; };
  return is_zero(dot(y, y) - size) && is_zero(dot(z, z) - size) && is_zero(dot(x, y)) && is_zero(dot(y, z)) &&
         is_zero(dot(z, x));
}

}  // namespace

QuadricLight::QuadricLight(const EmissiveQuadric& record, bool two_sided, int patches)
    : record_(&record),
      stands_(record.quadric, record.to_bundle),
      own_area_(own_area(record.quadric.quadric)),
      two_sided_(two_sided) {
  const Quadric& q = record.quadric.quadric;
  if (is_whole_sphere(q)) way_ = Way::sphere;
  if (q.kind == QuadricKind::disk && is_whole_turn(q) && q.low <= 0) way_ = Way::disk;
  if (q.kind == QuadricKind::cylinder && is_whole_turn(q) && (two_sided || !record.quadric.inside_out)) {
    way_ = Way::cylinder;
    const auto& [x, y, z] = stands_.column;
    own_height_ = length(z) / std::sqrt(length(x) * length(y));
  }
  const bool by_area = way_ == Way::area || (way_ == Way::cylinder && two_sided);
  if (by_area && patches >= QuadricPatches::fewest && stands_.determinant > 0)
    patches_ = std::make_shared<const QuadricPatches>(record, two_sided, patches);
}

Vector3d QuadricLight::own(Vector3d v) const {
  return {dot(stands_.inverse[0], v), dot(stands_.inverse[1], v), dot(stands_.inverse[2], v)};
}

Vector3d QuadricLight::placed(Vector3d v) const {
  const auto& [x, y, z] = stands_.column;
  return x * v.x + y * v.y + z * v.z;
}

// ---- Spheres

// Of what is seen from outside, or inside; per solid angle of the own space.
double QuadricLight::sphere_pdf(Vector3d q, bool from_outside) const {
  const auto cone = lanes::sphere_cone(lanes::fill<double>(q), stands_.doubt);
  return from_outside == cone.outside ? lanes::cone_pdf(cone) : 0;
}

std::optional<QuadricLight::Sample> QuadricLight::sample_sphere(Point3d from, float u, float v) const {
  const auto s = lanes::sample_sphere<double>(lanes::fill<double>(from - middle), u, v,
                                              [&](int) -> const PlacedQuadric& { return stands_; });
  if (!s.arrives) return std::nullopt;
  return Sample{middle + lane(s.local, 0), lane(s.to_light, 0), lane(s.normal, 0), s.distance, s.pdf,
                is_front(s.outside)};
}

// ---- Cylinders

// How the whole cylinder of radius 1 is seen from q, about its axis.
struct QuadricLight::Arc {
  double q_z = 0;
  double rho = 0;       // of q
  double half_rad = 0;  // 0: its outside is not seen

  // Of the angles along the axis that it is seen under, from a horizontal distance.
  struct Slit {
    double low_rad = 0, width_rad = 0;
  };
  Slit slit(double horizontal, double height) const {
    const double low = -q_z * height, high = (1 - q_z) * height;
    return {portable_atan2(low, horizontal),
            portable_atan2(horizontal * height, horizontal * horizontal + low * high)};
  }
  // `way` from q to the point; per solid angle where the own space is stretched to that height.
  double pdf(Vector3d way, double height) const {
    const double horizontal = hypotenuse(way.x, way.y);
    if (!(half_rad > 0) || !(horizontal > 0)) return 0;
    const double stretched = hypotenuse(horizontal, way.z * height);
    // The rest of the way's length is in the caller's cube.
    const double shorter = length(way) / stretched;
    return height * shorter * shorter * shorter * stretched /
           (horizontal * 2 * half_rad * slit(horizontal, height).width_rad);
  }
};

QuadricLight::Arc QuadricLight::arc(Vector3d q) const {
  const double rho2 = q.x * q.x + q.y * q.y;
  Arc arc{q.z, std::sqrt(rho2)};
  if (rho2 > 1 + stands_.doubt) arc.half_rad = portable_atan2(1, std::sqrt(rho2 - 1));
  return arc;
}

std::optional<QuadricLight::Sample> QuadricLight::sample_cylinder(Point3d from, float u, float v) const {
  const Vector3d q = own(from - origin_of(record_->to_bundle));
  const Arc arc = this->arc(q);
  if (!(arc.half_rad > 0)) return std::nullopt;
  const double theta = (2 * static_cast<double>(u) - 1) * arc.half_rad;
  const double sine = portable_sin(theta), cosine = portable_cos(theta);
  // At the point between the ray and the normal.
  const double sin_there = std::clamp(arc.rho * sine, -1.0, 1.0),
               cos_there = safe_sqrt(1 - sin_there * sin_there);
  const double horizontal = (arc.rho * arc.rho - 1) / (arc.rho * cosine + cos_there);
  const auto [low, width] = arc.slit(horizontal, own_height_);
  const double rise = std::clamp(
      horizontal * portable_tan(low + static_cast<double>(v) * width) / own_height_, -q.z, 1 - q.z);
  // About the axis, from q's own side.
  const double x = cos_there * cosine + sin_there * sine, y = sin_there * cosine - cos_there * sine;
  const double c = q.x / arc.rho, s = q.y / arc.rho;
  Sample sample;
  sample.local = {c * x - s * y, s * x + c * y, q.z + rise};
  const Vector3d own_way{-horizontal * (c * cosine + s * sine), horizontal * (c * sine - s * cosine), rise};
  const Vector3d way = placed(own_way);
  sample.distance = length(way);
  sample.to_light = way * (1 / sample.distance);
  sample.normal = placed_quadric_normal(record_->quadric, record_->to_bundle, sample.local);
  sample.front = is_front(true);
  const double longer = sample.distance / length(own_way);
  sample.pdf = arc.pdf(own_way, own_height_) * longer * longer * longer / stands_.determinant;
  return sample;
}

// ---- Disks

// How the unit disk is seen from q: its cone's axis halves the angle between the nearest and the farthest
// point of its edge.
struct QuadricLight::EllipticCone {
  Vector3d x, y, z;             // orthonormal; z along the axis
  double tan_x = 0, tan_y = 0;  // of its half angles; 0: seen from its plane
  double height = 0;            // 1 − cos θ of the circular cone whose tangent is their mean
  double squeeze_x = 1, squeeze_y = 1;

  explicit EllipticCone(Vector3d q) {
    const double rho = hypotenuse(q.x, q.y), h = std::abs(q.z);
    const Vector3d aside = rho > 0 ? Vector3d{q.x / rho, q.y / rho, 0} : Vector3d{1, 0, 0};
    const double near = hypotenuse(rho - 1, h), far = hypotenuse(rho + 1, h), both = near + far;
    // The axis divides the diameter as these two.
    const Vector3d to_middle = aside * (4 * rho / (both * both)) - q;
    const double distance = length(to_middle);
    if (!(h > 0) || !(distance > 0)) return;
    z = to_middle * (1 / distance);
    y = {-aside.y, aside.x, 0};
    x = cross(y, z);
    const double product = near * far, along = rho * rho - 1 + h * h;  // ·, of the two ways
    tan_x = along > 0 ? 2 * h / (along + product) : (product - along) / (2 * h);
    tan_y = 2 * std::sqrt(product) / (both * distance);
    const double tangent2 = tan_x * tan_y, cosine = 1 / std::sqrt(1 + tangent2);
    height = tangent2 * cosine * cosine / (1 + cosine);
    squeeze_x = std::sqrt(tan_y / tan_x), squeeze_y = std::sqrt(tan_x / tan_y);
  }
  // Of a direction that meets the disk, of any length; per solid angle of the own space. The squeeze keeps
  // volumes.
  double pdf(Vector3d way) const {
    if (!(tan_x > 0)) return 0;
    const Vector3d squeezed{dot(way, x) * squeeze_x, dot(way, y) * squeeze_y, dot(way, z)};
    const double longer = length(way) / length(squeezed);
    return longer * longer * longer / (2 * pi * height);
  }
};

std::optional<QuadricLight::Sample> QuadricLight::sample_disk(Point3d from, float u, float v) const {
  const Vector3d q = own(from - origin_of(record_->to_bundle));
  const EllipticCone cone(q);
  if (!(cone.tan_x > 0)) return std::nullopt;
  const Vector3d disk = sample_cosine_hemisphere(u, v);
  const double drop = cone.height * (disk.x * disk.x + disk.y * disk.y);
  const double aside = std::sqrt(cone.height * (2 - drop));
  const Vector3d direction = cone.x * (disk.x * aside / cone.squeeze_x) +
                             cone.y * (disk.y * aside / cone.squeeze_y) + cone.z * (1 - drop);
  const double t = -q.z / direction.z;
  if (!(t > 0)) return std::nullopt;
  const Vector3d own_way = direction * t, way = placed(own_way);
  Sample s;
  s.local = {q.x + own_way.x, q.y + own_way.y, 0};
  s.distance = length(way);
  s.to_light = way * (1 / s.distance);
  s.normal = placed_quadric_normal(record_->quadric, record_->to_bundle, s.local);
  s.front = is_front(q.z > 0);
  const double longer = s.distance / length(own_way);
  s.pdf = cone.pdf(own_way) * longer * longer * longer / stands_.determinant;
  return s;
}

// ---- Others

std::optional<QuadricLight::Sample> QuadricLight::sample_area(Point3d from, float u, float v) const {
  QuadricPatches::Place place{static_cast<double>(u), static_cast<double>(v), 1};
  const Quadric& quadric = record_->quadric.quadric;
  if (patches_) {
    const auto chosen = patches_->choose(from, sides(from), place.s, place.t);
    if (!chosen) return std::nullopt;
    place = *chosen;
  }
  Sample s;
  s.local = point_by_area(quadric, place.s, place.t);
  const Vector3d way = placed_point(record_->to_bundle, s.local) - from;
  s.distance = length(way);
  s.to_light = way * (1 / s.distance);
  s.normal = placed_quadric_normal(record_->quadric, record_->to_bundle, s.local);
  const double cosine = -dot(s.to_light, s.normal);
  s.front = cosine > 0;
  s.pdf = place.density * s.distance * s.distance / (std::max(std::abs(cosine), 1e-12) * area_by(s.normal));
  return s;
}

// ---- Any

Sides QuadricLight::sides(Point3d from) const {
  return sides_seen(record_->quadric.quadric, middle + own(from - origin_of(record_->to_bundle)));
}

QuadricLight::Way QuadricLight::way(Point3d from) const {
  const bool by_sides = way_ == Way::cylinder && two_sided_;
  return by_sides && sides(from) != Sides::outer ? Way::area : way_;
}

std::optional<QuadricLight::Sample> QuadricLight::sample(Point3d from, float u, float v) const {
  const Way way = this->way(from);
  const auto sample = way == Way::sphere     ? sample_sphere(from, u, v)
                      : way == Way::cylinder ? sample_cylinder(from, u, v)
                      : way == Way::disk     ? sample_disk(from, u, v)
                                             : sample_area(from, u, v);
  if (!sample || !(sample->distance > 0) || !(sample->pdf > 0)) return std::nullopt;
  if (!sample->front && !two_sided_) return std::nullopt;
  return sample;
}

double QuadricLight::pdf(Point3d from, Point3d at, double cosine) const {
  if (cosine <= 0 && !two_sided_) return 0;
  const Vector3d way_there = at - from, own_way = own(way_there);
  const double distance = length(way_there), own_distance = length(own_way);
  if (!(own_distance > 0)) return 0;
  const Vector3d q = own(from - origin_of(record_->to_bundle));
  const Way way = this->way(from);
  if (way == Way::area) {
    const Point3d local = middle + (q + own_way);
    const Vector3d normal = placed_quadric_normal(record_->quadric, record_->to_bundle, local);
    const double density = patches_ ? patches_->density(from, sides(from), local) : 1;
    return density * distance * distance / (std::max(std::abs(cosine), 1e-12) * area_by(normal));
  }
  // Of directions dω = |det| / |M ω′|³ dω′.
  const double longer = distance / own_distance;
  const bool outer = is_front(cosine > 0);
  const double own_pdf = way == Way::sphere     ? sphere_pdf(q, outer)
                         : way == Way::cylinder ? (outer ? arc(q).pdf(own_way, own_height_) : 0)
                                                : EllipticCone(q).pdf(own_way);
  return own_pdf * longer * longer * longer / stands_.determinant;
}

// ---- What is known of it once

TexturePoint QuadricLight::texture_point(Point3d local) const {
  const QuadricPoint at = quadric_point(record_->quadric, record_->to_bundle, local);
  return {at.uv, at.p, at.normal};
}

double QuadricLight::area() const {
  constexpr int cells = 16;  // a side; exact where all is stretched alike
  double sum = 0;
  for (int i = 0; i < cells * cells; ++i) {
    const Point3d local =
        point_by_area(record_->quadric.quadric, (i % cells + 0.5) / cells, (i / cells + 0.5) / cells);
    sum +=
        area_stretch(record_->to_bundle, placed_quadric_normal(record_->quadric, record_->to_bundle, local));
  }
  return own_area_ * sum / (cells * cells);
}

LightBounds QuadricLight::bounds() const {
  Transform to;
  for (std::size_t i = 0; i < 3; ++i) std::copy_n(record_->to_bundle.m[i], 4, to.m[i].begin());
  const Facing facing = facing_of(record_->quadric.quadric);
  LightBounds b;
  b.box = bounds_of(record_->quadric.quadric, to);
  b.axis = placed_quadric_normal(record_->quadric, record_->to_bundle, facing.middle);
  // Angles keep under similarities alone.
  b.theta_o_rad = facing.half_rad == 0 || is_similarity(record_->to_bundle) ? facing.half_rad : pi;
  return b;
}

}  // namespace vitrail
