// SPDX-License-Identifier: Apache-2.0
#include "tracer/interaction.h"

#include <algorithm>
#include <cmath>

namespace vitrail {

namespace {

// Of three values at the corners.
template <class V>
V interpolated(const Hit& hit, const V& a, const V& b, const V& c) {
  return a * (1 - hit.u - hit.v) + b * hit.u + c * hit.v;
}

Vector3d interpolated_normal(const ClusterNormals& normals, const Hit& hit) {
  const auto& code = normals.normal[hit.lane];
  if (code[0] == no_normal) return {};
  const auto at = [&](int i) { return cast<double>(to_vector(decode_normal(code[i]))); };
  return interpolated(hit, at(0), at(1), at(2));
}

// ∂p/∂u and ∂p/∂v of the plane through the corners.
void find_uv(const ClusterUvs& uvs, const Hit& hit, Vector3d e1, Vector3d e2, double cone_width,
             Interaction& at) {
  const auto& uv = uvs.uv[hit.lane];
  const auto corner = [&](int i) { return Vector3d{uv[i][0], uv[i][1], 0}; };
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

}  // namespace

Interaction make_interaction(const DomainView& domain, const Hit& hit, Vector3f direction, double cone_width,
                             std::uint32_t attributes) {
  const Cluster& cluster = domain.clusters[hit.cluster];
  const auto vertex = [&](int i) {
    const auto& v = cluster.vertex[i];
    return cast<double>(Point3f{v[0][hit.lane], v[1][hit.lane], v[2][hit.lane]});
  };
  const Point3d p0 = vertex(0);
  const Vector3d e1 = vertex(1) - p0, e2 = vertex(2) - p0;

  Interaction at;
  at.p = p0 + e1 * hit.u + e2 * hit.v;
  at.out = normalize(-cast<double>(direction));
  at.geometric = normalize(cross(e1, e2));
  at.front = dot(at.out, at.geometric) > 0;
  at.triangle = hit.triangle;
  at.shading = at.geometric;
  if (!domain.normals.empty()) {
    Vector3d n = normalize(interpolated_normal(domain.normals[hit.cluster], hit));
    if (dot(n, at.geometric) < 0) n = -n;
    // A shading normal that the ray sees from the other side than the surface cannot be used.
    if ((dot(at.out, n) > 0) == at.front && dot(n, n) > 0.5) at.shading = n;
  }
  if (!domain.uvs.empty()) find_uv(domain.uvs[hit.cluster], hit, e1, e2, cone_width, at);
  at.attribute_count = attributes;
  for (std::uint32_t slot = 0; slot < attributes; ++slot) {
    const auto& v = domain.attributes[hit.cluster * std::size_t{attributes} + slot].value[hit.lane];
    const auto u = static_cast<float>(hit.u), w = static_cast<float>(hit.v);
    at.attributes[slot].weights = {1 - u - w, u, w};
    for (std::size_t k = 0; k < 3; ++k) std::ranges::copy(v[k], at.attributes[slot].corners[k].begin());
  }
  return at;
}

}  // namespace vitrail
