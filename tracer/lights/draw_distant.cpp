// SPDX-License-Identifier: Apache-2.0
// Light of one direction, and suns.
#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/geometry/portable_math.h"
#include "tracer/lights/draw_light.h"
#include "tracer/sampling/wavelengths.h"

namespace vitrail {

namespace {

// Of the sun's disc, rad: its mean over the year.
constexpr double disc_radius_rad = 0.2666 * radian;

// A point of a disc around the direction, uniform over it.
Vector3d on_disc(Vector3d middle, double u, double v) {
  const Vector3d x =
      normalize(cross(std::abs(middle.z) < 0.9 ? Vector3d{0, 0, 1} : Vector3d{1, 0, 0}, middle));
  const double out = portable_sin(disc_radius_rad) * std::sqrt(u);
  return normalize(middle + x * (out * sin_pi(2 * v + 0.5)) + cross(middle, x) * (out * sin_pi(2 * v)));
}

// What of a row's part of [0,1) is not used at its ends: rounding to a float cannot leave the row.
constexpr double unused = 1.0 / 64;

}  // namespace

float LightSampler::number_of_row(std::size_t row, std::size_t rows, float u) {
  const double within = unused + (1 - 2 * unused) * static_cast<double>(u);
  return static_cast<float>((static_cast<double>(row) + within) / static_cast<double>(rows));
}

Vector3d LightSampler::Distant::to_light(float u, float v) const {
  if (!rows.empty()) {
    const double place = static_cast<double>(u) * static_cast<double>(rows.size());
    const std::size_t row = std::min(static_cast<std::size_t>(place), rows.size() - 1);
    const double within = (place - static_cast<double>(row) - unused) / (1 - 2 * unused);
    return on_disc(rows[row], std::clamp(within, 0.0, 1.0), static_cast<double>(v));
  }
  if (!sun) return -direction;
  return frame.to_world(sample_sun(*sun, static_cast<double>(u), static_cast<double>(v)));
}

SampledSpectrum LightSampler::Distant::irradiance_from(Vector3d to_light,
                                                       const SampledWavelengths& wavelengths) const {
  if (!sun) return evaluate(irradiance, wavelengths);
  return sun->sun(frame.to_light(to_light), wavelengths) *
         static_cast<float>(2 * pi * (1 - sun->sun_cosine()));
}

bool draw_distant(const LightQuery& query, std::uint32_t index, LightSample& sample) {
  const LightSampler::Distant& distant = query.lights.distant[index];
  sample.to_light = distant.to_light(query.far[0], query.far[1]);
  sample.distance = std::numeric_limits<double>::infinity();
  sample.radiance = distant.irradiance_from(sample.to_light, query.wavelengths);
  sample.pdf = 1;
  sample.is_delta = true;
  sample.light = {LightKind::distant, index};
  return true;
}

SampledSpectrum discs(const LightSampler& s, Vector3d direction, const SampledWavelengths& wavelengths) {
  SampledSpectrum sum;
  for (const std::uint32_t i : s.suns)
    if (const LightSampler::Distant& d = s.distant[i]; d.sun->meets_sun(d.frame.to_light(direction)))
      sum = sum + d.sun->sun(d.frame.to_light(direction), wavelengths);
  return sum;
}

}  // namespace vitrail
