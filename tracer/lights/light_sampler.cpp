// SPDX-License-Identifier: Apache-2.0
#include "tracer/lights/light_sampler.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/geometry/portable_math.h"
#include "tracer/rays/rounding.h"
#include "tracer/sampling/wavelengths.h"

namespace vitrail {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

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

SampledSpectrum surface_radiance(const LightSampler& s, std::uint32_t area_light, const TexturePoint& at,
                                 const SampledWavelengths& wavelengths, LastLamp& last) {
  if (last.area_light == area_light) return last.radiance;
  const AreaLight& light = s.scene.area_lights[area_light];
  if (const auto* spectrum = std::get_if<Spectrum>(&light.radiance)) {
    last = {area_light, evaluate(*spectrum, wavelengths) * light.scale};
    return last.radiance;
  }
  if (!s.scene.textures) return filled(0);
  return s.scene.textures->spectrum(light.radiance, at, wavelengths) * light.scale;
}

// How much of the surface there is. None at all, everywhere: a light that nothing meets, and that shines as
// if it was whole.
float shining_share(const LightSampler& s, const FloatParameter& opacity, const TexturePoint& at) {
  if (const auto* constant = std::get_if<float>(&opacity))
    return is_invisible(opacity) ? 1 : std::clamp(*constant, 0.0f, 1.0f);
  if (!s.scene.textures) return 1;
  return static_cast<float>(std::clamp(s.scene.textures->number(opacity, at), 0.0, 1.0));
}

// What leaves a slot's surface, of which `point()` is an EmissivePoint.
template <class Point>
SampledSpectrum shining(const LightSampler& s, const LightSampler::Slot& t, const Point& point,
                        const SampledWavelengths& wavelengths, LastLamp& last) {
  const AreaLight& light = s.scene.area_lights[t.area_light];
  const auto all = [&](const TexturePoint& at) {
    return surface_radiance(s, t.area_light, at, wavelengths, last) * shining_share(s, t.opacity, at);
  };
  const bool constant =
      std::holds_alternative<Spectrum>(light.radiance) && std::holds_alternative<float>(t.opacity);
  return constant ? all({}) : all(point().point());
}

// Each of these fills in a sample whose values are those that it is made with, in place, as copies cost as
// much as the rest; false where nothing arrives.

// A directional light shines from where p lies on the triangle, seen along its normal.
bool draw_directional(const LightSampler& s, const LightSampler::Slot& t, Point3d p,
                      const SampledWavelengths& wavelengths, LastLamp& last, LightSample& sample) {
  const Edges edges(t.p);
  const LightSampler::Face face = s.face(t.light);
  if (!(face.area > 0)) return false;
  const AreaLight& light = s.scene.area_lights[t.area_light];
  const Vector3d from = p - edges.p0;
  const double height = dot(from, face.normal);
  if (height == 0 || (height < 0 && !light.two_sided)) return false;
  const auto [b1, b2] = edges.barycentric(from, face);
  if (b1 < 0 || b2 < 0 || b1 + b2 > 1) return false;
  sample.to_light = face.normal * (height > 0 ? -1.0 : 1.0);
  sample.distance = std::abs(height);
  sample.normal = face.normal;
  sample.radiance = shining(
      s, t, [&, x = b1, y = b2] { return EmissivePoint(s.scene, t.light, x, y); }, wavelengths, last);
  sample.pdf = 1;
  sample.is_delta = true;
  sample.light = t.area_light;
  return true;
}

// pdf: given the triangle. `choice`: in [0,1), of one of its parts.
bool draw_triangle(const LightSampler& s, const LightSampler::Slot& t, Point3d p, float u, float v,
                   double choice, const SampledWavelengths& wavelengths, LastLamp& last,
                   LightSample& sample) {
  const AreaLight& light = s.scene.area_lights[t.area_light];
  if (light.directional) return draw_directional(s, t, p, wavelengths, last, sample);

  const TriangleParts* parts = s.parts_of_triangle(t.light);
  const auto [b1, b2, density] = parts ? parts->choose(choice, u, v) : uniform_place(u, v);
  const Edges edges(t.p);
  const LightSampler::Face face = s.face(t.light);
  const Vector3d towards = (edges.p0 + edges.e1 * b1 + edges.e2 * b2) - p;
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
      s, t, [&, x = b1, y = b2] { return EmissivePoint(s.scene, t.light, x, y); }, wavelengths, last);
  sample.is_delta = is_invisible(t.opacity);
  sample.light = t.area_light;
  return true;
}

