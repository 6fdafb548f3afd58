// SPDX-License-Identifier: Apache-2.0
// Quadrics as lights; QuadricLight has their geometry.
#include "tracer/lights/draw_light.h"
#include "tracer/lights/surface_shine.h"

namespace vitrail {

EmissivePoint::EmissivePoint(const QuadricLight& quadric, Point3d local) : at(quadric.texture_point(local)) {}

bool draw_quadric(const LightQuery& query, const LightSampler::Slot& t, LightSample& sample) {
  const QuadricLight& quadric = query.lights.quadrics[t.light.index];
  const auto drawn = quadric.sample(query.p, query.u[0], query.u[1]);
  if (!drawn) return false;
  sample.to_light = drawn->to_light;
  sample.distance = drawn->distance;
  sample.normal = drawn->normal;
  sample.quadric = &quadric.record();
  sample.pdf = drawn->pdf;
  sample.radiance = shining(
      query.lights, t, [&] { return EmissivePoint(quadric, drawn->local); }, query.wavelengths, query.last);
  sample.is_delta = is_invisible(t.opacity);
  sample.light = t.light;
  return true;
}

double density_of_quadric(const LightSampler& s, std::uint32_t quadric, Point3d from, Point3d at,
                          double cosine) {
  return probability_in_tree(s, from, {LightKind::quadric, quadric}) *
         s.quadrics[quadric].pdf(from, at, cosine);
}

}  // namespace vitrail
