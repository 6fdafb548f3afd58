// SPDX-License-Identifier: Apache-2.0
// Triangles as lights.
#include <algorithm>
#include <cmath>

#include "tracer/lights/draw_light.h"
#include "tracer/lights/surface_shine.h"
#include "tracer/rays/rounding.h"

namespace vitrail {

namespace {

// A triangle in doubles: a point of it is p0 + b₁e₁ + b₂e₂.
struct Edges {
  Point3d p0;
  Vector3d e1, e2;

  explicit Edges(std::span<const Point3f, 3> p) : p0(cast<double>(p[0])) {
    e1 = cast<double>(p[1]) - p0;
    e2 = cast<double>(p[2]) - p0;
  }
  // b₁, b₂ of the point over p0 + from, along the normal.
  std::array<double, 2> barycentric(Vector3d from, const LightSampler::Face& face) const {
    const double twice = 2 * face.area;
    return {dot(cross(from, e2), face.normal) / twice, dot(cross(e1, from), face.normal) / twice};
  }
};

// A directional light shines from where p lies on the triangle, seen along its normal.
bool draw_directional(const LightQuery& query, const LightSampler::Slot& t, LightSample& sample) {
  const LightSampler& s = query.lights;
  const Edges edges(t.p);
  const LightSampler::Face face = s.face(t.light.index);
  if (!(face.area > 0)) return false;
  const AreaLight& light = s.scene.area_lights[t.area_light];
  const Vector3d from = query.p - edges.p0;
  const double height = dot(from, face.normal);
  if (height == 0 || (height < 0 && !light.two_sided)) return false;
  const auto [b1, b2] = edges.barycentric(from, face);
  if (b1 < 0 || b2 < 0 || b1 + b2 > 1) return false;
  sample.to_light = face.normal * (height > 0 ? -1.0 : 1.0);
  sample.distance = std::abs(height);
  sample.normal = face.normal;
  sample.radiance = shining(
      s, t, [&, x = b1, y = b2] { return EmissivePoint(s.scene, t.light.index, x, y); }, query.wavelengths,
      query.last);
  sample.pdf = 1;
  sample.is_delta = true;
  sample.light = t.light;
  return true;
}

}  // namespace

LightSampler::Face::Face(std::span<const Point3f, 3> corners) {
  const Edges edges(corners);
  const Vector3d across = cross(edges.e1, edges.e2);
  const double twice = length(across);
  area = twice / 2;
  normal = twice > 0 ? across * (1 / twice) : across;
  const auto off = [&](Point3d p) { return rounding_along(normal, p); };
  tilt_rad = 2 * tilt_of(edges.e1, edges.e2, 2 * area,
                         {off(edges.p0), off(edges.p0 + edges.e1), off(edges.p0 + edges.e2)});
}

EmissivePoint::EmissivePoint(const LightScene& scene, std::size_t triangle, double b1, double b2) {
  const EmissiveTriangle& t = scene.triangles[triangle];
  const Edges edges(t.p);
  const double b0 = 1 - b1 - b2;
  const auto mix = [&](float x0, float x1, float x2) {
    return static_cast<double>(x0) * b0 + static_cast<double>(x1) * b1 + static_cast<double>(x2) * b2;
  };
  at = {{mix(t.uv[0].x, t.uv[1].x, t.uv[2].x), mix(t.uv[0].y, t.uv[1].y, t.uv[2].y)},
        edges.p0 + edges.e1 * b1 + edges.e2 * b2,
        LightSampler::Face(t.p).normal};
  const std::size_t slots = scene.attributes.size() / scene.triangles.size();
  for (; attribute_count < slots; ++attribute_count)
    attributes[attribute_count] = {scene.attributes[triangle * slots + attribute_count],
                                   {static_cast<float>(b0), static_cast<float>(b1), static_cast<float>(b2)}};
}

bool draw_triangle(const LightQuery& query, const LightSampler::Slot& t, double choice, LightSample& sample) {
  const LightSampler& s = query.lights;
  const AreaLight& light = s.scene.area_lights[t.area_light];
  if (light.directional) return draw_directional(query, t, sample);

  const float u = query.u[0], v = query.u[1];
  const TriangleParts* parts = s.parts_of_triangle(t.light.index);
  const auto [b1, b2, density] = parts ? parts->choose(choice, u, v) : uniform_place(u, v);
  const Edges edges(t.p);
  const LightSampler::Face face = s.face(t.light.index);
  const Vector3d towards = (edges.p0 + edges.e1 * b1 + edges.e2 * b2) - query.p;
  const double distance2 = dot(towards, towards);
  if (!(distance2 > 0)) return false;
  sample.distance = std::sqrt(distance2);
  sample.to_light = towards * (1 / sample.distance);
  const double cosine = -dot(sample.to_light, face.normal);  // > 0: its front is seen
  if (cosine == 0 || (cosine < 0 && !light.two_sided)) return false;
  sample.normal = face.normal;
  sample.tilt_rad = face.tilt_rad;
  sample.pdf = density * distance2 / (std::abs(cosine) * face.area);
  sample.radiance = shining(
      s, t, [&, x = b1, y = b2] { return EmissivePoint(s.scene, t.light.index, x, y); }, query.wavelengths,
      query.last);
  sample.is_delta = is_invisible(t.opacity);
  sample.light = t.light;
  return true;
}

double density_of_triangle(const LightSampler& s, std::uint32_t triangle, Point3d from, Point3d at,
                           double distance, double cosine) {
  const EmissiveTriangle& t = s.scene.triangles[triangle];
  const AreaLight& light = s.scene.area_lights[t.area_light];
  if (light.directional || (cosine <= 0 && !light.two_sided)) return 0;
  const LightSampler::Face face = s.face(triangle);
  if (!(face.area > 0)) return 0;
  double density = probability_in_tree(s, from, {LightKind::triangle, triangle});
  if (const TriangleParts* parts = s.parts_of_triangle(triangle)) {
    const Edges edges(t.p);
    const auto [b1, b2] = edges.barycentric(at - edges.p0, face);
    density *= parts->density(b1, b2);
  }
  return density * distance * distance / (std::max(std::abs(cosine), 1e-12) * face.area);
}

}  // namespace vitrail
