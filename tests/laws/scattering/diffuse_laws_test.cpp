// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <fmt/format.h>

#include "tests/laws/scattering/bsdf_laws.h"
#include "tracer/bsdf/diffuse.h"

namespace vitrail::diffuse_laws_test {
namespace {

using laws::albedo;
using laws::subject;

void expect_all(const laws::Subject& s, const std::string& name) {
  laws::expect_laws(s, name);
  laws::expect_finite_at_extremes(s, name);
}

TEST(DiffuseLaws, LambertObeysThem) { expect_all(subject(LambertBsdf{filled(1)}), "Lambert"); }

TEST(DiffuseLaws, OrenNayarObeysThem) {
  for (double sigma : {0.0, 0.05, 0.1, 0.2, 0.35, 1.0})
    expect_all(subject(OrenNayarBsdf{filled(1), sigma}), fmt::format("Oren–Nayar σ = {}", sigma));
}

TEST(DiffuseLaws, DiffuseTransmissionObeysThem) {
  for (float t : {0.0f, 0.3f, 1.0f})
    expect_all(subject(DiffuseTransmissionBsdf{filled(1 - t), {{t, t / 2, 0, t}}}, true),
               fmt::format("diffuse transmission of {}", t));
}

TEST(DiffuseLaws, WhiteFurnace) {
  for (Vector3d out : laws::incidences()) {
    EXPECT_NEAR(albedo(subject(LambertBsdf{filled(1)}), out).mean, 1, 1e-6);
    EXPECT_NEAR(albedo(subject(DiffuseTransmissionBsdf{filled(0.75f), filled(0.25f)}, true), out).mean, 1,
                1e-6);
    EXPECT_NEAR(albedo(subject(OrenNayarBsdf{filled(0.7f), 0}), out).mean, 0.7, 1e-6);
  }
}

// Oren & Nayar 1994: the albedo by its integral in closed form,
// A + (2B/π)·(sinθ·(θ/2 − sin 2θ/4) + tanθ·(1 − sin³θ)/3).
TEST(DiffuseLaws, OrenNayarsAlbedoIsItsIntegral) {
  const double sigma = 0.5, s2 = sigma * sigma;
  const double a = 1 - s2 / (2 * (s2 + 0.33)), b = 0.45 * s2 / (s2 + 0.09);
  for (Vector3d out : laws::incidences()) {
    const double sine = std::hypot(out.x, out.y), theta = std::atan2(sine, out.z);
    const double integral =
        sine * (theta / 2 - std::sin(2 * theta) / 4) + sine / out.z * (1 - sine * sine * sine) / 3;
    const auto measured = albedo(subject(OrenNayarBsdf{filled(0.5f), sigma}), out);
    EXPECT_NEAR(measured.mean, 0.5 * (a + 2 * b / 3.14159265358979 * integral),
                2e-4 + 4 * measured.standard_error);
  }
}

}  // namespace
}  // namespace vitrail::diffuse_laws_test
