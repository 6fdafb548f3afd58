// SPDX-License-Identifier: Apache-2.0
// These functions map a point of a surface to the (s,t) of a texture.
#pragma once

#include "scene/geometry/portable_math.h"
#include "scene/records/texture.h"

namespace vitrail {

// It is a TextureMapping as it is looked up: transforms inverted.
struct PreparedMapping {
  TextureMapping mapping;
  Transform world_to_texture;  // of all but uv
};

// Returns the mapping of (u, v, 0) to the (s,t) of a texture, which is the inverse of its transform.
inline UvMapping uv_mapping(const Transform& texture_to_uv) {
  const Transform m = inverse(texture_to_uv);
  const auto at = [&](std::size_t row, std::size_t column) { return static_cast<float>(m.m[row][column]); };
  return {at(0, 0), at(0, 1), at(0, 3), at(1, 0), at(1, 1), at(1, 3)};
}

struct MappedPoint {
  double s = 0, t = 0;
};

inline MappedPoint map_point(const PreparedMapping& prepared, Point2d uv, Point3d p) {
  if (const auto* m = std::get_if<UvMapping>(&prepared.mapping))
    return {static_cast<double>(m->a) * uv.x + static_cast<double>(m->b) * uv.y + static_cast<double>(m->c),
            static_cast<double>(m->d) * uv.x + static_cast<double>(m->e) * uv.y + static_cast<double>(m->f)};
  const Point3d q = transform_point(prepared.world_to_texture, p);
  if (const auto* m = std::get_if<PlanarMapping>(&prepared.mapping)) {
    const Vector3d v{q.x, q.y, q.z};
    return {m->offset_s + dot(v, m->v1), m->offset_t + dot(v, m->v2)};
  }
  const double turn = portable_atan2(q.y, q.x) / (2 * pi);
  const double r = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z), z = r > 0 ? q.z / r : 1;
  if (const auto* m = std::get_if<CylindricalMapping>(&prepared.mapping))
    return {0.5 + turn, m->of_direction ? z : q.z};
  const double down = portable_acos(z) / pi, around = turn < 0 ? turn + 1 : turn;
  if (std::holds_alternative<GlobeMapping>(prepared.mapping)) return {around, 1 - down};
  return {down, around};
}

// Returns the greatest size in (s,t) of a circle of diameter 1 in uv, along s and t; 0 where it is not known.
inline MappedPoint stretch(const TextureMapping& mapping) {
  const auto* m = std::get_if<UvMapping>(&mapping);
  if (!m) return {};
  const auto norm = [](float x, float y) {
    return std::sqrt(static_cast<double>(x) * static_cast<double>(x) +
                     static_cast<double>(y) * static_cast<double>(y));
  };
  return {norm(m->a, m->b), norm(m->d, m->e)};
}

}  // namespace vitrail
