// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/laws/scattering/bsdf_laws.h"
#include "tracer/bsdf/principled.h"

namespace vitrail::principled_laws_test {
namespace {

using laws::subject;

const SampledSpectrum color{{.8f, .5f, .1f, .3f}};

// Lobes are added without taking energy from those below: what rises above 1 does in Mitsuba too.
const laws::Tolerances not_conserving{.energy = 1.5, .samples = 10000};
const laws::Tolerances conserving{.reciprocity = 1e-3, .samples = 10000};

template <class Model>
void expect_all(const Model& model, bool two_sides, double eta, const laws::Tolerances& tolerances,
                const std::string& name) {
  const laws::Subject s = subject(model, two_sides, eta);
  laws::expect_laws(s, name, tolerances);
  laws::expect_finite_at_extremes(s, name);
}

TEST(PrincipledLaws, OpaqueOnesObeyThem) {
  for (const double roughness : {0.2, 1.0}) {
    expect_all(PrincipledBsdf{.base_color = color, .roughness = roughness, .anisotropic = .6}, false, 1,
               not_conserving, fmt::format("dielectric, roughness {}", roughness));
    expect_all(PrincipledBsdf{.base_color = color,
                              .luminance = .5,
                              .roughness = roughness,
                              .metallic = .5,
                              .spec_tint = .7,
                              .sheen = .6,
                              .sheen_tint = .5,
                              .flatness = .5,
                              .clearcoat = 1},
               false, 1, not_conserving, fmt::format("everything, roughness {}", roughness));
  }
}

TEST(PrincipledLaws, BasesBelowGlossConserveEnergy) {
  for (const double roughness : {0.0, 0.3, 1.0}) {
    expect_all(PrincipledBsdf{.base_color = filled(1), .roughness = roughness, .metallic = .3, .below = true},
               false, 1, {.energy = 0.02, .samples = 10000},
               fmt::format("below gloss, roughness {}", roughness));
    expect_all(PrincipledThinBsdf{.base_color = filled(1),
                                  .roughness = roughness,
                                  .spec_trans = .4,
                                  .diff_trans = .6,
                                  .below = true},
               true, 1, {.energy = 0.02, .reciprocal = false, .samples = 10000},
               fmt::format("sheet below gloss, roughness {}", roughness));
  }
}

TEST(PrincipledLaws, MetalsConserveEnergy) {
  for (const double roughness : {0.001, 0.2, 1.0})
    expect_all(PrincipledBsdf{.base_color = filled(1), .roughness = roughness, .metallic = 1}, false, 1,
               conserving, fmt::format("metal, roughness {}", roughness));
}

TEST(PrincipledLaws, GlassObeysThem) {
  for (const double eta : {1.0, 1.5, 0.7})
    for (const double roughness : {0.1, 0.6})
      expect_all(PrincipledBsdf{.base_color = filled(1), .eta = eta, .roughness = roughness, .spec_trans = 1},
                 true, eta == 1 ? 1.001 : eta, conserving,
                 fmt::format("glass of index {}, roughness {}", eta, roughness));
}

TEST(PrincipledLaws, MixturesOfGlassAndOthersObeyThem) {
  expect_all(PrincipledBsdf{.base_color = color,
                            .luminance = .5,
                            .roughness = .4,
                            .metallic = .3,
                            .spec_trans = .6,
                            .spec_tint = .4,
                            .sheen = .5,
                            .clearcoat = .8},
             true, 1.5, not_conserving, "mixture");
}

TEST(PrincipledLaws, SheetsObeyAllButReciprocity) {
  expect_all(PrincipledThinBsdf{.base_color = filled(1), .roughness = .1, .spec_trans = 1}, true, 1,
             {.reciprocal = false, .samples = 10000}, "clear sheet");
  expect_all(PrincipledThinBsdf{.base_color = color,
                                .luminance = .5,
                                .roughness = .5,
                                .anisotropic = .5,
                                .spec_trans = .4,
                                .spec_tint = .3,
                                .sheen = .5,
                                .sheen_tint = .5,
                                .flatness = .5,
                                .diff_trans = .8},
             true, 1, {.energy = 1.5, .reciprocal = false, .samples = 10000}, "sheet of everything");
}

TEST(PrincipledLaws, DiffuseSheetsObeyThem) {
  expect_all(PrincipledThinBsdf{.base_color = color, .luminance = .5, .sheen = .5, .diff_trans = 1.2}, true,
             1, not_conserving, "diffuse sheet");
}

}  // namespace
}  // namespace vitrail::principled_laws_test
