// SPDX-License-Identifier: Apache-2.0
#include "tracer/lights.h"

#include <limits>

#include "tracer/portable_math.h"

namespace vitrail {

namespace {

double area(const EmissiveTriangle& t) {
  return 0.5 * length(cross(cast<double>(t.p[1]) - cast<double>(t.p[0]),
                            cast<double>(t.p[2]) - cast<double>(t.p[0])));
}

}  // namespace

LightSampler make_light_sampler(const Manifest& manifest) {
  LightSampler s;
  for (std::uint32_t i = 0; i < manifest.lights.size(); ++i)
    (std::holds_alternative<bundle::InfiniteLight>(manifest.lights[i]) ? s.infinite : s.delta).push_back(i);

  std::vector<double> brightness;
  for (const bundle::AreaLight& light : manifest.area_lights) brightness.push_back(luminance(light.radiance));
  s.cumulative.push_back(0);
  for (std::uint32_t i = 0; i < manifest.emissive_triangles.size(); ++i) {
    const EmissiveTriangle& t = manifest.emissive_triangles[i];
    const double power = area(t) * brightness[t.area_light];
    if (!(power > 0)) continue;
    s.triangles.push_back(i);
    s.cumulative.push_back(s.cumulative.back() + power);
  }
  const double total = s.cumulative.back();
  s.area_pdf.assign(manifest.area_lights.size(), 0);
  if (s.triangles.empty()) return s;
  for (double& c : s.cumulative) c /= total;
  for (std::size_t i = 0; i < brightness.size(); ++i)
    s.area_pdf[i] = static_cast<float>(brightness[i] / total / static_cast<double>(s.choices()));
  return s;
}

namespace {

std::optional<LightSample> sample_triangle(const LightSampler& s, const Manifest& manifest, Point3d p,
                                           const std::array<float, 4>& u,
                                           const SampledWavelengths& wavelengths) {
  const auto above =
      std::upper_bound(s.cumulative.begin() + 1, s.cumulative.end() - 1, static_cast<double>(u[2]));
  const auto at = static_cast<std::size_t>(above - s.cumulative.begin()) - 1;
  const EmissiveTriangle& t = manifest.emissive_triangles[s.triangles[at]];
  const bundle::AreaLight& light = manifest.area_lights[t.area_light];

  // Uniform on the triangle (Heitz 2019): a low-distortion map of the square.
  double b0 = static_cast<double>(u[0]) / 2, b1 = static_cast<double>(u[1]) / 2;
  const double offset = b1 - b0;
  if (offset > 0)
    b1 += offset;
  else
    b0 -= offset;
  const Point3d p0 = cast<double>(t.p[0]);
  const Vector3d e1 = cast<double>(t.p[1]) - p0, e2 = cast<double>(t.p[2]) - p0;
  const Vector3d towards = (p0 + e1 * b0 + e2 * b1) - p;
  const double distance = length(towards);
  if (!(distance > 0)) return std::nullopt;

  LightSample sample;
  sample.to_light = towards * (1 / distance);
  sample.distance = distance;
  const double cosine = -dot(sample.to_light, normalize(cross(e1, e2)));  // > 0: its front is seen
  if (cosine == 0 || (cosine < 0 && !light.two_sided)) return std::nullopt;
  sample.pdf = static_cast<double>(s.area_pdf[t.area_light]) * distance * distance / std::abs(cosine);
  sample.radiance = evaluate(light.radiance, wavelengths);
  return sample;
}

}  // namespace

std::optional<LightSample> sample_light(const LightSampler& s, const Manifest& manifest, Point3d p,
                                        const std::array<float, 4>& u,
                                        const SampledWavelengths& wavelengths) {
  const std::size_t choices = s.choices();
  if (choices == 0) return std::nullopt;
  const auto choice = std::min(static_cast<std::size_t>(u[3] * static_cast<float>(choices)), choices - 1);
  if (choice == s.delta.size()) return sample_triangle(s, manifest, p, u, wavelengths);

  LightSample sample;
  sample.is_delta = true;
  sample.pdf = 1 / static_cast<double>(choices);
  const bundle::Light& light = manifest.lights[s.delta[choice]];
  if (const auto* distant = std::get_if<bundle::DistantLight>(&light)) {
    sample.to_light = -distant->direction;
    sample.distance = std::numeric_limits<double>::infinity();
    sample.radiance = evaluate(distant->irradiance, wavelengths);
    return sample;
  }
  const auto& point = std::get<bundle::PointLight>(light);
  const Vector3d towards = point.position - p;
  sample.distance = length(towards);
  if (!(sample.distance > 0)) return std::nullopt;
  sample.to_light = towards * (1 / sample.distance);
  sample.radiance =
      evaluate(point.intensity, wavelengths) * static_cast<float>(1 / (sample.distance * sample.distance));
  return sample;
}

SampledSpectrum sky_radiance(const LightSampler& s, const Manifest& manifest,
                             const SampledWavelengths& wavelengths) {
  SampledSpectrum sum;
  for (std::uint32_t i : s.infinite)
    sum = sum + evaluate(std::get<bundle::InfiniteLight>(manifest.lights[i]).radiance, wavelengths);
  return sum;
}

bool points_at_distant_light(const LightSampler& s, const Manifest& manifest, Vector3d direction) {
  // Each refraction rounds the direction by about 1.2e-7; a pane makes two.
  constexpr double tolerance = 4e-6;
  for (std::uint32_t i : s.delta)
    if (const auto* distant = std::get_if<bundle::DistantLight>(&manifest.lights[i]))
      if (length(direction + distant->direction) < tolerance) return true;
  return false;
}

}  // namespace vitrail