bool draw_quadric(const LightSampler& s, const LightSampler::Slot& t, Point3d p, float u, float v,
                  const SampledWavelengths& wavelengths, LastLamp& last, LightSample& sample) {
  const QuadricLight& quadric = s.quadrics[t.light - s.scene.triangles.size()];
  const auto drawn = quadric.sample(p, u, v);
  if (!drawn) return false;
  sample.to_light = drawn->to_light;
  sample.distance = drawn->distance;
  sample.normal = drawn->normal;
  sample.quadric = &quadric.record();
  sample.pdf = drawn->pdf;
  sample.radiance = shining(
      s, t, [&] { return EmissivePoint(quadric, drawn->local); }, wavelengths, last);
  sample.is_delta = is_invisible(t.opacity);
  sample.light = t.area_light;
  return true;
}

bool draw_emitter(const LightSampler& s, std::size_t index, Point3d p, const SampledWavelengths& wavelengths,
                  LightSample& sample) {
  const PointEmitter& e = s.emitters[index];
  const Vector3d towards = e.position - p;
  const double distance2 = dot(towards, towards);
  if (!(distance2 > 0)) return false;
  sample.distance = std::sqrt(distance2);
  sample.to_light = towards * (1 / sample.distance);
  sample.radiance =
      intensity(e, -sample.to_light, s.scene.textures, wavelengths) * static_cast<float>(1 / distance2);
  sample.pdf = 1;
  sample.is_delta = true;
  sample.light = s.emitter_light[index];
  return true;
}

