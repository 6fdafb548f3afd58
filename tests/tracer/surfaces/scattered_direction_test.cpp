// SPDX-License-Identifier: Apache-2.0
#include "tracer/surfaces/scattered_direction.h"

#include <gtest/gtest.h>

#include "scene/geometry/portable_math.h"

namespace vitrail::scattered_direction_test {
namespace {

// A surface seen along `out`, whose shading normal leans by 0.6 rad towards +x.
struct Leaning {
  explicit Leaning(Vector3d seen_from) {
    at.out = normalize(seen_from);
    at.geometric = {0, 0, 1};
    at.front = true;
    const Vector3d normal{portable_sin(0.6), 0, portable_cos(0.6)};
    at.shading = normal;
    scattering.bsdf = ConductorBsdf{};
    scattering.frame = {{normal.z, 0, -normal.x}, {0, 1, 0}, normal};
    out = scattering.frame.to_local(at.out);
  }
  std::optional<ScatteredDirection> send(Vector3d in, bool specular) const {
    const BsdfSample chosen{.in = in, .specular = specular};
    return kept_on_its_side(scattering, at, out, chosen, scattering.frame.to_world(in));
  }
  Interaction at;
  Scattering scattering;
  Vector3d out;
};

TEST(ScatteredDirection, StaysWhereItIsOnItsSide) {
  const Leaning above({0, 0.2, 1});
  const Vector3d in = normalize(Vector3d{0, 0.1, 1});
  const auto kept = above.send(in, false);
  ASSERT_TRUE(kept);
  EXPECT_EQ(kept->world, above.scattering.frame.to_world(in));
  EXPECT_FALSE(kept->by_surface);
}

TEST(ScatteredDirection, OfAMirrorGoesByTheSurfaceInsteadOfIntoIt) {
  const Leaning grazing({-1, 0, 0.9});
  const Vector3d in{-grazing.out.x, -grazing.out.y, grazing.out.z};
  ASSERT_GT(in.z, 0);
  ASSERT_LT(grazing.scattering.frame.to_world(in).z, 0) << "the shading normal sends it into the surface";
  const auto kept = grazing.send(in, true);
  ASSERT_TRUE(kept);
  EXPECT_TRUE(kept->by_surface);
  EXPECT_NEAR(length(kept->world - Vector3d{-grazing.at.out.x, -grazing.at.out.y, grazing.at.out.z}), 0,
              1e-15);
  EXPECT_FALSE(grazing.send(in, false)) << "all else ends";
}

TEST(ScatteredDirection, GoesAnywhereThroughWhatTransmits) {
  Leaning grazing({-1, 0, 0.9});
  grazing.scattering.transmits = true;
  const Vector3d in{-grazing.out.x, -grazing.out.y, grazing.out.z};
  const auto kept = grazing.send(in, false);
  ASSERT_TRUE(kept);
  EXPECT_EQ(kept->world, grazing.scattering.frame.to_world(in));
}

}  // namespace
}  // namespace vitrail::scattered_direction_test
