// SPDX-License-Identifier: Apache-2.0
#include "tracer/bsdf/principled.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scene/geometry/pi.h"

namespace vitrail::principled_test {
namespace {

struct Reference {
  int thin;
  double r, g, b, luminance, eta, roughness, anisotropic, metallic, spec_trans, spec_tint, sheen, sheen_tint,
      flatness, clearcoat, clearcoat_gloss, diff_trans;
  Vector3d out, in;
  double value[3];
};

constexpr Reference references[] = {
#include "tests/tracer/bsdf/principled_reference.inc"
};

SampledSpectrum color(const Reference& r) {
  return {{static_cast<float>(r.r), static_cast<float>(r.g), static_cast<float>(r.b), 0}};
}

SampledSpectrum value(const Reference& r) {
  if (r.thin)
    return eval(PrincipledThinBsdf{color(r), r.luminance, r.eta, r.roughness, r.anisotropic, r.spec_trans,
                                   r.spec_tint, r.sheen, r.sheen_tint, r.flatness, r.diff_trans},
                r.out, r.in)
        .value;
  return eval(PrincipledBsdf{color(r), r.luminance, r.eta, r.roughness, r.anisotropic, r.metallic,
                             r.spec_trans, r.spec_tint, r.sheen, r.sheen_tint, r.flatness, r.clearcoat,
                             r.clearcoat_gloss},
              r.out, r.in)
      .value;
}

TEST(Principled, AgreesWithMitsuba) {
  int lit = 0;
  for (const Reference& r : references) {
    const SampledSpectrum found = value(r);
    for (int i = 0; i < 3; ++i) {
      // Mitsuba's are single precision, which loses digits of narrow lobes.
      EXPECT_NEAR(static_cast<double>(found[i]), r.value[i], 1e-3 * std::abs(r.value[i]) + 1e-6)
          << "row " << &r - references << ", channel " << i;
      lit += r.value[i] > 0;
    }
  }
  EXPECT_GT(lit, 700);
}

// glTF 2.0, appendix B: mix(diffuse_brdf, specular_brdf, 0.04 + 0.96·(1 − |V·H|)⁵) of a dielectric, mixed
// with a metal of the base colour.
TEST(Principled, BelowIsTheModelOfGltf) {
  const double base = 0.5;
  for (const double roughness : {0.3, 0.7, 1.0})
    for (const double metallic : {0.0, 0.25})
      for (const double theta_out : {0.1, 0.8, 1.2})
        for (const double theta_in : {0.0, 0.5, 1.1}) {
          const Vector3d out{std::sin(theta_out), 0, std::cos(theta_out)},
              in{0, std::sin(theta_in), std::cos(theta_in)}, h = normalize(out + in);
          const double a2 = std::pow(roughness, 4), d = h.z * h.z * (a2 - 1) + 1;
          const auto masking = [&](double c) { return 2 * c / (c + std::sqrt(a2 + (1 - a2) * c * c)); };
          const double specular = a2 / (pi * d * d) * masking(out.z) * masking(in.z) / (4 * out.z * in.z),
                       weight = std::pow(1 - dot(out, h), 5), dielectric = 0.04 + 0.96 * weight,
                       metal = base + (1 - base) * weight;
          const double expected =
              std::lerp(std::lerp(base / pi, specular, dielectric), metal * specular, metallic) * in.z;
          const PrincipledBsdf bsdf{.base_color = filled(static_cast<float>(base)),
                                    .roughness = roughness,
                                    .metallic = metallic,
                                    .below = true};
          // Its Fresnel factor is Schlick's; ours is exact.
          EXPECT_NEAR(static_cast<double>(eval(bsdf, out, in).value[0]), expected, 0.015 * expected)
              << roughness << ' ' << metallic << ' ' << theta_out << ' ' << theta_in;
        }
}

TEST(Principled, BelowASheetToo) {
  const PrincipledThinBsdf sheet{.base_color = filled(1), .roughness = 1, .below = true};
  const Vector3d up{0, 0, 1}, in{std::sin(1.4), 0, std::cos(1.4)};
  const double expected = 0.96 * in.z / pi;
  EXPECT_NEAR(static_cast<double>(eval(sheet, up, in).value[0]), expected, 0.04 * expected);
}

}  // namespace
}  // namespace vitrail::principled_test
