// SPDX-License-Identifier: Apache-2.0
#include "importers/writing/spot_falloff.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vitrail {

namespace {

constexpr double radians = std::numbers::pi / 180;

// 1 within the beam, 0 from the cutoff on.
struct Profile {
  double beam_rad, cutoff_rad;
  SpotLight::Falloff falloff;

  double operator()(double theta_rad) const {
    if (theta_rad <= beam_rad) return 1;
    if (theta_rad >= cutoff_rad) return 0;
    if (falloff == SpotLight::Falloff::linear) return (cutoff_rad - theta_rad) / (cutoff_rad - beam_rad);
    const double edge = std::cos(cutoff_rad), t = (std::cos(theta_rad) - edge) / (std::cos(beam_rad) - edge);
    return falloff == SpotLight::Falloff::quartic ? t * t * t * t : t * t * (3 - 2 * t);
  }
};

// Of −df as a density: its mean over the cosine, which is 1 − flux ÷ 2π, and its variances.
struct Moments {
  double mean_cosine = 0, cosine_variance = 0, angle_variance = 0;
};

Moments moments_of(const Profile& profile) {
  constexpr int steps = 4096;
  double angle = 0, angle2 = 0, cosine = 0, cosine2 = 0;
  for (int i = 0; i < steps; ++i) {
    const auto at = [&](double k) {
      return profile.beam_rad + (profile.cutoff_rad - profile.beam_rad) * k / steps;
    };
    const double share = profile(at(i)) - profile(at(i + 1)), theta = at(i + 0.5);
    angle += share * theta, angle2 += share * theta * theta;
    cosine += share * std::cos(theta), cosine2 += share * std::cos(theta) * std::cos(theta);
  }
  return {cosine, std::max(cosine2 - cosine * cosine, 0.0), std::max(angle2 - angle * angle, 0.0)};
}

// A smoothstep of the cosine from a to b has the mean (a + b)/2 and the variance (b − a)²/20.
Profile smoothstep_of(const Moments& m) {
  const double half = std::min(std::sqrt(5 * m.cosine_variance), 1 - m.mean_cosine);
  return {std::acos(std::clamp(m.mean_cosine + half, -1.0, 1.0)),
          std::acos(std::clamp(m.mean_cosine - half, -1.0, 1.0)), SpotLight::Falloff::smoothstep};
}

// Uniform from a to b: the variance (b − a)²/12, the mean cosine (sin b − sin a)/(b − a).
Profile linear_of(const Moments& m) {
  const double width = std::sqrt(12 * m.angle_variance);
  const auto ends = [&](double middle) {
    const double beam = std::max(middle - width / 2, 0.0);
    return Profile{beam, std::max(2 * middle - beam, beam), SpotLight::Falloff::linear};
  };
  const auto mean_cosine = [&](double middle) {
    const Profile p = ends(middle);
    const double size = p.cutoff_rad - p.beam_rad;
    return size < 1e-9 ? std::cos(middle) : (std::sin(p.cutoff_rad) - std::sin(p.beam_rad)) / size;
  };
  double low = 0, high = std::numbers::pi / 2;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (mean_cosine(middle) > m.mean_cosine ? low : high) = middle;
  }
  return ends(high);
}

}  // namespace

double spot_falloff(const SpotLight& light, double theta_rad) {
  return Profile{radians * static_cast<double>(light.beam_deg),
                 radians * static_cast<double>(light.cutoff_deg), light.falloff}(theta_rad);
}

MatchedSpot matched_spot(const SpotLight& light, SpotLight::Falloff to) {
  const Profile given{static_cast<double>(light.beam_deg) * radians,
                      static_cast<double>(light.cutoff_deg) * radians, light.falloff};
  if (to == light.falloff || !(given.beam_rad < given.cutoff_rad))
    return {static_cast<double>(light.beam_deg), static_cast<double>(light.cutoff_deg), 0};
  const Moments moments = moments_of(given);
  const Profile made = to == SpotLight::Falloff::linear ? linear_of(moments) : smoothstep_of(moments);
  double difference = 0;
  const double most = std::max(given.cutoff_rad, made.cutoff_rad);
  for (int i = 0; i <= 1000; ++i)
    difference = std::max(difference, std::abs(given(most * i / 1000) - made(most * i / 1000)));
  return {made.beam_rad / radians, made.cutoff_rad / radians, difference};
}

}  // namespace vitrail
