// SPDX-License-Identifier: Apache-2.0
#include "tracer/surfaces/interaction.h"

#include <algorithm>
#include <cmath>

#include "tracer/intersect/instance_ray.h"
#include "tracer/quadrics/quadric_surface.h"
#include "tracer/rays/rounding.h"

namespace vitrail {

namespace {

// Of three values at the corners.
template <class V>
V interpolated(const Hit& hit, const V& a, const V& b, const V& c) {
  return a * (1 - hit.u - hit.v) + b * hit.u + c * hit.v;
}

// Back along a ray, whose direction is a unit vector rounded to floats: a step of Newton's for 1/√x at 1,
// which is off by 1e-13, takes neither a root nor a division.
Vector3d back_along(Vector3f direction) {
  const Vector3d d = cast<double>(direction);
  return d * (0.5 * dot(d, d) - 1.5);
}

// What holds the triangle that was hit, and how it stands in the scene.
struct Holder {
  const DomainView& content;
  bool is_object = false;
  Affine to_bundle;                   // of an object
  std::size_t corner[3] = {0, 1, 2};  // of the stored triangle that the placed one's come from

  explicit Holder(const DomainView& domain) : content(domain) {}
  Holder(const DomainView& object, const Affine& placed)
      : content(object),
        is_object(true),
        to_bundle(placed),
        corner{0, source_corner(mirrors(placed), 1), source_corner(mirrors(placed), 2)} {}

