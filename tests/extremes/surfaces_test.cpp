// SPDX-License-Identifier: Apache-2.0
// Surfaces and media that reflect nearly all, and nearly like mirrors.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scene/geometry/portable_math.h"
#include "tests/extremes/measure.h"
#include "tracer/bsdf/microfacet.h"
#include "tracer/rays/ray_records.h"

namespace vitrail::test::surfaces_test {
namespace {

Material metal(float alpha) {
  ConductorMaterial m;
  m.metal = PerfectReflector{};
  m.roughness.alpha_u = m.roughness.alpha_v = alpha;
  return {m};
}

// A floor of it, from straight above the middle; the camera looks down at 45° along +x.
Scene floor_of(const Material& material) {
  Scene scene;
  add_shape(scene, add_quads(scene, {square_at(0, 4)}), material);
  set_orthographic(scene, {-3, 0, 3}, {0, 0, 0}, {0, 1, 0}, 0.1, 16);
  scene.settings.max_depth = 2;
  return scene;
}

// A lamp of radiance 1, half of which the mirror shows.
void add_lamp(Scene& scene) {
  add_shape(scene, add_quads(scene, {{{{3, -1, 2}, {3, 0, 2}, {3, 0, 4}, {3, -1, 4}}}}), matte(0),
            lamp(1, true));
}

constexpr float roughnesses[] = {1e-5f, 1e-7f, 1e-40f};

// What is narrower than `least_alpha` has that, which blurs by 2·10⁻⁴ rad: 4.2 away, by a fifteenth of a
// pixel.
TEST(Roughness, NextToNoneLooksLikeAMirror) {
  Scene mirror = floor_of(metal(0));
  add_lamp(mirror);
  const Film smooth = render_finite(mirror, 64, "mirror").film;
  expect_absolute("mirror: half of the picture shows a lamp of 1", 0.5, measured(smooth).mean, 1e-3);
  for (const float alpha : roughnesses) {
    Scene scene = floor_of(metal(alpha));
    add_lamp(scene);
    const Film film = render_finite(scene, 64).film;
    const FilmDifference d = picture_difference(smooth, film);
    expect_absolute(fmt::format("roughness {:.0e} against a mirror: mean", alpha), 0, d.mean, 5e-3);
    expect_absolute(fmt::format("roughness {:.0e} against a mirror: pixels, r.m.s.", alpha), 0,
                    d.root_mean_square, 3e-2);
  }
}

TEST(Roughness, NextToNoneLosesNothing) {
  for (const float alpha : roughnesses) {
    Scene scene = floor_of(metal(alpha));
    add_sky(scene, 1);
    expect_relative(fmt::format("roughness {:.0e} under a sky of 1", alpha), 1, measure(scene, 64).mean,
                    2e-5);
    DielectricMaterial glass;
    glass.roughness.alpha_u = glass.roughness.alpha_v = alpha;
    Scene box;
    add_shape(box, add_quads(box, box_faces({-0.5f, -0.5f, -0.5f}, {0.5f, 0.5f, 0.5f})), Material{glass});
    add_sky(box, 1);
    set_camera(box, {1.3, 1.7, -2}, {0, 0, 0}, {0, 1, 0}, 0.5, 16, 16);
    box.settings.max_depth = 100;
    const Measured b = measure(box, 256);
    expect_relative(fmt::format("a box of glass of roughness {:.0e} under a sky of 1", alpha), 1, b.mean,
                    1e-4, b.standard_error);
  }
}

// Seen along the mirrored sun, GGX reflects L = E·D(0)·G/(4·cosθ) with D(0) = 1/(πα²) and, of both directions
// at 45°, G = 1/(1 + Λ)², Λ = (√(1 + α²) − 1)/2 (Heitz 2014, Eq. 72).
TEST(Roughness, HighlightOfTheSun) {
  for (const double alpha : {1e-2, 1e-3, 1e-4, 1e-5}) {
    Scene scene = floor_of(metal(static_cast<float>(alpha)));
    add_sun(scene, normalize(Vector3d{-1, 0, -1}), 1);
    scene.settings.max_depth = 1;
    const double kept = std::max(alpha, least_alpha), cosine = std::sqrt(0.5);
    const double lambda = (std::sqrt(1 + kept * kept) - 1) / 2;
    const double expected = 1 / (pi * kept * kept) / (4 * cosine) / ((1 + lambda) * (1 + lambda));
    expect_relative(fmt::format("highlight of the sun, roughness {:.0e}", alpha), expected,
                    measure(scene, 4).mean, 2e-5);
  }
}

constexpr float nearly_one = 1 - 1e-7f;  // 1 − 2⁻²³: the albedo
constexpr int deepest = std::min(max_path_depth, 100000);

// A box whose walls emit 1, from inside: Σ ρᵏ for k = 0 … depth.
TEST(Albedo, ClosedBoxOfNearlyOne) {
  for (const int depth : {100, deepest}) {
    Scene scene;
    auto faces = box_faces({-1, -1, -1}, {1, 1, 1});
    for (auto& face : faces) std::swap(face[1], face[3]);  // fronts inwards
    add_shape(scene, add_quads(scene, faces), matte(nearly_one), lamp(1));
    set_camera(scene, {0.1, 0.2, -0.3}, {0.4, 0, 1}, {0, 1, 0}, 1.2, 8, 8);
    scene.settings.max_depth = depth;
    const long double rho = nearly_one;
    const auto expected = static_cast<double>((1 - std::pow(rho, depth + 1.0L)) / (1 - rho));
    const Measured b = measure(scene, std::max(1, 4096 / depth));
    expect_relative(fmt::format("box of albedo 1 − 10⁻⁷, depth {}", depth), expected, b.mean, 2e-5,
                    b.standard_error);
  }
}

// A cloud of it under a sky of 1 loses 10⁻⁷ at each scattering: nothing that is seen.
TEST(Albedo, CloudOfNearlyOne) {
  Scene scene;
  Medium medium;
  medium.coefficients =
      ExtinctionAlbedo{Spectrum{ConstantSpectrum{4}}, Spectrum{ConstantSpectrum{nearly_one}}};
  scene.media.push_back(medium);
  add_shape(scene, add_quads(scene, box_faces({-0.5f, -0.5f, -0.5f}, {0.5f, 0.5f, 0.5f})),
            Material{InterfaceMaterial{}});
  scene.shapes[0].interior = Id<Medium>{0};
  add_sky(scene, 1);
  set_camera(scene, {1.3, 1.7, -2}, {0, 0, 0}, {0, 1, 0}, 0.3, 16, 16);
  scene.settings.max_depth = deepest;
  const Measured b = measure(scene, 64);
  expect_relative("cloud of albedo 1 − 10⁻⁷ under a sky of 1", 1, b.mean, 2e-5, b.standard_error);
}

}  // namespace
}  // namespace vitrail::test::surfaces_test
