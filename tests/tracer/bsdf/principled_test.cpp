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

// What comes of a sky of 1, in a direction.
template <class Model>
double albedo(const Model& model, double degrees) {
  constexpr int n = 200;
  const double theta = degrees * pi / 180;
  const Vector3d out{std::sin(theta), 0, std::cos(theta)};
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double r = std::sqrt((i + 0.5) / n), phi = 2 * pi * (j + 0.5) / n, z = std::sqrt(1 - r * r);
      sum += static_cast<double>(eval(model, out, {r * std::cos(phi), r * std::sin(phi), z}).value[0]) / z;
    }
  return sum * pi / (n * n);
}

// Blender 4.2's Cycles: a plane of glTF, base colour .5, no metal, under a sky of 1.
TEST(Principled, BelowIsTheDielectricOfGltfAsCyclesHasIt) {
  struct Row {
    double roughness, at[4];
  };
  constexpr double degrees[] = {0, 45, 60, 75};
  for (const Row& row : {Row{0.3, {.5199, .5253, .5434, .6029}}, Row{0.5, {.5186, .5231, .5332, .5563}},
                         Row{0.7, {.5146, .5173, .5222, .5334}}, Row{1, {.5069, .5093, .5124, .5192}}})
    for (int i = 0; i < 4; ++i) {
      const PrincipledBsdf bsdf{.base_color = filled(0.5f), .roughness = row.roughness, .below = true};
      EXPECT_NEAR(albedo(bsdf, degrees[i]), row.at[i], 0.01 * row.at[i])
          << "roughness " << row.roughness << ", " << degrees[i] << " degrees";
    }
}

// Without metal a white base gives back what it gets, less the little that is lost between facets.
TEST(Principled, BelowReflectsAllThatThereIs) {
  for (const double eta : {1.05, 1.3, 1.5, 1.8})
    for (const double roughness : {0.3, 0.6, 1.0})
      for (const double degrees : {0.0, 40.0, 60.0, 75.0}) {
        const PrincipledBsdf bsdf{.base_color = filled(1), .eta = eta, .roughness = roughness, .below = true};
        const double reflected = albedo(bsdf, degrees);
        EXPECT_LT(reflected, 1.01) << eta << ' ' << roughness << ' ' << degrees;
        EXPECT_GT(reflected, 0.94) << eta << ' ' << roughness << ' ' << degrees;
      }
}

TEST(Principled, BelowNoGlossIsLamberts) {
  for (const double roughness : {0.0, 0.3, 1.0})
    for (const double degrees : {0.0, 60.0, 85.0}) {
      const PrincipledBsdf bsdf{.base_color = filled(0.5f), .eta = 1, .roughness = roughness, .below = true};
      EXPECT_NEAR(albedo(bsdf, degrees), 0.5, 1e-6) << roughness << ' ' << degrees;
    }
}

// A sheet's gloss is there whatever its base lets through.
TEST(Principled, BelowASheetToo) {
  for (const double roughness : {0.3, 1.0})
    for (const double degrees : {0.0, 60.0}) {
      const PrincipledThinBsdf sheet{.base_color = filled(1), .roughness = roughness, .below = true};
      EXPECT_NEAR(albedo(sheet, degrees), 1, 0.025) << roughness << ' ' << degrees;
    }
}

}  // namespace
}  // namespace vitrail::principled_test
