// SPDX-License-Identifier: Apache-2.0
#include "tracer/bsdf/principled.h"

#include <gtest/gtest.h>

#include <cmath>

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

}  // namespace
}  // namespace vitrail::principled_test