  Point3f stored(const Cluster& cluster, std::uint32_t lane, std::size_t k) const {
    const auto& v = cluster.vertex[corner[k]];
    return {v[0][lane], v[1][lane], v[2][lane]};
  }
  Point3f vertex(const Cluster& cluster, std::uint32_t lane, std::size_t k) const {
    const Point3f p = stored(cluster, lane, k);
    return is_object ? placed(to_bundle, p) : p;
  }
  std::uint32_t normal(const ClusterNormals& normals, std::uint32_t lane, std::size_t k) const {
    const std::uint32_t code = normals.normal[lane][corner[k]];
    return is_object ? placed_normal(to_bundle, code) : code;
  }
};

Holder holder_of(const DomainView& domain, const Hit& hit, double time_s) {
  if (hit.depth == 0) return Holder(domain);
  const DomainView* at = &domain;
  Affine to_bundle{};
  for (std::uint32_t i = 0; i < hit.depth; ++i) {
    const InstanceRef& ref = at->instances[hit.chain[i]];
    to_bundle = through_instance(i == 0 ? nullptr : &to_bundle, ref, *domain.objects[ref.object], time_s);
    at = domain.objects[ref.object];
  }
  return {*at, to_bundle};
}

Vector3d interpolated_normal(const Holder& holder, const Hit& hit) {
  const ClusterNormals& normals = holder.content.normals[hit.cluster];
  std::uint32_t code[3];
  for (std::size_t k = 0; k < 3; ++k) code[k] = holder.normal(normals, hit.lane, k);
  if (code[0] == no_normal) return {};
  const auto at = [&](int i) { return cast<double>(to_vector(decode_normal(code[i]))); };
  const Vector3d first = at(0);
  // Those of a flat face are one.
  return interpolated(hit, first, code[1] == code[0] ? first : at(1), code[2] == code[0] ? first : at(2));
}

// ∂p/∂u and ∂p/∂v of the plane through the corners.
void find_uv(const Holder& holder, const Hit& hit, Vector3d e1, Vector3d e2, double cone_width,
             Interaction& at) {
  const auto& uv = holder.content.uvs[hit.cluster].uv[hit.lane];
  const auto corner = [&](int i) {
    const auto& c = uv[holder.corner[i]];
    return Vector3d{c[0], c[1], 0};
  };
  const Vector3d here = interpolated(hit, corner(0), corner(1), corner(2));
  at.uv = {here.x, here.y};
  const Vector3d d1 = corner(1) - corner(0), d2 = corner(2) - corner(0);
  const double determinant = d1.x * d2.y - d1.y * d2.x;
  if (determinant == 0 || !std::isfinite(1 / determinant)) return;
  at.dpdu = (e1 * d2.y - e2 * d1.y) * (1 / determinant);
  at.dpdv = (e2 * d1.x - e1 * d2.x) * (1 / determinant);
  const double area = length(cross(e1, e2));
  if (cone_width > 0 && area > 0) at.uv_width = cone_width * std::sqrt(std::abs(determinant) / area);
}

// Of a triangle with such edges from p0, hit at p from `away`. Giants are not rounded as coarsely where they
// are near as at their corners.
double rounding_of(Vector3d normal, Point3d p0, Vector3d e1, Vector3d e2, Point3d p, double away) {
  const auto along = [&](int i) {
    const double corner = std::max({std::abs(p0[i]), std::abs(p0[i] + e1[i]), std::abs(p0[i] + e2[i])});
    return std::min(corner, std::abs(p[i]) + away);
  };
  return rounding_along(normal, {along(0), along(1), along(2)});
}

// A quadric has no mesh attributes: they are 0.
Interaction quadric_interaction(const Holder& holder, const Hit& hit, Vector3f direction, double cone_width,
                                std::uint32_t attributes, bool uvs_show) {
  const QuadricPoint point =
      quadric_point(*holder.content.quadric, holder.to_bundle, {hit.u, hit.v, hit.w}, uvs_show);
  Interaction at;
  at.p = point.p;
  at.out = back_along(direction);
  at.geometric = at.shading = point.normal;
  at.front = dot(at.out, at.geometric) > 0;
  at.rounding = rounding_along(at.geometric, at.p);
  at.triangle = hit.triangle;
  at.uv = point.uv;
  at.dpdu = point.dpdu, at.dpdv = point.dpdv;
  const double area = length(cross(at.dpdu, at.dpdv));
  if (cone_width > 0 && area > 0) at.uv_width = cone_width / std::sqrt(area);
  at.attribute_count = attributes;
  std::fill_n(at.attributes.begin(), attributes, AttributeValue{});
  return at;
}

Interaction triangle_interaction(const Holder& holder, const Hit& hit, Vector3f direction, double cone_width,
                                 std::uint32_t attributes) {
  const Cluster& cluster = holder.content.clusters[hit.cluster];
  const auto vertex = [&](std::size_t k) { return cast<double>(holder.vertex(cluster, hit.lane, k)); };
  const Point3d p0 = vertex(0);
  const Vector3d e1 = vertex(1) - p0, e2 = vertex(2) - p0;

  Interaction at;
  at.p = p0 + e1 * hit.u + e2 * hit.v;
  at.out = back_along(direction);
  at.geometric = normalize(cross(e1, e2));
  at.front = dot(at.out, at.geometric) > 0;
  at.rounding = rounding_of(at.geometric, p0, e1, e2, at.p, hit.t);
  at.triangle = hit.triangle;
  at.shading = at.geometric;
  if (!holder.content.normals.empty()) {
    Vector3d n = normalize(interpolated_normal(holder, hit));
    if (dot(n, at.geometric) < 0) n = -n;
    // A shading normal that the ray sees from the other side than the surface cannot be used.
    if ((dot(at.out, n) > 0) == at.front && dot(n, n) > 0.5) at.shading = n;
  }
  if (!holder.content.uvs.empty()) find_uv(holder, hit, e1, e2, cone_width, at);
  at.attribute_count = attributes;
  for (std::uint32_t slot = 0; slot < attributes; ++slot) {
    const auto& v = holder.content.attributes[hit.cluster * std::size_t{attributes} + slot].value[hit.lane];
    const auto u = static_cast<float>(hit.u), w = static_cast<float>(hit.v);
    at.attributes[slot].weights = {1 - u - w, u, w};
    for (std::size_t k = 0; k < 3; ++k)
      std::ranges::copy(v[holder.corner[k]], at.attributes[slot].corners[k].begin());
  }
  return at;
}

}  // namespace

Interaction make_interaction(const DomainView& domain, const Hit& hit, Vector3f direction, double cone_width,
                             std::uint32_t attributes, double time_s, bool uvs_show) {
  const Holder holder = holder_of(domain, hit, time_s);
  if (holder.content.quadric)
    return quadric_interaction(holder, hit, direction, cone_width, attributes, uvs_show);
  return triangle_interaction(holder, hit, direction, cone_width, attributes);
}

double normal_doubt(const DomainView& domain, const Hit& hit, bool shading, double vertex_doubt,
                    double time_s) {
  const Holder holder = holder_of(domain, hit, time_s);
  // Of a normal's code, of 16 bits a coordinate; a placed normal is coded twice.
  constexpr double code_rounding = 6.5e-5;
  if (holder.content.quadric) return 1e-12;
  if (shading) return holder.is_object ? 2 * code_rounding : code_rounding;

  const Cluster& cluster = holder.content.clusters[hit.cluster];
  std::array<Point3d, 3> p;
  for (std::size_t k = 0; k < 3; ++k) p[k] = cast<double>(holder.vertex(cluster, hit.lane, k));
  const Vector3d e1 = p[1] - p[0], e2 = p[2] - p[0], across = cross(e1, e2), normal = normalize(across);
  const auto& m = holder.to_bundle.m;
  const auto column = [&](std::size_t j) {
    return normal.x * m[0][j] + normal.y * m[1][j] + normal.z * m[2][j];
  };
  const Vector3d local_normal{column(0), column(1), column(2)};
  std::array<double, 3> off;
  for (std::size_t k = 0; k < 3; ++k) {
    off[k] = rounding_along(normal, p[k]);
    if (holder.is_object)
      off[k] += rounding_along(local_normal, cast<double>(holder.stored(cluster, hit.lane, k)));
  }
  const double decimals = vertex_doubt * (holder.is_object ? length(local_normal) : 1);
  return tilt_of(e1, e2, length(across), off) +
         std::min(tilt_of(e1, e2, length(across), {decimals, decimals, decimals}), most_of_decimals_rad);
}

}  // namespace vitrail
