// SPDX-License-Identifier: Apache-2.0
// Every number of a light is of one light, and no light has another.
#include "tracer/lights/light_ref.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/tracer/lights/light_fixtures.h"

namespace vitrail::light_ref_test {
namespace {

// Kinds without lights stand first, last, alone and side by side.
const std::vector<std::array<std::size_t, light_kinds>> some_counts{
    {3, 2, 4, 1, 2, 3}, {0, 2, 0, 0, 2, 0}, {0, 0, 0, 0, 0, 1}, {5, 0, 0, 0, 0, 0}, {0, 0, 0, 3, 1, 0}};

TEST(LightNumbers, CountKindByKind) {
  for (const auto& counts : some_counts) {
    const LightNumbers numbers(counts);
    std::size_t number = 0;
    for (std::size_t kind = 0; kind < light_kinds; ++kind)
      for (std::uint32_t index = 0; index < counts[kind]; ++index, ++number) {
        const LightRef light{static_cast<LightKind>(kind), index};
        EXPECT_EQ(numbers.light(number), light) << number;
        EXPECT_EQ(numbers.number(light), number) << number;
      }
    EXPECT_EQ(numbers.size(), number);
  }
}

TEST(LightNumbers, ChooseFarLightsAloneAndTheOthersTogether) {
  for (const auto& counts : some_counts) {
    const LightNumbers numbers(counts);
    std::size_t choice = LightNumbers::choice_of_tree;
    for (std::size_t number = 0; number < numbers.size(); ++number) {
      const LightRef light = numbers.light(number);
      if (light.kind == LightKind::infinite) continue;  // is never chosen
      if (light.kind < LightKind::distant) {
        EXPECT_EQ(numbers.choice(light), LightNumbers::choice_of_tree);
        continue;
      }
      EXPECT_EQ(numbers.choice(light), ++choice);
      EXPECT_EQ(numbers.single_light(choice), light);
    }
  }
}

TEST(LightNumbers, AreThoseOfTheSampler) {
  const Spectrum white = ConstantSpectrum{1};
  const std::vector<EmissiveTriangle> triangles{{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}, 0},
                                                {{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}, {}, 1}};
  const std::vector<AreaLight> area_lights{{.radiance = white}};
  const std::vector<Light> lights{{PointLight{{0, 0, 2}, white}},
                                  {DistantLight{{0, 0, -1}, white}},
                                  {InfiniteLight{white}},
                                  {PointLight{{0, 0, 3}, white}}};
  LightScene scene;
  scene.area_lights = area_lights;
  scene.triangles = triangles;
  scene.lights = lights;
  const LightSampler s = make_light_sampler(scene, test::only(nullptr));
  EXPECT_EQ(s.numbers.size(), triangles.size() + lights.size());
  EXPECT_EQ(s.emitters.size(), 2u);
  EXPECT_EQ(s.numbers.number({LightKind::emitter, 1}), 3u);
  EXPECT_EQ(s.numbers.single_light(1), (LightRef{LightKind::distant, 0}));
  EXPECT_EQ(s.share.size(), 2u);
  for (const LightSampler::Slot& slot : s.slots) EXPECT_LE(slot.light.kind, LightKind::emitter);
}

}  // namespace
}  // namespace vitrail::light_ref_test