bool draw_tree(const LightSampler& s, Point3d p, const std::array<float, 4>& u, double choice,
               const SampledWavelengths& wavelengths, LastLamp& last, LightSample& sample) {
  const auto chosen = s.tree.choose(p, choice);
  if (!chosen) return false;
  const LightSampler::Slot& slot = s.slots[chosen->slot];
  const std::size_t triangles = s.scene.triangles.size(), surfaces = triangles + s.quadrics.size();
  const bool drawn = slot.light < triangles
                         ? draw_triangle(s, slot, p, u[0], u[1], chosen->rest, wavelengths, last, sample)
                     : slot.light < surfaces ? draw_quadric(s, slot, p, u[0], u[1], wavelengths, last, sample)
                                             : draw_emitter(s, slot.light - surfaces, p, wavelengths, sample);
  sample.pdf *= chosen->probability * s.share[0];
  return drawn;
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

EmissivePoint::EmissivePoint(const QuadricLight& quadric, Point3d local) : at(quadric.texture_point(local)) {}

TexturePoint EmissivePoint::point() const {
  TexturePoint result = at;
  result.attributes = std::span(attributes).first(attribute_count);
  return result;
}

std::optional<LightSample> sample_light(const LightSampler& s, Point3d p, const std::array<float, 4>& u,
                                        const SampledWavelengths& wavelengths) {
  LastLamp last;
  return sample_light(s, p, u, {u[0], u[1]}, wavelengths, last);
}

Vector3d LightSampler::Distant::to_light(float u, float v) const {
  if (!sun) return -direction;
  return frame.to_world(sample_sun(*sun, static_cast<double>(u), static_cast<double>(v)));
}

SampledSpectrum LightSampler::Distant::irradiance_from(Vector3d to_light,
                                                       const SampledWavelengths& wavelengths) const {
  if (!sun) return evaluate(irradiance, wavelengths);
  return sun->sun(frame.to_light(to_light), wavelengths) *
         static_cast<float>(2 * pi * (1 - sun->sun_cosine()));
}

namespace {

bool draw_light(const LightSampler& s, Point3d p, const std::array<float, 4>& u,
                const std::array<float, 2>& far, const SampledWavelengths& wavelengths, LastLamp& last,
                LightSample& sample) {
  if (s.three_numbers) return draw_tree(s, p, u, static_cast<double>(u[2]), wavelengths, last, sample);
  if (s.share.empty()) return false;
  double rest = static_cast<double>(u[3]);
  std::size_t kind = 0;
  while (kind + 1 < s.share.size() && rest >= s.share[kind]) rest -= s.share[kind++];
  const double share = s.share[kind];
  if (!(share > 0)) return false;

  if (kind == 0) {
    // What is left of u[3] refines u[2]: 24 bits cannot reach every one of many lights.
    const double fine = std::clamp(rest / share, 0.0, 0x1.fffffp-1);
    const double choice = std::min(static_cast<double>(u[2]) + fine * 0x1p-24, 0x1.fffffffffffffp-1);
    return draw_tree(s, p, u, choice, wavelengths, last, sample);
  }
  if (kind <= s.distant.size()) {
    const LightSampler::Distant& distant = s.distant[kind - 1];
    sample.to_light = distant.to_light(far[0], far[1]);
    sample.distance = infinity;
    sample.radiance = distant.irradiance_from(sample.to_light, wavelengths);
    sample.pdf = share;
    sample.is_delta = true;
    sample.light = distant.light;
    return true;
  }
  const std::size_t index = kind - 1 - s.distant.size();
  const Environment& e = s.environments[index];
  sample.to_light = sample_direction(e, static_cast<double>(u[0]), static_cast<double>(u[1]));
  sample.distance = infinity;
  const Background seen = background(s, sample.to_light, wavelengths);
  if (!(seen.pdf > 0)) return false;
  sample.pdf = seen.pdf;
  sample.radiance = seen.radiance;
  sample.light = s.environment_light[index];
  return true;
}

}  // namespace

std::optional<LightSample> sample_light(const LightSampler& s, Point3d p, const std::array<float, 4>& u,
                                        const std::array<float, 2>& far,
                                        const SampledWavelengths& wavelengths, LastLamp& last) {
  std::optional<LightSample> sample(std::in_place);
  if (!draw_light(s, p, u, far, wavelengths, last, *sample)) sample.reset();
  return sample;
}

Variety variety(const LightSampler& s, Point3d p) {
  if (s.one_is_enough) return Variety::none;
  const Vector3d way = p - s.lamp_center;
  return s.lamp_radius2 > 0 && dot(way, way) > 16 * s.lamp_radius2 ? Variety::little : Variety::much;
}

double triangle_pdf(const LightSampler& s, Point3d from, std::uint32_t triangle, Point3d at, double distance,
                    double cosine) {
  const auto above =
      std::upper_bound(s.runs.begin(), s.runs.end(), triangle,
                       [](std::uint32_t id, const LightSampler::Run& r) { return id < r.first; });
  if (above == s.runs.begin() || s.share.empty()) return 0;
  const LightSampler::Run& run = *(above - 1);
  if (triangle - run.first >= run.count) return 0;
  const std::uint32_t index = run.index + (triangle - run.first);
  if (index >= s.scene.triangles.size())
    return s.share[0] * s.tree.probability(from, index) *
           s.quadrics[index - s.scene.triangles.size()].pdf(from, at, cosine);
  const EmissiveTriangle& t = s.scene.triangles[index];
  const AreaLight& light = s.scene.area_lights[t.area_light];
  if (light.directional || (cosine <= 0 && !light.two_sided)) return 0;
  const LightSampler::Face face = s.face(index);
  if (!(face.area > 0)) return 0;
  double density = s.share[0] * s.tree.probability(from, index);
  if (const TriangleParts* parts = s.parts_of_triangle(index)) {
    const Edges edges(t.p);
    const auto [b1, b2] = edges.barycentric(at - edges.p0, face);
    density *= parts->density(b1, b2);
  }
  return density * distance * distance / (std::max(std::abs(cosine), 1e-12) * face.area);
}

SampledSpectrum emitted(const LightSampler& s, std::uint32_t area_light, const TexturePoint& at,
                        double cosine, const SampledWavelengths& wavelengths, LastLamp& last) {
  const AreaLight& light = s.scene.area_lights[area_light];
  if (light.directional || (cosine <= 0 && !light.two_sided)) return filled(0);
  return surface_radiance(s, area_light, at, wavelengths, last);
}

SampledSpectrum emitted(const LightSampler& s, std::uint32_t area_light, const TexturePoint& at,
                        double cosine, const SampledWavelengths& wavelengths) {
  LastLamp last;
  return emitted(s, area_light, at, cosine, wavelengths, last);
}

SampledSpectrum leaving(const LightSampler& s, std::size_t light, const EmissivePoint& point,
                        const SampledWavelengths& wavelengths) {
  const std::size_t triangles = s.scene.triangles.size();
  LastLamp last;
  if (light >= triangles) {
    const EmissiveQuadric& q = s.quadrics[light - triangles].record();
    return surface_radiance(s, q.area_light, point.point(), wavelengths, last) *
           shining_share(s, q.opacity, point.point());
  }
  const SampledSpectrum radiance =
      surface_radiance(s, s.scene.triangles[light].area_light, point.point(), wavelengths, last);
  if (s.scene.opacities.empty()) return radiance;
  return radiance * shining_share(s, s.scene.opacities[light], point.point());
}

Background background(const LightSampler& s, Vector3d direction, const SampledWavelengths& wavelengths) {
  Background sum{filled(0)};
  for (const std::uint32_t i : s.infinite)
    sum.radiance =
        sum.radiance + evaluate(std::get<InfiniteLight>(s.scene.lights[i].model).radiance, wavelengths);
  for (std::size_t i = 0; i < s.environments.size(); ++i) {
    const EnvironmentValue value = value_towards(s.environments[i], direction, wavelengths);
    sum.radiance = sum.radiance + value.radiance;
    sum.pdf += s.share[1 + s.distant.size() + i] * value.pdf;
  }
  return sum;
}

SampledSpectrum discs(const LightSampler& s, Vector3d direction, const SampledWavelengths& wavelengths) {
  SampledSpectrum sum;
  for (const LightSampler::Distant& d : s.distant)
    if (const Vector3d local = d.frame.to_light(direction); d.sun && d.sun->meets_sun(local))
      sum = sum + d.sun->sun(local, wavelengths);
  return sum;
}

}  // namespace vitrail
