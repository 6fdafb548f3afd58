// SPDX-License-Identifier: Apache-2.0
#include "tracer/bsdf/fourier.h"

#include <gtest/gtest.h>

#include "scene/geometry/portable_math.h"
#include "scene/spectra/srgb_basis.h"
#include "tests/laws/scattering/bsdf_laws.h"
#include "tests/laws/scattering/table_cases.h"
#include "tracer/bsdf/conductor.h"
#include "tracer/bsdf/dielectric.h"

namespace vitrail::fourier_laws_test {
namespace {

using laws::fourier_table;
using laws::subject;

double lambert(Vector3d out, Vector3d in) { return out.z * in.z > 0 ? 0.5 * std::abs(in.z) / pi : 0; }

laws::Lobe metal(double alpha) {
  const ConductorBsdf b{.microfacets = make_microfacets(alpha, alpha), .perfect = true};
  return [b](Vector3d out, Vector3d in) {
    return out.z > 0 && in.z > 0 ? static_cast<double>(eval(b, out, in).value[0]) : 0.0;
  };
}

// A table, and a BSDF of it.
struct Case {
  FourierTable table;
  FourierIntegrals integrals = integrals_of(table);
  std::array<SampledSpectrum, 3> primaries{{{{1, 0, 0, 0.25f}}, {{0, 1, 0, 0.5f}}, {{0, 0, 1, 0.25f}}}};
  FourierBsdf bsdf() const { return {&table, &integrals, primaries}; }
};

std::vector<Vector3d> directions() {
  std::vector<Vector3d> all;
  for (const double z : {1.0, 0.999, 0.8, 0.45, 0.2, 0.03, -0.01, -0.6, -1.0})
    for (const double phi : {0.0, 0.7, 2.0, pi})
      all.push_back({safe_sqrt(1 - z * z) * std::cos(phi), safe_sqrt(1 - z * z) * std::sin(phi), z});
  return all;
}

TEST(FourierLaws, ADiffuseTableIsLambert) {
  const std::array<double, 3> color{0.8, 0.4, 0.2};
  const Case grey{fourier_table(lambert, 6, 3)}, colored{fourier_table(lambert, 6, 3, 1, &color)};
  ASSERT_EQ(fault_of(grey.table), nullptr);
  for (const Vector3d out : directions())
    for (const Vector3d in : directions()) {
      EXPECT_NEAR(eval(grey.bsdf(), out, in).value[0], lambert(out, in), 1e-6);
      EXPECT_NEAR(pdf(grey.bsdf(), out, in), 2 * lambert(out, in), 1e-6);
      for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(eval(colored.bsdf(), out, in).value[i],
                    color[static_cast<std::size_t>(i)] * lambert(out, in), 1e-6);
    }
  EXPECT_NEAR(laws::albedo(subject(grey.bsdf(), true), {0.6, 0, -0.8}).mean, 0.5, 1e-5);
}

TEST(FourierLaws, ALobeFollowsItsExpansion) {
  const Case c{fourier_table(metal(0.4), 40, 64)};
  const laws::Lobe f = metal(0.4);
  double worst = 0;
  for (const Vector3d out : directions())
    for (const Vector3d in : directions())
      if (out.z > 0.1 && in.z > 0.1)
        worst = std::max(worst, std::abs(static_cast<double>(eval(c.bsdf(), out, in).value[2]) - f(out, in)) /
                                    (f(out, in) + 0.05));
  EXPECT_LT(worst, 0.01);
  EXPECT_EQ(eval(c.bsdf(), {0.6, 0, -0.8}, {0.6, 0, -0.8}).value, filled(0));
  const auto expected = laws::albedo(
      subject(ConductorBsdf{.microfacets = make_microfacets(0.4, 0.4), .perfect = true}), {0.6, 0, 0.8});
  EXPECT_NEAR(laws::albedo(subject(c.bsdf()), {0.6, 0, 0.8}).mean, expected.mean, 2e-3);
}

TEST(FourierLaws, TablesObeyThem) {
  const laws::Tolerances t{.energy = 2e-3, .reciprocal = false};
  const Case diffuse{fourier_table(lambert, 6, 1)}, lobe{fourier_table(metal(0.4), 40, 64)};
  const DielectricBsdf glass{1.5, make_microfacets(0.4, 0.4)};
  const Case rough_glass{fourier_table(
      [&](Vector3d out, Vector3d in) { return static_cast<double>(eval(glass, out, in).value[0]); }, 40, 64,
      1.5f)};
  laws::expect_laws(subject(diffuse.bsdf(), true), "diffuse", {});
  laws::expect_laws(subject(lobe.bsdf()), "lobe", t);
  (void)rough_glass;
  for (const Case* c : {&diffuse, &lobe}) laws::expect_finite_at_extremes(subject(c->bsdf(), true), "table");
}

// Red, green and blue add up to white, and have their colours under white light (scene/spectra/color.h).
TEST(FourierLaws, PrimariesAreWhiteTogether) {
  for (double nm = 300; nm < 900; nm += 7) {
    const auto rgb = srgb_basis(nm);
    EXPECT_NEAR(rgb[0] + rgb[1] + rgb[2], 1, 2e-5);
    for (const double x : rgb) EXPECT_GE(x, 0);
  }
}

}  // namespace
}  // namespace vitrail::fourier_laws_test
