// SPDX-License-Identifier: Apache-2.0
// This file makes hits of a domain's own triangles ready for shading, as make_interaction does. Hits of
// instances, hits with a cone's width and hits with attributes are left to make_interaction.
#pragma once

#include "tracer/lanes/directions.h"
#include "tracer/lanes/domain_tables.h"
#include "tracer/rays/ray.h"

namespace vitrail::lanes {

namespace {

// It is vitrail::Interaction.
template <class D>
struct Interaction {
  Vector<D> p, out, geometric, shading;
  Vector<D> dpdu;  // 0 where the domain has no (u, v)
  D u, v;          // 0 there
  D rounding;
  D cosine;  // out · geometric
  Mask<D> front;
  VITRAIL_LANES D side() const { return select<D>(front, fill<D>(1), fill<D>(-1)); }
};

namespace detail {

template <class D>
VITRAIL_LANES Vector<D> interpolated(D u, D v, Vector<D> a, Vector<D> b, Vector<D> c) {
  return a * (1.0 - u - v) + b * u + c * v;
}

template <class D>
VITRAIL_LANES D rounding_along(Vector<D> unit, Vector<D> p) {
  return 0x1p-24 * (abs(unit.x * p.x) + abs(unit.y * p.y) + abs(unit.z * p.z));
}

template <class D>
VITRAIL_LANES D farthest_corner(D p0, D e1, D e2, D p, D away) {
  const D corner = lanes::max(lanes::max(abs(p0), abs(p0 + e1)), abs(p0 + e2));
  return lanes::min(corner, abs(p) + away);
}

template <class D, class DomainOf, class HitOf>
VITRAIL_LANES void find_shading_normal(const DomainOf& domain, const HitOf& hit, D u, D v,
                                       Interaction<D>& at) {
  using U = WordsLike<D>;
  const auto code = [&](int k) __attribute__((always_inline)) {
    return gather<U>([&](int j) __attribute__((always_inline)) {
      const ClusterNormals* const normals = domain(j).normals;
      return normals ? normals[hit(j).cluster].normal[hit(j).lane][k] : no_normal;
    });
  };
  const U first = code(0), second = code(1), third = code(2);
  const Mask<U> has = first != no_normal;
  if (!any(has)) return;
  const auto decoded = [](U c) __attribute__((always_inline)) { return to_doubles(decode_normal(c)); };
  const Vector<D> n0 = decoded(first);
  // The three normals of a flat face are one.
  const bool flat = all((second == first) & (third == first));
  Vector<D> n = normalize(interpolated(u, v, n0, flat ? n0 : decoded(second), flat ? n0 : decoded(third)));
  n = select<D>(dot(n, at.geometric) < 0, -n, n);
  const Mask<D> usable = ((dot(at.out, n) > 0) == at.front) & (dot(n, n) > 0.5) & mask_for<D>(has);
  at.shading = select<D>(usable, n, at.shading);
}

template <class D, class DomainOf, class HitOf>
VITRAIL_LANES void find_uv(const DomainOf& domain, const HitOf& hit, D hit_u, D hit_v, Vector<D> e1,
                           Vector<D> e2, Interaction<D>& at) {
  const auto number = [&](int corner, int k) __attribute__((always_inline)) {
    return to_doubles(gather<FloatsLike<D>>([&](int j) __attribute__((always_inline)) {
      const ClusterUvs* const uvs = domain(j).uvs;
      return uvs ? uvs[hit(j).cluster].uv[hit(j).lane][corner][k] : 0;
    }));
  };
  const D u0 = number(0, 0), u1 = number(1, 0), u2 = number(2, 0);
  const D v0 = number(0, 1), v1 = number(1, 1), v2 = number(2, 1);
  at.u = u0 * (1.0 - hit_u - hit_v) + u1 * hit_u + u2 * hit_v;
  at.v = v0 * (1.0 - hit_u - hit_v) + v1 * hit_u + v2 * hit_v;
  const D d1u = u1 - u0, d1v = v1 - v0, d2u = u2 - u0, d2v = v2 - v0;
  const D determinant = d1u * d2v - d1v * d2u, inverse = 1.0 / determinant;
  const Mask<D> spans = (determinant != 0) & (abs(inverse) <= std::numeric_limits<double>::max());
  at.dpdu = select<D>(spans, (e1 * d2v - e2 * d1v) * inverse, at.dpdu);
}

}  // namespace detail

// hit(j) is the vitrail::Hit of lane j, of depth 0, in domain(j). `direction` is that of the rays, decoded.
template <class D, class DomainOf, class HitOf>
VITRAIL_LANES Interaction<D> triangle_interaction(const DomainOf& domain, const HitOf& hit,
                                                  Vector<FloatsLike<D>> direction) {
  const auto vertex = [&](int k) __attribute__((always_inline)) {
    const auto coordinate = [&](int axis) __attribute__((always_inline)) {
      return to_doubles(gather<FloatsLike<D>>([&](int j) __attribute__((always_inline)) {
        return domain(j).clusters[hit(j).cluster].vertex[k][axis][hit(j).lane];
      }));
    };
    return Vector<D>{coordinate(0), coordinate(1), coordinate(2)};
  };
  const D u = gather<D>([&](int j) __attribute__((always_inline)) { return hit(j).u; });
  const D v = gather<D>([&](int j) __attribute__((always_inline)) { return hit(j).v; });
  const D t = gather<D>([&](int j) __attribute__((always_inline)) { return hit(j).t; });
  const Vector<D> p0 = vertex(0), e1 = vertex(1) - p0, e2 = vertex(2) - p0;
  const Vector<D> d = to_doubles(direction);

  Interaction<D> at;
  at.p = p0 + e1 * u + e2 * v;
  at.out = d * (0.5 * dot(d, d) - 1.5);
  at.geometric = normalize(cross(e1, e2));
  at.cosine = dot(at.out, at.geometric);
  at.front = at.cosine > 0;
  at.rounding =
      detail::rounding_along<D>(at.geometric, {detail::farthest_corner(p0.x, e1.x, e2.x, at.p.x, t),
                                               detail::farthest_corner(p0.y, e1.y, e2.y, at.p.y, t),
                                               detail::farthest_corner(p0.z, e1.z, e2.z, at.p.z, t)});
  at.shading = at.geometric;
  at.dpdu = fill<D>(Vector3d{});
  at.u = at.v = fill<D>(0);
  bool has_normals = false, has_uvs = false;
  for (int j = 0; j < width<D>; ++j) {
    has_normals |= domain(j).normals != nullptr;
    has_uvs |= domain(j).uvs != nullptr;
  }
  if (has_normals) detail::find_shading_normal(domain, hit, u, v, at);
  if (has_uvs) detail::find_uv(domain, hit, u, v, e1, e2, at);
  return at;
}

}  // namespace
}  // namespace vitrail::lanes
