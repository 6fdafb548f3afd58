// SPDX-License-Identifier: Apache-2.0
#include "tracer/bsdf/microfacet.h"
#include "tracer/simd/quick_math.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "scene/geometry/portable_math.h"
#include "tests/laws/scattering/bsdf_laws.h"
#include "tests/laws/scattering/rough_cases.h"
#include "tests/laws/scattering/sphere_cells.h"

namespace vitrail::microfacet_laws_test {
namespace {

std::vector<Vector3d> normals_seen(const Microfacets& mf, Vector3d v) {
  std::vector<Vector3d> result;
  for (int i = 0; i < 60; ++i)
    for (int j = 0; j < 60; ++j)
      result.push_back(sample_visible_normal(
          mf, v, {(static_cast<float>(i) + 0.5f) / 60, (static_cast<float>(j) + 0.5f) / 60}));
  return result;
}

double integral(const laws::SphereCells& cells, const std::function<double(Vector3d)>& f) {
  double sum = 0;
  for (double x : cells.integrate(f)) sum += x;
  return sum;
}

// Their areas, seen from above, add up to the surface's; seen from v, to σ(v).
TEST(MicrofacetLaws, AreasAddUp) {
  for (const Microfacets& mf : laws::rough_cases())
    for (Vector3d v : laws::incidences()) {
      const laws::SphereCells cells(normals_seen(mf, v));
      const double seen =
          integral(cells, [&](Vector3d m) { return normal_density(mf, m) * std::max(0.0, dot(v, m)); });
      EXPECT_NEAR(seen / visible_area(mf, v), 1, 2e-3) << laws::name_of(mf) << ", cos θ = " << v.z;
    }
}

TEST(MicrofacetLaws, MaskingIsWhatIsNotSeen) {
  for (const Microfacets& mf : laws::rough_cases()) {
    const Vector3d m = normalize(Vector3d{0.01, -0.02, 1});
    double previous = 1;
    for (Vector3d v : laws::incidences()) {
      v = {std::hypot(v.x, v.y), 0, v.z};
      const double g = masking(mf, v, m);
      EXPECT_LE(g, previous + 1e-12);
      EXPECT_GT(g, 0);
      EXPECT_DOUBLE_EQ(g, masking(mf, -v, m)) << "seen from below, m.z > 0 still";
      EXPECT_EQ(masking(mf, v, -v), 0);
      EXPECT_NEAR(g * visible_area(mf, v), v.z, 1e-12);
      const double both = shadowing_over_cosines(mf, v, v) * v.z * v.z;
      EXPECT_NEAR(both, mf.masking == Masking::separable ? g * g : g / (2 - g), 1e-9);
      previous = g;
    }
  }
}

// The normals that are sampled follow the pdf that is claimed: the laws of a pdf, for a "model" whose
// directions are normals.
TEST(MicrofacetLaws, VisibleNormalsFollowTheirPdf) {
  for (const Microfacets& mf : laws::rough_cases()) {
    laws::Subject normals;
    normals.pdf = [=](Vector3d v, Vector3d m) { return visible_normal_pdf(mf, v, m); };
    normals.eval = [=](Vector3d v, Vector3d m) {
      const double p = visible_normal_pdf(mf, v, m);
      return BsdfValue{filled(static_cast<float>(p)), p};
    };
    normals.sample = [=](Vector3d v, float, Point2f u) -> std::optional<BsdfSample> {
      const Vector3d m = sample_visible_normal(mf, v, u);
      return BsdfSample{.in = m, .weight = filled(1), .pdf = visible_normal_pdf(mf, v, m)};
    };
    laws::expect_laws(normals, laws::name_of(mf), {.reciprocal = false, .samples = 6000});
  }
}

TEST(MicrofacetLaws, WidthsAreBroughtIntoRange) {
  EXPECT_TRUE(make_microfacets(0, 0).smooth());
  EXPECT_TRUE(make_microfacets(-1, 0).smooth());
  EXPECT_FALSE(make_microfacets(1e-9, 0).smooth());
  EXPECT_EQ(make_microfacets(1e-9, 0).alpha_v, least_alpha);
  EXPECT_EQ(make_microfacets(0.25, 0.5).alpha_u, 0.25);
}

TEST(MicrofacetLaws, InverseErf) {
  for (double y = -0.9999999; y < 1; y += 1e-4)
    EXPECT_NEAR(portable_erf(lanes::inverse_erf(y)), y, 1e-6 * (1 - std::abs(y)) + 2e-7 * std::abs(y));
  EXPECT_EQ(lanes::inverse_erf(0.0), 0);
}

}  // namespace
}  // namespace vitrail::microfacet_laws_test
