// SPDX-License-Identifier: Apache-2.0
// Overlapping dielectrics with priorities: what is seen through slabs that reach into each other, against
// the closed form for the stack that the priorities leave.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "bundle/interiors.h"
#include "scene/geometry/portable_math.h"
#include "tests/support/render.h"

namespace vitrail::test::nested_dielectrics_test {
namespace {

constexpr float wide = 1000;

struct Slab {
  float lower, upper, eta;
  int priority;
  float sigma_a = 0;
  float alpha = 0;
};

void add_slab(Scene& scene, const Slab& slab) {
  DielectricMaterial glass{ConstantSpectrum{slab.eta}};
  glass.priority = slab.priority;
  glass.roughness.alpha_u = glass.roughness.alpha_v = slab.alpha;
  add_shape(scene, add_quads(scene, box_faces({-wide, -wide, slab.lower}, {wide, wide, slab.upper})),
            Material{glass});
  Medium medium;
  medium.coefficients = AbsorptionScattering{ConstantSpectrum{slab.sigma_a}, ConstantSpectrum{0}};
  scene.media.push_back(medium);
  scene.shapes.back().interior = Id<Medium>{static_cast<std::uint32_t>(scene.media.size() - 1)};
}

// From `eye_z` straight down; everything is wide enough for no light to leave it at its sides.
void look_down(Scene& scene, double eye_z) {
  OrthographicCamera camera;
  camera.camera_to_world = look_at({0.3, 0.2, eye_z}, {0.3, 0.2, eye_z - 1}, {0, 1, 0});
  camera.screen = {-1, 1, -1, 1};
  scene.camera = camera;
  scene.film.width = scene.film.height = 8;
  scene.film.crop = {0, 8, 0, 8};
  scene.film.filter = BoxFilter{};
}

Id<TriangleMesh> floor(Scene& scene, float z) {
  return add_quads(scene, {{{{-wide, -wide, z}, {wide, -wide, z}, {wide, wide, z}, {-wide, wide, z}}}});
}

double reflectance(double a, double b) { return (a - b) / (a + b) * (a - b) / (a + b); }

struct Layer {
  double eta, thickness, sigma_a;
};

// Transmittance of parallel layers in air at normal incidence with all reflections between them, without
// interference: layers are added from below.
double transmittance(const std::vector<Layer>& layers) {
  double eta = 1, t = 1, r = 0;  // of what is below, seen from within `eta`
  for (const Layer& layer : layers) {
    const double face = reflectance(eta, layer.eta), through = (1 - face) / (1 - face * r);
    const double absorbed = std::exp(-layer.sigma_a * layer.thickness);
    t = t * through * absorbed;
    r = (face + (1 - face) * (1 - face) * r / (1 - face * r)) * absorbed * absorbed;
    eta = layer.eta;
  }
  const double face = reflectance(eta, 1);
  return t * (1 - face) / (1 - face * r);
}

// The lamp below the stack, seen from above it.
void expect_seen_through(const std::vector<Slab>& slabs, const std::vector<Layer>& layers, double slack) {
  Scene scene;
  for (const Slab& slab : slabs) add_slab(scene, slab);
  add_shape(scene, floor(scene, -1), Material{DiffuseMaterial{ConstantSpectrum{0}}},
            AreaLight{ConstantSpectrum{1}});
  look_down(scene, 9);
  scene.settings.max_depth = 30;
  for (const std::uint32_t domains : {1u, 4u}) {
    const Brightness seen = brightness(render(scene, 512, domains).film);
    EXPECT_NEAR(seen.mean, transmittance(layers), slack + 4 * seen.standard_error);
    EXPECT_LT(seen.standard_error, 0.002);
  }
}

// Glass above water that reaches into it: their common part is the glass's.
TEST(NestedDielectrics, TheGreaterPriorityIsThere) {
  expect_seen_through({{0, 2, 1.33f, 1}, {1, 3, 1.6f, 2}}, {{1.33, 1, 0}, {1.6, 2, 0}}, 1e-5);
  expect_seen_through({{0, 2, 1.33f, 3}, {1, 3, 1.6f, 2}}, {{1.33, 2, 0}, {1.6, 1, 0}}, 1e-5);
}

TEST(NestedDielectrics, AMediumFillsWhatIsLeftToIt) {
  expect_seen_through({{0, 2, 1.33f, 1, 0.4f}, {1, 3, 1.6f, 2, 0.1f}}, {{1.33, 1, 0.4}, {1.6, 2, 0.1}}, 1e-5);
  expect_seen_through({{0, 2, 1.33f, 2, 0.4f}, {1, 3, 1.6f, 1, 0.1f}}, {{1.33, 2, 0.4}, {1.6, 1, 0.1}}, 1e-5);
}

// A slab within another of greater priority is not there; two of one material that overlap are one.
TEST(NestedDielectrics, FacesInsideAreNotThere) {
  expect_seen_through({{0, 3, 1.5f, 2}, {1, 2, 2.4f, 1}}, {{1.5, 3, 0}}, 1e-5);
  Scene scene;
  const auto faces = box_faces({-wide, -wide, 0}, {wide, wide, 2});
  auto all = box_faces({-wide, -wide, 1}, {wide, wide, 3});
  all.insert(all.end(), faces.begin(), faces.end());
  DielectricMaterial glass{ConstantSpectrum{1.5f}};
  glass.priority = 1;
  add_shape(scene, add_quads(scene, all), Material{glass});
  add_shape(scene, floor(scene, -1), Material{DiffuseMaterial{ConstantSpectrum{0}}},
            AreaLight{ConstantSpectrum{1}});
  look_down(scene, 9);
  scene.settings.max_depth = 30;
  const Brightness seen = brightness(render(scene, 512).film);
  EXPECT_NEAR(seen.mean, transmittance({{1.5, 3, 0}}), 1e-5 + 4 * seen.standard_error);
}

TEST(NestedDielectrics, RoughFacesStandInTheirSurroundings) {
  const float alpha = 0.01f;
  expect_seen_through({{0, 2, 1.33f, 1, 0, alpha}, {1, 3, 1.6f, 2, 0, alpha}}, {{1.33, 1, 0}, {1.6, 2, 0}},
                      2e-3);
}

// The sun through the stack, on a floor whose one reflection is seen from below the stack.
TEST(NestedDielectrics, ConnectionsRefractThroughWhatIsThere) {
  Scene scene;
  add_slab(scene, {0, 2, 1.33f, 1, 0.4f});
  add_slab(scene, {1, 3, 1.6f, 2, 0.1f});
  add_shape(scene, floor(scene, -1), Material{DiffuseMaterial{ConstantSpectrum{0.5f}}});
  DistantLight sun;
  sun.irradiance = ConstantSpectrum{2};
  sun.direction = {0, 0, -1};
  scene.lights.push_back(Light{sun});
  look_down(scene, -0.5);
  scene.settings.max_depth = 1;
  const Brightness seen = brightness(render(scene, 256).film);
  const double passes = transmittance({{1.33, 1, 0.4}, {1.6, 2, 0.1}});
  EXPECT_NEAR(seen.mean, 0.5 / pi * 2 * passes, 1e-5 + 4 * seen.standard_error);
  EXPECT_LT(seen.standard_error, 1e-4);
}

TEST(Interiors, AreKeptApartInAByte) {
  Manifest manifest;
  manifest.media.resize(255);
  EXPECT_EQ(Interiors(manifest).medium(255), 254);
  DielectricMaterial glass;
  for (int i = 0; i < 7; ++i) {
    glass.priority = i + 1;
    manifest.surfaces.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(i)});
    manifest.materials.push_back(Material{glass});
  }
  EXPECT_THROW(Interiors{manifest}, Error);
  manifest.media.resize(1);
  const Interiors interiors(manifest);
  // Into all of them, the least first: each face is there; out again: none but that of the last one left.
  std::uint8_t state = interiors.state_in(0);
  for (const Surface& surface : manifest.surfaces) {
    EXPECT_TRUE(interiors.face(state, surface, true));
    state = interiors.beside(state, surface, false, true);
  }
  EXPECT_EQ(interiors.medium(state), 0);
  for (const Surface& surface : manifest.surfaces) {
    EXPECT_EQ(interiors.face(state, surface, false).has_value(), &surface == &manifest.surfaces.back());
    state = interiors.beside(state, surface, true, true);
  }
  EXPECT_EQ(state, interiors.state_in(0));
}

}  // namespace
}  // namespace vitrail::test::nested_dielectrics_test
