// SPDX-License-Identifier: Apache-2.0
#include "tracer/bsdf/adaptive.h"

#include <gtest/gtest.h>

#include "scene/geometry/portable_math.h"
#include "tests/laws/scattering/bsdf_laws.h"
#include "tests/laws/scattering/table_cases.h"
#include "tracer/bsdf/conductor.h"

namespace vitrail::adaptive_laws_test {
namespace {

using laws::subject;

struct Case {
  AdaptiveTable table;
  AdaptiveWarps warps = warps_of(table);
  AdaptiveBsdf bsdf(std::array<float, 4> nm = {400, 500, 600, 700}) const {
    return {&table, &warps, {nm, {}}};
  }
};

const Case& isotropic() {
  static const Case c{laws::adaptive_table({.facets = make_microfacets(0.3, 0.3), .low = 0.2, .high = 0.8})};
  return c;
}
const Case& anisotropic() {
  static const Case c{laws::adaptive_table({.facets = make_microfacets(0.15, 0.4)})};
  return c;
}

TEST(AdaptiveLaws, TablesObeyThem) {
  ASSERT_EQ(fault_of(isotropic().table), nullptr);
  const laws::Tolerances t{.energy = 0.02, .reciprocal = false};
  laws::expect_laws(subject(isotropic().bsdf()), "isotropic", t);
  laws::expect_laws(subject(anisotropic().bsdf()), "anisotropic", t);
  laws::expect_finite_at_extremes(subject(isotropic().bsdf()), "isotropic");
  laws::expect_finite_at_extremes(subject(anisotropic().bsdf()), "anisotropic");
}

// At incidences that were measured, to what the grid resolves.
TEST(AdaptiveLaws, ShowsTheFacetsThatWereMeasured) {
  const Microfacets mf = make_microfacets(0.3, 0.3);
  const ConductorBsdf metal{.microfacets = mf, .perfect = true};
  for (const std::size_t node : {1u, 3u, 5u}) {
    const auto theta = static_cast<double>(isotropic().table.theta_i[node]);
    const Vector3d out{std::sin(theta), 0, std::cos(theta)};
    double difference = 0, all = 0;
    for (int i = 0; i < 32; ++i)
      for (int j = 0; j < 32; ++j) {
        const auto s = sample(metal, out, 0, {static_cast<float>(i) / 32, static_cast<float>(j) / 32});
        if (!s) continue;
        const double expected = static_cast<double>(eval(metal, out, s->in).value[0]);
        difference +=
            std::abs(static_cast<double>(eval(isotropic().bsdf(), out, s->in).value[3]) - 0.8 * expected);
        all += 0.8 * expected;
      }
    EXPECT_LT(difference / all, 0.02) << theta;
  }
}

TEST(AdaptiveLaws, WavelengthsAreLinearAndHeldBeyondTheTable) {
  const Vector3d out{0.6, 0, 0.8}, in{-0.5, 0.1, std::sqrt(1 - 0.26)};
  const auto at = [&](float nm) {
    return static_cast<double>(eval(isotropic().bsdf({nm, nm, nm, nm}), out, in).value[0]);
  };
  EXPECT_EQ(at(360), at(400));
  EXPECT_EQ(at(830), at(700));
  EXPECT_NEAR(at(700) / at(400), 4, 1e-4);
  EXPECT_NEAR(at(475), (at(400) + at(550)) / 2, 1e-6);
}

TEST(AdaptiveLaws, AQuarterOfTheAzimuthsStandsForAll) {
  const Vector3d out{0.5, 0.3, std::sqrt(1 - 0.34)}, in{-0.45, -0.2, std::sqrt(1 - 0.2425)};
  const float there = eval(anisotropic().bsdf(), out, in).value[0];
  EXPECT_GT(there, 0.1f);
  for (const double x : {1.0, -1.0})
    for (const double y : {1.0, -1.0})
      EXPECT_FLOAT_EQ(
          eval(anisotropic().bsdf(), {out.x * x, out.y * y, out.z}, {in.x * x, in.y * y, in.z}).value[0],
          there);
  const Vector3d turned{-out.y, out.x, out.z}, in_turned{-in.y, in.x, in.z};
  EXPECT_GT(std::abs(eval(anisotropic().bsdf(), turned, in_turned).value[0] - there), 0.05f);
  EXPECT_NEAR(eval(isotropic().bsdf(), turned, in_turned).value[0],
              eval(isotropic().bsdf(), out, in).value[0], 1e-5);
}

TEST(AdaptiveLaws, WithoutNormalsTheSpectraAreAll) {
  Case c{isotropic().table};
  c.table.normalised = false;
  const Vector3d out{0.6, 0, 0.8}, in{-0.5, 0.1, std::sqrt(1 - 0.26)};
  const float with = eval(isotropic().bsdf(), out, in).value[3], without = eval(c.bsdf(), out, in).value[3];
  const Microfacets mf = make_microfacets(0.3, 0.3);
  const double scale = normal_density(mf, normalize(out + in)) / (4 * visible_area(mf, out));
  EXPECT_NEAR(static_cast<double>(with / without) / scale, 1, 0.01);
}

}  // namespace
}  // namespace vitrail::adaptive_laws_test
