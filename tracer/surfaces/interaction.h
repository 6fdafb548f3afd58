// SPDX-License-Identifier: Apache-2.0
// An Interaction is a hit made ready for shading.
#pragma once

#include <array>
#include <span>

#include "bundle/manifest.h"
#include "tracer/rays/ray.h"
#include "tracer/textures/textures.h"

namespace vitrail {

struct Interaction {
  Point3d p;
  Vector3d out;        // unit, back along the ray
  Vector3d geometric;  // unit normal of the front side
  Vector3d shading;    // unit, on the same side as `geometric`
  std::uint32_t triangle = no_triangle;
  bool front = false;  // the ray came from the front side
  // It is how far floats may have moved the surface along its normal. The corners count, which may be farther
  // from 0 than p, as far as they matter where the ray comes from.
  double rounding = 0;
  // It is the index in front of a dielectric with a priority; null: the material's own.
  const Spectrum* exterior_eta = nullptr;

  // They are set on surfaces that textures are looked up on.
  Point2d uv;
  Vector3d dpdu, dpdv;  // 0 where the triangle's (u,v) do not span a plane
  double uv_width = 0;  // of the ray's cone
  std::uint32_t attribute_count = 0;
  std::array<AttributeValue, max_attributes> attributes;

  double side() const { return front ? 1 : -1; }
  TexturePoint texture_point() const {
    return {uv, p, shading, uv_width, std::span(attributes).first(attribute_count), side()};
  }
};

// `domain` holds the hit. `direction` is the ray's, decoded, `cone_width` its cone's at the hit (0: none),
// and `time_s` its time, where anything moves. `uvs_show` says that some texture or picture reads (u,v);
// otherwise those of quadrics may be 0.
Interaction make_interaction(const DomainView& domain, const Hit& hit, Vector3f direction, double cone_width,
                             std::uint32_t attributes, double time_s = 0, bool uvs_show = true);

// Returns the angle, in rad, by which rounding can turn the normal. It is that of the stored shading normal,
// or that of the surface, whose vertices may stand `vertex_doubt` off beside (Surface). Decimals count up to
// `most_of_decimals_rad`.
double normal_doubt(const DomainView& domain, const Hit& hit, bool shading, double vertex_doubt,
                    double time_s = 0);

// A face that decimals make less certain than this is taken as it is. A pane's two faces together then turn
// light by less than the radius of the sun's disc.
inline constexpr double most_of_decimals_rad = 0x1p-8;

}  // namespace vitrail
